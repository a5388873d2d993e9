"""Packs the module and the pages into a folder that works by double click.

    pack.py SOURCE_FOLDER MODULE_JS LABS_MODULE_JS LABS_JUDGE_JS PROBE_JS READER_JS FOLDER FOLDER/PROGRAM... labs/LAB...
    pack.py --own SOURCE_FOLDER FOLDER LAB_FOLDER...

The second adds pages of other labs, each a folder whose picture is FOLDER/NAME.png, to a FOLDER of the first.

FOLDER gets index.html, book.html and labs.html, a page for each program, chapter and lab, what they share, and .lighting, the
list of all; FOLDER/single has each page of a program or lab as one file. LIGHTING_NATIVE in the environment is the folder of
the native programs, which draw the book's pictures and say what they cost.
A browser fetches nothing for a page from file://, so the WebAssembly is a text in a script, and a page names each of its
scripts.
"""
import base64
import difflib
import gzip
import hashlib
import html
import json
import lzma
import os
import pathlib
import re
import shutil
import sys

import book
import costs
import markdown
import prose

INDEX = ["lighting.js", "module.js", "index.js"]
PROGRAM = ["lighting.js", "module.js", "worker.js", "png.js", "zip.js", "link.js", "controls.js", "editor.js",
           "lent.js", "share.js", "undo.js", "wipe.js", "before.js", "assembled.js", "point.js", "program.js"]
# What a page loads when a pixel is asked for.
POINTED = ["probe.js", "precision.js", "pixel.js"]
BOOK = ["module.js", "worker.js", "controls.js", "point.js", "book.js", "slides.js", "costs.js"]
LABS = ["progress.js", "labs.js"]
AT_ONCE = 250000  # bytes that a chapter loads before its reader does anything
BORROW = ["precision.js", "qrcode.js", "borrow.js"]
LAB = ["labs_module.js", "module.js", "progress.js", "lab_worker.js", "png.js", "zip.js", "controls.js",
       "editor.js", "wipe.js", "point.js", "lab.js"]
# And with the first check.
LAB_POINTED = ["labs_judge.js", "precision.js", "pixel.js", "wrong.js"]
CHECK = """<div class="row"><button type="button" id="check">Check</button></div>
<p><small>Draws your files in a dozen scenes and says what is wrong, as <code>check</code> does natively.</small></p>"""
NO_CHECK = """<p>This lab is written in C, which the browser does not compile. Check it natively:
<code>examples/run check lab03 mine</code>.</p>"""
NOTES = {"lab03_normal_matrix": "The browser compiles no C: the picture is that of the starter. Your text is kept, and saved "
                                "below to be handed in.",
         "lab10_budget": "Of <code>budget.c</code> the browser reads assignments of numbers, which may have names "
                         "(<code>#define</code> or <code>const int</code>)."}
EXACT = """<p><button type="button" id="compare">Compare with the exact picture</button></p>
<p id="compared" role="status"></p>
<figure id="exact" hidden><canvas id="map" width="400" height="400" role="img" aria-label="Map of the errors"></canvas>
<figcaption><small>Black: at most half a step of 1/255. Blue, green, yellow, white: 0.5, 4, 32, 255 steps.</small></figcaption>
</figure>"""
NO_SCENE = """<p>The lecture's programs draw no scene that the exact picture could be computed of; natively a test compares
their pictures with closed forms.</p>"""
HEAD = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="%s">"""
# See editor.js.
EDITOR = """<div class="row">
<label>File <select class="files"></select></label>
<label><input type="checkbox" class="live" checked> Draw while I type</label>
</div>
<div class="text"><pre class="gutter" aria-hidden="true"></pre><textarea class="source" spellcheck="false"
 autocapitalize="off" autocomplete="off" wrap="off" aria-label="Source of the %s"
 aria-describedby="editor-keys"></textarea><div class="colours" aria-hidden="true"><pre></pre></div></div>
