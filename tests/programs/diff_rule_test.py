"""The diff rule: a lecture program differs from its predecessor only in the lesson.

    diff_rule_test.py SOURCE_DIR

A test cannot judge a lesson, but it finds drift: changed lines with none of the lesson's words. It also checks the
length of the programs, 80 to 160 lines, and that each shader file is complete.
"""

import difflib
import pathlib
import re
import sys

# program: its predecessor, and words: every changed line of code or shader contains one of them.
MODEL = r"u_MvpMatrix|model|[Rr]otat|TURN|AXIS|MOVE|[Nn]ormal|clip_from|mat4_|seconds"
POINT = r"LIGHT|[Ll]ight|EYE|HALF_SIDE|[Mm]odel|position"
FRAGMENT = r"normal|Normal|Position|[Ll]ight|ambient|diffuse|Color|nDotL"
SPHERE = r"[Ss]phere|SPHERE|cube|CUBE|DIVISIONS|HALF_SIDE|EYE|LIGHT|TURN"
LESSONS = {
    "LightedCube": (None, ""),
    "LightedCube_animation": ("LightedCube", MODEL),
    "LightedCube_ambient": ("LightedCube", "[Aa]mbient|AMBIENT|u_LightColor|diffuse"),
    "LightedTranslatedRotatedCube": ("LightedCube_ambient", MODEL + "|LIGHT_DIRECTION"),
    "PointLightedCube": ("LightedTranslatedRotatedCube", POINT + "|" + MODEL),
    "PointLightedCube_animation": ("PointLightedCube", "TURN"),
    "PointLightedCube_perFragment": ("PointLightedCube_animation", FRAGMENT),
    "PointLightedSphere": ("PointLightedCube", SPHERE),
    "PointLightedSphere_perFragment": ("PointLightedSphere", FRAGMENT + "|TURN"),
}

passed = failed = 0


def check(condition, what):
    global passed, failed
    if condition:
        passed += 1
    else:
        failed += 1
        print("failed:", what)


def code(path, name):
    """The lines of a file without comments, blank lines and what must differ: names."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", path.read_text(), flags=re.S)
    text = text.replace(name, "NAME")
    lines = (" ".join(line.split()) for line in text.splitlines())
    # Wrapping is the formatter's: statements are compared, not lines.
    joined = re.sub(r"(&&|\|\||,)\n", r"\1 ", "\n".join(line for line in lines if line))
    statements = (line.strip(" (){};") for line in re.split(r"\n|\|\| ", joined))
    return [line for line in statements if line and ".summary" not in line]


def changed(before, after):
    return [line[2:] for line in difflib.ndiff(before, after) if line[0] in "+-"]


def main():
    source = pathlib.Path(sys.argv[1])
    shaders, programs = source / "shaders/lecture", source / "examples/lecture"
    check({p.stem for p in programs.glob("*.c")} == set(LESSONS), "every program has its lesson here")
    pages = re.findall(r"\bX\((\w+), (?:&(\w+)|NULL)\)", (source / "examples/lessons/lessons.c").read_text())
    check(pages == [(name, before or "") for name, (before, _) in LESSONS.items()], "lessons has the same")
    for name, (before, words) in LESSONS.items():
        length = len((programs / f"{name}.c").read_text().splitlines())
        check(80 <= length <= 160, f"{name}.c has {length} lines, not 80 to 160")
        for suffix in "vert", "frag":
            text = (shaders / f"{name}.{suffix}").read_text()
            check("#include" not in text and "void main()" in text, f"{name}.{suffix} is complete")
        if before is None:
            continue
        for folder, suffix in (programs, "c"), (shaders, "vert"), (shaders, "frag"):
            pair = [code(folder / f"{n}.{suffix}", n) for n in (before, name)]
            for line in changed(*pair):
                check(line == "return false" or re.search(words, line), f"{name}.{suffix}, against {before}: {line!r}")
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


sys.exit(main())
