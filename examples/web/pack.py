"""Packs the module and the pages into a folder that works by double click.

    pack.py SOURCE_FOLDER MODULE_JS FOLDER FOLDER/PROGRAM...

FOLDER gets index.html, a page for each program, what they share, and .lighting, the list of all; FOLDER/single has each
program's page as one file.
A browser fetches nothing for a page from file://, so the WebAssembly is a text in a script, and a page names each of its
scripts.
"""
import base64
import difflib
import gzip
import hashlib
import html
import os
import pathlib
import re
import shutil
import sys

INDEX = ["lighting.js", "module.js", "index.js"]
PROGRAM = ["lighting.js", "module.js", "worker.js", "png.js", "link.js", "controls.js", "editor.js", "program.js"]
EXACT = """<p><button type="button" id="compare">Compare with the exact picture</button></p>
<p id="compared" role="status"></p>
<figure id="exact" hidden><canvas id="map" width="400" height="400" role="img" aria-label="Map of the errors"></canvas>
<figcaption><small>Black: at most half a step of 1/255. Blue, green, yellow, white: 0.5, 4, 32, 255 steps.</small></figcaption>
</figure>"""
NO_SCENE = """<p>The lecture's programs draw no scene that the exact picture could be computed of; natively a test compares
their pictures with closed forms.</p>"""
# Effects are of scenes.
EXPLAIN = """<details id="explain"><summary>What is computed, and why (<code>--explain</code>)</summary>
<pre id="explained" tabindex="0"></pre></details>"""

root, module, site = (pathlib.Path(path) for path in sys.argv[1:4])
programs = [path.split("/") for path in sys.argv[4:]]
here = root / "examples/web"


def read(path):
    """In UTF-8 in any locale: the policy has digests of the bytes."""
    return path.read_text(encoding="utf-8")


def write(path, text):
    path.write_text(text, encoding="utf-8")


# As the lessons have them.
predecessors = dict(re.findall(r"\{&(\w+), &(\w+)\}", read(root / "examples/lessons/lessons.c")))


def lighting_js():
    """The module in a function, whose text a worker gets too, and the WebAssembly."""
    packed = gzip.compress(module.with_suffix(".wasm").read_bytes(), 9, mtime=0)
    return ('"use strict";\nconst LIGHTING_WASM = "%s";\nfunction lightingFactory() {\n%s\nreturn createLighting;\n}\n'
            % (base64.b64encode(packed).decode(), read(module)))


def summary(folder, name):
    text = read(root / "examples" / folder / (name + ".c"))
    return re.search(r'^    \.summary = "(.*)",$', text, re.MULTILINE).group(1)


def diff(before, after):
    """Of a program and its shaders with those of its predecessor, names aside."""
    lines = []
    for path in ("examples/lecture/%s.c", "shaders/lecture/%s.vert", "shaders/lecture/%s.frag"):
        old, new = (read(root / (path % name)).replace(name, "NAME").splitlines() for name in (before, after))
        changes = list(difflib.unified_diff(old, new, path % before, path % after, n=2, lineterm=""))
        for line in changes or [path % after + ": the same"]:
            tag = {"+": "ins", "-": "del"}.get(line[0])
            text = html.escape(line)
            lines.append(f"<{tag}>{text}</{tag}>" if tag else text)
    return "\n".join(lines)


def fill(template, **parts):
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found.group(1)], read(here / template))


def digest(text):
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


def policy(scripts, styles):
    return (f"default-src 'none'; script-src {scripts} 'wasm-unsafe-eval'; style-src {styles}; img-src blob: data:; "
            "worker-src blob:; base-uri 'none'; form-action 'none'")


def shared(names):
    # Of a file Firefox takes no other for 'self'.
    return {"policy": policy("'self' file:", "'self' file:"), "style": '<link rel="stylesheet" href="style.css">',
            "scripts": "\n".join(f'<script src="{name}"></script>' for name in names)}


def alone(names):
    texts = ["\n" + read(site / name).replace("</script", "<\\/script") for name in names]
    style = "\n" + read(site / "style.css")
    return {"policy": policy(" ".join(map(digest, texts)), digest(style)), "style": f"<style>{style}</style>",
            "scripts": "\n".join(f"<script>{text}</script>" for text in texts)}


def page(folder, name, parts, single):
    before = predecessors.get(name)
    link = before if single else f'<a href="{before}.html">{before}</a>'
    scene = folder == "lighting"
    more = EXPLAIN if scene else ""
    if before:
        more = (f"<details class=\"diff\"><summary>What differs from {before}</summary>\n<p>The predecessor is {link}.</p>\n"
                f'<pre tabindex="0">{diff(before, name)}</pre></details>')
    links = "" if single else '<nav aria-label="Pages"><a href="index.html">All programs</a></nav>'
    return fill("program.html", name=name, summary=html.escape(summary(folder, name)), links=links, more=more,
                exact=EXACT if scene else NO_SCENE, only="<code>--error</code>, " if scene else "", **parts)


def card(folder, name):
    text = html.escape(summary(folder, name))
    return (f'<li><a href="{name}.html"><canvas data-program="{name}" width="400" height="400" aria-hidden="true"></canvas>'
            f"{name}</a><br>{text}</li>\n")


def main():
    shutil.rmtree(site, ignore_errors=True)
    (site / "single").mkdir(parents=True)
    write(site / "lighting.js", lighting_js())
    for path in [*here.glob("*.js"), here / "style.css"]:
        shutil.copy(path, site)
    cards = {group: "".join(card(folder, name) for folder, name in programs if folder == group)
             for group in ("lecture", "lighting")}
    version = re.search(r'VERSION "(.*)"', read(pathlib.Path("common/base/version.h"))).group(1)
    write(site / "index.html", fill("index.html", version=html.escape(version), **cards, **shared(INDEX)))
    for folder, name in programs:
        write(site / f"{name}.html", page(folder, name, shared(PROGRAM), False))
        write(site / "single" / f"{name}.html", page(folder, name, alone(PROGRAM), True))
    files = sorted(str(path.relative_to(site)) for path in site.rglob("*") if path.is_file())
    write(site / ".lighting", "\n".join(files) + "\n")


main()
