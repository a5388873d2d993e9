#!/usr/bin/env python3
"""`check --class` as a teaching assistant uses it, and as an attacker would abuse it.

usage: class_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]
       class_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER --time [N]

The second form judges N submissions of lab 5 (60), a third of them wrong, and prints the time. No
test depends on how long anything takes. Exit code: 77 if nothing can be drawn.
"""
import csv
import fcntl
import html.parser
import io
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tarfile
import time
import unittest
import xml.etree.ElementTree
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path[:0] = [os.path.join(os.path.dirname(HERE), "programs"), HERE]
import command_line_test as base

# Seconds of processor time, enough for what is right on a slow machine.
LIMIT = "12" if base.SANITIZED else "3"
PROGRAM = "check"
SOLUTIONS = os.path.join(base.SOURCE, "shaders/labs/solutions")
SOLUTION = os.path.join(SOLUTIONS, "lab05_per_fragment")
STARTER = os.path.join(base.SOURCE, "examples/labs/lab05_per_fragment")
VERT, FRAG = "lab05.vert", "lab05.frag"
SANDBOXED = r"each submission runs in bubblewrap: no network, no files but its own, "
# As many turns as are allowed, which no compiler shortens, so heavy that they do not end in time.
ENDLESS = (
    "float z = v_Position.x; for (int n = 0; n < 90000; n++) { "
    + " ".join(f"z = fract(sin(z * {i}.5) * 43758.5) * 0.5;" for i in range(1, 60))
    + " }"
)


def read(*path, mode="r"):
    with open(os.path.join(*path), mode) as file:
        return file.read()


class Page(html.parser.HTMLParser):
    """A page's element names, addresses and text; fails if an element is not closed."""

    def __init__(self, text):
        super().__init__()
        self.open, self.names, self.addresses, self.text = [], set(), [], ""
        self.feed(text)
        assert not self.open, self.open

    def handle_starttag(self, tag, attrs):
        self.names.add(tag)
        self.addresses += [value for key, value in attrs if key in ("href", "src")]
        assert not [key for key, value in attrs if key.startswith("on")], attrs
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open.pop() == tag, tag

    def handle_data(self, data):
        self.text += data


class Class(base.Case):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("class"))

    # Submissions.

    def submit(self, name, source=SOLUTION, **changed):
        """A folder with the files of `source`; `changed` replaces files by name ("_" for "."), None
        removes one."""
        folder = self.path("class", name)
        shutil.copytree(source, folder, ignore=shutil.ignore_patterns("*.md", "*.png"))
        for key, text in changed.items():
            path = os.path.join(folder, key.replace("_", "."))
            if os.path.exists(path):
                os.remove(path)
            if text is not None:
                self.make(path, text)
        return folder

    def frag(self, before="", replace=()):
        text = before + read(SOLUTION, FRAG)
        for old, new in replace:
            self.assertIn(old, text)
            text = text.replace(old, new, 1)
        return text

    def submit_endless(self, name):
        draw = "gl_FragColor = "
        text = self.frag(replace=((draw, f"{ENDLESS} {draw}z * "),))
        return self.submit(name, lab05_frag=text)

    # Runs.

    def start_class(self, *arguments, **more):
        """The program as a process, on lab 5 with results in "out"."""
        command = [os.path.join(base.EXAMPLES, PROGRAM), "--class", "class", "--lab", "5"]
        return subprocess.Popen(
            [*command, "-o", "out", *arguments], cwd=self.folder, stdout=subprocess.DEVNULL, **more
        )

    def run_class(self, *arguments, out="out", **more):
        """The exit code, and standard error as text."""
        result = self.run_it("--class", "class", "-o", out, *arguments, program=PROGRAM, **more)
        return result.returncode, result.stderr.decode()

    def check_class(self, *arguments, out="out", code=0, **more):
        """The lines of standard error after the one about the sandbox."""
        returned, error = self.run_class(*arguments, out=out, **more)
        self.assertEqual(returned, code, error)
        lines = error.splitlines()
        for line in lines:
            self.assertTrue(line.startswith("check: "), error)
        self.assertIn("each submission runs ", lines[0] if lines else "")
        return lines[1:]

    def lab5(self, *arguments, **more):
        return self.check_class("--lab", "5", *arguments, **more)

    def results(self):
        """The path and bytes of each file written."""
        for folder, _, names in os.walk(self.path("out")):
            for name in names:
                yield os.path.join(folder, name), read(folder, name, mode="rb")

    def junit(self):
        return xml.etree.ElementTree.parse(self.path("out/junit.xml")).getroot()

    def table(self, out="out"):
        with open(self.path(out, "class.csv"), newline="", encoding="utf-8") as file:
            return {row["student"]: row for row in csv.DictReader(file)}

    def verdicts(self, out="out"):
        return {name: row["verdict"] for name, row in self.table(out).items()}

    def check_refused(self, said, *arguments, code=1):
        self.refused(code, "^check: .*" + said, *arguments, program=PROGRAM)

    def assert_one_line(self, lines, student, verdict, said):
        about = [line for line in lines if line.startswith(f"check: {student}: ")]
        self.assertEqual(len(about), 1, (student, lines))
        self.assertRegex(about[0], rf"^check: {re.escape(student)}: {verdict}: .*(?:{said})")


