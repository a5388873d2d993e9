#!/usr/bin/env python3
"""Labs by folder alone: judged by their solutions, and one clear line for what is wrong in a lab.json.

usage: own_labs_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]
Exit code: 77 if nothing can be drawn.
"""
import csv
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path[:0] = [os.path.join(os.path.dirname(HERE), "programs")]
import command_line_test as base

LABS = os.path.join(base.SOURCE, "examples", "labs")
EXTRA = os.path.join(LABS, "extra")
CHECK = os.path.join(base.EXAMPLES, "check")


def check(*arguments):
    return subprocess.run([CHECK, *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=base.PATIENCE)


def result(lab, path, *more):
    done = check("--lab", lab, path, "--seed", "1", "--limit", str(base.PATIENCE), "--json", "-", *more)
    assert done.stdout.startswith("{"), done
    found = json.loads(done.stdout)
    found.pop("seconds")
    return found


def read(*path):
    with open(os.path.join(*path)) as file:
        return file.read()


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="own_labs_test-")
        self.addCleanup(self.folder.cleanup)

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def write(self, text, *names):
        os.makedirs(os.path.dirname(self.path(*names)), exist_ok=True)
        with open(self.path(*names), "w") as file:
            file.write(text)
        return os.path.dirname(self.path(*names))

    def copy(self, name, target):
        shutil.copytree(os.path.join(EXTRA, name), self.path(target))
        return self.path(target)

    def change(self, old, new, *names):
        text = read(self.path(*names))
        self.assertIn(old, text)
        self.write(text.replace(old, new), *names)


