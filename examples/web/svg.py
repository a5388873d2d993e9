"""Makes the SVG of cairo short: a diagram's letters are outlines in six decimals, each written out anew.

A tenth of a pixel is kept, and each outline is counted from its first point: so the same letter is the same text, of which gzip
keeps one.
"""
import re

COORDINATES = {"L": 2, "C": 6, "Z": 0}


def number(value):
    return re.sub(r"^(-?)0\.", r"\1.", f"{round(value, 1) + 0:g}")  # + 0: not -0


def outline(text):
    """Of the commands M, L, C and Z, which are all that cairo writes, with absolute coordinates."""
    (x, y), parts = (float(value) for value in text.split()[1:3]), re.findall(r"([LCZ])([^LCZ]*)", text)
    made, at = f"M{number(x)} {number(y)}", (0, 0)
    for command, rest in parts:
        values = [float(value) for value in rest.split()]
        assert len(values) == COORDINATES[command], text
        places = [round(value - (x, y)[i % 2], 1) for i, value in enumerate(values)]
        made += command.lower() + " ".join(number(place - at[i % 2]) for i, place in enumerate(places)).replace(" -", "-")
        at = places[-2:] or (0, 0)
    return made


def shorten(text):
    return re.sub(r' d="([^"]*)"', lambda path: ' d="' + "".join(map(outline, re.findall("M[^M]*", path[1]))) + '"', text)
