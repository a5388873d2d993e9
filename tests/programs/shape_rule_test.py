"""The shape of the C sources: functions of at most 60 lines and six parameters, few long files, no two files that
include each other, no weak symbols, and a sentence at the top of each file.

    shape_rule_test.py SOURCE_FOLDER

The sources are formatted by clang-format, so that what begins in the first column is a definition.
"""
import pathlib
import re
import sys

FUNCTION_LINES, PARAMETERS = 60, 6
FILE_LINES, LONG_FILES = 500, 5
DEFINITION = re.compile(r"^(?!typedef|struct|enum|union|extern|using|namespace)[A-Za-z_][^;{}#\n]*\((?:[^;{}]*)\)\n?[^;{}\n]*\n?\{\n"
                        r"(?:.*\n)*?\}\n", re.MULTILINE)

root = pathlib.Path(sys.argv[1])
failures = []
paths = sorted(path for top in ("common", "examples", "tests") for path in (root / top).rglob("*")
               if path.suffix in (".c", ".h", ".cpp"))
text = {path.relative_to(root).as_posix(): path.read_text() for path in paths if "alternatives" not in path.parts}


def parameters(signature):
    """Commas of the outermost parentheses, and one."""
    depth, count = 0, 1
    for letter in signature:
        depth += (letter == "(") - (letter == ")")
        count += letter == "," and depth == 1
    return count


for name, code in text.items():
    for found in DEFINITION.finditer(re.sub(r'"(\\.|[^"\\\n])*"', '""', code)):
        if re.match(r"EM_JS|.*GL_APIENTRY", found.group()):
            continue  # JavaScript; a signature of OpenGL's
        lines, signature = found.group().count("\n"), found.group().partition("\n{")[0]
        if lines > FUNCTION_LINES:
            failures.append(f"{name}: {signature.splitlines()[0]}: {lines} lines; at most {FUNCTION_LINES}")
        if parameters(signature) > PARAMETERS:
            failures.append(f"{name}: {signature.splitlines()[0]}: {parameters(signature)} parameters; at most {PARAMETERS}")
    if re.search(r"#pragma weak|__attribute__\(\(weak", code):
        failures.append(f"{name}: a weak symbol")

long = [name for name, code in text.items() if not name.startswith("tests/") and code.count("\n") > FILE_LINES]
if len(long) > LONG_FILES:
    failures.append(f"{len(long)} files have more than {FILE_LINES} lines, at most {LONG_FILES} may: {', '.join(long)}")

# A module is its .c and .h; a header that a file includes must not include that file's header.
modules = {name.rpartition(".")[0] for name in text}
uses = {}
for name, code in text.items():
    module = name.rpartition(".")[0]
    for header in re.findall(r'^#include "([^"]+)\.h"', code, re.MULTILINE):
        for folder in ("common/", "examples/", "tests/"):
            if folder + header in modules and folder + header != module:
                uses.setdefault(module, set()).add(folder + header)
for module, used in uses.items():
    for other in used:
        if module < other and module in uses.get(other, ()):
            failures.append(f"{module} and {other} include each other")

print("\n".join(failures))
sys.exit(1 if failures else 0)