<p id="editor-keys"><small>Tab and Shift+Tab indent what you type; Escape, then Tab, leaves.</small></p>
<div class="row">
<button type="button" class="apply">Apply (Ctrl+Enter)</button>
<button type="button" class="revert">Restore all files</button>
<button type="button" class="save">Save this file</button>%s
<button type="button" class="open">Open files or a ZIP</button>
<input type="file" class="chosen" multiple accept=".zip,.vert,.frag,.glsl,.c" aria-label="Files to open" hidden>
</div>
<p class="said" role="status"></p>
<ul class="errors" aria-label="Errors"></ul>"""
ALL = '\n<button type="button" class="all">Save all as ZIP</button>'
SHADERS = '<section aria-labelledby="shaders-heading" id="editor">\n<h2 id="shaders-heading">Shaders</h2>\n%s%s\n</section>\n'
# Effects are of scenes.
ASSEMBLED = """<details id="assembled"><summary>The shader that lights, as assembled for this scene</summary>
<p><small>What the driver gets, without the parts that this scene's conditions leave out. It is made of the files below. \u2190 names the
effect that calls for a line.</small></p>
<pre tabindex="0"></pre>
<details><summary>The receipt: each effect, and its lines (<code>--explain --verbose</code>)</summary>
<pre tabindex="0"></pre></details></details>\n"""
# See files.js.
FILES = """<section aria-labelledby="files-heading">
<h2 id="files-heading">%s</h2>
<div class="row"><button type="button" id="choose-file">Choose OBJ, PLY or glTF</button></div>
<input type="file" id="file" multiple accept=".obj,.mtl,.ply,.gltf,.glb,.bin,.png,.jpg,.jpeg,.bmp,.tga" aria-label="Files of the model" hidden>
<p><small>Or drop it on the page: a file, all files of a model, or their folder. What reads it is loaded then, %.0f kB, once.
The command reads other formats, too.</small></p>
<p id="files-said" role="status"></p>
</section>
"""
NO_FILES = """<p><small>In one file this page reads no models. That of all pages does: <code>examples/run web -o pages</code>, then
pages/%s.html.</small></p>"""
EXPLAIN = """<details id="explain"><summary>What is computed, and why (<code>--explain</code>)</summary>
<pre id="explained" tabindex="0"></pre></details>"""

if sys.argv[1] == "--own":
    root, site, *own = (pathlib.Path(path) for path in sys.argv[2:])
    labs = sorted(path.name for path in (root / "examples/labs").glob("lab[0-9][0-9]_*"))
else:
    root, module, labs_module, labs_judge, probe_module, reader_module, site = (pathlib.Path(path) for path in sys.argv[1:8])
    own, paths = [], [path.split("/") for path in sys.argv[8:]]
    programs = [path for path in paths if path[0] != "labs"]
    labs = [name for folder, name in paths if folder == "labs"]
lab_folders = {name: root / "examples/labs" / name for name in labs} | {path.name: path for path in own}
here = root / "examples/web"


def read(path):
    """In UTF-8 in any locale: the policy has digests of the bytes."""
    return path.read_text(encoding="utf-8")


def stripped(text):
    """A script or style without what a browser does not need: indentation, and comments that have lines of their own or end
    one. No text in one goes over a line's end."""
    text = re.sub(r"^[ \t]*/\*(?:[^*]|\*(?!/))*\*/[ \t]*\n", "", text, flags=re.MULTILINE)
    text = re.sub(r"[ \t]*/\*[^*\n]*\*/[ \t]*$", "", text, flags=re.MULTILINE)
    return re.sub(r"^[ \t]+|^\n", "", text, flags=re.MULTILINE)


def write(path, text):
    path.write_text(text, encoding="utf-8")


# As the lessons have them.
predecessors = dict(re.findall(r"X\((\w+), &(\w+)\)", read(root / "examples/lessons/lessons.c")))
assert predecessors, "lessons.c: no LESSON_LIST"


def packed(data):
    """As module.js unpacks it."""
    filters = [{"id": lzma.FILTER_LZMA1, "preset": 9 | lzma.PRESET_EXTREME, "lc": 3, "lp": 0, "pb": 0}]
    return {"packed": base64.b64encode(lzma.compress(data, lzma.FORMAT_RAW, filters=filters)).decode(), "size": len(data)}


def module_js(name, module):
    """The module as {packed, size, factory}; a worker gets the factory's text, too."""
    return ('"use strict";\nconst %s = {...%s, factory: function () {\n%s\nreturn createLighting;\n}};\n'
            % (name, json.dumps(packed(module.with_suffix(".wasm").read_bytes())), read(module)))


