"""The book: examples/chapter/NN-title.md as pages whose figures are drawn by the programs.

    book.py --places     prints the table of examples/README.md: where each section of the originals is shown

A chapter is Markdown with formulas in TeX, and

    ![CAPTION](program: NAME OPTIONS controls: OPTION,time,error,plot)   a figure, drawn live with these few controls
    ![CAPTION](change: OLD NEW)                         what differs from a program to the next
    ![CAPTION](precision: highp mediump lowp)           what the reader's own device computes
    ![CAPTION](formula: CASE live: NAME OPTIONS plain: MORE stable: MORE slider: OPTION START FROM TO STEP VALUE)
                                                        a hard case, plain, stable and exact, drawn live by a program, with the
                                                        slider in place of $ in VALUE; of MORE may be FILE=STUDY, shaders' names
    QUESTION `OPTIONS`                                  what the reader expects when these options are set in the figure
    :   ANSWER                                          above, or in the program that is named
    $$ A, \\qquad B \\allowbreak + C $$                  a formula, which may be broken there
    [NUMBER]{check="EXPRESSION"}                        a number (also a word, a formula, a vector) that tests/book computes again; which
                                                        others may stand: prose.py
    <!-- place: HEADING; HEADING -->                    what the section above shows of places.txt
    <!-- costs: NAME OPTIONS; OPTIONS; ... -->           what accuracy costs there (costs.py)
    <!-- at: NAME = {NAME} ... -->                      below a formula: its numbers at the pixel that is clicked (terms.js)
"""
import html
import math
import os
import pathlib
import re
import subprocess
import sys

import markdown
import svg

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "chapter"
SHADERS = FOLDER.parent.parent / "shaders"
FIGURE = re.compile(r"^!\[((?:[^\[\]]|\[[^\]]*\])*)\]\((program|change|precision|formula): *([^)]*)\)$", re.MULTILINE)
ANSWER = re.compile(r"`([A-Z]\w+ --[^`]+|hard_cases --[^`]+)`\n+:   ")
SETS = re.compile(r"`(--[^`]+|[A-Z]\w+(?: --[^`]+)?|hard_cases --[^`]+)`\n+:   ")
CHECK = re.compile(r'\[([^\[\]]*)\]\{check="([^"]*)"\}')
PLACE = re.compile(r"<!-- place: (.*?) -->", re.DOTALL)
AT = re.compile(r"<!-- at: (.*?) -->", re.DOTALL)
# Not in the pages' module, and how large their pictures are, so that the text below stays when they come.
STILL = {"Vectors": ' width="800" height="450"', "hard_cases": ' width="1292" height="314"'}
# Emphasis, links, code and checks left out.
PLAIN = ((CHECK, r"\1"), (re.compile(r"\[([^\]]*)\]\([^)]*\)"), r"\1"), (re.compile(r"[`*$]"), ""))


def plain(text):
    for pattern, to in PLAIN:
        text = pattern.sub(to, text)
    return " ".join(text.split())


class Figure:
    def __init__(self, chapter, number, found):
        self.caption, self.kind, rest = found.groups()
        words, _, controls = rest.partition("controls:")
        self.parts = {}
        if self.kind == "formula":
            case, *more = re.split(r"\s*\b(live|plain|stable|slider): *", rest)
            words, self.parts = f"hard_cases --case {case}", dict(zip(more[::2], more[1::2]))
        self.words = words.split()
        self.controls = controls.strip()
        self.number = f"{chapter}.{number}"
        self.name = self.words[0] if self.words else ""
        self.live = self.kind == "program" and self.name not in STILL
        drawn = self.kind in ("program", "formula")
        self.picture = f"chapter{chapter:02}_{number}.{suffix(self.name)}" if drawn else None

    def command(self):
        return "examples/run " + " ".join(self.words)


def merge(base, words):
    """The later of two values of an option wins, as in a page."""
    name, *first = base.split()
    values = {}
    for words_of in (first, words.split()):
        last = None
        for word in words_of:
            if word.startswith("--"):
                last, values[word] = word, []
            else:
                values[last].append(word)
    return " ".join([name, *(part for option, rest in values.items() for part in (option, *rest))])


