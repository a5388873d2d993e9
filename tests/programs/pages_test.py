"""The pages: links, anchors and pictures exist, options are in --help, the map of common/ is complete,
commands print what is shown of them.

    pages_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

examples, root = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
pages = [root / "README.md", root / "CHANGELOG.md", *sorted(root.glob("[cest]*/**/*.md"))]
# Options of scripts are looked for in their text; these are of other programs.
SCRIPTS = ("examples/run", "tests/run", "tests/tables", "tests/drivers", "tests/systems/run", "tests/labs/labs_test.py", "tests/benchmark/bench.c")
FOREIGN = {"--benchmark", "--array", "--half", "--every", "--table", "--cross-file",  # meson, sbatch, labs/corpus.py
           "--cflags", "--libs", "--variable",  # pkg-config
           "--places"}  # examples/web/book.py
failures = []


def check(condition, page, text):
    if not condition:
        failures.append(f"{page.relative_to(root)}: {text}")


def anchors(page):
    """Of its headings, as GitHub and GitLab make them."""
    titles = re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}


def help_texts():
    for program in sorted(path for path in examples.iterdir() if path.is_file() and path.stat().st_mode & 0o100):
        for more in ([], ["--class", "x"]) if program.name == "check" else ([],):
            yield subprocess.run([program, *more, "--help"], capture_output=True, text=True, check=True).stdout
    for script in SCRIPTS:
        yield (root / script).read_text()


def options(text):
    return set(re.findall(r"(?<![\w<!-])--[a-z][a-z-]+", text))


known = FOREIGN.union(*map(options, help_texts()))
for page in pages:
    text = page.read_text()
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        path, _, anchor = link.partition("#")
        target = page.parent / path if path else page
        if "://" in link:
            continue
        check(target.exists(), page, f"{link}: no such file")
        check(not anchor or target.is_file() and anchor in anchors(target), page, f"{link}: no such heading")
    for path in re.findall(r"`((?:examples|common|shaders|tests)/[\w./-]+\.\w+)`", text):
        check((root / path).exists() or "NAME" in path, page, f"{path}: no such file")
    for option in sorted(options(text) - known):
        check(page.name == "CHANGELOG.md", page, f"{option}: no program has it")

# What the tables from OpenGL 1.1 and from JavaScript name is declared in a header; a field, in its struct.
headers = "\n".join(path.read_text() for path in sorted(root.glob("common/*/*.h")))
headers = re.sub(r"/\*.*?\*/", "", headers, flags=re.DOTALL)
structs = {name: body for body, name in re.findall(r"^typedef struct (?:\w+ )?\{(.*?)^\} (\w+);", headers, re.M | re.S)}
programs = {path.stem for path in root.glob("examples/l*/*.c")}
lighting = root / "examples/lighting/README.md"
for title, rows in (("From OpenGL 1.1", 15), ("From the slides' JavaScript", 15)):
    section = lighting.read_text().split(f"## {title}\n")[1].split("\n## ")[0]
    named = [cell for row in re.findall(r"^\| .*$", section, re.M) for cell in row.split(" | ")[1:]]
    check(len(named) > rows, lighting, f"{title}: no table")
    for token in re.findall(r"`([^`]+)`", " ".join(named)):
        field = re.fullmatch(r"(\w*)\.(\w+)(?:\[\]\.(\w+))?", token)
        if field:
            struct = field[1] or struct
            body = structs.get(struct, "") + (headers if field[3] else "")
            check(all(re.search(rf"\b{name}\b", body) for name in field.groups()[1:] if name), lighting,
                  f"{title}: {token}: no such field")
        elif not token.startswith("--") and token.split()[0] not in programs:  # options are checked above
            for name in re.findall(r"\w+", token.split("(")[0]):
                entry = rf"\b{name[2:]}\)" if re.match("gl[A-Z]", name) else rf"\b{name}\b"  # gl.h has their list
                check(re.search(entry, headers) or name in ("gouraud", "constant", "flat") or name[:3] == "GL_",
                      lighting, f"{title}: {name}: no header has it")

modules = (root / "common/README.md").read_text()
for header in sorted(root.glob("common/*/*.h")):
    check(f"({header.parent.name}/{header.name})" in modules, root / "common/README.md",
          f"{header.name} is missing; tests/tables --map prints the table")
# A table of times says what it was measured on; what made it exists.
for page in pages:
    for command, table in re.findall(r"<!-- begin: (.+?) -->\n(.*?)<!-- end -->", page.read_text(), re.DOTALL):
        for path in re.findall(r"(?<!\S)(?:\.\./)?((?:examples|tests)/[\w./]+)", command):
            name = pathlib.PurePath(path).name
            check((root / path).is_file() or (examples.parent / path).is_file() or list(root.glob(f"tests/*/{name}.c")),
                  page, f"{command}: no {path}")
        if "--markdown" in command:
            check(re.search(r"\d cores.*; (?:.*; )?gcc [\d.]+ -O\d", table.replace("\n", " ")), page,
                  f"{command}: the table does not name processor and compiler")

reference = subprocess.run([root / "tests/tables", "--options"], capture_output=True, text=True, check=True,
                           env={**os.environ, "LIGHTING_BUILD": str(examples.parent)}).stdout
check(reference.strip() in (root / "examples/guide/options.md").read_text(), root / "examples/guide/options.md",
      "not what --help says; tests/tables --options prints it")

# A block that begins with a command shows what that prints; "..." stands for more. Times differ from run to run.
for page in pages:
    for command, shown in re.findall(r"^ *```\n\$ examples/run (.*)\n((?:.*\n)*?) *```$", page.read_text(), re.MULTILINE):
        words = command.split()
        emulated = {"--probe", "--show"}.intersection(words)  # what the pages are of: mediump of 11 bits
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([examples / words[0], *words[1:], *(["--arithmetic", "llvmpipe"] if emulated else [])], text=True,
                                  cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=True)
        printed = re.sub(r"[\d.]+ ms", "1 ms", done.stdout)
        for line in shown.splitlines():
            check(re.sub(r"[\d.]+ ms", "1 ms", line.removesuffix("...")) in printed, page, f"{command}: does not print: {line}")

lines = len((root / "README.md").read_text().splitlines())
check(lines <= 150, root / "README.md", f"{lines} lines; at most 150")

print("\n".join(failures))
sys.exit(1 if failures else 0)