def summary(folder, name):
    text = read(root / "examples" / folder / (name + ".c"))
    return re.search(r'^    \.summary = "(.*)",$', text, re.MULTILINE).group(1)


def compared(path, name):
    """The lines of a file that count: of C neither comments nor what --help says, as in lessons."""
    text = read(root / (path % name)).replace(name, "NAME")
    if path.endswith(".c"):
        text = re.sub(r"/\*.*?\*/", "", text[:text.index("const Example ")], flags=re.DOTALL)
    return [line.rstrip() for line in text.splitlines() if line.strip()]


def diff(before, after):
    """Of a program and its shaders with those of its predecessor, names aside."""
    lines = []
    for path in ("examples/lecture/%s.c", "shaders/lecture/%s.vert", "shaders/lecture/%s.frag"):
        changes = difflib.unified_diff(compared(path, before), compared(path, after), path % before, path % after, n=2, lineterm="")
        changes = ["\u22ef" if line.startswith("@@") else line for line in changes]
        for line in changes or [path % after + ": the same"]:
            tag = None if line[:4] in ("--- ", "+++ ") else {"+": "ins", "-": "del"}.get(line[0])
            text = html.escape(line)
            lines.append(f"<{tag}>{text}</{tag}>" if tag else text)
    return "\n".join(lines)


def fill(template, **parts):
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found.group(1)], read(here / template))


def digest(text):
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


def policy(scripts, styles, images=""):
    return (f"default-src 'none'; script-src {scripts} 'wasm-unsafe-eval'; style-src {styles}; img-src blob: data:{images}; "
            "worker-src blob:; base-uri 'none'; form-action 'none'")


def shared(names):
    # To versions of Firefox before 153 a file may have no 'self'.
    return {"head": HEAD % policy("'self' file:", "'self' file:", " 'self' file:"),
            "style": '<link rel="stylesheet" href="style.css">', "scripts": "\n".join(f'<script src="{name}"></script>' for name in names)}


def alone(names):
    """In one file. The module that runs shaders does what the pages' own does, and takes its place."""
    for last, drawn, (probe, *pointed) in ((PROGRAM[-1], PROGRAM[0], POINTED), (LAB[-1], LAB[0], LAB_POINTED)):
        if last in names:
            names = [probe if name == drawn else name for name in names[:-1]] + [*pointed, last]
    texts = ["\n" + read(site / name).replace("</script", "<\\/script") for name in names]
    style = "\n" + read(site / "style.css") + read(site / "pixel.css")
    return {"head": HEAD % policy(" ".join(map(digest, texts)), digest(style)), "style": f"<style>{style}</style>",
            "scripts": "\n".join(f"<script>{text}</script>" for text in texts)}


def bytes_of(name):
    """Packed as a server sends it; 0 of a picture that is not drawn."""
    path = site / name
    return len(gzip.compress(path.read_bytes(), 9)) if path.exists() else 0


def weight(names):
    """In kB."""
    return sum(map(bytes_of, names)) / 1000


def page(folder, name, parts, single):
    before = predecessors.get(name)
    link = before if single else f'<a href="{before}.html">{before}</a>'
    scene = folder != "lecture"
    files = NO_FILES % name if single else FILES % ("A scene of your own" if folder == "file" else "A model instead of the shape",
                                                    weight(["reader.js"]))
    more = EXPLAIN if scene else ""
    if before:
        more = (f"<details class=\"diff\"><summary>What differs from {before}</summary>\n<p>The predecessor is {link}.</p>\n"
                f'<pre tabindex="0">{diff(before, name)}</pre></details>')
    links = "" if single else '<nav aria-label="Pages"><a href="index.html">All programs</a></nav>'
    shaders = SHADERS % (ASSEMBLED if scene else "", EDITOR % ("shader file", ALL)) + more
    # A lecture program is its shaders; a scene its options.
    return fill("program.html", name=name, files=files if reads_files(folder, name) else "", summary=html.escape(summary(folder, name)), links=links,
                first="" if scene else shaders, last=shaders if scene else "", exact=EXACT if scene else NO_SCENE,
                only="<code>--error</code>, " if scene else "", pointed=" ".join(POINTED), weight=f"{weight([*POINTED, 'pixel.css']):.0f}", **parts)


