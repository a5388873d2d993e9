"""Includes point down: each file includes only its own folder and the floors below it. Below app, and the kinds of programs on it, nothing prints or
ends the process or names an option: what fails leaves a message, and app prints it."""
import pathlib
import re
import sys

# From the ground up; a program stands on all of them.
FLOORS = ["base", "glsl", "core", "shapes", "shadows", "scene", "lighting", "reference", "probe", "choose", "images", "window", "app",
          "kinds"]
# What the programs' own libraries may include besides common/: themselves and those before them.
STUDY = ["study/results", "study/measure", "study/report", "study/cases", "study/arithmetic"]
LABS = ["labs/program", "labs/submission", "labs/diagnosis", "labs/check", "labs/web", "labs/sandbox", "labs/class"]
DIAGRAMS = ["diagrams"]
LECTURE_HEADERS, LECTURE_LINES = 9, 700
SPEAKS = re.compile(r"\b(v?printf|puts|putchar|perror|exit|_exit|_Exit|abort)\s*\(|\b(stdout|stderr)\b")
MAY_SPEAK = {"base/memory_end.c",    # the end of a program that gets no memory
             "base/progress.c",  # its bar is on stderr
             "scene/scene_file_read.c"}   # _exit in a forked child
OPTION = re.compile(r'"[^"\n]*(?<![\w-])--[a-z]')

root = pathlib.Path(sys.argv[1])
failures = []


def includes(path):
    return re.findall(r'^#include "([^"]+)"', path.read_text(), re.MULTILINE)


def check(folder, name, allowed):
    for path in sorted(folder.glob("*.[ch]*")):
        for header in includes(path):
            if header.rpartition("/")[0] not in allowed:
                failures.append(f"{path.relative_to(root)}: {header}: {name} may include {', '.join(allowed)}")


def up_to(floor):
    """The floors that one may include; the exact picture includes nothing that draws."""
    below = FLOORS[: FLOORS.index(floor) + 1]
    return [name for name in below if name not in ("shadows", "lighting")] if floor == "reference" else below


for floor in FLOORS:
    check(root / "common" / floor, floor, up_to(floor))
for floor in FLOORS[:-2]:
    for path in sorted((root / "common" / floor).glob("*.[ch]*")):
        name = f"{floor}/{path.name}"
        code = re.sub(r"/\*.*?\*/|//[^\n]*", "", path.read_text(), flags=re.S)
        found = SPEAKS.search(re.sub(r'"(\\.|[^"\\\n])*"', "", code))
        if found and name not in MAY_SPEAK:
            failures.append(f"common/{name}: {found.group()}: only app prints and ends the process")
        found = OPTION.search(code)
        if found:
            failures.append(f"common/{name}: {found.group()}: only app names options of the command line")
check(root / "common/web", "what differs in a browser", FLOORS)
check(root / "examples/web", "the pages' module", FLOORS + ["web"])
for group in (STUDY, STUDY + LABS):
    for i, folder in enumerate(group):
        if folder in STUDY and group is not STUDY:
            continue
        check(root / "examples" / folder, folder, FLOORS + group[: i + 1])
check(root / "examples/diagrams", "a diagram", up_to("images") + DIAGRAMS)
check(root / "examples/study", "a program", FLOORS + STUDY)
check(root / "examples/lighting", "a scene", up_to("lighting"))
check(root / "examples/lecture", "a lecture program", ["core"])


def closure(path, seen):
    for header in includes(path):
        if header not in seen:
            seen.add(header)
            closure(root / "common" / header, seen)
    return seen


for program in sorted((root / "examples/lecture").glob("*.c")):
    headers = closure(program, set())
    lines = sum(len((root / "common" / header).read_text().splitlines()) for header in headers)
    if len(headers) > LECTURE_HEADERS or lines > LECTURE_LINES:
        failures.append(f"{program.name}: includes {len(headers)} headers of {lines} lines in all; at most "
                        f"{LECTURE_HEADERS} of {LECTURE_LINES}: {', '.join(sorted(headers))}")

print("\n".join(failures))
sys.exit(1 if failures else 0)
