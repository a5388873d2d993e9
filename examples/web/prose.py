"""The numbers in the text of a chapter: each is computed from an expression, [NUMBER]{check="EXPRESSION"}, or of one of these kinds.

In code, a formula that stands alone, or an equation of numbers, which tests/book evaluates; 0, 1 and 2 in other formulas; of a chapter,
lab, figure or section; a year; a version; the bits in a format's name; an end of a scale (0 and 1, or 255 for a byte), not a count; of the
options of the figure that the caption, question or answer is about; or what a computed number in the same paragraph is computed from.
"""
import re

import book

QUIET = re.compile(r"^```.*?^```|\$\$.*?\$\$|`[^`]*`|\]\([^)]*\)|<!--.*?-->|\{#[^}]*\}", re.DOTALL | re.MULTILINE)
NAMES = re.compile(r"\b(?:[Cc]hapter|[Ll]ab|[Ff]igure|[Ss]ection)\s+\d+(?:\.\d+)*|^#+ \d+\.(?= )|\bin (?:19|20)\d\d\b|"
                   r"\b(?:OpenGL(?: ES)?|WebGL|GLSL(?: ES)?|IEEE)\s+\d+(?:\.\d+)?|\b\d+-bit\b", re.MULTILINE)
MEASURED = ("step", "pixel", "degree", "percent", "times", "bit", "byte", "digit", "operation", "second", "sample", "division", "units", "unit apart")
COUNTED = (*MEASURED, "%", "time", "vert", "corner", "face", "triangle", "slice", "stack", "texel", "frame", "ms", "unit", "lamp", "light",
           "colour", "material", "scene")
SCALE = re.compile(rf"\b1/255\b|\bof\s+255\b|(?<![\d.,/])(?:0|1|255)\b(?![./]\d|\s*(?:{'|'.join(COUNTED)}))")
NUMBER = re.compile(r"\d+(?:\.\d+)?")
QUESTION = re.compile(r"^.*`([^`]+)`\n+:   ", re.MULTILINE)
FORMULA = re.compile(r"\$([^$]+)\$")
FEW = re.compile(r"\d \\times \d|[_^](?:\d|\{[^}]*\})|(?<![\d.])[012](?![\d.])")
# Numbers as words, of what is measured: of other things, a face's corners or a model's parts, the sentence itself says them.
WORDS = {word: number for number, word in enumerate("two three four five six seven eight nine ten eleven twelve".split(), 2)}
WORDS.update(half=0.5, dozen=12, twenty=20, thirty=30, forty=40, fifty=50, hundred=100, million=10**6)
WORD = re.compile(rf"\b({'|'.join(WORDS)})(?: million| an?| the)? (?:{'|'.join(MEASURED)})s?\b", re.IGNORECASE)


def equation(formula):
    """Its sides for Python if they are numbers alone, else None."""
    sides = [re.sub(r"\\cos (\d+)°", r"cos(radians(\1))", side) for side in formula.split("=")]
    return sides if len(sides) > 1 and all(re.fullmatch(r"(?:[\d.()+/ -]|cos|radians)+", side) for side in sides) else None


def in_formula(found):
    return " " if equation(found[1]) else FEW.sub(" ", found[1])


def unmarked(chapter):
    """The numbers that are neither computed nor of a kind, each with what stands around it."""
    found, figures, known = [], iter(chapter.figures), set()
    for block in re.split(r"\n\s*\n", re.sub(r"^```.*?^```", "", chapter.text, flags=re.DOTALL | re.MULTILINE)):
        if book.FIGURE.match(block):
            figure = next(figures)
            known = set(NUMBER.findall(" ".join([*figure.words, *figure.parts.values()])))
        about = known if book.FIGURE.match(block) or "\n:   " in block else set()
        options = [number for words in QUESTION.findall(block) for number in NUMBER.findall(words)]
        computed_from = [number for _, expression in book.CHECK.findall(block) for number in NUMBER.findall(expression)]
        text = SCALE.sub(" ", NAMES.sub(" ", FORMULA.sub(in_formula, QUIET.sub(" ", book.CHECK.sub(" ", block)))))
        found += [" ".join(text[max(0, number.start() - 30):number.end() + 20].split()) for number in NUMBER.finditer(text)
                  if number[0] not in {*about, *options, *computed_from}]
        found += [word[0] for word in WORD.finditer(text) if str(WORDS[word[1].lower()]) not in {*about, *options, *computed_from}]
    return found