class Names(Class):
    @base.in_long_form
    def test_submissions_are_found_under_names_of_people_and_platforms(self):
        self.submit("mueller_anna")
        self.submit("123456")
        self.submit("Zoë O'Brien_7788_assignsubmission_file_/nested")
        self.make("class/Zoë O'Brien_7788_assignsubmission_onlinetext_/onlinetext.html", "a text")
        for name in (VERT, FRAG):
            for to in (f"canvas_LATE_12_34_{name[:5]}-1{name[5:]}", f"flat_fred_{name}"):
                shutil.copy(os.path.join(SOLUTION, name), self.path("class", to))
        shutil.make_archive(self.path("class", "zip_zoe"), "zip", SOLUTIONS, "lab05_per_fragment")
        shutil.make_archive(self.path("class", "tar_tom"), "gztar", SOLUTION)
        os.makedirs(self.path("class/archive_in_folder/deep"))
        shutil.make_archive(self.path("class/archive_in_folder/deep/mine"), "xztar", SOLUTION)
        self.submit("all_labs/lab05_mine")
        self.submit("all_labs/lab06_mine", os.path.join(SOLUTIONS, "lab06_phong"))
        self.submit("topmost/deep")
        self.submit("topmost/deep/er", STARTER)
        self.submit("two/old")
        self.submit("two/new")
        for junk in (
            *(".DS_Store", "__MACOSX/x", "grades.csv", "Thumbs.db"),
            *("mueller_anna/._lab05.frag", "mueller_anna/report.pdf"),
        ):
            self.make(f"class/{junk}", b"\0junk")
        lines = self.lab5()
        self.assert_one_line(lines, "grades", "refused", "not read: .csv")
        self.assert_one_line(lines, "two", "refused", "(?=.*old).*new")
        students = (
            *("mueller_anna", "123456", "Zoë O'Brien", "canvas", "flat_fred"),
            *("zip_zoe", "tar_tom", "archive_in_folder", "all_labs", "topmost"),
        )
        self.assertEqual(
            self.verdicts(), {**dict.fromkeys(students, "right"), "grades": "refused", "two": "refused"}
        )
        self.assertEqual(self.table()["Zoë O'Brien"]["id"], "7788")
        attempts = {name: row["attempt"] for name, row in self.table().items()}
        self.assertEqual((attempts["canvas"], attempts["flat_fred"]), ("2", "1"))
        page = Page(read(self.path("out/index.html"))).text
        self.assertRegex(page, r"Zoë O'Brien\s+7788")
        self.assertRegex(page, r"canvas\s+12\s+attempt\xa02")

    def test_names_tell_the_lab(self):
        self.submit("a")
        self.assertEqual(self.check_class(), [])
        os.rename(self.path("class"), self.path("lab05 (handed in)"))
        result = self.run_it("--class", "lab05 (handed in)", "-o", "second", program=PROGRAM)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.verdicts("second"), {"a": "right"})

    def test_of_several_submissions_of_a_student_one_is_judged(self):
        self.submit("twice")
        shutil.make_archive(self.path("class", "twice"), "zip", STARTER)
        os.utime(self.path("class", "twice.zip"), (1, 1))
        os.utime(self.path("class", "twice"), (2, 2))
        error = self.run_class("--lab", "5")[1]
        first = error.splitlines()[0]
        self.assertIn("twice: more than one submission; the folder is judged, which is the latest", first)
        self.assertEqual(self.verdicts(), {"twice": "right"})
        self.assertEqual(self.table()["twice"]["attempt"], "2")
        self.assertIn("attempt\xa02", Page(read(self.path("out/index.html"))).text)

    def test_results_may_stand_among_the_submissions(self):
        self.submit("a")
        for out in ("results", "parts/1", "parts/1"):
            result = self.run_it(
                "--class", ".", "-o", out, "--lab", "5", program=PROGRAM, cwd=self.path("class")
            )
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(self.verdicts(f"class/{out}"), {"a": "right"})
            if out == "results":
                shutil.rmtree(self.path("class/results"))
                os.makedirs(self.path("class/parts"))

    def test_faults_of_the_command_line(self):
        self.submit("a")
        os.makedirs(self.path("nothing"))
        for option, value in (
            *(("--jobs", "0"), ("--part", "3/2"), ("--part", "0/2"), ("--part", "x")),
            *(("--limit", "0"), ("--seed", "-1")),
        ):
            said = f"{option} {value}: must be"
            self.check_refused(said, "--class", "class", option, value, code=2)
        for code, said, *arguments in (
            (2, r"--job: ", "--class", "class", "--job"),
            (2, r"did you mean --part", "--class", "class", "--prat", "1/2"),
            (2, r"one of them", "--class", "class", "--merge"),
            (2, r"needs the folders", "--merge"),
            (2, r"--class: needs a value", "--class"),
            (2, r"not an option", "--class", "class", "more"),
            (2, r"lab77", "--class", "class", "--lab", "lab77"),
            (1, r"missing: No such file", "--class", "missing", "--lab", "5"),
            (1, r"nothing: no submissions", "--class", "nothing", "--lab", "5"),
            (1, r"missing/out: cannot create", "--class", "class", "-o", "missing/out", "--lab", "5"),
        ):
            self.check_refused(said, *arguments, code=code)
        self.assertIn("--part I/N", self.good("--class", "x", "--help", program=PROGRAM).decode())


