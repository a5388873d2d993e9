#!/usr/bin/env python3
"""The front end of GLSL ES 1.00 against glslang and the driver: what is accepted, and the line of the first error.

usage: judges_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

Shaders of every program as the driver gets them, every submission of the corpus, random programs, and mutations of all.
Where the two judges differ, RULINGS says which of them the specification is with. LIGHTING_TEST_SEED seeds.
"""
import functools
import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest

EXAMPLES, SOURCE = (os.path.abspath(path) for path in sys.argv[1:3])
sys.path[:0] = [os.path.join(SOURCE, "tests/labs"), os.path.join(SOURCE, "tests/glsl")]
import corpus
import glsl_random

JUDGE = os.path.join(EXAMPLES, "../tests/glsl_judge")
LONG = int(os.environ.get("LIGHTING_TEST_LONG") or 0)
SEED = int(os.environ.get("LIGHTING_TEST_SEED", "28"))
BATCH = 200
# Where the judges differ, what one of them says of a text that the other accepts, whether it is in error by the specification,
# why, and what the text has if that is not clear from what was said. tests/EVIDENCE.md lists them.
RULINGS = [
    (r"starting with .gl_. are reserved", True, "names that begin with gl_ are reserved; Mesa takes them for parameters and locals"),
    (r"identifiers containing consecutive underscores", True, "names with __ are reserved; Mesa warns"),
    (r"uses reserved .gl_. prefix", True, "as before; glslang takes a variable named gl_FragColor"),
    (r"l-value required", True, "only a variable or a part of it is assigned; Mesa takes some values that nothing depends on"),
    (r"'void' : cannot construct", True, "void has no constructor; Mesa takes one whose value nothing uses"),
    (r"'line continuation'", True, "no line is continued by a backslash; Mesa does it"),
    (r"'floating-point suffix'", True, "floats have no suffix; Mesa takes 1.0f"),
    (r"'extraneous semicolon'", True, "no semicolon alone outside functions; Mesa takes it"),
    (r"'arrayed type'", True, "an array's length follows the name; Mesa takes float[2] a"),
    (r"type cannot have precision qualifier", True, "a bool has no precision; Mesa takes one in a parameter"),
    (r"numeric literal too big", True, "ints have 32 bits; Mesa warns"),
    (r"^\d+ '=' : global const initializers must be constant", True, "a comma is in no constant expression; Mesa takes it"),
    (r"Too few args in Macro", False, "a macro of one parameter may get an empty argument; glslang wants one"),
    (r"overloaded functions must have the same parameter precision", True, "a prototype has the precisions of its function; Mesa does not compare them"),
    (r"only in GLSL|GLSL \d\.\d+ is not supported", True, "#version 100 only; glslang takes the desktop's"),
    (r"unexpected end of file$", True, "a text has at least one declaration; glslang takes an empty one"),
    (r"second and third operands of \?: operator cannot be arrays", True, "? takes no arrays; glslang does"),
    (r"formal parameter lacks a name", False, "a parameter that is not used needs no name; Mesa wants one"),
    (r"`\w+' redeclared", False, "a function's body is a scope in that of its parameters; Mesa has one for both"),
    (r"preprocessor error: syntax error, unexpected .*expecting (IDENTIFIER|NEWLINE)", False, "what is skipped needs only #if, #elif, #else and #endif; Mesa reads their lines"),
    (r"preprocessor error: (extra tokens at end of directive|syntax error, unexpected HASH_TOKEN|#endif without #if)", False, "as before"),
    (r"bad character in float exponent", False, "what is skipped is not read for numbers; glslang reads them"),
    (r"Unterminated #if", False, "`# #endif` ends what is skipped; Mesa does not see it"),
    (r"'#endif' : unexpected tokens following", True, "nothing follows #endif; Mesa takes it"),
    (r"operands to arithmetic operators must be numeric", True, "+ takes no bool; glslang takes one"),
    (r"'non-constant global initializer", True, "a comma is in no constant expression; Mesa takes it"),
    (r"syntax error, unexpected IDENTIFIER$", False, "a word of the language can be a macro; glslang expands it sometimes only", r"# *define +(int|float|void|vec\d|mat\d|uniform|varying)\b"),
    (r"undeclared identifier", True, "in what is skipped #ififdef opens no group; Mesa takes it for an #if", r"# *if(?!n?def\b)\w"),
]
# Where both take what the specification does not: what we say.
AGAINST_BOTH = [
    (r"^\d+ [\d.]+f is no number", "floats have no suffix; glslang takes 1.0f in places"),
]


@functools.cache
def programs():
    """The shaders of the programs that draw, by name."""
    found = []
    with open(os.path.join(SOURCE, "examples/meson.build")) as file:
        listed = re.findall(r"^  '(\w+)',$", file.read(), re.MULTILINE)
    for program in listed[:: 1 if LONG else 4]:
        if program == "check" or any(os.path.exists(os.path.join(SOURCE, "examples", folder, program + ".c"))
                                     for folder in ("study", "diagrams")):
            continue
        for stage in ("vert", "frag"):
            done = subprocess.run([os.path.join(EXAMPLES, program), f"--print-shader={stage}"], capture_output=True, text=True)
            for i, text in enumerate(re.split(r"^(?=#version)", done.stdout, flags=re.MULTILINE)[1:]):
                found.append((f"{program}-{i}.{stage}", text))
    return found


def submissions():
    for lab in range(1, 12):
        for name, files in corpus.read(lab).items():
            for file, content in files.items():
                if file.endswith((".vert", ".frag")):
                    yield f"lab{lab:02}-{name}-{file}", content