def scripts_of(folder, name):
    """Those of a page: lecture programs have no scene, and Scene has nothing to draw before there is a file."""
    scripts = [script for script in PROGRAM if folder != "lecture" or script != "assembled.js"]
    if reads_files(folder, name):
        scripts.insert(-1, "files.js")
    return scripts[1:] if folder == "file" else scripts


def reads_files(folder, name):
    return folder == "file" or "SHAPE_PARAMETERS" in read(root / "examples" / folder / (name + ".c"))


def card(folder, name):
    text = html.escape(summary(folder, name))
    return (f'<li><a href="{name}.html"><canvas data-program="{name}" width="400" height="400" aria-hidden="true"></canvas>'
            f"{re.sub('(?<=[a-z_])(?=[A-Z])|(?<=_)', '<wbr>', name)}</a><br>{text}</li>\n")


def title(lab):
    return re.match(r"# (.*)", read(lab_folders[lab] / "TASK.md")).group(1)


def starter(folder):
    """Its files, as lab_files has them."""
    described = json.loads(read(folder / "lab.json"))
    base = described.get("shaders", folder.name.split("_")[0].lower())
    names = [] if described.get("special") == "matrices" else [base + ".vert", base + ".frag"]
    names += [described["code"]] if "code" in described else []
    return [{"name": name, "text": read(folder / name)} for name in names]


def lab_page(name, parts, single):
    all_labs = list(lab_folders)
    at = all_labs.index(name)
    beside = [(all_labs[i], word) for i, word in ((at - 1, "Previous"), (at + 1, "Next")) if 0 <= i < len(all_labs)]
    links = "".join(f' <a href="{lab}.html">{word}</a>' for lab, word in beside)
    links = "" if single else f'<nav aria-label="Pages"><a href="labs.html">All labs</a>{links}</nav>'
    # Without the title and the picture.
    task = re.sub(r"^# .*\n+(!\[.*\n+)?", "", read(lab_folders[name] / "TASK.md"))
    task, what, more = task.replace("## Run and check", "## The same natively").partition("\n## What there is\n")
    note = f"<p>{NOTES[name]}</p>" if name in NOTES else ""
    return fill("lab.html", name=name, title=html.escape(title(name)), task=markdown.to_html(task),
                files=html.escape(json.dumps(starter(lab_folders[name]))), more=markdown.to_html(what + more), links=links, note=note,
                editor=EDITOR % ("file", ""), check=NO_CHECK if name == "lab03_normal_matrix" else CHECK,
                pointed=" ".join(LAB_POINTED), weight=f"{weight([*LAB_POINTED, 'pixel.css']):.0f}", **parts)


def lab_card(name):
    return (f'<li><a href="{name}.html"><img src="{name}.png" width="400" height="400" alt="" loading="lazy">'
            f'{html.escape(title(name))}</a><br><small data-lab="{name}"></small></li>\n')


def own_js(folder):
    """Its files, which the page's module reads: not in plain letters, because its solutions are among them."""
    texts = {str(path.relative_to(folder)): read(path) for path in sorted(folder.rglob("*"))
             if path.suffix in (".vert", ".frag", ".glsl", ".json", ".c") and path.is_file()}
    return '"use strict";\nconst OWN = %s;\n' % json.dumps(packed(json.dumps(texts).encode()))


def write_own():
    """Again what lists all labs or links to the next."""
    write(site / "labs.html", fill("labs.html", cards="".join(map(lab_card, lab_folders)), **shared(LABS)))
    write(site / f"{labs[-1]}.html", lab_page(labs[-1], shared(LAB), False))
    for folder in own:
        name = folder.name
        write(site / f"own_{name}.js", own_js(folder))
        scripts = [f"own_{name}.js", *LAB]
        write(site / f"{name}.html", lab_page(name, shared(scripts), False))
        write(site / "single" / f"{name}.html", lab_page(name, alone(scripts), True))


def write_labs():
    write(site / "labs_module.js", module_js("LIGHTING", labs_module))
    write(site / "labs_judge.js", module_js("PROBE", labs_judge))
    write(site / "labs.html", fill("labs.html", cards="".join(map(lab_card, labs)), **shared(LABS)))
    for name in labs:
        shutil.copy(root / "examples/labs" / name / "expected.png", site / f"{name}.png")
        write(site / f"{name}.html", lab_page(name, shared(LAB), False))
        write(site / "single" / f"{name}.html", lab_page(name, alone(LAB), True))