class Abuse(Class):
    """Each attack costs its own submission, and one line."""

    def archive(self, name, *entries):
        """A .tar of entries: (name, content), or a TarInfo."""
        with tarfile.open(self.path("class", name), "w:gz", compresslevel=1) as tar:
            for entry in entries:
                if isinstance(entry, tarfile.TarInfo):
                    tar.addfile(entry)
                else:
                    info = tarfile.TarInfo(entry[0])
                    info.size = len(entry[1])
                    tar.addfile(info, io.BytesIO(entry[1]))

    def link(self, name, target, kind=tarfile.SYMTYPE):
        info = tarfile.TarInfo(name)
        info.type, info.linkname = kind, target
        return info

    @base.in_long_form
    def test_an_attack_costs_only_its_own_submission(self):
        secret = "the teacher's secret"
        self.make("secret.frag", "#error " + secret)
        self.submit("good")
        self.submit("ten_megabytes", lab05_frag=self.frag() + " " * 10_000_000)
        self.submit("another_file", lab05_frag=self.frag('#include "../good/lab05.frag"\n'))
        self.submit("absolute", lab05_frag=self.frag(f'#include "{self.path("secret.frag")}"\n'))
        self.submit("device", lab05_frag=self.frag('#include "/dev/zero"\n'))
        self.submit("itself", lab05_frag=self.frag('#include "lab05.frag"\n'))
        self.submit("link", lab05_frag=None)
        os.symlink(self.path("secret.frag"), self.path("class/link", FRAG))
        self.submit("linked_device", lab05_frag=None)
        os.symlink("/dev/zero", self.path("class/linked_device", FRAG))
        os.symlink(self.path("class/good"), self.path("class/linked_folder"))
        self.submit("pipe", lab05_frag=None)
        os.mkfifo(self.path("class/pipe", FRAG))
        self.submit("zeros", lab05_frag=b"\0" * 1000)
        self.submit("nothing", lab05_frag=None, lab05_vert=None)
        self.submit_endless("endless")
        files = [(name, read(SOLUTION, name, mode="rb")) for name in (VERT, FRAG)]
        self.archive("climbs.tar.gz", *files, ("../../climbed.frag", b"x"))
        self.archive("absolute_path.tar.gz", *files, ("/tmp/climbed.frag", b"x"))
        self.archive("link_in_archive.tar.gz", files[0], self.link(FRAG, "/etc/passwd"))
        self.archive("hard_link.tar.gz", files[0], self.link(FRAG, "/etc/passwd", tarfile.LNKTYPE))
        # A link to a folder, and a file through it: harmless because nothing is written.
        through = (self.link("x", self.folder), ("x/climbed.frag", b"x"))
        self.archive("through_link.tar.gz", *files, *through)
        self.archive("many.tar.gz", *[(f"{i}.frag", b"") for i in range(5000)])
        with zipfile.ZipFile(self.path("class/bomb.zip"), "w", zipfile.ZIP_DEFLATED, True, 1) as bomb:
            bomb.writestr(VERT, read(SOLUTION, VERT))
            bomb.writestr(FRAG, b" " * 270_000_000)
        with zipfile.ZipFile(self.path("class/climbing_zip.zip"), "w") as archive:
            archive.writestr("..\\..\\climbed.frag", "x")
        self.archive("solid_bomb.tar.gz", ("large.bin", bytes(270_000_000)), *files)
        self.make("class/no_archive.zip", b"PK\3\4 and then something else")
        before = sorted(os.listdir(self.folder))

        lines = self.lab5("--limit", LIMIT)
        for student, verdict, said in (
            ("ten_megabytes", "refused", "has 10000755 bytes; at most"),
            ("another_file", "refused|error", r"lab05\.frag"),
            ("absolute", "refused|error", r"secret\.frag"),
            ("device", "refused|error", "/dev/zero"),
            ("itself", "refused|error", "include"),
            ("link", "refused", "is a link"),
            ("linked_device", "refused", "is a link"),
            ("linked_folder", "refused", "a link"),
            ("pipe", "refused", "is a pipe"),
            ("zeros", "refused|error", "."),
            ("nothing", "refused", "no source files"),
            ("endless", "timeout", "loop"),
            ("climbs", "refused", r"leaves its folder: \.\./\.\./climbed"),
            ("absolute_path", "refused", "leaves its folder: /tmp/climbed"),
            ("climbing_zip", "refused", r"leaves its folder: \.\./\.\./climbed"),
            ("link_in_archive", "refused", "is a link"),
            ("hard_link", "refused", "is a link"),
            ("many", "refused", "more than"),
            ("bomb", "refused", "unpacks to more than"),
            ("solid_bomb", "refused", "unpacks to more than"),
            ("no_archive", "refused", "cannot be read"),
        ):
            with self.subTest(student=student):
                self.assert_one_line(lines, student, f"(?:{verdict})", said)
        self.assertEqual(
            {name: verdict for name, verdict in self.verdicts().items() if verdict == "right"},
            {"good": "right", "through_link": "right"},
        )
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(before + ["out"]))
        for path, content in self.results():
            self.assertNotIn(secret.encode(), content, path)
            self.assertNotIn(b"root:", content, path)

    @base.in_long_form
    def test_c_runs_only_in_a_sandbox(self):
        """The fork bombs run only after the program has proven its limits in this very folder and
        for this very user."""
        solution = os.path.join(SOLUTIONS, "lab03_normal_matrix")
        code = read(solution, "matrices.c")
        start = code.index("{", code.index("lab_matrices("))
        self.submit("good", solution)

        def with_code(name, before, inside):
            text = before + code[: start + 1] + inside + code[start + 1 :]
            self.submit(name, solution, matrices_c=text)

        returned, error = self.run_class("--lab", "3", out="first")
        if "install the package bubblewrap" in error:
            self.assertEqual(returned, 1)
            self.skipTest("no bubblewrap that works")
        self.assertRegex(error, SANDBOXED)
        self.assertEqual(self.verdicts("first"), {"good": "right"}, error)

        self.make("secret.h", "#error the secret\n")
        # No header that declares these may be included; an attacker declares them.
        declared = (
            "#include <stddef.h>\n#include <string.h>\n"
            "int fork(void); int pause(void); unsigned sleep(unsigned); int kill(int, int); "
            "int getppid(void); void *malloc(size_t); void abort(void); void _exit(int); struct file; "
            "struct file *fopen(const char *, const char *); "
            "int fputs(const char *, struct file *); int fclose(struct file *);\n"
        )
        # An endless one takes the seconds of processor time that a call has, and the class is patient twice.
        early = "for (;;) fork();" if base.LONG else "for (int i = 0; i < 10000; i++) fork(); abort();"
        constructor = f"__attribute__((constructor)) static void early(void) {{ {early} }}\n"
        bombs = (
            ("early_bomb", declared + constructor, ""),
            ("bomb", declared, " for (;;) fork(); "),
            ("patient_bomb", declared, " while (fork() >= 0) ; for (;;) pause(); "),
        )
        for bomb in bombs[:: base.step(9)]:
            with_code(*bomb)
        if base.LONG:  # labs_test.py has another: a call has 2 s, and a class is patient twice
            with_code("endless", "", " for (;;) ; ")
        with_code("sleeper", declared, " sleep(1000); ")
        eating = " for (;;) { char *p = malloc(1 << 20); if (!p) abort(); memset(p, 1, 1 << 20); } "
        with_code("eater", declared, eating)
        with_code("crash", "", " *(volatile int *)8 = 1; ")

        def writing(path, text):
            opened = f'struct file *f = fopen("{path}", "w");'
            return f" {{ {opened} if (f) {{ fputs({json.dumps(text)}, f); fclose(f); }} }} "

        with_code("writer", declared, writing(self.path("written"), "x"))
        with_code("killer", declared, " kill(getppid(), 9); ")
        # As if the kernel could not confine it.
        with_code("pretender", declared, " _exit(3); ")
        with_code("include_device", '#include "/dev/zero"\n', "")
        with_code("include_secret", f'#include "{self.path("secret.h")}"\n', "")
        with_code("include_system", "#include <unistd.h>\n", "")
        # Its own result, everywhere it might be read from.
        forged = json.dumps({"lab": "lab03_normal_matrix", "points": 10, "verdict": "right"})
        places = [f"{folder}out/verdict.json" for folder in ("/tmp/", "", "../")]
        forging = "".join(writing(place, forged) for place in places)
        with_code("forger", declared, forging + " abort(); ")
        lines = self.check_class("--lab", "3", "--limit", LIMIT)
        verdicts = self.verdicts()
        self.assertEqual(verdicts.pop("good"), "right")
        # Their calls fail, but the rest of their code may be right.
        for name in ("writer", "killer", "sleeper", "include_system"):
            self.assertIn(verdicts.pop(name), ("right", "error", "refused"))
        for name, verdict in verdicts.items():
            with self.subTest(student=name):
                self.assertIn(verdict, ("timeout", "error", "refused"), lines)
                self.assert_one_line(lines, name, verdict, ".")
        self.assertFalse(os.path.exists(self.path("written")))
        for path, content in self.results():
            self.assertNotIn(b"the secret", content, path)

    def test_text_that_students_choose_stays_text(self):
        names = ["<script>alert(1)<", "=1+cmd|' ", 'a"b,c', "-rf", "%s%n", "' onload='x", "a&b;", "@SUM(A1)"]
        for name in names:
            self.submit(name, lab05_frag="#error <script>=1+1</script>\n" + self.frag())
        self.assertEqual(len(self.lab5()), len(names))
        self.assertEqual(len(self.table()), len(names))
        with open(self.path("out/class.csv"), newline="", encoding="utf-8") as file:
            for row in csv.reader(file):
                for field in row:
                    self.assertFalse(field[:1] and field[0] in "=+-@\t\r", row)
        cases = self.junit().iter("testcase")
        self.assertEqual(sorted(case.get("name") for case in cases), sorted(names))
        for path, content in self.results():
            if path.endswith(".html"):
                self.assertNotIn("script", Page(content.decode()).names)


