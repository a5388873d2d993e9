"""The labs as pages: used as a student would, and their verdicts against those of `check`."""
import base64
import concurrent.futures
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time
import unittest

import browser
from pages import EXAMPLES, LONG, SITE, SOURCE, Case, differences, part

sys.path.insert(0, os.path.join(SOURCE, "tests/labs"))
import corpus
import faults
import mistakes

CHECK = os.path.join(EXAMPLES, "check")
SHADERS = (1, 2, 4, 5, 6, 7, 8, 9, 11)
SOLUTION = mistakes.read(5)


def check(lab, texts):
    """What `check` says of a submission for a lab, by number or folder."""
    of = ["--lab", lab] if isinstance(lab, str) else [mistakes.NAMES[lab]]
    with tempfile.TemporaryDirectory() as folder:
        for name, text in texts.items():
            pathlib.Path(folder, name).write_text(text)
        done = subprocess.run([CHECK, *of, folder, "--seed", "1", "--json", "-"], stdout=subprocess.PIPE)
    return json.loads(done.stdout)


def said(verdict):
    """What has to be the same. Of a bias more than one number is right, and depths are the driver's."""
    names = [re.sub(r" for [0-9.e-]+$", " for another", mistake["name"]) for mistake in verdict["mistakes"]]
    return (verdict["verdict"], verdict["points"], names)


def scenes(verdict):
    """What was judged, and how."""
    return [(probe["set"], probe["name"], probe["seconds"], probe["width"], probe["height"], probe["passed"])
            for probe in verdict["probes"]]


def sampled(count, seed):
    """(lab, name, texts) of so many submissions of the corpus in each lab. The browser refuses the suffix of 1.0f."""
    dice = random.Random(seed)
    for lab in SHADERS:
        submissions = {name: {file: text.decode() for file, text in files.items() if file != "label"}
                       for name, files in corpus.read(lab).items()}
        names = [name for name in sorted(submissions)
                 if not any(re.search(r"[\d.]f\b", text, re.IGNORECASE) for text in submissions[name].values())]
        for name in dice.sample(names, min(count, len(names))):
            yield lab, name, submissions[name]


def starter(lab):
    folder = pathlib.Path(SOURCE, "examples/labs", mistakes.NAMES[lab])
    return {path.name: path.read_text() for path in folder.iterdir() if path.suffix in (".vert", ".frag", ".c")}


def made(every):
    """(name, lab, texts) of every so many mistakes."""
    all_of_them = [(name, lab, edits) for name, labs in mistakes.MISTAKES.items() for lab, edits in labs.items()
                   if lab in SHADERS]
    return [(name, lab, mistakes.applied(mistakes.read(lab), lab, edits)) for name, lab, edits in all_of_them[::every]]


class OfLabs(Case):
    def judge(self, lab, texts):
        return self.page.run(f"""LabWorker.ask({{lab: {json.dumps(mistakes.NAMES[lab])},
            what: "check", seed: 1, texts: new Map(Object.entries({json.dumps(texts)}))}})
            .then(answer => answer.verdict || {{message: answer.message}})""")

    def beside(self, cases):
        """(name, lab, texts, what is said natively), which is computed while the page judges what comes before."""
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            natively = pool.map(lambda case: check(*case[1:]), cases)
            for case, expected in zip(cases, natively):
                yield *case, expected


def undefined():
    """What a driver draws by chance: the verdict must not depend on it."""
    def edited(lab, *edits):
        texts = mistakes.read(lab)
        for name in texts:
            for old, new in edits:
                texts[name] = texts[name].replace(old, new)
        return texts
    empty = {"lab01.frag": "void main() {}\n"}
    return [("no color", 1, {**mistakes.read(1), **empty}), ("no color in comments", 1, {**starter(1), "lab01.frag":
             "// gl_FragColor\nprecision mediump float;\nvarying vec4 v_Color;\nvoid main() { vec4 c = v_Color; }\n"}),
            ("beyond the array", 2, edited(2, ("i < 2", "i < 3"))), ("beyond the array", 4, edited(4, ("i < 2", "i<=2"))),
            ("beyond the array, and more", 2, edited(2, ("i < 2", "i < 3"), ("* nDotL", "* nDotL * 0.5")))]


