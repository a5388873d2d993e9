#!/usr/bin/env python3
"""The labs as students and teachers use them: starters, solutions, mistakes, errors, `check`.

usage: labs_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]
       labs_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER --many [SEEDS [PAIRS]]

The second form prints a Markdown table of how often `check` names the mistakes of mistakes.py: each
alone in SEEDS seeds (20), and PAIRS pairs for each lab (100). The first form takes a sample.
Exit code: 77 if nothing can be drawn.
"""
import collections
import concurrent.futures
import functools
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path[:0] = [os.path.join(os.path.dirname(HERE), "programs"), HERE]
import command_line_test as base
import corpus
import faults
import mistakes

LABS = mistakes.NAMES
EXAMPLES = os.path.join(base.SOURCE, "examples", "labs")
CHECK = os.path.join(base.EXAMPLES, "check")
WORKERS = os.cpu_count() or 1
FIRST = r"Wrong first, (where it is worst|in scene \w+ \(known\), column \d+, row \d+ from the top): "


def start_check(*arguments):
    return subprocess.run(
        [CHECK, *arguments], stdin=subprocess.DEVNULL, capture_output=True, timeout=base.PATIENCE
    )


def run_check(lab, folder, seed=1, *more):
    """The exit code and the JSON result."""
    options = ("--seed", str(seed), "--json", "-", "--limit", str(base.PATIENCE), *more)
    done = start_check(LABS[lab], folder, *options)
    assert done.stdout.startswith(b"{"), (folder, done)
    return done.returncode, json.loads(done.stdout)


@functools.cache
def check_solution(lab):
    """Of seed 1; several tests need it."""
    return run_check(lab, os.path.join(mistakes.SOLUTIONS, LABS[lab]))


def check_texts(lab, texts, seed=1):
    with tempfile.TemporaryDirectory(prefix="labs_test-") as folder:
        for name, text in texts.items():
            with open(os.path.join(folder, name), "w") as file:
                file.write(text)
        return run_check(lab, folder, seed)[1]


def in_parallel(function, jobs):
    with concurrent.futures.ThreadPoolExecutor(WORKERS) as pool:
        return list(pool.map(lambda job: function(*job), jobs))


def named(result):
    return [mistake["name"] for mistake in result["mistakes"]]


def derived(result):
    return all(said["sentence"].rpartition(". ")[2].startswith("It draws what") for said in result["mistakes"])


def points_at(result, texts, right):
    """Whether it names a line that was changed, or quotes one."""
    changed = {
        f"line {i + 1} of {name}:": line
        for name in texts
        for i, line in enumerate(texts[name].split("\n"))
        if line not in right[name].split("\n")
    }
    # What is missing has no line of its own.
    lost = [line for name in texts for line in right[name].split("\n") if line not in texts[name].split("\n")]
    said = " ".join(mistake["look"] for mistake in result["mistakes"])
    quoted = [mistake["sentence"].rpartition(" instead of ")[2][:-1] for mistake in result["mistakes"]]
    return any(line in said for line in changed) or any(text in line for text in quoted for line in lost)


def pictures(result):
    """Two submissions with equal errors in every scene draw the same."""
    return [(probe["maximum"], probe["rms"]) for probe in result["probes"]]


def outcome(result, kinds):
    """named, one (of two), unnamed, unseen or MISNAMED, for a text with these mistakes."""
    names = set(named(result))
    if not names:
        return "unseen" if result["verdict"] == "right" else "unnamed"
    # Derived: it computes the same numbers everywhere, or what is right with the change that it names.
    if derived(result):
        return "named"
    accepted = [mistakes.CALLED.get(kind, {kind}) for kind in kinds]
    if not names <= set.union(*accepted):
        return "MISNAMED"
    return "named" if all(of & names for of in accepted) else "one"


def judge_single(lab, name, seed):
    texts = mistakes.single(lab, name, seed % 2)
    result = check_texts(lab, texts, seed)
    right = mistakes.as_the_lecture(mistakes.read(lab)) if seed % 2 else mistakes.read(lab)
    return lab, name, seed, outcome(result, [name]), result, points_at(result, texts, right)


def judge_pair(lab, first, second, seed):
    """If one of two hides the other, the name of the first is right."""
    result = check_texts(lab, mistakes.pair(lab, first, second, seed % 2), seed)
    said = outcome(result, [first, second])
    if said in ("one", "unnamed"):
        alone = (mistakes.single(lab, name, seed % 2) for name in (first, second))
        if any(pictures(check_texts(lab, one, seed)) == pictures(result) for one in alone):
            said = "hidden"
    return lab, f"{first} + {second}", seed, said, result


def pairs_of(lab, count, chance):
    names = mistakes.of_lab(lab)
    every = [
        (a, b) for i, a in enumerate(names) for b in names[i + 1 :] if mistakes.pair(lab, a, b)
    ]
    return chance.sample(every, min(count, len(every)))


def tally(rows):
    return collections.Counter(row[3] for row in rows)


def share(counts, total):
    return counts["named"] / total if total else 1.0


class Labs(base.Case):
    def folder_of(self, lab, kind="solutions"):
        kinds = {"starter": EXAMPLES, "solutions": mistakes.SOLUTIONS}
        return os.path.join(kinds.get(kind, os.path.join(HERE, kind)), LABS[lab])

    def assert_right(self, jobs):
        def run(lab, folder, seed):
            known = seed == 1 and folder == self.folder_of(lab)
            return check_solution(lab) if known else run_check(lab, folder, seed)

        for (lab, folder, seed), (code, result) in zip(jobs, in_parallel(run, jobs)):
            worst = max((probe["maximum"] for probe in result["probes"]), default=None)
            said = (folder, seed, result["message"], result.get("details"), named(result), worst)
            self.assertEqual((result["verdict"], code), ("right", 0), said)
            # In lab 10 the other points are for cost; mediump costs a point.
            least = 5 if lab == 10 else 9 if named(result) == ["mediump overflow"] else 10
            self.assertGreaterEqual(result["points"], least, said)


class Right(Labs):
    def test_the_solutions_are_right_in_every_seed(self):
        seeds = (1, 2, 77)[:: base.step(3)]
        self.assert_right([(lab, self.folder_of(lab), seed) for lab in LABS for seed in seeds])

    def test_a_right_solution_written_differently_is_right(self):
        jobs = []
        for lab in LABS:
            folder = self.folder_of(lab, "alternatives")
            names = sorted(os.listdir(folder))
            self.assertGreaterEqual(len(names), 5, folder)
            jobs += [(lab, os.path.join(folder, name), 3) for name in names]
        self.assert_right(jobs[:: base.step(36)])

    @base.in_long_form
    def test_what_the_task_calls_a_bias_is_right(self):
        for seed, bias in ((2, "0.006"), (3, "0.0005")):
            texts = mistakes.applied(
                mistakes.read(11), 11, mistakes.frag("BIAS = 0.002", f"BIAS = {bias}")
            )
            result = check_texts(11, texts, seed)
            self.assertEqual((result["verdict"], result["points"]), ("right", 10), (bias, result))

    def test_the_starters_are_wrong_and_say_so(self):
        jobs = [(lab, self.folder_of(lab, "starter"), 1) for lab in list(LABS)[:: base.step(3)]]
        for (lab, _, _), (code, result) in zip(jobs, in_parallel(run_check, jobs)):
            self.assertEqual((result["verdict"], code), ("wrong", 1), LABS[lab])
            self.assertEqual(result["message"], "unchanged: this is the starter", LABS[lab])
            self.assertLess(result["points"], result["most"] / 2, LABS[lab])

    def test_each_task_is_complete(self):
        for lab, name in LABS.items():
            with open(os.path.join(EXAMPLES, name, "TASK.md")) as file:
                text = file.read()
            for part in ("What there is", "What to do", "What to read", "Run and check", "Points"):
                self.assertIn(f"## {part}", text, name)
            for part in ("expected.png", f"check lab{lab:02} mine"):
                self.assertIn(part, text, name)
            for path in re.findall(r"`((?:examples|shaders|common)/[\w./]+\.\w+)`", text):
                self.assertTrue(os.path.exists(os.path.join(base.SOURCE, path)), f"{name}: {path}")
            self.assertFalse(os.listdir(os.path.join(EXAMPLES, name)) == [])

    def test_the_expected_pictures_are_the_exact_ones(self):
        for lab, name in list(LABS.items())[:: base.step(9)]:
            picture = self.path("expected.png")
            self.assertEqual(start_check(name, "--expected", picture).returncode, 0)
            with open(os.path.join(EXAMPLES, name, "expected.png"), "rb") as file:
                kept = base.Png(file.read())
            self.assertEqual(kept.pixels, self.png("expected.png").pixels, name)