class Results(Class):
    def judged(self, out="out"):
        """When each result was written."""
        students = pathlib.Path(self.path(out, "students"))
        return {path.parent.name: path.stat().st_mtime_ns for path in students.glob("*/result.json")}

    def wait_for_result(self, process, student):
        path = self.path("out/students", student, "result.json")
        while process.poll() is None and not os.path.exists(path):
            time.sleep(0.01)

    def test_tables_and_pages(self):
        self.submit("right")
        self.submit("wrong", STARTER)
        self.submit("broken", lab05_frag="void main() { gl_FragColor = vec4(1.0) }\n")
        self.lab5()
        out = self.path("out")
        self.assertEqual(self.verdicts(), {"right": "right", "wrong": "wrong", "broken": "error"})
        everything = json.loads(read(out, "class.json"))
        students = [entry["student"] for entry in everything["students"]]
        self.assertEqual(students, ["broken", "right", "wrong"])
        suites = self.junit()
        counts = [suites.get(name) for name in ("tests", "failures", "errors")]
        self.assertEqual(counts, ["3", "1", "1"])
        self.assertEqual(
            {case.get("name"): [child.tag for child in case] for case in suites.iter("testcase")},
            {"right": [], "wrong": ["failure"], "broken": ["error"]},
        )
        for student, row in self.table().items():
            results = json.loads(read(out, "students", student, "results.json"))
            self.assertEqual(results["score"], float(row["points"]))
            self.assertEqual(results["output_format"], "text")
            for test in results["tests"]:
                self.assertIn(test["status"], ("passed", "failed"))
                self.assertTrue(test["name"])
            page = Page(read(out, "students", student, "index.html"))
            self.assertIn(f"{float(row['points']):g} of 10 points", page.text)
            # No other student's name, and nothing outside its folder.
            self.assertFalse(
                set(self.table()) - {student} & set(page.text.split()) - {student, "right", "wrong"}
            )
            self.assertFalse([path for path in page.addresses if "/" in path])
        page = Page(read(out, "index.html"))
        for path in page.addresses:
            self.assertTrue(os.path.exists(os.path.join(out, path)), path)
            self.assertNotIn(":", path)
        self.assertNotIn("script", page.names)
        picture = base.Png(read(out, "students/wrong/worst.png", mode="rb"))
        self.assertGreater(picture.width, picture.height)
        self.assertEqual(picture.texts, {})

    @base.in_long_form
    def test_similar_submissions_are_listed_with_both_texts(self):
        """Each student writes a line that no other has; the copy has other names, order and layout. Lines of both
        that begin with acc, which may be read as a number, are not the same."""
        last = "gl_FragColor = "
        for i in range(12):
            line = f"float own{i} = fract({i}.5 * v_Position.x) * min({i}.25, v_Position.y);"
            self.submit(f"student_{i}", lab05_frag=self.frag(replace=((last, f"{line}\n  {last}"),)))
        first = """vec2 a = mod(v_Position.xy, 0.3) / 7.5;
            float b = atan(a.x, a.y) + 0.125;
            vec3 c = cross(vec3(a, b), vec3(0.5, 0.25, b));
            if (b > 0.75) c = reflect(c, c.zyx) - vec3(b);
            float acc = b * 0.61 - 0.01;\n    acc = acc / 3.7 - 0.02 * b;"""
        second = """vec2 other = mod(v_Position.xy, 0.30)/7.5; float _z = 0.125 + /* mine */ atan(other.x,
            other.y); vec3 v = cross(vec3(other, _z), vec3(0.5, 0.25, _z));
            if (_z > 0.75)\n                v = reflect(v, v.zyx) - vec3(_z);
            float acc = 9.5 / _z + 1.25;\n    acc = _z + 4.4 * acc;"""
        for name, text in (("first", first), ("second", second)):
            self.submit(name, lab05_frag=self.frag(replace=((last, f"{text}\n  {last}"),)))
        self.assertEqual(self.run_class("--lab", "5")[0], 0)
        page = read(self.path("out", "index.html"))
        self.assertEqual(
            re.findall("<summary>.*</summary>", page),
            ["<summary><bdi>first</bdi> and <bdi>second</bdi>: 4 statements that few others have</summary>"],
        )
        self.assertEqual(page.count('<span class="same">'), 7)  # lines
        Page(page)
        self.assertNotIn("second", read(self.path("out", "students", "first", "index.html")))

    @base.in_long_form
    def test_a_run_continues_where_another_stopped(self):
        count = 12 if base.LONG else 6
        for i in range(count):
            self.submit(f"student{i:02}")
        with self.start_class("--jobs", "1", stderr=subprocess.PIPE) as process:
            self.wait_for_result(process, "student01")
            process.send_signal(signal.SIGINT)
            error = process.communicate(timeout=base.PATIENCE)[1].decode()
        self.assertEqual(process.returncode, 1, error)
        self.assertIn("interrupted; run the same command again", error)
        first = self.judged()
        self.assertTrue(2 <= len(first) < count, first)
        self.assertEqual(set(self.verdicts().values()), {"right"})
        self.assertEqual(self.lab5(), [])
        second = self.judged()
        self.assertEqual(len(second), count)
        self.assertEqual({name: second[name] for name in first}, first)

    @base.in_long_form
    def test_signals_that_are_ignored_do_not_interrupt(self):
        """As with nohup."""
        for i in range(3):
            self.submit(f"student{i}")
        ignore = lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)
        with self.start_class(
            "--jobs", "1", stderr=subprocess.PIPE, preexec_fn=ignore
        ) as process:
            self.wait_for_result(process, "student0")
            process.send_signal(signal.SIGHUP)
            error = process.communicate(timeout=base.PATIENCE)[1].decode()
        self.assertEqual(process.returncode, 0, error)
        self.assertEqual(len(self.judged()), 3)

    def state(self, process):
        """Its parent's id and its state's letter; (0, "Z") if it has ended."""
        try:
            words = read("/proc", str(process), "stat").rpartition(")")[2].split()
        except OSError:
            return 0, "Z"
        return int(words[1]), words[0]

    def descendants(self, process):
        """The processes that it has started, and theirs."""
        parents = {int(name): self.state(name)[0] for name in os.listdir("/proc") if name.isdigit()}
        found = []
        more = [process]
        while more:
            more = [child for child, parent in parents.items() if parent in more]
            found += more
        return found

    def judging(self, process):
        """Whether it has come to the check itself, in its sandbox."""
        try:
            words = read("/proc", str(process), "cmdline", mode="rb").split(b"\0")
            return words[1:3] == [b"--inside", b"check"]
        except OSError:
            return False

    def check_end(self, end, ready):
        """A class of endless submissions that gets the signal once `ready` is true of what it has
        started leaves nothing running."""
        arguments = ("--jobs", "4", "--limit", "1000", "--again")
        with self.start_class(*arguments, stderr=subprocess.DEVNULL) as process:
            started = []
            while process.poll() is None and not ready(started):
                time.sleep(0.01)
                started = self.descendants(process.pid)
            process.send_signal(end)
            process.wait(timeout=base.PATIENCE)
            # The kernel ends a process whose parent was killed a moment later.
            for _ in range(20 * base.PATIENCE):
                left = [pid for pid in started if self.state(pid)[1] != "Z"]
                if not left:
                    break
                time.sleep(0.05)
            self.assertEqual(left, [])

    def test_what_was_started_ends_with_the_program(self):
        for i in range(4):
            self.submit_endless(f"endless{i}")
        for end in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            with self.subTest(signal=end):
                self.check_end(end, lambda started: sum(map(self.judging, started)) >= 4)

    def test_what_was_started_ends_with_the_program_at_any_moment(self):
        """Bubblewrap alone leaves a sandbox behind if it is killed at its start."""
        for i in range(4):
            self.submit_endless(f"endless{i}")
        for count in range(2, 17, base.LONG or 5):
            for end in (signal.SIGINT, signal.SIGKILL):
                with self.subTest(processes=count, signal=end):
                    self.check_end(end, lambda started: len(started) >= count)

    @base.in_long_form
    def test_a_changed_submission_is_judged_again(self):
        self.submit("a", STARTER)
        self.submit("b")
        self.lab5()
        before = self.judged()
        self.assertEqual(self.verdicts(), {"a": "wrong", "b": "right"})
        for name in (FRAG, VERT):
            shutil.copy(os.path.join(SOLUTION, name), self.path("class/a"))
        self.lab5()
        self.assertEqual(self.verdicts(), {"a": "right", "b": "right"})
        second = self.judged()
        self.assertGreater(second["a"], before["a"])
        self.assertEqual(second["b"], before["b"])
        # With --again everything.
        self.lab5("--again")
        third = self.judged()
        self.assertTrue(all(third[name] > second[name] for name in second))

    @base.in_long_form
    def test_the_front_has_those_that_no_other_beats(self):
        """Of results with other costs."""
        costs = {"a": (1, 500), "b": (0.5, 1000), "c": (1, 1000), "d": (0.5, 1000), "e": None}
        for name in costs:
            self.submit(name)
        self.lab5()
        for name, cost in costs.items():
            path = os.path.join("out/students", name, "result.json")
            result = json.loads(read(self.path(path)))
            if cost:
                result["cost"] = {"error": cost[0], "time_ratio": 1, "operations": cost[1], "operations_ratio": cost[1] / 1000}
            self.make(path, json.dumps(result))
        self.good("--merge", "out", "-o", "front", program=PROGRAM)
        efficient = re.search("Efficient: (.*)", read(self.path("front/index.html")))[1]
        self.assertEqual(re.findall("<bdi>(.)</bdi>", efficient), ["a", "b", "d"])
        self.assertIn("(0.500 of the operations, 1.00 of the time, 1.00 steps)", efficient)

    def test_a_broken_result_is_judged_again(self):
        self.submit("a")
        self.lab5()
        os.truncate(self.path("out/students/a/result.json"), 100)
        self.assertIn("a/result.json: not a valid result, judging again", "\n".join(self.lab5()))
        self.assertEqual(self.verdicts(), {"a": "right"})

    @base.in_long_form
    def test_a_finished_result_stays_when_the_next_is_worse(self):
        """The same submission has too little time in the second run; the first is as if it had enough."""
        self.submit("fast")
        self.lab5()
        self.submit_endless("slow")
        self.lab5("--limit", "1")
        slow, fast = (json.loads(read(self.path("out/students", name, "result.json"))) for name in ("slow", "fast"))
        self.assertEqual((slow["verdict"], fast["verdict"]), ("timeout", "right"))
        self.make("out/students/slow/result.json", json.dumps({**fast, "student": "slow", "hash": slow["hash"]}))
        shutil.rmtree(self.path("class/fast"))
        self.assertEqual(self.lab5(), [])  # as it was made
        before = self.table()["slow"]
        self.assertEqual(before["verdict"], "right")
        lines = self.lab5("--again", "--limit", "1")
        self.assertRegex(lines[0], "slow: timeout: .*the earlier, better result stays")
        self.assertEqual(self.table()["slow"], before)

    @unittest.skipIf(base.SANITIZED, "a sanitizer takes terabytes of addresses")
    def test_what_a_machine_cannot_judge_is_its_failure(self):
        """And judged by the same command where it can."""
        for name in "a", "b":
            self.submit(name)
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (64 << 20,) * 2)
        lines = self.lab5(code=1, preexec_fn=limit)
        self.assertEqual([re.sub(r"^check: [ab]: ", "", line) for line in lines], [
            "error: judging failed: EGL: the limit of memory is 64 MB (ulimit -v): raise it to 1024"] * 2 + [
            "check: 2 of 2 could not be judged, which is no fault of theirs; the same command tries them again"])
        self.assertEqual(self.lab5(), [])
        self.assertEqual(self.verdicts(), {"a": "right", "b": "right"})

    def test_limits_that_are_less_than_the_sandboxs_are_named(self):
        """What does not fit into them would be taken for a submission's fault."""
        self.submit("a")
        for which, most, said in ((resource.RLIMIT_NOFILE, 16, r"open files \(ulimit -n\) is 16: raise it to 128"),
                                  (resource.RLIMIT_FSIZE, 9000, r"a file's bytes \(ulimit -f\) is 9000: raise it to \d+"),
                                  (resource.RLIMIT_CPU, 9, r"processor seconds \(ulimit -t\) is 9: raise it to 80")):
            result = self.run_it("--class", "class", "--lab", "5", "-o", "out", program=PROGRAM,
                                 preexec_fn=lambda: resource.setrlimit(which, (most, most)))
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr.decode(), "^check: no submission is judged: .*: the limit of " + said)

    @base.in_long_form
    def test_variables_of_the_driver_change_no_verdict(self):
        """llvmpipe divides by zero with vectors of 7 bits, and draws anything with some others."""
        for setting in {"LP_NATIVE_VECTOR_WIDTH": "7"}, {"GALLIUM_DRIVER": "nonsense", "LD_PRELOAD": ""}:
            result = self.run_it("5", SOLUTION, program=PROGRAM, environment=setting)
            self.assertEqual(result.returncode, 0, result.stdout.decode())

    def test_two_runs_do_not_write_into_one_folder(self):
        self.submit("a")
        self.lab5()
        with open(self.path("out/.lock"), "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            for arguments in (("--class", "class", "--lab", "5"), ("--merge", "out")):
                self.check_refused("out: another run writes there", *arguments, "-o", "out")

    def test_parts_are_merged_to_the_whole(self):
        count = 8 if base.LONG else 4
        for i in range(count):
            self.submit(f"student{i}", STARTER if i % 3 == 0 else SOLUTION)
        self.lab5(out="whole")
        for part in (1, 2, 3):
            self.lab5("--part", f"{part}/3", out=f"part{part}")
        merged = self.good("--merge", "part1", "part2", "part3", "-o", "merged", program=PROGRAM)
        self.assertEqual(merged, b"merged/index.html\n")
        parts = [f"part{part}" for part in (1, 2, 3)]
        judged = [out for out in parts if os.path.exists(self.path(out, "class.csv"))]
        self.assertEqual(sum(len(self.verdicts(out)) for out in judged), count)

        def without_times(out):
            return {name: {**row, "seconds": None} for name, row in self.table(out).items()}

        self.assertEqual(without_times("merged"), without_times("whole"))
        picture = "students/student0/worst.png"
        self.assertEqual(self.read(f"merged/{picture}"), self.read(f"whole/{picture}"))
        # What is missing, double or was judged otherwise is refused by name, and nothing is written.
        def refused(said, *folders):
            self.check_refused(said, "--merge", *folders, "-o", "other")
            self.assertFalse(os.path.exists(self.path("other")))

        refused("missing/run.json: No such file", "part1", "missing")
        refused("part 2 of 3 is missing; judge that", "part1", "part3")
        refused("part 1 of 3 is there twice: part1 and part1", "part1", "part1", "part2", "part3")
        refused("part1 and whole were not judged alike: parts is 3 and 0", "part1", "whole")
        # Who came between the parts would be in none.
        self.submit("late")
        self.lab5("--part", "2/3", out="more")
        refused(f'part1 and more were not judged alike: class is "{count} submissions, .*" and '
                f'"{count + 1} submissions, ', "part1", "more", "part3")
        shutil.rmtree(self.path("class/late"))
        lost = os.listdir(self.path(f"{judged[0]}/students"))[0]
        os.remove(self.path(f"{judged[0]}/students/{lost}/result.json"))
        refused(f"{judged[0]}: without a result: {lost}; judge that", *parts)
        result = self.run_it("--merge", *parts, "--partial", "-o", "other", program=PROGRAM)
        self.assertEqual((result.returncode, result.stderr.decode()),
                         (0, f"check: {judged[0]}: without a result: {lost}\n"))
        self.assertEqual(len(self.verdicts("other")), count - 1)
        self.lab5("--part", "2/3", "--seed", "9", out="seed")
        shutil.rmtree(self.path("other"))
        refused("part1 and seed were not judged alike: seed is 1 and 9", "part1", "seed", "part3")
        run = json.loads(self.read("part2/run.json"))
        for what in ("lab's files", "program"):  # another version of either
            self.make("part2/run.json", json.dumps({**run, what: "0123"}).encode())
            refused(f'part1 and part2 were not judged alike: {what} is "[0-9a-f]{{16}}" and "0123"', *parts)

    def test_results_of_another_lab_are_left_alone(self):
        self.submit("a")
        self.lab5()
        arguments = ("--class", "class", "--lab", "6", "-o", "out")
        self.check_refused("out: has results of lab05_per_fragment", *arguments)

    def test_judging_without_root(self):
        self.need_somebody()
        self.submit("a")
        self.submit("evil", lab05_frag=self.frag('#include "/etc/passwd"\n'))
        os.makedirs(self.path("theirs"))
        os.chmod(self.path("theirs"), 0o777)
        lines = self.lab5(out="theirs/out", **base.SOMEBODY)
        if len(lines) == 2:  # as in a chroot, where only root may make a name space
            self.assertRegex(lines.pop(0), "^check: bubblewrap: bwrap: ")
        self.assert_one_line(lines, "evil", "error", "/etc/passwd: no such file beside it")
        self.assertEqual(self.verdicts("theirs/out")["a"], "right")

    @unittest.skipIf(os.getuid() != 0, "only root judges as another user")
    def test_root_without_bubblewrap_is_told_what_is_closed(self):
        self.submit("a")
        os.mkdir(self.path("closed"), 0o700)
        copy = shutil.copy(os.path.join(base.EXAMPLES, PROGRAM), self.path("closed"))
        shutil.copy(os.path.join(base.EXAMPLES, "..", "source_root"), self.path("closed"))
        arguments = ("--class", "class", "--lab", "5", "-o", "out")
        result = self.run_it(*arguments, program=copy, environment={"PATH": self.folder})
        self.assertEqual(result.returncode, 1)
        self.assertRegex(
            result.stderr.decode(),
            r"^check: no submission is judged: bubblewrap: bwrap: No such file or directory; and "
            r"without it: .*/closed: is closed to other users, .*; open it \(chmod o\+rx\), or "
            r"install the package bubblewrap\n$",
        )
        self.assertFalse(os.path.exists(self.path("out/class.csv")))

    @base.in_long_form
    def test_without_bubblewrap_limits_remain(self):
        """And C does not run."""
        self.submit("a")
        os.makedirs(self.path("tmp"))
        nothing = {"PATH": self.folder, "TMPDIR": self.path("tmp")}
        self.need_somebody()
        lines = self.lab5(environment=nothing)
        self.assertIn("bubblewrap: bwrap: No such file", lines[0])
        self.submit_endless("endless")
        self.lab5("--limit", "1", environment=nothing)
        self.assertEqual(self.verdicts(), {"a": "right", "endless": "timeout"})
        self.assertEqual(os.listdir(self.path("tmp")), [])
        shutil.rmtree(self.path("class"))
        self.submit("c", os.path.join(SOLUTIONS, "lab03_normal_matrix"))
        returned, error = self.run_class("--lab", "3", out="c", environment=nothing)
        self.assertEqual(returned, 1)
        self.assertIn("has C, which runs only in a sandbox", error)
        self.assertFalse(os.listdir(self.path("c/students")))


def take_time(count):
    case = Class()
    case.setUp()
    for i in range(count):
        case.submit(f"student{i:02}", STARTER if i % 3 == 0 else SOLUTION)
    start = time.monotonic()
    case.lab5()
    print(f"{count} submissions: {time.monotonic() - start:.1f} s on {os.cpu_count()} processors")
    case.doCleanups()


if __name__ == "__main__":
    if "--time" in sys.argv:
        take_time(int((sys.argv[sys.argv.index("--time") + 1 :] + [60])[0]))
        sys.exit()
    sys.exit(base.main())
