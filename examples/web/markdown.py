"""Markdown as HTML, by pandoc: formulas become MathML, and what is wide scrolls by itself."""
import re
import subprocess


def to_html(text, link=lambda target: None):
    """`link` gives the address of what a link leads to; None: it is not among the pages, and the words alone stay."""
    # Without smart quotes, so that text is as it was written.
    made = subprocess.run(["pandoc", "--from=markdown-smart-implicit_figures-citations-auto_identifiers", "--to=html5", "--mathml", "--wrap=none",
                           "--columns=10000", "--no-highlight", "--email-obfuscation=none"],
                          input=text, stdout=subprocess.PIPE, text=True, encoding="utf-8", check=True).stdout

    def lead(found):
        address = link(found[1])
        return f'<a href="{address}">{found[2]}</a>' if address else found[2]

    made = re.sub(r'<a href="([^"]*)"[^>]*>(.*?)</a>', lead, made, flags=re.DOTALL)
    made = re.sub(r"<pre[^>]*>", '<pre tabindex="0">', made)
    made = re.sub(r'<table(?: style="[^"]*")?>', '<div class="wide" tabindex="0" role="group" aria-label="Table"><table>', made)
    made = re.sub(r' class="(?:header|odd|even|task-list)"| style="[^"]*"', "", made)
    made = re.sub(r"<th>", '<th scope="col">', made)
    return made.replace("</table>", "</table></div>").replace('<math display="block"', '<math display="block" tabindex="0"')
