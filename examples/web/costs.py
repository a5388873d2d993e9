"""What accuracy costs in a place of the book, as the programs themselves say it:

    <!-- costs: NAME OPTIONS; OPTIONS; ... -->

becomes a table. Its rows are the picture of the command, the same with other options, and as cheap as an error of two steps allows. Each
has the largest error, the operations of a vertex and a fragment, and the cost that is expected from counts, which is the same on every
machine; costs.js adds the time on the reader's. Below it stands what is left out: of the shader, because this scene has no use for it,
and of the model.
"""
import functools
import html
import re
import subprocess

import book

MARK = re.compile(r"^<!-- costs: (.*?) -->$", re.DOTALL | re.MULTILINE)
ALLOWED = "2"  # steps
FOUND = re.compile(r"view \d+, --error: ((?:(?!; error ).)*); error ([\d.]+) of [\d.]+ allowed inside objects \(plain: ([\d.]+)\)"
                   r"(?:, at [^,]*, and [^,]*)?, expected cost (\d+) \(plain: (\d+)\)")
OPERATIONS = re.compile(r"^operations: (\d+) per vertex \(\d+ special\), (\d+) per fragment", re.MULTILINE)


@functools.lru_cache(None)
def explained(programs, words, *more):
    name, *options = words.split()
    return subprocess.run([programs / name, *options, *more, "--explain"], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          encoding="utf-8").stdout


def operations(text):
    """The most of a vertex and of a fragment, over all objects."""
    vertex, fragment = zip(*((int(a), int(b)) for a, b in OPERATIONS.findall(text)))
    return max(vertex), max(fragment)


def searched(programs, words, allowed):
    """(how, error, plain error, cost, plain cost) over all views, and the operations of what was found."""
    text = explained(programs, words, "--error", allowed)
    how, *numbers = zip(*FOUND.findall(" ".join(text.split())))
    errors, plain_errors, costs, plain_costs = (list(map(float, column)) for column in numbers)
    return " / ".join(dict.fromkeys(how)), max(errors), max(plain_errors), sum(costs), sum(plain_costs), operations(text)


def left_out(text):
    """Of the shader of the first object, and of the model: (what, why) and sentences."""
    first, _, model = text.partition("\n# what the model leaves out\n")
    shader = re.findall(r"^ *without ([^:\n]+): (.*)$", re.sub(r"\n\n.*", "", first, flags=re.DOTALL), re.MULTILINE)
    return list(dict.fromkeys(shader)), re.sub(r"\n+#.*", "", model, flags=re.DOTALL).strip().splitlines()


def rows(programs, words):
    """Of a mark: (options, error, operations per vertex and fragment, cost) of each row, and what the last one's choice is."""
    base, *others = (" ".join(part.split()) for part in words.split(";"))
    how, error, plain_error, cost, plain_cost, found = searched(programs, base, ALLOWED)
    made = [("", plain_error, *operations(explained(programs, base)), plain_cost)]
    for options in others:
        command = book.merge(base, options)
        _, _, its_error, _, its_cost, _ = searched(programs, command, "255")  # which is soon found
        made.append((options, its_error, *operations(explained(programs, command)), its_cost))
    return [*made, (f"--error {ALLOWED}", error, *found, cost)], how


def shown(error):
    return f"{error:.1f}" if error < 10 else f"{error:.0f}"


def kinds(model):
    """What the model leaves out in few words: how many shadows, and the rest with each kind of object once."""
    shadows = sum("would cast a shadow" in line for line in model)
    rest = [re.sub(r"object \d+, (an? \w+),", r"\1", line) for line in model if "would cast a shadow" not in line]
    return [f"{shadows} shadow" + "s" * (shadows > 1)] * bool(shadows) + list(dict.fromkeys(rest))


def listed(items):
    return "".join(f"<li>{html.escape(item)}</li>" for item in items)


def table(words, programs, loads):
    """As HTML; `loads` is the weight of what measures, in kB."""
    base, (made, chosen) = " ".join(words.split(";")[0].split()), rows(programs, words)
    lines = ""
    for options, error, vertex, fragment, cost in made:
        measured = "" if options.startswith("--error") else f' data-words="{html.escape(book.merge(base, options))}"'
        said = re.sub(r"(--\S+(?: (?!--)\S+)*)", r"<code>\1</code>", html.escape(options)) or "as above"
        lines += (f'<tr{measured}><th scope="row">{said}</th>'
                  f"<td>{shown(error)}</td><td>{vertex}</td><td>{fragment}</td><td>{cost / made[0][-1]:.2f}</td><td hidden></td></tr>\n")
    shader, model = left_out(explained(programs, base))
    names = ", ".join(dict.fromkeys(what for what, _ in shader)) or "nothing"
    return (f'<div class="costs"><code class="command">examples/run {html.escape(base)}</code>\n'
            '<div class="wide" tabindex="0" role="group" aria-label="What accuracy costs"><table><tr><th scope="col">setting</th>'
            '<th scope="col">largest error, steps</th><th scope="col">operations per vertex</th><th scope="col">per fragment</th>'
            f'<th scope="col">expected cost</th><th scope="col" hidden>time here</th></tr>\n{lines}</table></div>\n'
            "<p><small>The cost is expected from the counts of vertices, fragments and operations, the same on every machine; that of the first row "
            "is 1.</small></p>\n"
            f'<p><button type="button" hidden data-loads="{loads:.0f}">Measure the time on this device</button> <span role="status"></span></p>\n'
            f'<p><b>Left out</b> of the shader, for this scene has no use for it: {html.escape(names)}. Left out of the model: '
            f'{html.escape("; ".join(kinds(model)))}.</p>\n'
            f"<details><summary>Why, and what <code>--error {ALLOWED}</code> chooses</summary>\n<ul>{listed(map(': '.join, shader))}"
            f"{listed(model)}<li><code>--error {ALLOWED}</code>: {html.escape(chosen)}</li></ul></details></div>")


def fill(page, programs, loads):
    """The marks of a chapter's HTML become tables; without programs there are none."""
    return MARK.sub(lambda found: table(html.unescape(found[1]), programs, loads) if programs else "", page)