def beside(all_chapters, at):
    """Links to the list, the slides, and the chapters before and after."""
    links = '<a href="book.html">Contents</a> <a href="?slides">Slides</a>'
    for i, word, kind in ((at - 1, "Before", ""), (at + 1, "Next", ' class="next"')):
        if 0 <= i < len(all_chapters):
            other = all_chapters[i]
            links += f' <a{kind} href="{other.name}.html">{word}: {html.escape(book.plain(other.title))}</a>'
    return links


def write_book():
    all_chapters = book.chapters()
    programs = "LIGHTING_NATIVE" in os.environ and pathlib.Path(os.environ["LIGHTING_NATIVE"])
    pointed = [*POINTED, "terms.js"]
    if programs:
        book.draw(site, programs)
    for at, chapter in enumerate(all_chapters):
        left = prose.unmarked(chapter)
        assert not left, f"{chapter.path.name}: numbers that nothing computes: {left}"
        scripts = [f"{kind}.js" for kind in ("formula", "precision") if f"]({kind}:" in chapter.text] + BOOK
        body = costs.fill(book.body(chapter, diff), programs, weight(["lighting.js"]))
        body = re.sub(r'data-src="([^"]*)"', lambda found: f'{found[0]} data-weight="{bytes_of(found[1])}"', body)

        def page(budget):
            return fill("chapter.html", title=html.escape(book.plain(chapter.title)), links=beside(all_chapters, at), body=body,
                        pointed=" ".join(pointed), weight=f"{weight([*pointed, 'pixel.css']):.0f}", module=str(bytes_of("lighting.js")),
                        budget=str(budget), **shared(scripts))

        # What the page is without the pictures and the module that its figures ask for.
        there = len(gzip.compress(page(AT_ONCE).encode(), 9)) + sum(map(bytes_of, ["style.css", "book.css", *scripts]))
        write(site / f"{chapter.name}.html", page(AT_ONCE - there))
    items = "".join(f'<li value="{chapter.number}"><a href="{chapter.name}.html">{html.escape(book.plain(chapter.title))}</a></li>\n'
                    for chapter in all_chapters)
    write(site / "book.html", fill("book.html", chapters=items, **shared([])))


def qr_library():
    """Kazuhiko Arase's, with its licence; where node has none the page has the link alone."""
    folders = [*os.environ.get("NODE_PATH", "").split(":"), "/usr/share/nodejs", "/usr/lib/node_modules"]
    found = [path for folder in folders if folder and (path := pathlib.Path(folder, "qrcode-generator/qrcode.js")).exists()]
    return read(found[0]) if found else ""


def main():
    shutil.rmtree(site, ignore_errors=True)
    (site / "single").mkdir(parents=True)
    write(site / "lighting.js", module_js("LIGHTING", module))
    write(site / "probe.js", module_js("PROBE", probe_module))
    write(site / "reader.js", module_js("READER", reader_module))
    for path in [*here.glob("*.js"), *here.glob("*.css")]:
        write(site / path.name, stripped(read(path)))
    cards = {group: "".join(card(folder, name) for folder, name in programs if folder == group)
             for group in ("lecture", "lighting")}
    version = re.search(r'VERSION "(.*)"', read(pathlib.Path("common/base/version.h"))).group(1)
    write(site / "index.html", fill("index.html", version=html.escape(version), **cards, **shared(INDEX)))
    for folder, name in programs:
        scripts = scripts_of(folder, name)
        write(site / f"{name}.html", page(folder, name, shared(scripts), False))
        if folder != "file":
            write(site / "single" / f"{name}.html", page(folder, name, alone([each for each in scripts if each != "files.js"]), True))
    write_labs()
    write_book()
    write(site / "qrcode.js", qr_library())
    write(site / "precision.html", fill("precision.html", **shared(BORROW)))


write_own() if own else main()
files = sorted(str(path.relative_to(site)) for path in site.rglob("*") if path.is_file() and path.name != ".lighting")
write(site / ".lighting", "\n".join(files) + "\n")
