"""The tasks' Markdown as HTML: headings, paragraphs, lists, tables and code, as they use them."""
import html
import re


def words(text):
    """Code, links and bold within a paragraph. What a link leads to is not among the pages."""
    parts = re.split(r"(`[^`]+`)", re.sub(r"\[([^\]]+)\]\([^)\s]+\)", r"\1", text))
    for i, part in enumerate(parts):
        if i % 2:
            parts[i] = f"<code>{html.escape(part[1:-1])}</code>"
        else:
            parts[i] = re.sub(r"\*\*([^*]+)\*\*", r"<b>\1</b>", html.escape(part))
    return "".join(parts)


def table(lines):
    rows = [[words(cell.strip()) for cell in line.strip("|").split("|")] for line in lines]
    head = "".join(f'<th scope="col">{cell}</th>' for cell in rows[0])
    body = "\n".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows[2:])
    return f'<div class="wide" tabindex="0" role="group" aria-label="Table"><table><tr>{head}</tr>\n{body}</table></div>'


def code(lines):
    return f'<pre tabindex="0"><code>{html.escape(chr(10).join(lines))}</code></pre>'


def numbered(lines):
    """Items; a line that is indented continues one."""
    items = []
    for line in lines:
        found = re.match(r"\d+\. (.*)", line)
        if found:
            items.append(found.group(1))
        else:
            items[-1] += " " + line.strip()
    return "<ol>" + "".join(f"<li>{words(item)}</li>" for item in items) + "</ol>"


def block(lines):
    first = lines[0]
    if first.startswith("#"):
        level = len(first) - len(first.lstrip("#"))
        return f"<h{level}>{words(first[level:].strip())}</h{level}>"
    if first.startswith("|"):
        return table(lines)
    if first.startswith("    "):
        return code([line[4:] for line in lines])
    if re.match(r"\d+\. ", first):
        return numbered(lines)
    return f"<p>{words(' '.join(lines))}</p>"


def to_html(text):
    made, fence = [], re.split(r"^```\w*\n(.*?)\n```$", text, flags=re.MULTILINE | re.DOTALL)
    for i, part in enumerate(fence):
        if i % 2:
            made.append(code(part.split("\n")))
            continue
        made += [block(lines.split("\n")) for lines in re.split(r"\n\s*\n", part.strip("\n")) if lines.strip()]
    return "\n".join(made)