class Corpus(Labs):
    """A sample of what was written without knowledge of `check`."""

    def rows(self):
        todo = list(corpus.jobs(every=33 * base.step(30)))
        # Lab 11's, the last, take several times as long, but for the right ones.
        right = [job for job in corpus.jobs(lab=11) if job[2]["label"].startswith(b"right")]
        return corpus.judge_all(CHECK, todo + right if base.LONG else todo[:10:2])

    def test_right_is_right_and_all_get_a_verdict(self):
        ruled = corpus.rulings()
        for row in self.rows():
            said = corpus.outcome(row, ruled)
            if row["label"].startswith("right"):
                self.assertEqual(said, "right", row)
            self.assertNotEqual(row["verdict"], "no verdict", row)


class Wrong(Labs):
    """A sample; --many tries all."""

    def assert_named(self, rows, least):
        rows = [row for row in rows if row[3] != "hidden"]
        said = [row[:4] + (named(row[4]),) for row in rows if row[3] != "named"]
        self.assertFalse([row for row in said if row[3] == "MISNAMED"], said)
        self.assertGreaterEqual(share(tally(rows), len(rows)), least, said)

    def test_a_mistake_alone_is_named(self):
        jobs = [
            (lab, name, 5 + i % 3)
            for lab in LABS
            for i, name in enumerate(mistakes.of_lab(lab))
            if i % (12 * base.step(30)) == lab % 12
            # Those of the other labs that have a name are in Holes.
            and (base.LONG or lab in (4, 8))
        ]
        rows = in_parallel(judge_single, jobs)
        # What has no name keeps its symptoms; three in a row of twenty is chance.
        self.assert_named(rows, 0.85)
        # Two changes may be the same: of the normal's sign and the light's.
        named_rows = [row for row in rows if row[3] == "named" and derived(row[4])]
        elsewhere = [row[:4] + (row[4]["mistakes"],) for row in named_rows if not row[5]]
        self.assertLessEqual(len(elsewhere), 0.25 * len(named_rows), elsewhere)

    def test_two_at_once_are_named(self):
        """Of those that are not it is said what is wrong."""
        chance = random.Random(7)
        jobs = [
            (lab, first, second, 9) for lab in LABS for first, second in pairs_of(lab, 4, chance)
        ]
        rows = in_parallel(judge_pair, jobs[:: 4 * base.step(30)])
        self.assert_named(rows, 0.6)
        for row in rows:
            self.assertTrue(row[3] == "named" or row[4]["symptoms"], row)

    def test_a_mistake_of_no_known_kind_is_derived_or_has_no_name(self):
        names = list(mistakes.ART)[:: 2 * base.step(24)]
        jobs = [(*mistakes.art(name), 4) for name in names]
        for name, result in zip(names, in_parallel(check_texts, jobs)):
            self.assertEqual(result["verdict"], "wrong", (name, result["message"]))
            for mistake in result["mistakes"]:
                self.assertIn("It draws what", mistake["sentence"], name)
            self.assertTrue(result["symptoms"], name)


    @base.in_long_form
    def test_what_is_at_another_place_is_named(self):
        """A value of another light, a sum after the loop, what is computed at the vertices, an axis of its own."""
        loop, view = "    for (int i = 0; i < 2; i++) {", "normalize(u_EyePosition - v_Position)"
        reflected = "    vec3 R = reflect(-normalize(u_LightPosition[0] - v_Position), normal);\n"
        part = "part = u_LightColor[i] * nDotL;\n    }\n    light += part;"
        fade = "vec3 u_LightPosition, u_Attenuation;\nvarying float v_Fade;\nvoid main() {"
        cases = (
            (6, "R for reflected", ("frag", loop, reflected + loop),
             ("frag", "dot(reflected,", "dot(R,")),
            (5, "= for +=: part", ("frag", loop, "    vec3 part;\n" + loop),
             ("frag", "light += u_LightColor[i] * nDotL;\n    }", part)),
            (5, "after the loop, not in it: light += part * nDotL", ("frag", loop, "    vec3 part;\n    float nDotL;\n" + loop),
             ("frag", "float nDotL = ", "nDotL = "),
             ("frag", "light += u_LightColor[i] * nDotL;\n    }", "part = u_LightColor[i];\n    }\n    light += part * nDotL;")),
            (8, "v_Fade ", ("vert", "void main() {", "uniform " + fade),
             ("vert", "    v_Color =", "    float d = length(u_LightPosition - v_Position);\n    v_Fade = "
              "1.0 / (u_Attenuation.x + u_Attenuation.y * d + u_Attenuation.z * d * d);\n    v_Color ="),
             ("frag", "void main() {", "varying float v_Fade;\nvoid main() {"),
             ("frag", "attenuation * spot", "v_Fade * spot")),
            # What a variable without a first value holds is the driver's: added to it, it begins with 0.
            (5, "= for +=: sum", ("frag", loop, "    vec3 sum;\n" + loop),
             ("frag", "light += u_LightColor[i] * nDotL;", "vec3 one = u_LightColor[i] * nDotL;\n        sum = one;"),
             ("frag", "vec4(light *", "vec4((light + sum) *")),
            (6, "vec3(0.0, 0.0, 5.0) for u_EyePosition", ("frag", "uniform vec3 u_EyePosition; // world space", ""),
             ("frag", view, "normalize(vec3(0.0, 0.0, 5.0) - v_Position)")),
        )  # fmt: skip
        jobs = [(lab, edited(lab, *edits)) for lab, _, *edits in cases]
        for (_, said, *_), result in zip(cases, in_parallel(check_texts, jobs)):
            self.assertEqual(len(result["mistakes"]), 1, (said, result["message"]))
            self.assertTrue(named(result)[0].startswith(said), (said, named(result)))


def edited(lab, *edits):
    """The solution's texts with edits; each must be possible."""
    texts = mistakes.applied(mistakes.read(lab), lab, list(edits))
    assert texts is not None, (lab, edits)
    return texts


# Lab 11: nine places, also where the map ends.
NINE = f"""uniform float u_ShadowMapSize;
float visibility() {{
    vec3 place = {mistakes.PLACE};
    float sum = 0.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++)
            sum += lit(place + vec3(float(x), float(y), 0.0) / u_ShadowMapSize);
    return sum / 8.0;
}}
"""

# Lab 6: a highlight by a function, and all in eye space.
SHINE = """float shine(vec3 n, vec3 l, vec3 v) {
    return dot(n, l) > 0.0 ? pow(max(dot(reflect(-l, n), v), 0.0), u_Shininess) : 0.0;
}
"""
IN_EYE_SPACE = (
    ("vert", "uniform mat4 u_ModelMatrix;", "uniform mat4 u_ModelViewMatrix, u_ViewMatrix;\nuniform vec3 u_LightPosition[2];\nvarying vec3 v_Light[2];"),
    ("vert", "u_ModelMatrix * a_Position", "u_ModelViewMatrix * a_Position"),
    ("vert", "u_NormalMatrix", "u_EyeNormalMatrix"),
    ("vert", "v_Color =", "for (int i = 0; i < 2; i++)\n        v_Light[i] = vec3(u_ViewMatrix * vec4(u_LightPosition[i], 1.0));\n    v_Color ="),
    ("frag", "uniform vec3 u_LightPosition[2];", "varying vec3 v_Light[2];"),
    ("frag", "u_LightPosition[i] - v_Position", "v_Light[i] - v_Position"),
)  # fmt: skip


