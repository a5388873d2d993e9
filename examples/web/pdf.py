"""The book as one PDF, printed by a headless Chromium.

    pdf.py FOLDER_OF_THE_PAGES FILE

The chapters' articles are put into one page: figures are their pictures, answers are open, texts that differ are shown.
It is printed twice, because only the first print tells on which page a chapter begins, which the contents want to say.
"""
import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CHROMIUM = ["chromium", "--headless=new", "--hide-scrollbars", "--no-first-run", "--use-gl=angle", "--use-angle=gl-egl",
            "--ignore-gpu-blocklist", "--disable-gpu-sandbox", "--no-pdf-header-footer", "--generate-pdf-document-outline",
            # Chapter 21 has a table that is measured on the device.
            "--virtual-time-budget=10000"]
COVER = "chapter15_1.png"
ABOUT = "<p>%s Each figure is what the command below it draws. Guess before you read an answer.</p>"
ALWAYS = {"What accuracy costs here", "A hard case"}  # in the contents nothing new
PAGE = """<!DOCTYPE html>
<html lang="en" data-scheme="light"><head><meta charset="utf-8"><base href="%(base)s"><title>Lighting</title>
<link rel="stylesheet" href="style.css"><link rel="stylesheet" href="book.css"><link rel="stylesheet" href="paper.css"><style>%(style)s</style></head>
<body class="book paper">
<section class="cover"><h1>Lighting</h1>%(about)s<img src="%(cover)s" alt=""></section>
<section class="contents"><h2>Contents</h2>%(contents)s</section>
%(chapters)s
<script src="precision.js"></script></body></html>"""
MARGINS = '@page %s { @top-center { content: "%s"; font: 9pt sans-serif; color: #444; } }\n.%s { page: %s; }\n'


def article(site, name):
    """A chapter, its links leading into this book."""
    text = re.search(r"<article>\n(.*)</article>", (site / f"{name}.html").read_text(encoding="utf-8"), re.DOTALL)[1]
    text = re.sub(r'<form class="controls".*?</form>|<details class="numbers">.*?</details>', "", text,
                  flags=re.DOTALL)
    text = re.sub("<noscript>.*?</noscript>", "", text).replace("<details ", "<details open ").replace(' loading="lazy"', "")
    text = text.replace(" data-src=", " src=")
    text = re.sub(r'href="(chapter\d\d)\.html"', r'href="#\1"', text)
    return re.sub(r'<a href="\w+\.html">(.*?)</a>', r"\1", text)


def plain(text):
    return html.unescape(re.sub(r"<annotation.*?</annotation>|<[^>]*>", "", text))


def contents(chapters, pages):
    items = ""
    for name, text in chapters.items():
        title, *sections = re.findall(r"<h[12]>(.*?)</h[12]>", text)
        items += (f'<p><a href="#{name}">{title}</a><span class="page">{pages.get(name, "0")}</span><br>'
                  f'<small>{" · ".join(text for text in sections if text not in ALWAYS)}</small></p>\n')
    return items


def page(site, chapters, pages):
    about = ABOUT % re.search(r"</h1>\n<p>(.*?\.) Every", (site / "book.html").read_text(encoding="utf-8"), re.DOTALL)[1]
    titles = {name: plain(re.search(r"<h1>(.*?)</h1>", text)[1]) for name, text in chapters.items()}
    return PAGE % {
        "base": site.as_uri() + "/", "cover": COVER, "about": about, "contents": contents(chapters, pages),
        "style": "".join(MARGINS % (name, title.replace('"', '\\"'), name, name) for name, title in titles.items()),
        "chapters": "\n".join(f'<article class="{name}" id="{name}">{text}</article>' for name, text in chapters.items())}


def printed(text, folder):
    """The PDF, and the text of each page."""
    source, made = folder / "book.html", folder / "book.pdf"
    source.write_text(text, encoding="utf-8")
    root = ["--no-sandbox"] if os.geteuid() == 0 else []
    subprocess.run([*CHROMIUM, *root, f"--user-data-dir={folder}/profile", f"--print-to-pdf={made}", source.as_uri()], check=True,
                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    said = subprocess.run(["pdftotext", "-layout", made, "-"], check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout
    return made, said.split("\f")[:-1]


def begins(pages, chapters):
    """The first page of each chapter, which has its title above and as its heading."""
    found = {}
    for number, text in enumerate(pages, 1):
        heading = re.search(r"^ *(\d+)\. .*\n\s*\1\. ", text)
        if heading:
            found.setdefault(f"chapter{int(heading[1]):02}", number)
    assert list(found) == list(chapters), (found, list(chapters))
    return found


def main(site, file):
    chapters = {path.stem: article(site, path.stem) for path in sorted(site.glob("chapter[0-9][0-9].html"))}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        _, pages = printed(page(site, chapters, {}), folder)
        made, _ = printed(page(site, chapters, begins(pages, chapters)), folder)
        part = pathlib.Path(f"{file}.{os.getpid()}")
        shutil.copy(made, part)
        os.replace(part, file)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: pdf.py FOLDER_OF_THE_PAGES FILE")
    main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2])