class Corpus(OfLabs):
    def test_verdicts_of_the_corpus_are_native(self):
        seed = int(os.environ.get("LIGHTING_TEST_SEED", 1))
        self.open(mistakes.NAMES[5])
        todo = [(f"{name}, LIGHTING_TEST_SEED={seed}", lab, texts)
                for lab, name, texts in sampled(int(os.environ.get("LIGHTING_TEST_CASES", 3 if LONG == 1 else 1)), seed)]
        self.assertGreaterEqual(len(todo), len(SHADERS))
        for name, lab, texts, expected in self.beside(part(todo, seed)):
            with self.subTest(name, lab=lab):
                verdict = self.judge(lab, texts)
                self.assertEqual(said(verdict), said(expected))
                self.assertEqual(scenes(verdict), scenes(expected))


class Verdicts(OfLabs):
    def test_verdicts_are_native(self):
        self.open(mistakes.NAMES[5])
        cases = [("solution", lab, mistakes.read(lab)) for lab in SHADERS]
        cases += [("starter", lab, starter(lab)) for lab in SHADERS]
        for name, lab, texts, expected in self.beside(undefined() + part(cases, 1) + made(18 * LONG if LONG > 1 else 12)):
            with self.subTest(name, lab=lab):
                self.assertEqual(said(self.judge(lab, texts)), said(expected))
        # Operations are counted; of the C, numbers are read.
        texts = mistakes.read(10)
        named = texts["budget.c"].replace("lices = 112;", "lices = SLICES;").replace("\nvoid", "\n#define SLICES 112\nvoid")
        for text in (texts["budget.c"], named, named.replace("#define SLICES 112", "").replace("{", "{ const int SLICES = 112;")):
            verdict = self.judge(10, {**texts, "budget.c": text})
            self.assertEqual((verdict["verdict"], verdict["points"]), ("right", 10), text)

    def test_what_is_refused_is_refused_natively(self):
        """With the same words; where they are the compiler's, the verdict and the advice are the same."""
        self.open(mistakes.NAMES[5])
        text = SOLUTION["lab05.frag"]
        for words, wrong in (("999999", "/" * 1000000), ("not a text file", text + "\0"), ("byte 0x01", text + "\1"),
                             ("is empty", "\n"), ("#version", "\n#version 300 es\n" + text),
                             ("no such file beside it", text + '#include "none.glsl"\n'),
                             ("through lab05.frag", text + '#include "lab05.vert"\n'),
                             ("depends on __VERSION__", text + "#if __VERSION__ == 100\n#endif\n"),
                             ("function `void main()`", text.replace("void main", "void mine")),
                             ("has no #endif", "#if 1\n" + text), ("does not end with", text + "/* open\n")):
            texts = {**SOLUTION, "lab05.frag": wrong}
            if "through" in words:
                texts["lab05.vert"] += '#include "lab05.frag"\n'
            with self.subTest(words):
                here, natively = self.judge(5, texts), check(5, texts)
                self.assertIn(natively["verdict"], ("error", "refused"))
                if words in natively["message"]:
                    self.assertEqual(here["message"], natively["message"])
                else:
                    self.assertIn(words, natively["details"])
                    self.assertIn(words, here["details"])
                if "verdict" in here:  # else the page does not come to judging
                    self.assertEqual((here["verdict"], here["points"]), (natively["verdict"], natively["points"]))
        texts = {**mistakes.read(10), "budget.c": mistakes.read(10)["budget.c"].replace("112", "1")}
        self.assertEqual(said(self.judge(10, texts)), said(check(10, texts)))

    def test_errors_of_the_compiler_are_explained(self):
        self.open(mistakes.NAMES[5])
        for number, (name, ((lab, texts), file, meaning)) in part(enumerate(faults.FAULTS.items())):
            with self.subTest(name):
                said = self.page.run(f"""LabWorker.ask({{lab: {json.dumps(mistakes.NAMES[lab])},
                    what: "draw", seconds: 1, texts: new Map(Object.entries({json.dumps(texts)}))}})
                    .then(answer => answer.message.replace("/tmp/mine/", ""))""")
                if file:
                    self.assertRegex(said, rf"^lab0{lab}\.{file}:\d+: ")
                self.assertRegex(said, re.compile(meaning, re.DOTALL))
                if number % 9 == 0:
                    verdict = self.judge(lab, texts)
                    self.assertEqual((verdict["verdict"], verdict["points"]), ("error", 0))
                    self.assertRegex(verdict["message"] + " " + verdict["details"], re.compile(meaning, re.DOTALL))