class Extra(Case):
    """The labs of examples/labs/extra."""

    def test_solutions_are_right_and_starters_are_not(self):
        for name in sorted(os.listdir(EXTRA)):
            lab = os.path.join(EXTRA, name)
            self.assertEqual(result(lab, os.path.join(lab, "solution"))["points"], 10, name)
            starter = result(lab, lab)
            self.assertEqual((starter["verdict"], starter["message"]), ("wrong", "unchanged: this is the starter"))

    def test_a_mistake_is_wrong_in_words(self):
        lab = os.path.join(EXTRA, "fog")
        solution = read(lab, "solution", "fog.frag")
        self.write(read(lab, "solution", "fog.vert"), "mine", "fog.vert")
        mine = self.write(solution.replace("-depth * depth", "-depth"), "mine", "fog.frag")
        wrong = result(lab, mine)
        self.assertEqual((wrong["verdict"], wrong["points"]), ("wrong", 1))
        self.assertIn("The outline is right: the mistake is in the light.", wrong["symptoms"])

    # Of the solution: what becomes what, and the value that is wrong first, which is drawn, but the result.
    FIRST = [
        ("fog", "u_FogDensity * length(", "length(", "depth", "line 22 of fog.frag"),
        ("spot", "normalize(v_Normal)", "v_Normal", "nDotL", "line 21 of spot.frag"),
        ("spot", "-lightDirection, u_SpotDirection", "lightDirection, u_SpotDirection", "cosine", "line 23 of spot.frag"),
        ("spot", "u_Attenuation.y * d", "u_Attenuation.x * d", "attenuation", "line 25 of spot.frag"),
        ("spot", "v_Color.rgb, v_Color.a", "v_Color.bgr, v_Color.a", "gl_FragColor", "line 27 of spot.frag"),
    ]

    @base.in_long_form
    def test_the_first_wrong_value_is_told_and_drawn(self):
        for name, old, new, value, place in self.FIRST[:: base.step(2)]:  # both labs, and the result
            lab = os.path.join(EXTRA, name)
            self.write(read(lab, "solution", name + ".vert"), name, name + ".vert")
            mine = self.write(read(lab, "solution", name + ".frag"), name, name + ".frag")
            self.change(old, new, name, name + ".frag")
            symptoms = result(lab, mine, "--pictures", self.path("found"))["symptoms"]
            first = [text for text in symptoms if text.startswith(("Wrong first", "Below in the picture"))]
            with open(self.path("found", "worst.png"), "rb") as file:
                width, height = struct.unpack(">II", file.read(24)[16:])
            drawn = value != "gl_FragColor"
            self.assertEqual(len(first), 2 if drawn else 1, symptoms)
            self.assertRegex(first[0], rf"^Wrong first, .*: {value} is [-\d].*; right is [-\d].*\. See {place}")
            if drawn:
                self.assertRegex(first[1], rf"submitted and right: {value}: from .*, dark violet, to ")
            # Square scenes; one is twice as wide.
            self.assertIn(round((width - 16) / (height - (8 if drawn else 0)), 2), (1.5, 3) if drawn else (3, 6), first)

    # Of the solution: what becomes what.
    MISTAKES = {
        "fog": {
            "a linear exponent": ("-depth * depth", "-depth"),
            "from the origin": ("u_EyePosition - v_Position", "v_Position"),
            "the fog's share for the surface's": ("mix(u_FogColor, lit, seen)", "mix(lit, u_FogColor, seen)"),
            "fog only on the light": ("mix(u_FogColor, lit, seen)", "lit * seen"),
            "the distance squared, not the density": ("exp(-depth * depth)", "exp(-depth * length(u_EyePosition - v_Position))"),
        },
        "spot": {
            "a linear edge": ("smoothstep(u_CosOuterCut, u_CosInnerCut, cosine)",
                              "clamp((cosine - u_CosOuterCut) / (u_CosInnerCut - u_CosOuterCut), 0.0, 1.0)"),
            "a hard edge": ("smoothstep(u_CosOuterCut, u_CosInnerCut, cosine)", "step(u_CosOuterCut, cosine)"),
            "no attenuation": (" * attenuation)", ")"),
            "no quadratic term": (" + u_Attenuation.z * d * d", ""),
            "ambient light in the cone only": ("u_AmbientLight + u_LightColor * (nDotL * spot", "(u_AmbientLight + u_LightColor * nDotL) * (spot"),
            "not normalized": ("normalize(v_Normal)", "v_Normal"),
            "no max": ("max(dot(normalize(v_Normal), lightDirection), 0.0)", "dot(normalize(v_Normal), lightDirection)"),
        },
    }
    ALTERNATIVES = {
        "fog": {"written otherwise": ("exp(-depth * depth)", "1.0 / exp2(1.442695 * depth * depth)")},
        "spot": {"by hand": ("smoothstep(u_CosOuterCut, u_CosInnerCut, cosine);",
                             "clamp((cosine - u_CosOuterCut) / (u_CosInnerCut - u_CosOuterCut), 0.0, 1.0);\n"
                             "    spot *= spot * (3.0 - 2.0 * spot);")},
    }

    @base.in_long_form
    def test_mistakes_are_wrong_and_alternatives_right(self):
        for verdict, changes in (("wrong", self.MISTAKES), ("right", self.ALTERNATIVES)):
            for name, of_lab in changes.items():
                lab = os.path.join(EXTRA, name)
                self.write(read(lab, "solution", name + ".vert"), name, name + ".vert")
                solution = read(lab, "solution", name + ".frag")
                for kind, (old, new) in list(of_lab.items())[:: base.step(3)]:
                    self.assertIn(old, solution, kind)
                    mine = self.write(solution.replace(old, new), name, name + ".frag")
                    self.assertEqual(result(lab, mine)["verdict"], verdict, kind)

    def test_a_class(self):
        lab, results = os.path.join(EXTRA, "fog"), self.path("results")
        for name, source in ("anna", "solution"), ("ben", "."):
            for file in "fog.vert", "fog.frag":
                self.write(read(lab, source, file), "class", name, file)
        done = check("--class", self.path("class"), "--lab", lab, "-o", results)
        self.assertEqual(done.returncode, 0, done)
        with open(os.path.join(results, "class.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(row["student"], row["lab"], row["points"], row["most"]) for row in rows],
                         [("anna", "fog", "10", "10"), ("ben", "fog", "1", "10")])


class Platform(Case):
    """Archives as Moodle and Canvas hand them out, and what they take back."""

    def class_of(self, names, out):
        """A class by the names of the platform's files, each with what its student hands in."""
        lab = os.path.join(EXTRA, "fog")
        with zipfile.ZipFile(self.path(out + ".zip"), "w") as archive:
            for name, source in names:
                for file in "fog.vert", "fog.frag":
                    archive.writestr(name + file, read(lab, source, file))
        done = check("--class", self.path(out + ".zip"), "--lab", lab, "-o", self.path(out))
        self.assertEqual(done.returncode, 0, done)
        return self.path(out)

    def test_moodle(self):
        out = self.class_of([("Zoë Ünal_4711_assignsubmission_file_/", "solution"), ("Ben Li_12_assignsubmission_file_/", ".")],
                            "moodle")
        with open(os.path.join(out, "moodle.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
        # What the importer needs: mod/assign/feedback/offline/importgradeslib.php.
        self.assertEqual([(row["Identifier"], row["Full name"], row["Grade"], row["Last modified (grade)"]) for row in rows],
                         [("Participant 12", "Ben Li", "1", "-"), ("Participant 4711", "Zoë Ünal", "10", "-")])
        with zipfile.ZipFile(os.path.join(out, "feedback.zip")) as archive:
            self.assertIsNone(archive.testzip())
            found = {}
            for path in archive.namelist():
                # As mod/assign/feedback/file/importziplib.php divides names.
                folder, file = path.split("/")
                name, number, plugin, kind, rest = folder.split("_", 4)
                self.assertEqual((plugin, kind, rest), ("assignfeedback", "file", ""))
                found.setdefault((name, int(number)), []).append(file)
            self.assertEqual(found, {("Ben Li", 12): ["index.html", "worst.png"], ("Zoë Ünal", 4711): ["index.html"]})
            self.assertIn("1 of 10", archive.read("Ben Li_12_assignfeedback_file_/index.html").decode())

    def test_canvas(self):
        out = self.class_of([("unalzoe_LATE_901_5551_", "solution"), ("liben_902_5552_", ".")], "canvas")
        with open(os.path.join(out, "canvas.csv"), newline="") as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows, [["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "fog"],
                                ["    Points Possible", "", "", "", "", "10"],
                                ["liben", "902", "", "", "", "1"], ["unalzoe", "901", "", "", "", "10"]])

    def test_archives_that_are_refused(self):
        link = zipfile.ZipInfo("Ann_1_assignsubmission_file_/fog.vert")
        link.create_system, link.external_attr = 3, 0o120777 << 16
        for entry, said in (("../evil.vert", "not unpacked: ../evil.vert"), ("/tmp/evil.vert", "not unpacked: /tmp/evil.vert"),
                            (link, "not unpacked: Ann_1"), (None, "name the platform's .zip or a folder")):
            with open(self.path("bad.zip"), "wb") as file:
                file.write(b"no archive")
            if entry:
                with zipfile.ZipFile(self.path("bad.zip"), "w") as archive:
                    archive.writestr(entry, "/etc/passwd")
            done = check("--class", self.path("bad.zip"), "--lab", os.path.join(EXTRA, "fog"), "-o", self.path("out"))
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done)
            self.assertIn(said, done.stderr)
            self.assertFalse(os.path.exists(self.path("evil.vert")) or os.path.lexists(self.path("out", "evil.vert")))


class Points(Case):
    """Points by parts, and what is taken from those that are late."""

    PARTS = '"parts": {"ambient": 1, "diffuse": 2, "attenuation": 3, "spot": 2}'
    # Of the solution of extra/spot: what becomes what, the parts that are right, and the points.
    DIVIDED = ("spot * attenuation", "spot / dot(u_Attenuation, vec3(1.0, d, d * d))")
    ALONE = ("    float attenuation = 1.0 / (u_Attenuation.x + u_Attenuation.y * d + u_Attenuation.z * d * d);\n", "")
    WRONG = [
        ([("normalize(v_Normal)", "v_Normal")], ["ambient", "attenuation", "spot"], 7),
        ([("u_AmbientLight + ", "")], ["diffuse", "attenuation", "spot"], 8),
        ([("spot * attenuation", "spot / attenuation")], ["ambient", "attenuation", "spot"], 7),
        ([("smoothstep(u_CosOuterCut, u_CosInnerCut, cosine)", "step(u_CosOuterCut, cosine)")], ["ambient", "attenuation"], 5),
        # In other words, and without the variable.
        ([DIVIDED, ALONE], ["ambient", "diffuse", "attenuation", "spot"], 10),
        ([DIVIDED, ALONE, ("nDotL *", "0.5 * nDotL *")], ["ambient", "attenuation", "spot"], 7),
        ([DIVIDED, ALONE, ("vec3(1.0, d, d * d)", "vec3(1.0, d, 0.0)")], ["ambient", "spot"], 4),
    ]

    def lab(self, points, name="spot"):
        lab = self.copy(name, name)
        self.change('"drawn": 1, "scenes": 8', '"drawn": 1, ' + points, name, "lab.json")
        return lab

    def test_parts(self):
        lab = self.lab(self.PARTS)
        self.write(read(lab, "solution", "spot.vert"), "mine", "spot.vert")
        for changes, right, points in reversed(self.WRONG[:: -base.step(3)]):
            mine = self.write(read(lab, "solution", "spot.frag"), "mine", "spot.frag")
            for old, new in changes:
                self.change(old, new, "mine", "spot.frag")
            done = check("--lab", lab, mine, "--seed", "1", "--limit", str(base.PATIENCE), "--json", self.path("found.json"))
            found = json.loads(read(self.path("found.json")))
            self.assertEqual([part["name"] for part in found["parts"] if part["state"] == "right"], right, changes)
            self.assertEqual((found["points"], sum(part["points"] for part in found["parts"])), (points, min(points - 1, 8)), changes)
        self.assertIn("\n  ambient: right, 1 of 1 points\n  diffuse: wrong, 0 of 2 points\n", done.stdout)
        self.write("void main() {", "mine", "spot.frag")
        self.assertEqual([(part["state"], part["points"]) for part in result(lab, mine)["parts"]], [("not judged", 0)] * 4)

    @base.in_long_form
    def test_days(self):
        for rule, days in (
            ('10', {0: 10, 1: 9, 2: 8, 10: 0, 200: 0}), ('[10, 25, 100]', {1: 9, 2: 7.5, 3: 0, 9: 0}), ('3', {1: 9.5, 2: 9}),
        ):
            shutil.rmtree(self.path("fog"), ignore_errors=True)
            lab = self.lab('"scenes": 8, "late": {"percent": %s}' % rule, "fog")
            for day, points in list(days.items())[:: base.step(2)]:
                found = result(lab, os.path.join(lab, "solution"), "--late", str(day))
                self.assertEqual(found["points"], points, (rule, day))
                self.assertEqual("parts" in found, day > 0)
        done = check("--lab", os.path.join(EXTRA, "fog"), os.path.join(EXTRA, "fog"), "--late", "1")
        self.assertEqual((done.returncode, done.stderr), (2, 'check: --late: lab.json of fog has no "late"\n'))

    def test_a_class(self):
        lab = self.lab('"parts": {"seen": 4}, "late": {"due": "2026-11-20 23:59", "percent": 10}', "fog")
        names = {"ann": "2026-11-20 23:59", "ben": "2026-11-21 00:00", "cy": "2026-11-22 12:00",
                 "Dee_7_assignsubmission_file_": "2026-12-24 12:00", "Eve_8_assignsubmission_file_": "2026-12-24 12:00"}
        for name, when in names.items():
            stamp = time.mktime(time.strptime(when, "%Y-%m-%d %H:%M"))
            for file in "fog.vert", "fog.frag":
                self.write(read(lab, "solution", file), "class", name, file)
                os.utime(self.path("class", name, file), (stamp, stamp))
        for file in "fog.vert", "fog.frag":
            self.write(read(lab, "solution", file), "class", "fay_LATE_9_1_" + file)

        def points(*more):
            done = check("--class", self.path("class"), "--lab", lab, "-o", self.path("out"), *more)
            self.assertEqual(done.returncode, 0, done)
            with open(self.path("out", "class.csv"), newline="") as table:
                rows = list(csv.DictReader(table))
            return {row["student"]: float(row["points"]) for row in rows}, rows, done.stderr

        found, rows, said = points()
        self.assertEqual(found, {"ann": 10, "ben": 9, "cy": 8, "Dee": 10, "Eve": 10, "fay": 9})
        self.assertIn("does not say when a file came", said)
        self.assertEqual(rows[2]["parts"], "seen: right, 4 of 4 points; ")
        self.assertIn("day 2 after the deadline: -2 of 10 points", rows[4]["parts"])
        self.write("7,3\nEve,2026-11-21 23:59\nben,0\n", "late.csv")
        found, rows, said = points("--late", self.path("late.csv"))
        self.assertEqual(found, {"ann": 10, "ben": 10, "cy": 8, "Dee": 7, "Eve": 9, "fay": 9})
        self.assertNotIn("does not say", said)
        page, student = read(self.path("out", "index.html")), read(self.path("out", "students", "cy", "index.html"))
        self.assertIn('day 3 after the deadline', page)
        self.assertIn('<th scope="row">seen</th><td class="number">6</td>', page)
        self.assertIn("day 2 after the deadline: late, -2 of 10 points", student)
        self.assertIn("Participant 7,\"Dee\",7,10,-", read(self.path("out", "moodle.csv")))
        gradescope = json.loads(read(self.path("out", "students", "cy", "results.json")))
        self.assertEqual(gradescope["score"], 8)
        self.assertIn("day 2 after the deadline", gradescope["output"])
        for line, why in ("Zoe,1", "no submission has this name"), ("ben,soon", "must be a student's name or number, a comma, and"), ("x", "a comma"):
            self.write("7,3\n" + line, "late.csv")
            done = check("--class", self.path("class"), "--lab", lab, "-o", self.path("out"), "--late", self.path("late.csv"))
            self.assertEqual(done.stderr.count("late.csv:2: "), 1, done)
            self.assertIn(why, done.stderr)


class Folder(Case):
    @base.in_long_form
    def test_the_labs_of_the_programs_are_the_same_by_their_folders(self):
        names = sorted(name for name in os.listdir(LABS) if os.path.exists(os.path.join(LABS, name, "lab.json")))
        self.assertEqual(len(names), 11)
        for name in names[::base.step(4)]:
            pictures = [self.path("a.png"), self.path("b.png")]
            self.assertEqual(check(name, "--expected", pictures[0]).returncode, 0)
            self.assertEqual(check("--lab", os.path.join(LABS, name), "--expected", pictures[1]).returncode, 0)
            with open(pictures[0], "rb") as one, open(pictures[1], "rb") as other:
                self.assertEqual(one.read(), other.read(), name)
        solution = os.path.join(base.SOURCE, "shaders/labs/solutions/lab06_phong")
        by_name = check("lab06", solution, "--seed", "1", "--json", "-")
        by_folder = result(os.path.join(LABS, "lab06_phong"), solution)
        self.assertEqual({**json.loads(by_name.stdout), "seconds": 0}, {**by_folder, "seconds": 0})

    @base.in_long_form
    def test_points_and_tolerance(self):
        lab = self.copy("fog", "fog")
        self.change('"most": 10, "drawn": 1, "scenes": 8', '"most": 30, "drawn": 5, "scenes": 10', "fog", "lab.json")
        right, starter = result(lab, self.path("fog", "solution")), result(lab, lab)
        self.assertEqual((right["points"], right["most"], starter["points"]), (30, 30, 5))
        self.change('"light":', '"tolerance": 50, "light":', "fog", "lab.json")
        self.write(read(lab, "solution", "fog.vert"), "mine", "fog.vert")
        near = self.write(read(lab, "solution", "fog.frag").replace("exp(-depth", "0.97 * exp(-depth"), "mine", "fog.frag")
        self.assertEqual(result(lab, near)["verdict"], "right")

    @base.in_long_form
    def test_names_of_its_own_several_solutions_and_another_folder_name(self):
        lab = self.copy("fog", "my lab")
        for file in "lab.json", os.path.join("solution", "fog.vert"), os.path.join("solution", "fog.frag"):
            text = read(lab, file).replace("a_Position", "position").replace("u_MvpMatrix", "mvp")
            self.write(text.replace("u_LightPosition", "sun.place"), "my lab", file)
        self.change("uniform vec3 sun.place;", "struct Sun { vec3 place; };\nuniform Sun sun;", "my lab", "solution", "fog.frag")
        self.change('"uniforms": {', '"shaders": "fog", "attributes": {"position": "position"}, "uniforms": {"mvp": '
                    '"u_MvpMatrix", "sun.place": {"is": "u_LightPosition", "light": 0},', "my lab", "lab.json")
        self.assertEqual(result(lab, self.path("my lab", "solution"))["verdict"], "right")
        shutil.copytree(self.path("my lab", "solution"), self.path("my lab", "linear"))
        self.change("-depth * depth", "-depth", "my lab", "linear", "fog.frag")
        self.assertEqual(result(lab, self.path("my lab", "linear"))["verdict"], "wrong")
        self.change('"shaders"', '"solutions": ["solution", "linear"], "shaders"', "my lab", "lab.json")
        self.assertEqual(result(lab, self.path("my lab", "linear"))["verdict"], "right")

    BROKEN = [
        ('"light":', '"lihgt":', '"lihgt": no such key; did you mean "light"?'),
        ('"point"', '"pont"', '"light": must be one of "directional", "point", "spot"'),
        ('"ambient": true', '"ambient": 1', '"ambient": must be true or false'),
        ('"eye": [0, 0, 6],', "", '"scene": "eye": is missing'),
        ('"eye": [0, 0, 6]', '"eye": [0, 6]', '"scene": "eye": must be a list of three numbers, like [1, 0.5, 0.2]'),
        ('"scale": 1,', '"scale": 1000,', '"scene": "scale": must be a number from 0.01 to 100'),
        ('"coarse ball"', '"bal"', '"scene": "shape": must be one of "cube", '),
        ('{"place": [2, 2.5, 2.5], "color": [0.8, 0.75, 0.7]}', "", '"scene": "lights": must be a list of one to 2 lights'),
        ('"place"', '"pos"', '"scene": "lights": "pos": no such key'),
        ('"min": 0.08', '"min": 0.8', '"uniforms": "u_FogDensity": "min" must not exceed "max"'),
        ('"value": 0.12, ', "", '"uniforms": "u_FogDensity": must be a name like "u_MvpMatrix", or have "value"'),
        ('{"value": 0.12, "min": 0.08, "max": 0.16}', '"u_Fog"', '"u_FogDensity": "u_Fog" is none of this lab\'s values'),
        ('"most": 10', '"most": 5', '"points": "drawn", "scenes" and "parts" together must not exceed "most"'),
        (', "scenes": 8', "", '"points": "scenes" is missing, or "parts"'),
        ('"scenes": 8', '"parts": {"seeen": 1}', '"seeen": no part: must be "diffuse", "ambient", "highlight", "light 1" or "light 2", as far'),
        ('"scenes": 8', '"parts": {"highlight": 1}', '"highlight": no part: must be "diffuse"'),
        ('"scenes": 8', '"parts": {"ambient": "1"}', '"points": "ambient": must be a number from 0 to 1000'),
        ('"scenes": 8', '"parts": {"ambient": 9, "diffuse": 1}', '"parts" together must not exceed "most"'),
        ('"scenes": 8', '"parts": []', '"points": "parts": must be an object of one to 12 parts'),
        ('"scenes": 8', '"scenes": 8, "step": 0', '"points": "step": must be a number from 0.01 to 1000'),
        ('"scenes": 8', '"scenes": 8, "late": {"percent": 110}', '"points": "late": "percent": must be a number from 0 to 100'),
        ('"scenes": 8', '"scenes": 8, "late": {"due": "2026-11-20 23:59"}', '"points": "late": "percent": is missing'),
        ('"scenes": 8', '"scenes": 8, "late": {"due": "20.11.2026", "percent": 10}', '"late": "due": must be a time like "2026-11-20 23:59"'),
        ('"light": "point"', '"light": "spot"', '"spot": is missing in "scene": "light" is "spot"'),
        ('"ambient": true', '"highlight": "Phong"', '"shininess": is missing in "scene": there is a "highlight"'),
        ('"ambient": true', '"shaders": "Fog/x"', '"shaders": must be a file\'s name without .vert: a-z, 0-9, _ and -'),
        ('"ambient": true', '"solutions": ["../x"]', '"solutions": must name folders in the lab\'s own'),
        ('"ambient": true', '"ambient": true, "ambient": true', "duplicate object key near '\"ambient\"'"),
        ('"ambient": true,', '"ambient": true', "lab.json:5: '}' expected near '\"scene\"'"),
    ]

    def test_a_broken_file_has_one_clear_line(self):
        lab = self.copy("fog", "fog")
        text = read(lab, "lab.json")
        for old, new, said in self.BROKEN:
            self.assertIn(old, text)
            self.write(text.replace(old, new, 1), "fog", "lab.json")
            done = check("--lab", lab, lab)
            self.assertEqual((done.returncode, done.stdout), (2, ""), (new, done))
            self.assertIn(said, done.stderr)
            self.assertIn(os.path.join(os.path.realpath(lab), "lab.json"), done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    @base.in_long_form
    def test_the_report_says_what_no_scene_shows(self):
        lab = self.copy("fog", "fog")
        same, missed = "reversed: v_Position - u_EyePosition", "term missing: u_AmbientLight"
        said = check("--lab", lab, "--report").stdout
        self.assertIn(same, said)
        self.assertNotIn(missed, said)
        self.assertIn("at the vertices: depth, at most 1.", said)
        self.assertNotIn("in the wrong order", said)  # of numbers and colours that is as right
        tried, shown, hidden = map(int, re.search(r"(\d+) mistakes tried; shown: (\d+), not shown: (\d+)", said).groups())
        self.assertEqual((tried, said.count(" instead of ")), (shown + hidden, hidden))
        with open(os.path.join(LABS, "TEACHING.md"), encoding="utf-8") as file:
            self.assertIn(f"Of extra/fog's {tried} it shows {shown}, and the other", file.read())
        # A fog through which nothing is seen hides the light's mistakes.
        self.change('"value": 0.12, "min": 0.08, "max": 0.16', '"value": 3, "min": 3, "max": 4', "fog", "lab.json")
        said = check("--lab", lab, "--report").stdout
        self.assertIn(missed, said)
        self.assertGreater(said.count(" instead of "), hidden + 10)
        shutil.rmtree(self.path("fog", "solution"))
        self.assertIn("fog: has no solution to change", check("--lab", lab, "--report").stderr)

    def test_a_lab_that_cannot_be_judged(self):
        lab = self.copy("fog", "fog")
        self.change('"u_FogDensity"', '"u_FogDensitx"', "fog", "lab.json")
        done = check("--lab", lab, lab)
        self.assertEqual(done.returncode, 1)
        self.assertIn("the solution of fog: uniform u_FogDensity does not exist in this lab; did you mean u_FogDensitx?",
                      done.stderr)
        os.remove(self.path("fog", "solution", "fog.frag"))
        self.assertIn("solution: fog.frag: is missing from the folder", check("--lab", lab, lab).stderr)
        self.assertIn("lab.json: No such file", check("--lab", self.folder.name, lab).stderr)
        self.assertEqual(check("--lab", lab).returncode, 2)


class New(Case):
    """check --new-lab, from shaders in the manner of other courses."""

    VERTEX = """attribute vec3 aPos;
attribute vec3 aNormal;
uniform mat4 model, view, projection;
uniform mat3 normalMatrix;
varying vec3 place, normal;
void main()
{
    place = vec3(model * vec4(aPos, 1.0));
    normal = normalMatrix * aNormal;
    gl_Position = projection * view * vec4(place, 1.0);
}
"""
    FRAGMENT = """precision highp float;
struct Lamp { vec3 position, direction, diffuse; float cutOff, outerCutOff, linear; };
uniform Lamp lamp[1];
uniform vec3 viewPos, objectColor, mist;
uniform float wrap;
varying vec3 place, normal;
float cosine(vec3 a, vec3 b) { return dot(normalize(a), normalize(b)); }
void main()
{
    vec3 way = lamp[0].position - place;
    float edge = smoothstep(lamp[0].outerCutOff, lamp[0].cutOff, cosine(-way, lamp[0].direction));
    float lit = max((cosine(normal, way) + wrap) / (1.0 + wrap), 0.0) * edge / (1.0 + lamp[0].linear * length(way));
    gl_FragColor = vec4(mix(lamp[0].diffuse * lit * objectColor, mist, 0.01 * length(viewPos - place)), 1.0);
}
"""
    MEANT = {
        "model": "u_ModelMatrix", "view": "u_ViewMatrix", "projection": "u_ProjMatrix", "normalMatrix": "u_NormalMatrix",
        "viewPos": "u_EyePosition", "objectColor": "color of the object",
        "lamp[0].position": {"is": "u_LightPosition", "light": 0}, "lamp[0].direction": "u_SpotDirection",
        "lamp[0].diffuse": {"is": "u_LightColor", "light": 0}, "lamp[0].cutOff": "cosine of 0.8 u_SpotCutoff",
        "lamp[0].outerCutOff": "cosine of u_SpotCutoff", "lamp[0].linear": "linear of u_Attenuation",
    }

    def make(self, vertex, fragment, name="mist_lab"):
        self.write(vertex, "my.vert")
        self.write(fragment, "my.frag")
        return check("--new-lab", self.path(name), "--solution", self.path("my.vert"), self.path("my.frag"))

    def test_a_lab_in_the_manner_of_another_course(self):
        self.assertEqual(self.make(self.VERTEX, self.FRAGMENT.replace("lamp", "light").replace("Lamp", "Light")).returncode, 0)
        lab = self.path("mist_lab")
        with open(os.path.join(lab, "lab.json")) as file:
            made = json.load(file)
        own = [made["uniforms"].pop(name) for name in ("wrap", "mist")]
        self.assertNotEqual(own[0]["value"], own[1]["value"][0])  # one cannot stand for the other
        self.assertEqual([round(most / least, 5) for most, least in zip(own[1]["max"], own[1]["min"])], [3] * 3)
        self.assertEqual(made["uniforms"], {name.replace("lamp", "light"): meant for name, meant in self.MEANT.items()})
        self.assertEqual((made["attributes"], made["light"]), ({"position": "aPos", "normal": "aNormal"}, "spot"))
        self.assertEqual(result(lab, os.path.join(lab, "solution"))["points"], 10)
        self.assertEqual(result(lab, lab)["message"], "unchanged: this is the starter")
        starter = read(lab, "mist.frag")
        self.assertTrue(starter.startswith(self.FRAGMENT.replace("lamp", "light").replace("Lamp", "Light")
                                           .split("float cosine")[0]))
        self.assertNotIn("smoothstep", starter)
        self.assertIn("| `wrap` | uniform float | to do |", read(lab, "TASK.md"))
        self.assertTrue(os.path.exists(os.path.join(lab, "expected.png")))

    def test_lines_of_another_number(self):
        self.assertEqual(self.make(self.VERTEX, "#line 1000\n" + self.FRAGMENT).returncode, 0)

    def test_a_solution_that_draws_nothing_is_said(self):
        result = self.make("attribute vec4 aPos;\nvoid main() { gl_Position = vec4(aPos.xyz + 9.0, 1.0); }\n",
                           "precision mediump float;\nvoid main() { gl_FragColor = vec4(1.0); }\n")
        self.assertEqual(result.returncode, 1)
        self.assertIn("the solution draws one colour and nothing else", result.stderr)

    @base.in_long_form
    def test_light_at_the_vertices(self):
        for name in "lab01_diffuse", "lab09_two_sided":
            folder = os.path.join(base.SOURCE, "shaders/labs/solutions", name)
            shaders = [read(folder, name.split("_")[0] + ending) for ending in (".vert", ".frag")]
            self.assertEqual(self.make(*shaders, name).returncode, 0)
            lab = self.path(name)
            self.assertEqual(result(lab, os.path.join(lab, "solution"))["points"], 10)
            self.assertEqual(result(lab, lab)["verdict"], "wrong")
        self.assertIn("gl_Position = u_MvpMatrix * a_Position;", read(self.path("lab01_diffuse"), "lab01.vert"))

    def test_what_is_no_lab(self):
        for vertex, fragment, said in (
            (self.VERTEX.replace("vec3 aNormal;", "vec3 aNormal;\nattribute vec2 aTexCoords;"), self.FRAGMENT,
             "vec2 aTexCoords: no lab has one; there are positions, normals and colours"),
            (self.VERTEX, self.FRAGMENT.replace("uniform float", "uniform sampler2D picture;\nuniform float"),
             "sampler2D picture: no lab has one"),
            (self.VERTEX, self.FRAGMENT.replace("wrap", "wrap" * 20), "wrapwrap: too many or too long names"),
            (self.VERTEX, self.FRAGMENT.replace("float lit =", "float lot ="), "my.frag:13:"),
        ):
            done = self.make(vertex, fragment)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done)
            self.assertIn(said, done.stderr)
            self.assertFalse(os.path.exists(self.path("mist_lab")))
        self.write("", "mist_lab", "mine")
        self.assertIn("mist_lab: File exists", self.make(self.VERTEX, self.FRAGMENT).stderr)
        self.assertEqual(check("--new-lab", self.path("x")).returncode, 2)


if __name__ == "__main__":
    if not os.path.exists(CHECK):
        sys.exit(77)
    sys.exit(base.main())