def draw_one(programs, words, to):
    """The picture of a command; of a hard case its sheet."""
    name, *options = words
    quiet = {"check": True, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    if name != "hard_cases":
        subprocess.run([programs / name, *options, "-o", to], **quiet)
        if to.suffix == ".svg":
            to.write_text(svg.shorten(to.read_text(encoding="utf-8")), encoding="utf-8")
        return
    folder = to.with_suffix(".hard")
    subprocess.run([programs / name, *options, "-o", folder], **quiet)
    os.replace(folder / (options[-1] + ".png"), to)
    os.rmdir(folder)


def suffix(program):
    return "svg" if program == "Vectors" else "png"


class Chapter:
    def __init__(self, path, text):
        self.path = path
        self.number = int(path.stem[:2])
        self.text = text
        self.title = re.match(r"# (.*)\n", self.text)[1]
        self.name = f"chapter{self.number:02}"
        self.figures = [Figure(self.number, i + 1, found) for i, found in enumerate(FIGURE.finditer(self.text))]
        # Of answers that no live figure draws: the command's words by the name of the picture.
        self.answers = {f"{self.name}_answer{i + 1}.{suffix(words.split()[0])}": words
                        for i, words in enumerate(words for words in ANSWER.findall(self.text) if words.split()[0] in STILL)}
        # Of the others, in order: where a live figure draws it, the picture's name, for paper, and the command; else None.
        self.drawn = [words and (f"{self.name}_drawn{i + 1}.png", words) for i, words in enumerate(self.commands())]
        self.checks = CHECK.findall(self.text)

    def commands(self):
        """Of each answer that sets options of a program in the pages' module; None where the figure above is not such a program."""
        figures, base, found = iter(self.figures), None, []
        for part in re.finditer(f"{FIGURE.pattern}|{SETS.pattern}", self.text, re.MULTILINE):
            if part[2]:
                base = next(figures)
            elif part[4].split()[0] not in STILL:
                found.append(None if not base.live else merge(" ".join(base.words), part[4]) if part[4].startswith("--") else part[4])
        return found

    def sections(self):
        """(heading, text) of each section, the chapter's own title first."""
        parts = re.split(r"^##? (.*)\n", self.text, flags=re.MULTILINE)
        return list(zip(parts[1::2], parts[2::2]))


def chapters():
    return [Chapter(path, path.read_text(encoding="utf-8")) for path in sorted(FOLDER.glob("[0-9][0-9]-*.md"))]


def plot():
    """Error over time of the study's ball, as its table has them, both by factors; a point to be moved by book.js."""
    rows = re.findall(r"^\| \d+ \|((?: [\d.]* \|){6})$", (FOLDER.parent / "study/tables/accuracy.md").read_text(encoding="utf-8"),
                      re.MULTILINE)
    x, y = (-1, 2), (-1, 2.5)

    def place(value, range_, low, high):
        return low + (high - low) * (math.log10(value) - range_[0]) / (range_[1] - range_[0])

    def mark(kind, cx, cy):
        """A filled circle, an empty one, a cross: told apart without colours."""
        return (f'<path class="flat" d="M{cx - 3:.1f} {cy - 3:.1f}l6 6m0 -6l-6 6"/>' if kind == "flat" else
                f'<circle class="{kind}" cx="{cx:.1f}" cy="{cy:.1f}" r="3"/>')

    points, lines = "", ""
    for numbers in rows:
        cells = [float(cell) for cell in numbers.replace("|", " ").split()]
        for kind, error, ms in zip(("Phong", "Gouraud", "flat"), cells[::2], cells[1::2]):
            points += mark(kind, place(ms, x, 40, 470), place(error, y, 250, 10))
    for value in (0.1, 1, 10, 100):
        at = place(value, x, 40, 470)
        lines += f'<line x1="{at:.1f}" y1="10" x2="{at:.1f}" y2="250"/><text x="{at:.1f}" y="264" text-anchor="middle">{value} ms</text>'
        at = place(value, y, 250, 10)
        lines += f'<line x1="40" y1="{at:.1f}" x2="470" y2="{at:.1f}"/><text x="35" y="{at + 4:.1f}" text-anchor="end">{value}</text>'
    return ('<svg class="plot" viewBox="0 0 500 290" role="img" aria-label="Error in steps over time of a frame" '
            f'data-x="{x[0]},{x[1]}" data-y="{y[0]},{y[1]}">{lines}{points}<circle class="mine" r="6" visibility="hidden"/>'
            f'{mark("Phong", 60, 280)}<text x="68" y="284">at the fragments</text>'
            f'{mark("Gouraud", 180, 280)}<text x="188" y="284">at the vertices</text>'
            f'{mark("flat", 290, 280)}<text x="298" y="284">flat</text>'
            '<circle class="mine" cx="345" cy="280" r="5"/><text x="355" y="284">this device</text></svg>')


def still(figure, caption, hidden=""):
    """The picture of a figure, which book.js loads when it is in sight, and where something is drawn instead not before paper
    or a failure needs it."""
    image = f'src="{figure.picture}"{STILL.get(figure.name, "")} alt="{caption}">'
    return f"<img{hidden} data-{image}<noscript><img loading=\"lazy\" {image}</noscript>"


def canvas(words, caption, more=' tabindex="0"'):
    """As large as the picture will be."""
    width, height = re.search(r"--size (\d+)x(\d+)|$", words).groups()
    return f'<canvas width="{width or 400}" height="{height or 400}"{more} role="img" aria-label="{caption}"></canvas>'


def frame(figure, change):
    """What stands above a caption."""
    caption = html.escape(plain(figure.caption), quote=True)
    if figure.kind == "change":
        return f'<details class="diff"><summary>The text itself</summary>\n<pre tabindex="0">{change(*figure.words)}</pre></details>'
    if figure.kind == "precision":
        return '<div class="wide" tabindex="0" role="group" aria-label="Table"><table class="precision"></table></div>'
    if figure.kind == "formula":
        return still(figure, caption, " hidden") + ways(figure)
    if not figure.live:
        return still(figure, caption)
    below = plot() if "plot" in figure.controls.split(",") else ""
    return (f'{still(figure, caption, " hidden")}\n<div class="stack loading">{canvas(" ".join(figure.words), caption)}</div>\n{below}<p class="read"></p>\n'
            '<form class="controls" autocomplete="off"></form>\n<p class="told" role="status"></p>')


def ways(figure):
    """Places for three pictures, the plain formula's text, and a slider: see formula.js."""
    option, start, low, high, step, _ = figure.parts["slider"].split()
    made, texts = "", ""
    for way in ("plain", "stable", "exact"):
        words = figure.parts.get(way, "").split()
        for name, study in (word.split("=") for word in words if not word.startswith("--") and "=" in word):
            text = (SHADERS / study).read_text(encoding="utf-8")
            texts += (f'<details data-file="{name}"><summary>The plain formula</summary><pre tabindex="0">{html.escape(text)}</pre>'
                      "</details>")
        words = " ".join(word for word in words if ".glsl=" not in word)
        drawn = canvas(figure.parts["live"], way, "" if way == "exact" else ' tabindex="0"')
        made += f'<p class="way" data-words="{words}"><span class="stack loading">{drawn}</span>{way}<span></span></p>'
    return (f'<div class="ways">{made}</div><p class="read"></p>{texts}<p class="told" role="status"></p><form class="controls" hidden><label>'
            f'<code>--{option}</code> <output></output><input type="range" min="{low}" max="{high}" step="{step}" value="{start}">'
            "</label></form>")


def block(figure, change):
    attributes = f' data-words="{html.escape(" ".join(figure.words))}" data-controls="{figure.controls}"' if figure.live else ""
    if figure.parts:
        attributes = f' data-words="{figure.parts["live"]}" data-slider="{figure.parts["slider"]}"'
    kind = "live" if figure.live else figure.kind if figure.kind != "program" else f"still {figure.name}"
    command = f'<code class="command">{html.escape(figure.command())}</code>' if figure.picture else ""
    return (f'```{{=html}}\n<figure class="{kind}" id="figure{figure.number.replace(".", "_")}"{attributes}>\n{frame(figure, change)}\n'
            f'<figcaption>\n```\n\n**Figure {figure.number}.** {figure.caption}\n\n```{{=html}}\n{command}</figcaption></figure>\n```')


def ask(found, chapter, drawn):
    """Questions, of which some set options, or show another still picture."""
    items = []
    names = {words: name for name, words in chapter.answers.items()}
    for question, answer in re.findall(r"<dt>(.*?)</dt>\s*<dd>(.*?)</dd>", found[1], re.DOTALL):
        code = re.search(r"<code>([^<]*)</code>\s*$", question)
        words = f' data-words="{html.escape(html.unescape(code[1]))}"' if code else ""
        still = names.get(html.unescape(code[1])) if code else None
        image = f'<div class="still {code[1].split()[0]}"><img src="{still}" alt="" loading="lazy"></div>' if still else ""
        made = next(drawn) if code and not still else None
        image += f'<img class="drawn" src="{made[0]}" alt="" loading="lazy">' if made else ""
        items.append(f'<details class="expect"{"" if still else words}><summary>{question}</summary>\n{answer.strip()}{image}</details>')
    return "\n".join(items)


def numbers(chapter):
    if not chapter.checks:
        return ""
    rows = "".join(f'<tr><td>{html.escape(plain(value))}</td><td><code>{html.escape(how)}</code></td></tr>'
                   for value, how in dict.fromkeys(chapter.checks))
    return ('<details class="numbers"><summary>Where the numbers of this chapter come from</summary>\n<p>A test computes each again, '
            'from the programs, and fails if it is another one.</p><div class="wide" tabindex="0" role="group" aria-label="Numbers">'
            f'<table><tr><th scope="col">number</th><th scope="col">computed by</th></tr>{rows}</table></div></details>')


def link(target):
    """Other chapters, labs and programs are pages; the guides are not."""
    found = re.fullmatch(r"(\d\d)-[\w-]+\.md", target)
    lab = re.fullmatch(r"\.\./labs/(lab\d\d_\w+)/TASK\.md", target)
    return f"chapter{found[1]}.html" if found else f"{lab[1]}.html" if lab else target if re.fullmatch(r"\w+\.html", target) else None


def body(chapter, change):
    """The chapter as HTML; change(old, new) is the difference of two programs."""
    figures = iter(chapter.figures)
    text = FIGURE.sub(lambda _: block(next(figures), change), PLACE.sub("", chapter.text))
    text = AT.sub(lambda found: f'```{{=html}}\n<p class="at" data-at="{html.escape(" ".join(found[1].split()))}" hidden></p>\n```', text)
    # Pieces that stand in one line or, on a phone, one below the other.
    text = re.sub(r"^\$\$.*\$\$$", lambda found: re.sub(r"(\\qquad)|\\allowbreak", r"\1 $$ $$ ", found[0]), text, flags=re.MULTILINE)
    made = markdown.to_html(CHECK.sub(r"\1", text), link).replace("<h1>", f"<h1>{chapter.number}. ", 1)
    drawn = iter(chapter.drawn)
    made = re.sub(r"<dl>(.*?)</dl>", lambda found: ask(found, chapter, drawn), made, flags=re.DOTALL)
    assert not list(drawn), f"{chapter.path.name}: a question's options are not at its end"
    return made + numbers(chapter)


def draw(folder, programs):
    for chapter in chapters():
        for figure in chapter.figures:
            if figure.picture:
                draw_one(programs, figure.words, folder / figure.picture)
        for name, words in [*chapter.answers.items(), *filter(None, chapter.drawn)]:
            draw_one(programs, words.split(), folder / name)


def places():
    """{heading: [(chapter, section, its text)]} in the order of places.txt, and a list of those that are not in it."""
    lines = (FOLDER / "places.txt").read_text(encoding="utf-8").splitlines()
    found = {line: [] for line in lines if line and not line.startswith("#")}
    unknown = []
    for chapter in chapters():
        for section, text in chapter.sections():
            for mark in PLACE.findall(text):
                for heading in re.split(r"\s*;\s*", " ".join(mark.split())):
                    if heading in found:
                        found[heading].append((chapter, section, text))
                    else:
                        unknown.append((chapter.path.name, heading))
    return found, unknown


def commands(text):
    """Of figures and within sentences."""
    words = [" ".join(Figure(0, 0, found).words) for found in FIGURE.finditer(text) if found[2] == "program"]
    return list(dict.fromkeys(words + re.findall(r"`([A-Z]\w+ --[^`]+|hard_cases --[^`]+)`", text)))


def anchor(heading):
    return re.sub(r"[^\w\- ]", "", plain(heading).lower()).replace(" ", "-")


def table():
    lines = (FOLDER / "places.txt").read_text(encoding="utf-8").splitlines()
    found, _ = places()
    for line in lines:
        if line.startswith("# "):
            print(f"\n### {line[2:]}\n\n| section or slide | in the book | by | lab |\n|---|---|---|---|")
        elif line:
            where = ", ".join(f"[{chapter.number}: {plain(section)}](chapter/{chapter.path.name}#{anchor(section)})"
                              for chapter, section, _ in found[line])
            shown = dict.fromkeys(command for _, _, text in found[line] for command in commands(text))
            labs = sorted({int(lab) for chapter, _, _ in found[line] for lab in re.findall(r"labs/lab(\d\d)_", chapter.text)})
            print(f"| {line} | {where} | {', '.join(f'`{command}`' for command in shown)} | {', '.join(map(str, labs))} |")


if __name__ == "__main__":
    if sys.argv[1:] != ["--places"]:
        sys.exit("usage: book.py --places")
    table()