# Which Debian does not have as a package, but in Chromium, as a text in its Lighthouse.
AXE = "devtools://devtools/bundled/third_party/lighthouse/lighthouse-dt-bundle.js"
WRONG = """axe.run(document).then(found => found.violations.map(({id, nodes}) => [id, nodes[0].html, nodes[0].failureSummary]))"""


class Accessible(OfLabs):
    """What axe-core finds on the pages, at each width and in each colour scheme."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.number = 0
        with browser.Browser() as chromium:
            chromium.open(AXE, "true")
            text = chromium.run("document.body ? document.body.textContent : ''")
            found = re.search(r"`/\*! axe v(?:[^`\\]|\\.)*`", text, re.DOTALL)
            cls.axe = chromium.run(found.group(0)) if found else ""
        if not cls.axe:
            print("not checked: what axe-core finds on the pages, because this Chromium has none")

    def tearDown(self):
        self.page.media()
        super().tearDown()

    def assert_accessible(self, *what):
        if not self.axe:
            return
        self.page.run("for (const part of document.querySelectorAll('details')) part.open = true")
        self.page.run(self.axe + "\n;0")
        for dark, width in part([(False, 1280), (False, 360), (True, 1280), (True, 360)], self.number):
            self.page.media(dark=dark)
            self.page.resize(width, 900)
            with self.subTest(*what, dark=dark, width=width):
                self.assertEqual(self.page.run(WRONG), [])
        type(self).number += 1  # another one in the long form

    def assert_narrow_and_named(self, name):
        self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), 360, name)
        self.assertEqual(self.page.complaints(), [])
        self.assert_named(name)

    def nonsense(self):
        """In the editor, which then lists errors; not kept."""
        self.page.run("""(() => {
            document.querySelector(".source").value = "nonsense;";
            document.querySelector(".source").dispatchEvent(new Event("input"));
        })()""")
        self.page.wait("document.querySelectorAll('.errors li').length")
        self.page.run("localStorage.clear()")

    def test_programs(self):
        for name in ("index", "precision", "LightedCube_ambient", "PointLightedSphere_perFragment", "Materials", "single/FourLights"):
            self.open(name)
            self.assert_accessible(name)
        self.page.click("#picture")
        self.page.wait("document.getElementById('pixel') && document.getElementById('pixel').dataset.milliseconds")
        self.assert_accessible("a pixel")
        self.page.run("Page.compare().then(() => true)")
        self.nonsense()
        self.assert_accessible("a comparison and an error")

    def test_chapters(self):
        for name in ("chapter06", "chapter11", "chapter19", "chapter21"):
            self.open(name)
            self.assert_accessible(name)

    def test_labs(self):
        judged = part([*mistakes.NAMES.values(), "single/" + mistakes.NAMES[9]])
        for name in ["labs", *mistakes.NAMES.values(), "single/" + mistakes.NAMES[9]]:
            self.page.resize(360, 700)
            self.open(name)
            self.assert_narrow_and_named(name)
            if name in judged and self.page.run("!!document.getElementById('check')"):
                self.page.run("Lab.check(1)")
                self.assertTrue(self.text("#result summary"))
            self.assert_accessible(name)
        self.open(mistakes.NAMES[5])
        texts = {**SOLUTION, "lab05.frag": SOLUTION["lab05.frag"].replace("normalize(v_Normal)", "v_Normal")}
        self.page.run(f"Lab.lab.editor.texts = () => new Map(Object.entries({json.dumps(texts)}))")
        self.page.run("Lab.check(1)")
        self.assertIn("not normalized", self.text("[aria-label=Mistakes]"))
        self.page.run("Point.load().then(() => Lab.lab.point.show())")
        self.page.wait("document.getElementById('pixel')?.dataset.milliseconds")
        self.nonsense()
        self.assert_accessible("a mistake and an error")


class Labs(OfLabs):
    def setUp(self):
        self.open(mistakes.NAMES[5])
        if self.page.run("localStorage.length"):  # of the test before
            self.page.run("localStorage.clear()")
            self.open(mistakes.NAMES[5])

    def put(self, texts):
        """Types the files, one after another."""
        for name, text in texts.items():
            self.page.run(f"""(() => {{
                const files = document.querySelector(".files"), field = document.querySelector(".source");
                files.value = {json.dumps(name)};
                files.dispatchEvent(new Event("change"));
                field.focus();
                field.select();
            }})()""")
            self.page.type(text)

    def pixels(self, name):
        return base64.b64decode(self.page.run(f"""(() => {{
            const canvas = document.getElementById({json.dumps(name)});
            const {{data}} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            let text = "";
            for (let i = 0; i < data.length; i += 4)
                text += String.fromCharCode(data[i], data[i + 1], data[i + 2]);
            return btoa(text);
        }})()"""))

    def compared(self):
        """The largest error that the page says, once it is below a step or not."""
        return float(re.search(r"inside objects: ([\d.]+) steps", self.text("#compared")).group(1))

    def finish(self):
        """Clicks Check and waits for the verdict."""
        self.page.click("#check")
        self.page.wait("!document.getElementById('check').disabled")

    def test_a_lab_is_done(self):
        self.assertGreater(self.compared(), 50)
        before, expected = self.pixels("drawn"), self.pixels("expected")
        self.put(SOLUTION)
        self.page.wait("parseFloat(document.getElementById('compared').textContent.split(': ')[1]) < 1")
        self.assertTrue(self.pixels("drawn") != before)
        self.assertTrue(self.pixels("expected") == expected)
        with tempfile.TemporaryDirectory() as folder:
            for name, text in SOLUTION.items():
                pathlib.Path(folder, name).write_text(text)
            program = os.path.join(EXAMPLES, mistakes.NAMES[5])
            native = subprocess.run([program, "--shaders", folder, "-t", "1", "-o", "-", "--format", "rgb"], check=True,
                                    stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
        self.assertEqual(differences(self.pixels("drawn"), native), (0, 0))
        self.finish()
        self.assertIn("right, 10 of 10 points", self.text("#result"))
        # Text and progress outlive the page.
        self.page.open(pathlib.Path(SITE, "labs.html").as_uri())
        self.assertEqual(self.text("[data-lab=lab05_per_fragment]"), "right, 10 of 10 points")
        self.open(mistakes.NAMES[5])
        self.assertLess(self.compared(), 1)
        self.assertEqual(differences(self.pixels("drawn"), native), (0, 0))
        self.assertEqual(self.page.complaints(), [])

    def test_a_mistake_is_named_and_hints_are_asked_for(self):
        self.put({**SOLUTION, "lab05.frag": SOLUTION["lab05.frag"].replace("normalize(v_Normal)", "v_Normal")})
        self.finish()
        self.assertIn("not normalized: v_Normal", self.text("#result"))
        self.assertFalse(self.page.run("document.querySelector('#result details').open"))
        self.page.click("#result summary")
        self.page.wait("document.querySelector('#result details').open")
        self.assertIn("does not have length 1", self.page.run("document.querySelector('#result details').innerText"))
        self.assertGreater(self.page.run("document.getElementById('sheet').width"), 200)
        self.assertEqual(self.page.complaints(), [])

    def test_where_a_mistake_shows_first(self):
        """The value is wrong at that pixel, in that line; beside it is the right one, as the solution has it."""
        self.open(mistakes.NAMES[6])
        vertex, fragment = ("lab06.vert", "lab06.frag")
        right = mistakes.read(6)
        for old, new, name in (("reflect(-lightDirection", "reflect(lightDirection", "reflected"),
                               ("normal = normalize(v_Normal)", "normal = v_Normal", "normal")):
            texts = {vertex: right[vertex], fragment: right[fragment].replace(old, new)}
            line = next(i for i, row in enumerate(texts[fragment].splitlines(), 1) if new in row)
            self.page.run(f"Lab.lab.editor.texts = () => new Map({json.dumps(list(texts.items()))}); Lab.check(1)")
            self.page.wait("!document.getElementById('check').disabled && !!document.querySelector('.first')")
            self.assertRegex(self.text(".first"), rf"^Column \d+, row \d+: line {line}: {name} is [-0-9., ]+; in a right program it is [-0-9., ]+\.$")
            captions = self.page.run("[...document.querySelectorAll('#result .pictures figcaption')].map(part => part.firstChild.data)")
            self.assertEqual(captions, ["Yours", "Right"])
            self.assertNotEqual(*self.page.run("[...document.querySelectorAll('#result .pictures canvas')].map(part => part.toDataURL())"))
        self.page.run(f"Lab.lab.editor.texts = () => new Map({json.dumps(list(right.items()))}); Lab.check(1)")
        self.page.wait("!document.getElementById('check').disabled && /right/.test(document.querySelector('#result p').className)")
        self.assertFalse(self.page.run("!!document.querySelector('.first')"))
        self.assertEqual(self.page.complaints(), [])

    def test_own_labs(self):
        """A folder becomes a page, whose verdicts, pictures and pixels are those of the folder natively."""
        own = {name: pathlib.Path(SOURCE, "examples/labs/extra", name) for name in ("spot", "fog")}
        changes = {"spot": (("normalize(v_Normal)", "v_Normal"), ("max(", "abs("), ("smoothstep(u_CosOuterCut, u_CosInnerCut", "smoothstep(u_CosInnerCut, u_CosOuterCut")),
                   "fog": (("normalize(v_Normal)", "v_Normal"), ("exp(-", "exp("), ("u_FogColor,", "v_Color.rgb,"))}
        with tempfile.TemporaryDirectory() as site:
            run = [os.path.join(SOURCE, "examples/run"), "web", "-o", site]
            environment = {**os.environ, "LIGHTING_BUILD": os.path.dirname(EXAMPLES)}
            subprocess.run([*run, "--lab", own["spot"], f"--lab={own['fog']}"], check=True, stderr=subprocess.DEVNULL, env=environment)
            for name, folder in own.items():
                self.page.open(pathlib.Path(site, "single" if name == "fog" else "", name + ".html").as_uri())
                self.assertEqual(self.page.run("Lab.lab.files.map(({name, text}) => [name, text])"),
                                 [[name + end, (folder / (name + end)).read_text()] for end in (".vert", ".frag")])
                self.assertEqual(self.page.run("document.getElementById('error').textContent"), "")
                solution = {path.name: path.read_text() for path in (folder / "solution").iterdir()}
                self.assertNotIn(solution[name + ".frag"][-80:].strip(), pathlib.Path(site, "own_" + name + ".js").read_text())
                for old, new in ((" ", " "), *changes[name]):
                    texts = {file: text.replace(old, new) for file, text in solution.items()}
                    with self.subTest(name, old=old):
                        self.page.run(f"Lab.lab.editor.texts = () => new Map({json.dumps(list(texts.items()))}); 0")
                        verdict, native = self.page.run("Lab.check(1)"), check(str(folder), texts)
                        self.assertEqual((said(verdict), scenes(verdict)), (said(native), scenes(native)))
                # The solution is what is expected; a pixel of it has no error of the formula.
                self.page.run(f"Lab.lab.texts = new Map({json.dumps(list(solution.items()))}); Lab.draw(true)")
                self.page.wait("/ 0\\.\\d+ steps/.test(document.getElementById('compared').textContent)")
                self.page.run("Point.load().then(() => Lab.lab.point.show())")
                self.page.wait("document.getElementById('pixel')?.dataset.milliseconds")
                self.assertLess(abs(self.page.run("Pixel.said().verdict?.formula || 0")), 0.51)  # the solution's picture has bytes
                self.assertEqual(self.page.complaints(), [])
            self.page.open(pathlib.Path(site, "labs.html").as_uri())
            self.assertEqual(self.page.run("[...document.querySelectorAll('.cards a')].slice(-2).map(a => a.getAttribute('href'))"),
                             ["spot.html", "fog.html"])
            # What is no lab is refused, and the pages stay.
            broken = pathlib.Path(site, "broken")
            broken.mkdir()
            (broken / "TASK.md").write_text("# Broken\n")
            (broken / "lab.json").write_text("{\n")
            done = subprocess.run([*run, "--lab", broken], capture_output=True, text=True, env=environment)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr.splitlines()[-1], r"^examples/run: web: --lab .*/broken: .*lab\.json:\d+: ")
            self.assertTrue(pathlib.Path(site, "spot.html").exists())

    def test_a_dropped_file_leaves_the_page(self):
        self.put(SOLUTION)
        self.page.drop(".source", os.path.join(SOURCE, "examples/labs/lab05_per_fragment/lab05.frag"))
        self.page.wait("document.getElementById('error').textContent.startsWith('lab05.frag: a page reads no files')")
        self.assertIn(self.page.run("document.querySelector('.source').value"), SOLUTION.values())

    def test_errors_are_at_their_lines(self):
        self.put({"lab05.frag": SOLUTION["lab05.frag"].replace("nDotL = max", "nDotl = max")})
        self.page.wait("document.querySelectorAll('.errors li').length")
        self.assertRegex(self.text(".errors li"), r"^lab05.frag:\d+: .*nDotL")
        self.assertIn("did you mean nDotl?", self.text(".said"))
        self.finish()
        self.assertIn("error, 0 of 10 points", self.text("#result"))

    def test_what_is_handed_in_is_what_check_takes(self):
        self.put(SOLUTION)
        self.page.run("document.getElementById('student').focus()")
        self.page.type("Ada <b> ../Lovelace")
        with tempfile.TemporaryDirectory() as folder:
            self.saved(folder, "#hand-in", "Ada_b_.._Lovelace-lab05.zip")
            results = os.path.join(folder, "results")
            subprocess.run([CHECK, "--class", folder, "--lab", "5", "-o", results], check=True, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
            students = json.loads(pathlib.Path(results, "class.json").read_text())["students"]
            self.assertEqual([student["verdict"] for student in students], ["right"])

    def test_an_endless_loop_costs_no_text(self):
        loop = SOLUTION["lab05.frag"].replace("void main() {", "void main() {\n    for (int i = 0; i < 2000000000; i++)\n"
                                              "        if (float(i) < -1.0) discard;")
        before = self.pixels("drawn")
        self.put({"lab05.vert": SOLUTION["lab05.vert"], "lab05.frag": loop})
        self.page.wait("document.querySelectorAll('.errors li').length")
        self.assertRegex(self.text(".errors li"), r"^lab05.frag:\d+: error: this loop takes about \d+ steps")
        self.finish()
        self.assertIn("this loop takes", self.text("#result"))
        # The page is loaded again with the text, says the same, and shows the starter.
        self.open(mistakes.NAMES[5])
        self.assertIn("this loop takes", self.text(".errors li"))
        self.assertTrue(self.pixels("drawn") == before)
        self.page.run("document.querySelector('.files').value = 'lab05.frag'")
        self.page.run("document.querySelector('.files').dispatchEvent(new Event('change'))")
        self.assertEqual(self.page.run("document.querySelector('.source').value"), loop)
        self.put(SOLUTION)
        self.page.wait("parseFloat(document.getElementById('compared').textContent.split(': ')[1]) < 1")
        # What was being drawn when the page ended is not drawn again by itself.
        self.page.run("localStorage.setItem('lighting drawing lab05_per_fragment', 'yes')")
        self.open(mistakes.NAMES[5])
        self.assertGreater(self.compared(), 50)
        self.assertIn("Your text of last time", self.text(".said"))
        self.page.click(".apply")
        self.page.wait("parseFloat(document.getElementById('compared').textContent.split(': ')[1]) < 1")

    def test_a_worker_that_does_not_answer_is_ended(self):
        self.page.run("LabWorker.limit = 1")
        self.put(SOLUTION)
        self.page.wait("document.querySelector('.said').textContent.includes('endless loop')")
        self.page.run("LabWorker.limit = 60000")
        self.page.click(".apply")
        self.page.wait("parseFloat(document.getElementById('compared').textContent.split(': ')[1]) < 1")

    def test_a_reload_in_the_middle_of_a_check(self):
        self.put(SOLUTION)
        self.page.wait("parseFloat(document.getElementById('compared').textContent.split(': ')[1]) < 1")
        self.page.run("Lab.check(1), 0")
        self.open(mistakes.NAMES[5])
        self.assertIn(self.page.run("document.querySelector('.source').value"), SOLUTION.values())
        self.finish()
        self.assertIn("right, 10 of 10 points", self.text("#result"))
        self.assertEqual(self.page.complaints(), [])

    def test_two_tabs(self):
        """One edits the vertex shader, the other the fragment shader: both have both."""
        first = self.page.new_tab()
        self.open(mistakes.NAMES[5])
        second = self.page.tab
        try:
            self.put({"lab05.frag": SOLUTION["lab05.frag"]})
            self.page.show_tab(first)
            self.put({"lab05.vert": SOLUTION["lab05.vert"]})
            for session in (first, second):
                self.page.show_tab(session)
                self.page.click(".apply")
                self.page.wait("parseFloat(document.getElementById('compared').textContent.split(': ')[1]) < 1")
        finally:
            self.page.show_tab(second)
            self.page.close_tab(first)

    def test_labs_with_c(self):
        self.open(mistakes.NAMES[3])
        self.assertIn("does not compile", self.text("[aria-labelledby=check-heading]"))
        self.assertFalse(self.page.run("!!document.getElementById('check')"))
        self.assertIn("lab_matrices", self.page.run("document.querySelector('.source').value"))
        self.put({"matrices.c": "mine"})
        self.page.wait("document.querySelector('.said').textContent.includes('compiles no C')")
        self.page.click(".revert")
        self.open(mistakes.NAMES[10])
        self.put(mistakes.read(10))
        self.page.wait("parseFloat(document.getElementById('compared').textContent.split(': ')[1]) < 1.3")
        self.finish()
        self.assertIn("right, 10 of 10 points", self.text("#result"))
        budget = mistakes.read(10)["budget.c"]
        for text, message in ((budget.replace("112", "56 * 2"), "reads lines like"), (budget.replace("112", "1"), "3 to 512"),
                              ("#define X\n" + budget, "reads lines like"), ("int" + budget, "reads lines like")):
            self.put({"budget.c": text})
            self.page.wait(f"document.querySelector('#editor').textContent.includes({json.dumps(message)})")
        self.page.click(".revert")

    def test_a_lost_context_comes_back(self):
        before = self.pixels("drawn")
        self.page.run("document.getElementById('drawn').width = 1")
        self.page.run("LabWorker.lose()")
        self.page.wait("document.getElementById('drawn').width === 400")
        self.assertTrue(self.pixels("drawn") == before)

    def test_time(self):
        self.open(mistakes.NAMES[1])
        before = self.pixels("expected")
        self.page.run("document.getElementById('time').select()")
        self.page.type("3.5")
        self.page.key("Tab")
        self.page.wait("Lab.lab.seconds === 3.5 && document.getElementById('compared').textContent")
        self.assertTrue(self.pixels("expected") != before)

    def test_storage(self):
        for value in ("null", "[]", '{"lab05_per_fragment": 5}', '{"lab05_per_fragment": {"verdict": "<b>", "points": "x"}}'):
            self.page.run(f"localStorage.setItem('lighting labs', {json.dumps(value)})")
            self.page.open(pathlib.Path(SITE, "labs.html").as_uri())
            self.assertEqual(self.text("[data-lab=lab05_per_fragment]"), "")
            self.assertEqual(self.page.complaints(), [])
        with self.page.before("""
            Object.defineProperty(window, "localStorage", {get() { throw new DOMException("blocked"); }});"""):
            self.open(mistakes.NAMES[1])
            self.put({"lab01.frag": "x"})
            self.page.wait("document.querySelector('.said').textContent.includes('keeps nothing')")

    def test_a_browser_without_webgl(self):
        with self.page.before("""
            window.OffscreenCanvas = undefined; window.Worker = class { constructor() { throw "no workers"; } };"""):
            self.page.open(pathlib.Path(SITE, "lab01_diffuse.html").as_uri(),
                           "document.getElementById('error').textContent")
            self.assertIn("This page cannot run: no workers", self.text("#error"))