class Holes(Labs):
    """What once passed."""

    RAY = """
    vec3 way = normalize(v_Position - u_EyePosition);
    float b = dot(u_EyePosition, way), c = dot(u_EyePosition, u_EyePosition) - 1.0;
    vec3 place = u_EyePosition + way * (-b - sqrt(max(b * b - c, 0.0)));
    vec3 normal = normalize(place);
    vec3 lightDirection = normalize(u_LightPosition - place);"""

    @base.in_long_form
    def test_values_explain_what_pictures_do_not(self):
        """Black, or anything: what is drawn is told from the numbers."""
        start, out = "vec3 light = u_AmbientLight;", "vec4(light * v_Color.rgb"
        helper = "vec3 n;\nvec3 lit(int i) {\n    return vec3(abs(dot(n, vec3(0.6, 0.8, 0.0))));\n}\n"
        cases = {
            "variable never set: line 24": [("frag", start, "vec3 light;")],
            "black: 0 from here on: line 24": [
                ("frag", start, "vec3 light = vec3(0.0);"),
                ("frag", "light += u_LightColor[i] * nDotL", "light *= u_LightColor[i] * nDotL"),
            ],
            "no number: line 26": [("frag", out, "vec4(sqrt(-1.0 - light) * v_Color.rgb")],
            "every pixel discarded": [
                ("frag", mistakes.MAIN, mistakes.MAIN + "    if (gl_FragCoord.z >= 0.0) discard;\n")
            ],
            # Set in main, read in a function above it.
            "": [
                ("frag", mistakes.MAIN, helper + mistakes.MAIN),
                ("frag", "    vec3 light", "    n = normal;\n    vec3 light"),
                ("frag", out, "vec4(lit(0) * light * v_Color.rgb"),
            ],
        }
        jobs = [(5, edited(5, *edits), 2) for edits in cases.values()]
        for said, result in zip(cases, in_parallel(check_texts, jobs)):
            self.assertEqual(result["verdict"], "wrong")
            self.assertTrue(result["message"].startswith(said), (said, result["message"]))
            self.assertNotIn("variable never set" if not said else "matrices", result["message"])

    def wrong(self, lab, *edits):
        result = check_texts(lab, edited(lab, *edits), 1)
        self.assertEqual(result["verdict"], "wrong", (lab, edits, result["message"]))
        return result

    @base.in_long_form
    def test_what_is_said_to_mend_it_does(self):
        """In lab 7 several exponents are right, and two mistakes that hide each other are named in every seed."""
        halved = ("frag", "normalize(lightDirection + viewDirection)", "(lightDirection + viewDirection) / 2.0")
        exponent, power = "4.0 * u_Shininess + 1.3", ("frag", "pow(nDotH, shininess)", "exp2(log(nDotH) * shininess)")
        reversed_light = ("vert", "u_LightPosition[i] - position", "position - u_LightPosition[i]")
        matrix = ("vert", "u_NormalMatrix * vec4", "u_ModelMatrix * vec4")
        distance = ("normalize(u_LightPosition[i] - v_Position);",
                    "u_LightPosition[i] - v_Position, toLight = lightDirection;\n        lightDirection = normalize(toLight);")
        cases = [
            (7, 1, ["not normalized: "], halved, ("frag", exponent, "u_Shininess * 4.0")),
            (7, 1, ["not normalized: "], halved, ("frag", exponent, "4.05 * u_Shininess")),
            (7, 1, ["5.0 for 4.0"], ("frag", exponent, "5.0 * u_Shininess")),
            (7, 1, ["log(nDotH) for log2(nDotH)"], power, ("frag", exponent, "4.0 * u_Shininess")),
            (5, 1, ["divided by length(toLight)"], ("frag", *distance), ("frag", "nDotL;", "nDotL / length(toLight);")),
            (8, 1, ["in parentheses: "], ("frag", "color += attenuation * ", "color = attenuation * (color + "), ("frag", "* reflectance", "* reflectance)")),
            (4, 1, ["reversed: ", "u_ModelMatrix for u_NormalMatrix"], reversed_light, matrix),
            (4, 7, ["reversed: ", "u_ModelMatrix for u_NormalMatrix"], reversed_light, matrix),
        ]
        cases = cases[:: base.step(4)]
        jobs = [(lab, edited(lab, *edits), seed) for lab, seed, _, *edits in cases]
        for (_, _, names, *edits), result in zip(cases, in_parallel(check_texts, jobs)):
            self.assertEqual(len(named(result)), len(names), (edits, result["message"]))
            for name, said in zip(names, named(result)):
                self.assertTrue(said.startswith(name), (edits, result["message"]))

    @base.in_long_form
    def test_shadows_that_are_filtered(self):
        """Named in the student's words; what is changed as the fields say is right."""
        cases = {
            "wb3": "arguments of step swapped",  # which takes least: the short form has it alone
            "wa1": "p.z + 0.004 for (p.z - 0.004)",
            "wa2": "8.0 for 9.0",
            "wc1": "no bias: place.z",
            "wa4": "not divided by the map's size: ",
            "wa6": "sun() on the ambient light, too",
            "wa7": "not asked: what is beside the map",
            "wb4": "not mapped to 0 to 1: vShadow.z / vShadow.w",
            "wc4": "one channel of the depth: texture2D(u_ShadowMap, place).r",
            "wd1": "amount for (1.0 - amount)",
        }
        cases = dict(list(cases.items())[:: base.step(10)])
        given = [{name: text.decode() for name, text in corpus.read(11)[case].items() if name != "label"} for case in cases]
        results = in_parallel(check_texts, [(11, texts, 4) for texts in given])
        mended = [self.changed(texts, result["mistakes"]) for texts, result in zip(given, results)]
        for case, result, after in zip(cases, results, in_parallel(check_texts, [(11, texts, 5) for texts in mended])):
            self.assertTrue(result["message"].startswith(cases[case]), (case, result["message"]))
            self.assertEqual(after["verdict"], "right", (case, after["message"]))
            self.assertTrue(any(re.match(FIRST, said) for said in result["symptoms"]), (case, result["symptoms"]))

    def changed(self, texts, said):
        """With each mistake's change, the last first."""
        for one in sorted(said, key=lambda one: (-one["line"], -one["column"])):
            lines = texts[one["file"]].split("\n")
            start = sum(len(line) + 1 for line in lines[: one["line"] - 1]) + one["column"] - 1
            self.assertEqual(texts[one["file"]][start : start + len(one["text"])], one["text"], one)
            texts = {**texts, one["file"]: texts[one["file"]][:start] + one["change"] + texts[one["file"]][start + len(one["text"]) :]}
        return texts

    def test_one_place_of_several(self):
        """Where a name stands twice in a line the operation around it is said; what is moved is one mistake."""
        light, add = "float nDotL = dot(normal, lightDirection);", "light += u_LightColor[i] * nDotL;"
        with open(os.path.join(self.folder_of(3, "alternatives"), "rotation_by_hand", "matrices.c")) as file:
            by_hand = file.read()
        cases = (
            (5, "not normalized: v_Normal", ("frag", "= normalize(v_Normal);", "= dot(v_Normal, v_Normal) > 0.0 ? v_Normal : vec3(1.0);")),
            (5, "added for each light, or twice: u_AmbientLight", ("frag", "vec3 light = u_AmbientLight;", "vec3 light = vec3(0.0);"),
             ("frag", add, "light += u_AmbientLight + u_LightColor[i] * nDotL;")),
            # Three times as much, one of them negative, is right, too: no light is.
            (6, "term too many: u_AmbientLight * v_Color.rgb", ("frag", light, light + "\n        vec3 part = u_AmbientLight * v_Color.rgb;"),
             ("frag", "color += ", "part += "), ("frag", "        }\n    }\n", "        }\n        color += part;\n    }\n")),
            (6, "also where dot(normal, lightDirection) is not above 0", ("frag", light, ""), ("frag", "if (nDotL > 0.0)", ""),
             ("frag", "* nDotL;", "* max(dot(normal, lightDirection), 0.0);")),
            (9, "clamped at another place", ("frag", "        normal = -normal;\n", ""),
             ("frag", "nDotL = max(dot(normal, lightDirection), 0.0);", "c = max(dot(normal, lightDirection), 0.0), nDotL = front ? c : -c;")),
            (11, "not asked: what is beside the map", ("frag", mistakes.OUTSIDE, "    place.xy = min(max(place.xy, 0.0), 1.0);\n"),
             ("frag", mistakes.COMPARE + " ? 1.0 : 0.0", "step(place.z - BIAS, mapDepth(place.xy))")),
            (11, "on the ambient light, too: visibility()", ("frag", mistakes.SUM + ";", "u_AmbientLight + u_LightColor * nDotL;\n    light *= visibility();")),
            (5, "normalized before the difference: ", ("frag", mistakes.TO_LIGHT[5], "normalize(u_LightPosition[i]) - normalize(v_Position)")),
            (5, "squared length: way", ("frag", mistakes.TO_LIGHT[5], "way / dot(way, way)"),
             ("frag", "vec3 lightDirection", "vec3 way = u_LightPosition[i] - v_Position;\n        vec3 lightDirection")),
            (5, "squared length: ", ("frag", mistakes.TO_LIGHT[5] + ";", "u_LightPosition[i] - v_Position, d = lightDirection;\n        lightDirection /= d.x * d.x + d.y * d.y + d.z * d.z;")),
            (5, "its result is not used: normalize(normal)", ("frag", "= normalize(v_Normal);", "= v_Normal;\n    normalize(normal);")),
            (2, "too late: nDotL = ", ("vert", "    for (", "    float nDotL = 0.0;\n    for ("), ("vert", "        float nDotL = max(dot(u_LightDirection[i], normal), 0.0);\n", ""),
             ("vert", "* nDotL;", "* nDotL;\n        nDotL = max(dot(u_LightDirection[i], normal), 0.0);")),
            (5, "declared anew, which hides the one outside: normal", ("frag", "vec3 normal = normalize(v_Normal);", "vec3 normal = v_Normal;\n    if (dot(normal, normal) > 0.0) {\n        vec3 normal = normalize(v_Normal);\n    }")),
            # The other stage has u_BackColor with four components.
            (9, "factor too many: u_Mirrored", ("vert", mistakes.MAIN, "uniform float u_Mirrored;\n" + mistakes.MAIN), ("vert", "v_Normal = normalize", "v_Normal = u_Mirrored * normalize")),
            (11, "8.0 for 9.0", ("frag", f"float visibility() {{\n    vec3 place = {mistakes.PLACE};\n", "float lit(vec3 place) {\n"), ("frag", mistakes.MAIN, NINE + mistakes.MAIN)),
            (1, "arguments of step swapped: ", ("vert", "max(dot(u_LightDirection, normal), 0.0)", "dot(u_LightDirection, normal);\n    nDotL *= step(nDotL, 0.0)")),
            # By chance right, too, of a - b: dot(c, a) for dot(a, a).
            (1, "twice as much, or added twice: dot(a, a)", ("vert", mistakes.MAIN, "float c(vec3 a, vec3 b) {\n    vec3 c = a - b;\n    return dot(a, a) + dot(b, b) - dot(c, c);\n}\n" + mistakes.MAIN),
             ("vert", "dot(u_LightDirection, normal)", "c(u_LightDirection, normal)")),
            (5, "not halved: x + abs(x)", ("frag", mistakes.MAIN, "float positive(float x) {\n    return x + abs(x);\n}\n" + mistakes.MAIN), ("frag", "max(dot(lightDirection, normal), 0.0)", "positive(dot(normal, lightDirection))")),
            (2, "else if for if: b > 0.0", ("vert", "    for (int i = 0; i < 2; i++) {", "    float a = dot(u_LightDirection[0], normal), b = dot(u_LightDirection[1], normal);"),
             ("vert", "        float nDotL = max(dot(u_LightDirection[i], normal), 0.0);", "    if (a > 0.0)\n        light += a * u_LightColor[0];\n    else if (b > 0.0)\n        light += b * u_LightColor[1];\n"),
             ("vert", "        light += u_LightColor[i] * nDotL;\n    }\n", "")),
            # No scene of some seeds once had a face that no light reaches.
            (2, "a case too many: ", ("vert", "    vec3 light = u", "    bool dark = dot(u_LightDirection[0], normal) <= 0.0 && dot(u_LightDirection[1], normal) <= 0.0;\n    if (dark) {\n        v_Color = vec4(vec3(0.0), a_Color.a);\n        return;\n    }\n    vec3 light = u")),
            (6, "component by component, not their dot product: ", ("frag", "reflect(-lightDirection, normal)", "2.0 * (normal * lightDirection) * normal - lightDirection")),
            # reflect(-N, N) is N.
            (7, "R for normal", ("frag", "vec3 halfway", "vec3 R = reflect(-lightDirection, normal);\n        vec3 halfway"), ("frag", "dot(normal, halfway)", "dot(R, halfway)")),
            (9, "reversed: u_EyePosition - v_Position", ("frag", mistakes.MAIN, "uniform vec3 u_EyePosition;\n" + mistakes.MAIN), ("frag", "        normal = -normal;\n", ""),
             ("frag", "    vec3 lightDirection", "    vec3 V = normalize(u_EyePosition - v_Position);\n    normal = faceforward(normal, V, normal);\n    vec3 lightDirection")),
            (11, "statement too many: sum += ", ("frag", "    return " + mistakes.COMPARE + " ? 1.0 : 0.0;", "    float sum = 0.0;\n" + "".join(f"    sum += place.z - BIAS <= mapDepth(place.xy + vec2(0.0, {i} / 2048.0)) ? 1.0 : 0.0;\n" for i in ("-1.0", "1.0", "1.0")) + "    return sum / 2.0;")),
            (7, "blended, not added: ", ("frag", "color += u_LightColor[i] * v_Color.rgb * nDotL;", "vec3 diffuse = v_Color.rgb * nDotL;"),
             ("frag", "u_SpecularColor * pow(nDotH, shininess)", "mix(diffuse, u_SpecularColor, pow(nDotH, shininess))")),
            (5, "not inout: sum", ("frag", mistakes.MAIN, "void put(vec3 sum, vec3 more) {\n    sum += more;\n}\n" + mistakes.MAIN), ("frag", add, "put(light, u_LightColor[i] * nDotL);")),
            (5, "lamps[0] for lamps[i]", ("frag", mistakes.MAIN, "struct Lamp {\n    vec3 color;\n};\n" + mistakes.MAIN), ("frag", "u_LightColor[i] * nDotL", "lamps[0].color * nDotL"),
             ("frag", "    vec3 light =", "    Lamp lamps[2];\n    lamps[0].color = u_LightColor[0];\n    lamps[1].color = u_LightColor[1];\n    vec3 light =")),
            (7, "L - normalize(E) for L + normalize(E)", ("frag", "normalize(lightDirection + viewDirection)", "normalize(L - normalize(E))"),
             ("frag", "lightDirection", "L"), ("frag", "viewDirection = normalize(u_EyePosition - v_Position)", "E = u_EyePosition - v_Position")),
            (8, "not its reciprocal: ", ("frag", mistakes.ATTENUATION, mistakes.ATTENUATION[6:])),
            (8, "factor too many: att", ("frag", mistakes.MAIN, "float att(float d) {\n    float c = dot(u_Attenuation, vec3(1.0, d, d * d));\n    return 1.0 / c;\n}\n" + mistakes.MAIN),
             ("frag", mistakes.ATTENUATION, "att(distance)"), ("frag", "color += attenuation", "vec3 lit = att(distance) * attenuation"),
             ("frag", "u_LightColor * reflectance;", "u_LightColor * reflectance;\n        color += lit;")),
            (6, "swapped: viewDirection and lightDirection", ("frag", mistakes.MAIN, SHINE + mistakes.MAIN), ("frag", "if (nDotL > 0.0) ", ""),
             ("frag", "* nDotL;", "* max(nDotL, 0.0);"), ("frag", "pow(rDotV, u_Shininess)", "shine(normal, viewDirection, lightDirection)")),
            (6, "times u_SpecularColor, too: ", ("frag", "* v_Color.rgb * nDotL;", "* (1.0 - 1.0);"),
             ("frag", "u_SpecularColor * pow(rDotV, u_Shininess)", "u_SpecularColor * (v_Color.rgb * nDotL + pow(rDotV, u_Shininess))")),
            (6, "sign of v_Position reversed", *IN_EYE_SPACE, ("frag", "normalize(u_EyePosition - v_Position)", "normalize(v_Position)"),
             ("frag", "reflect(-lightDirection, normal)", "2.0 * nDotL * normal - lightDirection")),
            (1, "not in eye space: u_LightDirection", ("vert", "u_NormalMatrix", "u_EyeNormalMatrix"), ("vert", mistakes.MAIN, "uniform mat4 u_ViewMatrix;\n" + mistakes.MAIN)),
            (4, "reversed: position - u_LightPosition[i]", ("vert", "light = u_AmbientLight;", "light = u_AmbientLight * a_Color.rgb;"),
             ("vert", "light += ", "light += a_Color.rgb * "), ("vert", "light * a_Color.rgb", "light"),
             ("vert", "u_LightPosition[i] - position", "position - u_LightPosition[i]")),
            (9, "sign reversed: normal", ("frag", "        normal = -normal;\n", ""), ("frag", "if (!front)", "bool back = !front;\n    if (back)")),
            (11, "0.4 + 0.6 * visibility() for visibility()", ("frag", mistakes.SUM, "u_AmbientLight + (0.4 + 0.6 * visibility()) * u_LightColor * nDotL")),
            (5, "declared anew, which hides the one outside: light", ("frag", add, "vec3 light = light + u_LightColor[i] * nDotL;")),
            (7, "place for a direction: u_EyePosition", ("frag", "= normalize(u_EyePosition - v_Position)", "= u_EyePosition")),
            (5, "gl_Position for the point in world space", ("vert", "vec3 v_Position", "vec4 v_Position"), ("vert", mistakes.POSITION, "gl_Position"),
             ("frag", "vec3 v_Position", "vec4 v_Position"), ("frag", "- v_Position", "- v_Position.xyz")),
            (4, "term missing: - position", ("vert", "light = u_AmbientLight;", "light = vec3(0.0);"), ("vert", "vec4(light *", "vec4((light + u_AmbientLight) *"),
             ("vert", "u_LightPosition[i] - position", "u_LightPosition[i]")),
            (9, "u_LightPosition for u_EyePosition", ("frag", mistakes.MAIN, "uniform vec3 u_EyePosition;\n" + mistakes.MAIN),
             ("frag", "gl_FrontFacing == (u_Mirrored > 0.0)", "dot(v_Normal, u_LightPosition - v_Position) >= 0.0"),
             ("frag", "        normal = -normal;\n        color = u_BackColor;\n", ""), ("frag", "color = v_Color", "color = front ? v_Color : u_BackColor"),
             ("frag", "= normalize(v_Normal)", "= front ? normalize(v_Normal) : -normalize(v_Normal)")),
            (5, "u_ModelViewMatrix for u_ModelMatrix", ("vert", mistakes.MAIN, "uniform mat4 u_ModelViewMatrix;\n" + mistakes.MAIN), ("vert", mistakes.POSITION, "vec3(u_ModelViewMatrix * a_Position)")),
            (2, "mixed, not added: ", ("vert", "light = u_AmbientLight;", "light = vec3(0.0);"), ("vert", "vec4(light *", "vec4(mix(light, vec3(1.0), u_AmbientLight) *")),
            (6, "a constant for a direction: vec3(0.0, 0.0, 1.0)", ("frag", "normalize(u_EyePosition - v_Position)", "vec3(0.0, 0.0, 1.0)")),
            (6, "times nDotL, not just where it is above 0: ", ("frag", "if (nDotL > 0.0)", ""), ("frag", "float nDotL = dot(normal, lightDirection);", "float nDotL = max(dot(normal, lightDirection), 0.0);"),
             ("frag", "u_SpecularColor * pow(rDotV, u_Shininess)", "u_SpecularColor * pow(rDotV, u_Shininess) * nDotL")),
            (11, "v_LightPosition.z for v_LightPosition.w", ("frag", "v_LightPosition.w", "v_LightPosition.z")),
            (11, "vec2(float(i)) * 1024.0 for vec2(float(i)) / 1024.0",
             ("frag", "return " + mistakes.COMPARE, "float sum = 0.0;\n    for (int i = 0; i < 2; i++) {\n        vec2 offset = vec2(float(i)) * 1024.0;\n        sum += " + mistakes.COMPARE),
             ("frag", "mapDepth(place.xy)", "mapDepth(place.xy + offset)"), ("frag", "? 1.0 : 0.0;", "? 1.0 : 0.0;\n    }\n    return sum / 2.0;")),
            (3, "wrong scale of the normal matrix", ("c", "mat4_transpose(inverse)", "mat4_product(rotation, mat4_scale((Vec3){1 / 2.0, 1 / 0.7, 1 / 1.1}))")),
            (3, "axis not normalized", ("c", None, by_hand), ("c", "sqrt(1 * 1 + 2 * 2 + 0.5 * 0.5)", "1")),
            (3, "angle without its fraction", ("c", "DEGREES_PER_SECOND * seconds", "(int)(DEGREES_PER_SECOND * seconds)")),
        )  # fmt: skip
        cases = cases[:: base.step(3)]
        given = [edited(lab, *edits) for lab, _, *edits in cases]
        results = in_parallel(check_texts, [(lab, texts) for (lab, *_), texts in zip(cases, given)])
        for (lab, said, *_), texts, result in zip(cases, given, results):
            self.assertEqual(len(result["mistakes"]), 1, (said, result["message"]))
            self.assertTrue(named(result)[0].startswith(said), (said, named(result)))
            if result["mistakes"][0]["line"]:
                after = self.changed(texts, result["mistakes"])
                self.assertEqual(check_texts(lab, after)["verdict"], "right", (said, result["mistakes"]))

    def test_the_first_wrong_value_is_at_the_mistake(self):
        """Also where nothing there is assigned: of a condition, a loop that is too short, a line that is missing, a function."""
        cases = (
            (9, "normal", 24, ("frag", "        normal = -normal;\n", "")),
            (6, "color", 24, ("frag", "i < 2", "i < 1")),
            (11, "light", 31, ("frag", "<= mapDepth", "> mapDepth")),
            (6, "color", 29, ("frag", "if (nDotL > 0.0) {", "{")),
            (8, "color", 34, ("frag", "cos(radians(u_SpotCutoff))", "cos(u_SpotCutoff)")),
            (5, "nDotL", 23, ("frag", "max(dot(lightDirection, normal), 0.0)", "0.5 * dot(lightDirection, normal) + 0.5")),
            (6, "color", 23, ("frag", "u_AmbientLight * v_Color.rgb", "vec3(0.0)")),
            (7, "gl_Position", 17, ("vert", mistakes.PROJECT, mistakes.PROJECT + "\n    gl_Position.z = 0.0;")),
        )[:: base.step(4)]
        results = in_parallel(check_texts, [(lab, edited(lab, edit), 3) for lab, *_, edit in cases])
        for (lab, name, line, edit), result in zip(cases, results):
            first = [said for said in result["symptoms"] if said.startswith("Wrong first, in scene")]
            self.assertEqual(len(first), 1, (edit, result["symptoms"]))
            self.assertRegex(first[0], rf": {name} is [-\d].*; right is [-\d].*\. See line {line} of lab{lab:02}\.", edit)
            self.assertIn(f"line {line} of", result["mistakes"][0]["look"], edit)

    @base.in_long_form
    def test_two_mistakes_have_their_places(self):
        texts = mistakes.pair(6, "not renormalized per fragment", "reflect's sign")
        result = check_texts(6, texts, 3)
        self.assertEqual(len(result["mistakes"]), 2, result["message"])
        self.assertEqual(check_texts(6, self.changed(texts, result["mistakes"]), 3)["verdict"], "right")
        self.assertRegex(" ".join(result["symptoms"]), FIRST)

    def test_two_mistakes_at_several_places_each(self):
        """Of a formula of the student's own, so that changes of the solution explain them."""
        far = {name: text.decode() for name, text in corpus.read(4)["n19-d"].items() if name != "label"}
        color = (("frag", "= u_AmbientLight * v_Color.rgb", "= u_AmbientLight"), ("frag", "u_LightColor[i] * v_Color.rgb", "u_LightColor[i]"),
                 ("frag", "vec4(color,", "vec4(color * v_Color.rgb,"))
        for lab, texts, names in (
            (4, far, ["not normalized: ", "factor missing: u_NormalMatrix"]),
            (6, edited(6, ("frag", "reflect(-lightDirection, normal)", "reflect(lightDirection, -normal)"), *color), ["sign reversed: ", "times v_Color.rgb, too: "]),
        )[: 2 if base.LONG else 1]:
            found = check_texts(lab, texts, 3)
            self.assertEqual(len(named(found)), 2, found["message"])
            for name, said in zip(names, named(found)):
                self.assertTrue(said.startswith(name), found["message"])

    def test_matrices_have_their_line(self):
        texts = {"matrices.c": corpus.read(3)["wf1"]["matrices.c"].decode()}
        look = check_texts(3, texts, 3)["mistakes"][0]["look"]
        self.assertRegex(look, r"^line 11 of matrices\.c: .*transpose")

    def test_light_that_is_clamped_before_the_colour(self):
        for lab, limit in ((4, "0.95"), (2, "1.0"), (5, "0.98"))[: None if base.LONG else 0]:
            out = mistakes.OUT[lab]
            limited = out.replace("light *", f"min(light, {limit}) *")
            self.wrong(lab, (mistakes.light_file(lab), out, limited))
        out = "vec4(light * color.rgb, color.a)"
        result = self.wrong(9, ("frag", out, f"min({out}, 0.9)"))
        self.assertEqual(len(named(result)), 1, result["message"])
        self.assertIn("min(", result["mistakes"][0]["sentence"])

    @base.in_long_form
    def test_a_sphere_that_the_fragment_shader_cuts_out_of_a_larger_mesh(self):
        """Its outline is the exact one, not the mesh's."""
        texts = mistakes.read(10)
        grow = "    vec4 place = vec4(1.05 * a_Position.xyz, 1.0);\n"
        texts["lab10.vert"] = (
            texts["lab10.vert"].replace("* a_Position", "* place").replace("main() {\n", "main() {\n" + grow)
        )
        cut = "    if (b * b < c) discard;"
        texts["lab10.frag"] = (
            texts["lab10.frag"]
            .replace("    vec3 normal = normalize(v_Normal);\n", "")
            .replace("    vec3 lightDirection = normalize(u_LightPosition - v_Position);", self.RAY + cut)
            .replace("v_Position);\n        float rDotV", "place);\n        float rDotV")
        )
        texts["budget.c"] = texts["budget.c"].replace("112", "20").replace("80", "14")
        result = check_texts(10, texts)
        self.assertEqual(result["verdict"], "right", result["message"])

    @base.in_long_form
    def test_a_mesh_that_is_just_too_coarse_has_no_other_name(self):
        texts = mistakes.read(10)
        texts["budget.c"] = texts["budget.c"].replace("112", "64").replace("80", "44")
        result = check_texts(10, texts)
        self.assertEqual(result["verdict"], "wrong", result["message"])
        self.assertIn(named(result), ([], ["mesh too coarse"]))

    @base.in_long_form
    def test_an_index_beyond_the_array(self):
        """Which reads 0 here, and passed."""
        loop = "i < 2"
        for lab, edits in (
            (2, (("i < 2", "i <= 2"),)),
            (4, (("for (int i = 0; i < 2; i++)", "for (int i=0;i<3;++i)"),)),
            (5, (("i < 2", "i < LIGHTS"), ("void main", "#define LIGHTS 3\nvoid main"))),
        ):
            texts = mistakes.read(lab)
            name = next(name for name in texts if loop in texts[name])
            for old, new in edits:
                self.assertIn(old, texts[name])
                texts[name] = texts[name].replace(old, new, 1)
            result = check_texts(lab, texts)
            self.assertEqual(result["verdict"], "wrong", (lab, result["message"]))
            self.assertEqual(named(result), ["index beyond the array"])

    @base.in_long_form
    def test_an_index_beyond_the_array_of_another_lab(self):
        """Whose file lies in the same folder."""
        other = mistakes.read(2)["lab02.vert"].replace("i < 2", "i < 3")
        self.assertEqual(check_texts(1, {**mistakes.read(1), "lab02.vert": other})["verdict"], "right")

    @base.in_long_form
    def test_an_exponent_a_little_off(self):
        result = self.wrong(6, ("frag", "u_Shininess)", "0.95 * u_Shininess)"))
        self.assertEqual(named(result), ["factor too many: 0.95"])

    @base.in_long_form
    def test_numbers_a_little_off(self):
        edits = (
            ("{0.5, 0.3, -0.8}", "{0.5, 0.32, -0.8}"),
            ("{0.5, 0.3, -0.8}", "{0.55, 0.3, -0.8}"),
            ("{2, 0.7, 1.2}", "{2, 7 / 10, 1.2}"),
            ("DEGREES_PER_SECOND = 30", "DEGREES_PER_SECOND = 30.1"),
        )
        for old, new in edits[:: base.step(4)]:
            result = self.wrong(3, ("c", old, new))
            self.assertEqual(len(named(result)), 1, result["message"])
        project = mistakes.PROJECT
        self.wrong(1, ("vert", project, project + "\n    gl_Position.x += 0.05;"))

    def test_both_precisions_are_compiled(self):
        for lab in (2, 5):
            texts = edited(
                lab,
                ("frag", "void main() {", "uniform vec3 u_AmbientLight;\nvoid main() {")
                if lab == 2
                else ("frag", mistakes.HIGHP, "precision mediump float;"),
                ("frag", "gl_FragColor = v_Color", "gl_FragColor = v_Color + 0.0 * vec4(u_AmbientLight, 0.0)")
                if lab == 2
                else ("vert", "void main() {", "uniform vec3 u_AmbientLight;\nvoid main() {"),
            )
            if lab == 5:
                texts["lab05.vert"] = texts["lab05.vert"].replace(
                    "v_Color = a_Color", "v_Color = a_Color + 0.0 * vec4(u_AmbientLight, 0.0)"
                )
            result = check_texts(lab, texts)
            self.assertEqual(result["verdict"], "error", (lab, result["message"]))
            self.assertIn("precision", result["message"] + result["details"])

    @base.in_long_form
    def test_a_coarse_mesh_with_a_ray_to_the_sphere(self):
        normal = "vec3 normal = normalize(v_Normal);\n    vec3 lightDirection = normalize(u_LightPosition - v_Position);"
        result = self.wrong(
            10,
            ("frag", normal, self.RAY.strip()),
            ("frag", mistakes.VIEW, "normalize(u_EyePosition - place)"),
            ("c", "slices = 112", "slices = 3"),
            ("c", "stacks = 80", "stacks = 2"),
        )
        self.assertIn("mesh too coarse", named(result))

    @base.in_long_form
    def test_what_is_drawn_is_what_is_counted(self):
        right = check_solution(10)[1]
        texts = edited(10)
        texts["lab10.frag"] = texts["lab10.frag"].replace("void main() {", "#define X 1\n#if X\nvoid main() {") + (
            "#else\nvoid main() {}\n#endif\n"
        )
        other = check_texts(10, texts)
        self.assertEqual(other["verdict"], "right", other["message"])
        for name in ("operations", "operations_ratio"):
            self.assertEqual(other["cost"][name], right["cost"][name], name)
        self.assertEqual(other["points"], right["points"])
        early = "void main() {\n    if (gl_FragCoord.x > 129.0 || gl_FragCoord.y > 97.0) return;\n"
        result = self.wrong(10, ("frag", "void main() {\n", early))
        self.assertEqual(named(result), ["depends on the picture's size"])

    @base.in_long_form
    def test_nothing_depends_on_the_compiler(self):
        for lab, head, other, said in (
            (6, "#if __VERSION__ == 100", "#else", "__VERSION__"),
            (1, "#ifdef GL_ES", "#else", "GL_ES"),
            (9, "#if defined(GL_OES_standard_derivatives)", "#else", "GL_OES"),
            (7, "#define A __VER\\\nSION__\n#if A == 100", "#else", "__VERSION__"),
            (2, "#ifdef GL_ES\n#define A\n#endif\n#ifndef A\n#else", "#endif\n#ifndef A", "GL_ES"),
            (4, "#if 1\n#define A (1.0 - gl_PointCoord.x)", "#else", "gl_PointCoord"),
            (5, "#ifdef GL_ES\nconst int k = 1;\n#else\nconst int k = 2;\n#endif\n#if 1", "#else", "GL_ES"),
            (5, "#ifdef GL_ES\nconst int k = 1;\n#endif\n#if 1", "#else", "GL_ES"),
        ):
            texts = edited(lab)
            for name in texts:
                if name.endswith(".frag"):
                    texts[name] = f"{head}\n{texts[name]}\n{other}\nvoid main() {{}}\n#endif\n"
            result = check_texts(lab, texts)
            self.assertEqual(result["verdict"], "refused", (lab, head, result["message"]))
            self.assertRegex(result["message"], said)
        texts = edited(5)
        texts["lab05.frag"] = texts["lab05.frag"].replace(
            mistakes.HIGHP,
            "#ifdef GL_ES\n#ifdef GL_FRAGMENT_PRECISION_HIGH\n#define P highp // __VERSION__\n"
            "#else\n#define P mediump\n#endif\nprecision P float;\n#endif\n"
        )
        lights = "uniform vec3 u_LightPosition[2];"
        texts["lab05.frag"] = texts["lab05.frag"].replace(
            lights,
            f"#ifdef GL_FRAGMENT_PRECISION_HIGH\n{lights}\n#else\n{lights.replace('vec3', 'mediump vec3')}\n#endif\n",
        )
        self.assertEqual(check_texts(5, texts)["verdict"], "right")

    def test_what_is_right_in_small_pictures_only(self):
        out = mistakes.OUT[5]
        late = f"{out}\n    if (gl_FragCoord.x > 200.0) gl_FragColor.rgb *= 0.5;"
        result = self.wrong(5, ("frag", out, late))
        self.assertEqual(named(result), ["depends on the picture's size"])

    @base.in_long_form
    def test_legal_words_of_glsl_1_are_counted(self):
        texts = edited(
            10,
            ("frag", "void main() {", "float round(float x) { return floor(x + 0.5); }\nvoid main() {"),
            ("frag", "vec3 color = ", "float smooth = round(0.2), sample = smooth;\n    vec3 color = sample + "),
            ("frag", "gl_FragColor", "gl_FragData[0]"),
        )
        result = check_texts(10, texts)
        self.assertEqual(result["verdict"], "right", result["message"])
        self.assertIsNotNone(result["cost"], result["details"])