def glslang(paths):
    """Of each text "ok", or the line and the message."""
    done = subprocess.run(["glslangValidator", *paths], capture_output=True, text=True, errors="replace")
    if done.returncode < 0:  # it crashed on one of them
        if len(paths) == 1:
            return {paths[0]: "crash"}
        middle = len(paths) // 2
        return {**glslang(paths[:middle]), **glslang(paths[middle:])}
    said, path = {}, None
    for line in done.stdout.splitlines():
        if line in paths:
            path = line
            said[path] = "ok"
        elif line.startswith("ERROR: ") and path and said[path] == "ok":
            found = re.match(r"ERROR: -?\d+:(-?\d+): (.*)", line)
            said[path] = f"{found.group(1)} {found.group(2)}" if found else f"0 {line}"
    return said


def ours_and_driver(paths):
    done = subprocess.run([JUDGE], input="\n".join(paths) + "\n", capture_output=True, text=True, errors="replace")
    if done.returncode == 77:
        print(done.stderr)
        sys.exit(77)
    assert done.returncode == 0, (done.returncode, done.stderr[-2000:], done.stdout[-300:])
    return {line.split("\t")[0]: line.split("\t")[1:3] for line in done.stdout.splitlines() if line.count("\t") >= 2}


class Count:
    """Of many texts, how many each judge judges as we do, and the rest."""

    def __init__(self):
        self.texts = self.valid = self.both = self.glslang = self.driver = self.ruled = 0
        self.lines = self.same_line = 0
        self.wrong = []

    def add(self, name, text, ours, other, driver):
        self.texts += 1
        accepted = [said == "ok" for said in (ours, other, driver)]
        self.valid += accepted[0]
        self.glslang += accepted[0] == accepted[1]
        self.driver += accepted[0] == accepted[2]
        if accepted[0] == accepted[1] == accepted[2]:
            self.both += 1
            if not accepted[0]:
                self.lines += 1
                line = ours.split(" ")[0]
                near = line in (other.split(" ")[0], driver.split(" ")[0])
                self.same_line += near
                if not near:
                    self.wrong.append(("line", name, ours, other, driver))
        elif ours != "differs" and ruled(text, ours, other, driver):
            self.ruled += 1
        else:
            self.wrong.append(("verdict", name, ours, other, driver))

    def __str__(self):
        return (f"{self.texts} texts, {self.valid} valid; as glslang {self.glslang}, as the driver {self.driver}, as both {self.both}, "
                f"by a ruling {self.ruled}; of {self.lines} in error for all, {self.same_line} in a judge's line")


def ruled(text, ours, other, driver):
    if (other == "ok") == (driver == "ok"):
        return other == "ok" and any(re.search(pattern, ours) for pattern, _ in AGAINST_BOTH)
    said = driver if other == "ok" else other
    text = text.decode(errors="replace") if isinstance(text, bytes) else text
    return any(re.search(pattern, said) and error == (ours != "ok") and all(re.search(wanted, text) for wanted in texts)
               for pattern, error, _, *texts in RULINGS)


def compare(texts):
    """texts: pairs of a name, which ends like the file, and the text."""
    count, batch = Count(), []

    def judge():
        with tempfile.TemporaryDirectory(prefix="glsl-") as folder:
            paths = []
            for name, text in batch:
                paths.append(os.path.join(folder, name))
                with open(paths[-1], "wb") as file:
                    file.write(text if isinstance(text, bytes) else text.encode())
            others, mine = glslang(paths), ours_and_driver(paths)
            for path, (_, text) in zip(paths, batch):
                before = len(count.wrong)
                count.add(os.path.basename(path), text, mine[path][0], others.get(path, "ok"), mine[path][1])
                keep = os.environ.get("GLSL_KEEP")
                if keep and len(count.wrong) > before:
                    with open(os.path.join(keep, os.path.basename(path)), "wb") as file:
                        file.write(text if isinstance(text, bytes) else text.encode())
        batch.clear()

    for pair in texts:
        batch.append(pair)
        if len(batch) == BATCH:
            judge()
    if batch:
        judge()
    return count


class Judges(unittest.TestCase):
    def check(self, what, texts, lines=1.0):
        count = compare(texts)
        print(f"{what}: {count}", flush=True)
        shown = "\n".join(" | ".join(entry) for entry in count.wrong[:200])
        self.assertGreater(count.texts, 0)
        self.assertEqual([entry for entry in count.wrong if entry[0] == "verdict"], [], "\n" + shown)
        self.assertGreaterEqual(count.same_line, lines * count.lines, shown)

    def test_shaders_of_the_programs(self):
        self.check("programs", programs())

    def test_submissions(self):
        self.check("corpus", list(submissions())[:: LONG or 120])

    def test_random_programs(self):
        self.check("random", self.random_programs(4000 // LONG if LONG else 20), 0.97)

    def random_programs(self, count):
        for i in range(count):
            program = glsl_random.Program(SEED * 1000003 + i, slips=(0, 1, 2, 4)[i % 4])
            text = program.text()
            yield f"random{i}.{program.stage}", text

    def test_mutations(self):
        originals = programs() + [pair for pair in submissions()][::7]
        originals += list(self.random_programs(200 if LONG else 10))
        count = 6000 // LONG if LONG else 10
        texts = []
        for i in range(count):
            name, text = originals[i * 7919 % len(originals)]
            text = text.decode(errors="replace") if isinstance(text, bytes) else text
            texts.append((f"mutation{i}-{name}", glsl_random.mutate(text, SEED * 1000003 + i)))
        self.check("mutations", texts, 0.9)


if __name__ == "__main__":
    if not any(os.access(os.path.join(folder, "glslangValidator"), os.X_OK) for folder in os.environ["PATH"].split(":")):
        print("glslangValidator is missing: apt install glslang-tools")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
