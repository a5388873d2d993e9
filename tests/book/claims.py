"""The numbers of the book, computed again from what they claim: [0.866]{check="cos(radians(30))"}.

An expression has Python's math and the functions below; a command is a program's name with its options.
"""
import functools
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys

import prose

EXAMPLES, PAGE_NATIVE, SOURCE = (os.path.abspath(path) for path in sys.argv[1:4])


@functools.lru_cache(None)
def run(command, *more):
    name, *words = command.split()
    return subprocess.run([os.path.join(EXAMPLES, name), *words, *more], check=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE).stdout


def size(command):
    with_size = re.search(r"--size (\d+)x(\d+)", command)
    if not with_size:
        name = command.split()[0]
        with_size = re.search(r"-s, --size WxH\s+in pixels; default (\d+)x(\d+)", run(name, "--help").decode())
    return tuple(map(int, with_size.groups()))


def pixels(command):
    """(red, green, blue) of each, row by row."""
    data = run(command, "-o", "-", "--format", "rgb")
    return list(zip(data[::3], data[1::3], data[2::3]))


def pixel(command, x, y):
    return pixels(command)[y * size(command)[0] + x]


def colours(command):
    return len(set(pixels(command)))


def difference(command, other):
    """The largest, of a byte."""
    return max(abs(a - b) for a, b in zip(run(command, "-o", "-", "--format", "rgb"), run(other, "-o", "-", "--format", "rgb")))


def changed(command, other):
    """How many pixels."""
    return sum(a != b for a, b in zip(pixels(command), pixels(other)))


@functools.lru_cache(None)
def error(command):
    """Against the exact picture."""
    name, *words = command.split()
    line = name
    for word in words:
        line += ("=" if not word.startswith("--") else " ") + word
    said = subprocess.run([PAGE_NATIVE], input=line + "\n", stdout=subprocess.PIPE, text=True, check=True).stdout
    return json.loads(said)


def largest(command):
    return error(command)["inside"]["maximum"]


def rms(command):
    return error(command)["inside"]["rms"]


def rms_of_all(command):
    return error(command)["all"]["rms"]


def said(command, pattern):
    """The number in what a command prints."""
    return float(re.search(pattern, run(command).decode(), re.MULTILINE)[1])


def page(path, pattern):
    """A number that a page of the project has measured."""
    text = " ".join(pathlib.Path(SOURCE, path).read_text(encoding="utf-8").split())
    return float(re.search(pattern, text)[1])


def numbers(path, pattern):
    """Those that stand in a part of a page or a source."""
    found = re.search(pattern, " ".join(pathlib.Path(SOURCE, path).read_text(encoding="utf-8").split()))[1]
    return tuple(map(float, re.findall(r"-?[\d.]+", found)))


def operations(effect, column=3):
    """Per fragment, as the study counts them: of the program that is specialized, or of the full one, column 4."""
    return page("examples/study/tables/costs.md", rf"\| {re.escape(effect)} (?:\|[^|]*){{{column - 1}}}\| (\d+) ")


def bits(precision):
    """Of a number on the study's device."""
    return page("examples/study/tables/precision.md", rf"\| {precision}\b[^|]*\| (\d+) \|")


def parameter(program, option, pattern):
    """A pattern's part in what --help says of an option."""
    text = re.search(rf"^ +--{option} (.*?)(?=^ +-|^$|\Z)", run(program, "--help").decode(), re.DOTALL | re.MULTILINE)[1]
    return re.search(pattern, re.sub(r"\|\s+", "|", " ".join(text.split())))[1]


def default(program, option):
    return float(parameter(program, option, r"default ([\d.]+)"))


def choices(program, option):
    return parameter(program, option, r"([\w|]+)").split("|")


def rows(heading, path="examples/study/tables/accuracy.md"):
    """Of the first table after a heading, the cells of each row but the first."""
    table = re.search(r"(?:^\|.*\n)+", pathlib.Path(SOURCE, path).read_text(encoding="utf-8").partition("\n" + heading)[2], re.MULTILINE)
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in table[0].splitlines()[2:]]


def cell(heading, row, column):
    return float(next(cells[column] for cells in rows(heading) if cells[0] == row))


def column(heading, number, row=""):
    """The numbers of a column, in rows that begin so; medians without their quartiles. Cells without one, such as "same", are left out."""
    cells = (cells[number].split() for cells in rows(heading) if " ".join(cells).startswith(row))
    return [float(words[0]) for words in cells if words and words[0] != "same"]


def models(name, number):
    """Of the study's comparison of two models of the highlight, the numbers of a column."""
    return [float(cells[number]) for cells in rows("Phong and Blinn-Phong on a sphere") if cells[0] == name]


def unit(*vector):
    length = math.sqrt(sum(x * x for x in vector))
    return tuple(x / length for x in vector)


def product(a, b):
    """By components, as of a colour and a reflectivity."""
    return tuple(x * y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


NAMES = {name: value for name, value in vars(math).items() if not name.startswith("_")}
NAMES.update({function.__name__: function for function in (size, pixels, pixel, colours, difference, changed, error, largest, rms,
                                                          rms_of_all, said, page, numbers, product, rows, cell, column, operations, unit, dot,
                                                          bits, default, choices, models, statistics.median)},
             sorted=sorted, abs=abs, max=max, min=min, round=round, sum=sum, len=len, set=set, any=any, all=all, int=int, zip=zip, range=range,
             float=float, tuple=tuple)


def computed(expression):
    return eval(expression, {"__builtins__": {}, **NAMES})


def read(text):
    """What a number in the text says, be it a word, a formula or a vector in one; and by how much each may be off that is not said."""
    plain = text.strip("$").replace("−", "-").lower()
    known = [prose.WORDS[word] for word in plain.split() if word in prose.WORDS]
    if known:
        return (math.prod(known),), (0.1 * math.prod(known),)
    if re.search(r"[/^]", plain):
        value = computed(re.sub(r"\^\{(.*?)\}", r" ** (\1)", plain))
        return (value,), (1e-9 * value,)
    parts = plain.strip("()").split(",") if plain.startswith("(") else [re.sub(r"[ ,%]", "", plain)]
    return tuple(map(float, parts)), tuple(0.5 * 10 ** -len(part.partition(".")[2]) + 1e-9 for part in parts)


def holds(text, expression):
    """Whether a number is right in all the digits that it has; and what it should be."""
    value = computed(expression)
    said, off = read(text)
    right = value if isinstance(value, tuple) else (value,)
    return len(right) == len(said) and all(abs(a - b) <= c for a, b, c in zip(right, said, off)), value