class Faults(Labs):
    def test_a_compile_error_is_reported_with_its_line_and_its_meaning(self):
        tried = list(faults.FAULTS.items())[:: base.step(3)]
        results = in_parallel(check_texts, [job for _, (job, _, _) in tried])
        for (name, (_, where, meaning)), result in zip(tried, results):
            said = result["message"] + "\n" + result["details"]
            self.assertEqual(result["verdict"], "error", f"{name}: {said}")
            self.assertEqual(result["points"], 0, name)
            if where:
                self.assertRegex(result["message"], rf"^lab\d\d\.{where}:\d+: ", name)
            own = [
                line
                for line in said.split("\n")
                if not re.match(r"lab\d\d\.\w+:\d+: |  *\d+ \|", line)
            ]
            self.assertRegex("\n".join(own), meaning, f"{name}: {said}")

    def refused_with(self, lab, folder, *patterns):
        code, result = run_check(lab, folder)
        self.assertEqual(code, 1, result)
        self.assertIn(result["verdict"], ("error", "refused"), result)
        self.assertEqual(result["points"], 0, result)
        for pattern in patterns:
            self.assertRegex(result["message"], pattern)
        return result

    def copy(self, lab, name="mine"):
        shutil.copytree(self.folder_of(lab), self.path(name))
        return self.path(name)

    def test_missing_files_and_folders(self):
        empty = self.path("empty")
        os.mkdir(empty)
        self.refused_with(5, empty, r"lab05\.vert")
        self.refused_with(3, empty, r"matrices\.c")
        done = start_check("lab05", self.path("nowhere"))
        self.assertEqual((done.returncode, done.stdout), (2, b""))
        self.assertRegex(done.stderr.decode(), r"^check: .*nowhere: No such file.*\n$")
        mine = self.copy(5)
        os.remove(os.path.join(mine, "lab05.frag"))
        self.refused_with(5, mine, r"lab05\.frag")
        os.mkdir(os.path.join(mine, "lab05.frag"))
        self.refused_with(5, mine, r"lab05\.frag")
        self.refused_with(5, os.path.join(mine, "lab05.vert"), r"lab05\.frag")  # one file of two

    def test_loops_that_do_not_end_soon(self):
        """The driver stops them and draws; appendix A forbids the second."""
        for loop, said in (
            ("for (int i = 0; i < 20000000; i++) light += u_AmbientLight * 0.0;", r"loops turn 100000\d times or more"),
            ("for (int i = 0; i < 400; i++) for (int k = 400; k > 0; k--) light += vec3(0.0);", "loops turn 160402"),
            ("while (light.r < 0.0) light += vec3(1.0);", "constant bounds"),
            ("for (float x = 1.0; x > 0.0; x += 0.0) light *= 1.0;", r"loops turn 100000\d times or more"),
        ):
            mine = self.copy(5, f"loop {len(loop)}")
            path = os.path.join(mine, "lab05.frag")
            with open(path) as file:
                text = file.read()
            with open(path, "w") as file:
                file.write(text.replace("vec3 light = u_AmbientLight;", f"vec3 light = u_AmbientLight; {loop}"))
            self.refused_with(5, mine, r"^lab05\.frag:\d+: ", said)

    @base.in_long_form
    def test_a_submission_is_read_as_one_of_a_class_is(self):
        """Names, folders, archives and sizes that a class's students may use."""
        solution = self.folder_of(5)
        for path, name, bulk in (
            ("mine/Lab05.VERT", "lab05.vert", 0),
            ("mine/my shader.fs", "lab05.frag", 300_000),
        ):
            with open(os.path.join(solution, name)) as file:
                self.make(path, file.read().encode() + b"//" + b"x" * bulk + b"\n")
        shutil.make_archive(self.path("handed in"), "zip", self.path("mine"))
        for path in ("mine", ".", "handed in.zip"):
            code, result = run_check(5, self.path(path))
            self.assertEqual((code, result["verdict"]), (0, "right"), (path, result))

    def test_files_that_are_not_text(self):
        for name, content, said in (
            ("garbage", bytes(range(256)) * 40, r"lab05\.frag"),
            ("huge", b"// " + b"x" * 10_000_000 + b"\n", r"lab05\.frag.*at most"),
            ("zeros", bytes(5000), r"lab05\.frag"),
            ("empty", b"", r"lab05\.frag"),
        ):
            mine = self.copy(5, name)
            self.make(f"{name}/lab05.frag", content)
            self.refused_with(5, mine, said)

    def test_a_line_that_is_not_utf_8_is_quoted(self):
        mine = self.copy(5)
        with open(os.path.join(mine, "lab05.frag"), "ab") as file:
            file.write(b"#error \xb0\xa1\xff\n")
        self.refused_with(5, mine, r"lab05\.frag:\d+: .*\ufffd")

    def test_links_pipes_and_unreadable_files(self):
        mine = self.copy(5)
        path = os.path.join(mine, "lab05.frag")
        os.remove(path)
        os.symlink("/etc/passwd", path)
        result = self.refused_with(5, mine, r"lab05\.frag")
        self.assertNotIn("root:", json.dumps(result))
        os.remove(path)
        os.mkfifo(path)
        self.refused_with(5, mine, r"lab05\.frag")
        os.remove(path)
        if os.getuid() != 0:
            self.make("mine/lab05.frag")
            os.chmod(path, 0)
            self.refused_with(5, mine, r"lab05\.frag")

    @base.in_long_form
    def test_an_include_stays_in_its_folder(self):
        for name in ("/etc/passwd", "../other/secret.glsl", "/dev/zero", "common.h"):
            self.make("other/secret.glsl", "secret\n")
            mine = self.copy(1, "mine" + str(abs(hash(name))))
            with open(os.path.join(mine, "lab01.frag"), "a") as file:
                file.write(f'#include "{name}"\n')
            result = self.refused_with(1, mine, r"lab01\.frag")
            self.assertNotIn("root:", json.dumps(result))
            self.assertNotIn("secret\n", json.dumps(result))

    @base.in_long_form
    def test_c_that_does_not_compile_or_end(self):
        head = '#include "lab_code.h"\nvoid lab_matrices(double s, Mat4 *w, Mat4 *n)\n{\n'
        broken = (
            (
                "semicolon",
                head + "    *w = mat4_identity()\n}\n",
                r"matrices\.c:4(.|\n)*mat4_identity\(\)(.|\n)*A semicolon is missing",
            ),
            ("missing", '#include "lab_code.h"\nstatic int unused;\n', r"function|lab_matrices"),
            ("outside", '#include "/etc/passwd"\n' + head + "}\n", r"No such file"),
            ("spliced", '#include \\ \n"/etc/passwd"\n' + head + "}\n", r"No such file"),
            (
                "assembler",
                'asm(".incbin \\"/etc/passwd\\"");\n' + head + "}\n",
                r"file not found|No such file",
            ),
            (
                "instruction",
                head + '    asm("foo bar");\n}\n',
                r"^matrices\.c: Error: no such instruction: `foo bar'\nWrite it in C",
            ),
            ("crash", head + "    *(volatile int *)8 = 1;\n}\n", r"."),
        )
        for name, text, said in broken[:: base.step(2)]:
            self.make(f"{name}/matrices.c", text)
            code, result = run_check(3, self.path(name))
            self.assertEqual(code, 1, name)
            self.assertIn(result["verdict"], ("error", "refused"), (name, result))
            self.assertRegex(result["message"] + "\n" + result["details"], said, name)
        self.make("endless/matrices.c", head + "    for (volatile int i = 0;; i = 0) ;\n}\n")
        code, result = run_check(3, self.path("endless"), 1, "--limit", "1")
        self.assertEqual((code, result["verdict"]), (1, "timeout"), result)
        if base.LONG:  # it is waited for: 20 s
            self.make("stopped/matrices.c", "int raise(int);\n" + head + "    raise(19);\n}\n")
            code, result = run_check(3, self.path("stopped"))
            self.assertEqual((code, result["verdict"]), (1, "timeout"), result)
            self.assertIn("it stopped, or waited", result["message"])

    def test_the_command_line(self):
        for arguments, code, said in (
            ((), 2, "lab05"),
            (("lab05",), 2, "lab05"),
            (("lab12", "x"), 2, "lab"),
            (("lab05_per_fragmant", "x"), 2, "lab05_per_fragment"),
            (("lab05", "x", "y"), 2, ""),
            (("lab05", "x", "--seed", "a"), 2, "--seed"),
        ):
            done = start_check(*arguments)
            self.assertEqual((done.returncode, done.stdout), (code, b""), arguments)
            self.assertRegex(done.stderr.decode(), rf"^check: .*{said}.*\n$", arguments)
        done = start_check("lab05", self.folder_of(5), "--seed", "1")
        self.assertEqual((done.returncode, done.stderr), (0, b""), done.stdout)
        self.assertRegex(done.stdout.decode(), r"^lab05_per_fragment: right, 10 of 10 points")
        os.mkdir(self.path("empty"))
        for name in ("5", "05", "lab5"):
            done = start_check(name, self.path("empty"))
            self.assertEqual((done.returncode, done.stderr), (1, b""), done.stdout)
            self.assertRegex(done.stdout.decode(), r"^lab05_per_fragment: \w+, 0 of 10 points")

    def test_the_worst_scene_is_drawn(self):
        wrong = self.folder_of(5, "starter")
        os.mkdir(self.path("found"))
        _, result = run_check(5, wrong, 1, "--pictures", self.path("found"))
        self.assertEqual(len(result["pictures"]), 1)
        sheet = self.png(os.path.join("found", result["pictures"][0]))
        self.assertGreaterEqual(sheet.width, 3 * 64)

    @base.in_long_form
    def test_points_for_cost_depend_on_counts_and_not_on_time(self):
        first = check_solution(10)[1]
        cost = first["cost"]
        if base.LONG:
            second = run_check(10, self.folder_of(10))[1]
            for name in ("operations", "operations_ratio"):
                self.assertEqual(cost[name], second["cost"][name], name)
            self.assertEqual(first["points"], second["points"])
        self.assertGreater(cost["time_ratio"], 0)
        # All five points at 0.63 of the plain program's operations, none at 1; in halves.
        share = min(max((1 - cost["operations_ratio"]) / 0.37, 0), 1)
        self.assertEqual(first["points"], 5 + int(10 * share) / 2)
        # Without culling it costs more.
        texts = mistakes.applied(
            mistakes.read(10), 10, mistakes.code("cull = true", "cull = false")
        )
        uncut = check_texts(10, texts)
        self.assertGreater(uncut["cost"]["operations"], cost["operations"])
        self.assertEqual(uncut["verdict"], "right")
        self.assertLess(uncut["points"], first["points"])

    @base.in_long_form
    def test_a_seed_always_gives_the_same_result(self):
        wrong = mistakes.single(6, "reflect's sign")
        first, second = check_texts(6, wrong, 12), check_texts(6, wrong, 12)
        for result in (first, second):
            result.pop("seconds"), result.pop("path")
        self.assertEqual(first, second)
        other = check_texts(6, wrong, 13)
        known, own = (
            lambda result, kind=kind: [probe for probe in result["probes"] if probe["set"] == kind]
            for kind in ("known", "seed")
        )
        self.assertEqual(known(first), known(other))
        self.assertNotEqual(own(first), own(other))


def many(seeds, pairs):
    """The table of examples/labs/TEACHING.md, and on standard error what was not named."""
    print("| lab | mistakes | alone: named | misnamed | pairs | both named | one named | misnamed |")
    print("|---|---|---|---|---|---|---|---|", flush=True)
    missed = collections.Counter()
    for lab, name in LABS.items():
        kinds = mistakes.of_lab(lab)
        jobs = [(lab, kind, seed) for kind in kinds for seed in range(100, 100 + seeds)]
        alone = in_parallel(judge_single, jobs)
        chosen = pairs_of(lab, pairs, random.Random(lab))
        two = in_parallel(judge_pair, [(lab, *pair, 500 + i) for i, pair in enumerate(chosen)])
        single, double = tally(alone), tally(two)
        seen = len(two) - double["hidden"]
        print(
            f"| {lab} | {len(kinds)} | {share(single, len(alone)):.0%} | {single['MISNAMED']} "
            f"| {seen} | {share(double, seen):.0%} | {double['one']} | {double['MISNAMED']} |",
            flush=True,
        )
        missed.update(
            f"{name}, {kind}: {said}  {', '.join(named(result))}"
            for _, kind, _, said, result, *_ in alone + two
            if said not in ("named", "hidden")
        )
    print("not named (how often: lab, mistake: outcome, what was said):", file=sys.stderr)
    for key, count in sorted(missed.items()):
        print(f"{count:4}  {key}", file=sys.stderr)


if __name__ == "__main__":
    if not os.path.exists(CHECK):
        sys.exit(77)
    if "--many" in sys.argv:
        numbers = [int(word) for word in sys.argv[sys.argv.index("--many") + 1 :]]
        many(*(numbers + [20, 100][len(numbers) :]))
        sys.exit()
    sys.exit(base.main())
