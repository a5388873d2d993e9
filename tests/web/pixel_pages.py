"""A pixel of a page's picture, pointed at as a person would: the same as natively with --probe and --show."""
import base64
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile

from pages import EXAMPLES, IN_FIREFOX, SOURCE, Case

CALCULATED = "document.getElementById('pixel') && document.getElementById('pixel').dataset.milliseconds"
# Red, green, blue of a canvas or picture.
BYTES = """window.bytes = (drawn) => {
    const canvas = document.createElement("canvas");
    canvas.width = drawn.width;
    canvas.height = drawn.height;
    canvas.getContext("2d").drawImage(drawn, 0, 0);
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let text = "";
    for (let i = 0; i < data.length; i += 4)
        text += String.fromCharCode(data[i], data[i + 1], data[i + 2]);
    return btoa(text);
}; 0"""
NATIVE = """new Promise(done => {
    const picture = new Image();
    picture.onload = () => done(bytes(picture));
    picture.src = "data:image/png;base64,%s";
})"""
ROWS = """[...document.querySelectorAll(".trail tr:not(.ran)")].slice(1).map(row => [...row.cells].map(cell => cell.textContent))"""


class Three:
    """Red, green and blue; a number is the same in all."""

    def __init__(self, *values):
        self.values = values

    def each(self, other, operation):
        return Three(*(operation(a, b) for a, b in zip(self.values, other.values if isinstance(other, Three) else (other,) * 3)))

    def __mul__(self, other):
        return self.each(other, lambda a, b: a * b)

    def __add__(self, other):
        return self.each(other, lambda a, b: a + b)

    __rmul__, __radd__ = __mul__, __add__


class Pixels(Case):
    def native(self, *more):
        """What the command of the page says, with more options."""
        words = shlex.split(self.text("#command"))
        return subprocess.run([os.path.join(EXAMPLES, words[1]), *words[2:], *more], check=True, capture_output=True)

    def at(self, pixel, canvas="#picture"):
        """The pixel's middle in the window."""
        return self.page.run(f"""(() => {{
            const canvas = document.querySelector({json.dumps(canvas)});
            canvas.scrollIntoView({{block: "center"}});
            const box = canvas.getBoundingClientRect();
            return [box.left + ({pixel[0]} + 0.5) / canvas.width * box.width,
                    box.top + ({pixel[1]} + 0.5) / canvas.height * box.height];
        }})()""")

    def explained(self):
        """Whether the pixel that is explained is told of, once more."""
        self.page.wait(CALCULATED)
        self.page.wait("document.getElementById('pixel-values').options.length > 3")

    def point(self, pixel, finger=False, canvas="#picture"):
        x, y = self.at(pixel, canvas)
        self.page.run("delete document.getElementById('pixel')?.dataset.milliseconds")
        if finger:
            self.page.touch("touchStart", (x, y))
            self.page.touch("touchEnd")
        else:
            self.page.mouse("mousePressed", x, y)
            self.page.mouse("mouseReleased", x, y)
        self.explained()

    def assert_told(self, pixel, more=()):
        """The page tells what --probe does, and shows each assignment, the verdict and the vertices."""
        natively = json.loads(self.native("--probe", "%d,%d" % pixel, "--format", "json", *more).stdout)
        self.assertEqual(self.page.run("Pixel.said()"), natively)
        rows = self.page.run(ROWS)
        self.assertEqual([row[0] for row in rows], [row["name"] for row in natively.get("assignments", [])])
        for row, said in zip(rows, natively.get("assignments", [])):
            for text, column in zip(row[1:], ("driver", "exact")):
                for shown, value in zip(text.split(", "), said[column]):
                    self.assertAlmostEqual(float(shown), value, delta=1e-6 * abs(value))  # 7 digits are shown
        if "verdict" in natively:
            self.assertIn(natively["verdict"]["text"], self.text(".verdict"))
        line = self.text("#pixel-line")
        self.assertTrue(line.startswith("%d,%d: " % pixel + ", ".join(str(round(255 * x)) for x in natively["drawn"])), line)
        return natively

    def test_a_scene(self):
        """The object, the equation and its directions are there, too."""
        for name, link, pixel in (("PhongBlinn", "precision=mediump", (80, 90)), ("PhongBlinn", "size=600x200&time=1.3&orbit=30,20,0.9", (290, 95)),
                                  ("Shadows", "", (200, 250)), ("FourLights", "reflection=phong", (190, 180)), ("SpotLight", "", (200, 190))):
            with self.subTest(name, link=link):
                self.open(name, link)
                self.point(pixel)
                told = self.assert_told(pixel)
                self.assertIn(told["equation"], self.page.run("document.querySelector('#pixel pre').textContent"))
                self.assertIn(told["object"], self.text("#pixel-line"))
                labels = self.page.run("[...document.querySelectorAll('#directions text')].map(text => text.textContent)")
                self.assertEqual(labels, [row["name"] for row in told["directions"]])
                self.assertTrue({"N", "V", "L0"} <= set(labels))
                self.assertEqual(self.page.complaints(), [])

    def test_a_lecture_program_with_its_edited_text(self):
        self.open("PointLightedSphere_perFragment")
        self.point((260, 120))
        told = self.assert_told((260, 120))
        self.assertNotIn("object", told)
        self.assertIn("diffuse = (0.8, 0.8, 0.8) * (1, 1, 1) * 0.9868", self.text(".trail"))  # the lecture's light and colour
        # A click on a line goes to it.
        self.page.run("[...document.querySelectorAll('.place')].find(button => button.textContent === 'line 18').click()")
        field = self.page.run("""(() => { const {value, selectionStart, selectionEnd} = document.activeElement;
                                          return value.slice(selectionStart, selectionEnd); })()""")
        self.assertIn("nDotL = max(dot(lightDirection, normal), 0.0)", field)
        # The text that is drawn now is what is explained.
        self.page.run("delete document.getElementById('pixel').dataset.milliseconds")
        self.edit("dot(lightDirection, normal)", "0.5 * dot(lightDirection, normal)")
        self.explained()
        self.page.wait("Pixel.said().assignments.some(({source}) => source.includes('0.5 * dot'))")
        shader = "PointLightedSphere_perFragment.frag"
        text = pathlib.Path(SOURCE, "shaders/lecture", shader).read_text()
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, shader).write_text(text.replace("dot(lightDirection, normal)", "0.5 * dot(lightDirection, normal)"))
            command = self.text("#command")
            self.assertIn("--shaders mine", command)
            words = shlex.split(command.replace("--shaders mine", "--shaders " + folder))
            done = subprocess.run([os.path.join(EXAMPLES, words[1]), *words[2:], "--probe", "260,120", "--format", "json"], check=True,
                                  capture_output=True)
        self.assertEqual(self.page.run("Pixel.said()"), json.loads(done.stdout))
        self.page.run("localStorage.clear()")

    def test_a_value_over_the_picture(self):
        for name, link, pixel, values in (("PointLightedSphere_perFragment", "size=200x150", (120, 60), ("nDotL", "normal", "error", "blame")),
                                          ("PhongBlinn", "size=300x100&precision=mediump", (40, 45), ("n_dot_l", "error:n_dot_l"))):
            self.open(name, link)
            self.point(pixel)
            self.page.run(BYTES)
            for value in values:
                self.page.run(f"""(() => {{
                    const list = document.getElementById("pixel-values");
                    list.value = {json.dumps(value)};
                    list.dispatchEvent(new Event("change"));
                }})()""")
                self.page.wait(f"/^{value}: (?!is computed)/.test(document.getElementById('legend').textContent)")
                with self.subTest(name, value=value):
                    done = self.native("--show", value, "-o", "-")
                    shown = self.page.run("bytes(document.getElementById('shown'))")
                    self.assertEqual(*(base64.b64decode(data) for data in (shown, self.page.run(NATIVE % base64.b64encode(done.stdout).decode()))))
                    self.assertEqual(self.text("#legend"), done.stderr.decode().strip())

    def test_a_lab(self):
        """A student's own text: the values are those of the lab's program, and the exact picture is the lab's."""
        shaders = {name: pathlib.Path(SOURCE, "shaders/labs/solutions", name).read_text() for name in
                   ("lab06_phong/lab06.vert", "lab06_phong/lab06.frag")}
        mine = {pathlib.Path(name).name: text.replace("* nDotL;", "* nDotL * 0.5;") for name, text in shaders.items()}
        for lab, texts, pixel in (("lab06_phong", mine, (190, 150)), ("lab11_shadow_map", {}, (150, 300)), ("lab10_budget", {}, (190, 150))):
            with self.subTest(lab), tempfile.TemporaryDirectory() as folder:
                self.open(lab)
                for name, text in texts.items():
                    pathlib.Path(folder, name).write_text(text)
                self.page.run(f"Lab.lab.texts = new Map({json.dumps(list(texts.items()))}); Lab.draw(true)")
                self.point(pixel, canvas="#drawn")
                said = self.page.run("Pixel.said()")
                options = ["--shaders", folder] if texts else []
                done = subprocess.run([os.path.join(EXAMPLES, lab), *options, "-t", "1", "--probe", "%d,%d" % pixel, "--format", "json"],
                                      check=True, capture_output=True)
                natively = json.loads(done.stdout)
                for part in ("column", "row", "drawn", "computed", "exact", "assignments", "vertices", "remarks"):
                    self.assertEqual(said.get(part), natively.get(part), part)
                self.assertRegex(said["object"], "^object ")
                self.assertIn("L0", [row["name"] for row in said["directions"]])
                self.assertIn("light 0", said["equation"])
                if texts:
                    self.assertGreater(said["verdict"]["formula"], 2)
                    shown = self.page.run(BYTES + """
                        const list = document.getElementById("pixel-values");
                        list.value = "nDotL";
                        list.dispatchEvent(new Event("change"));""")
                    self.page.wait("/^nDotL: (?!is computed)/.test(document.getElementById('legend').textContent)")
                    done = subprocess.run([os.path.join(EXAMPLES, lab), *options, "-t", "1", "--show", "nDotL", "-o", "-"], check=True,
                                          capture_output=True)
                    shown = self.page.run("bytes(document.getElementById('shown'))")
                    self.assertEqual(*(base64.b64decode(data) for data in
                                       (shown, self.page.run(NATIVE % base64.b64encode(done.stdout).decode()))))
                self.assertEqual(self.page.complaints(), [])

    def test_figures_of_the_book(self):
        """Each as its command; the plain formula by its own text; one pixel is open at a time."""
        self.page.resize(1000, 12000)
        self.open("chapter20")
        self.page.wait("Book.book.figures.every(({drawn}) => drawn)")
        self.assertEqual([asked for asked in self.page.requests() if "probe" in asked], [])
        formula = self.page.run("Book.book.figures.findIndex(({ways}) => ways)")
        where = "#" + self.page.run(f"Book.book.figures[{formula}].where.id")
        for way in (0, 1):
            self.point((100, 60), canvas=f"{where} .way:nth-child({way + 1}) canvas")
            name, *words = self.page.run(f"Book.book.figures[{formula}].lines({way})")
            texts = self.page.run(f"[...({'new Map()' if way else f'Book.book.figures[{formula}].plain'})]")
            with tempfile.TemporaryDirectory() as folder:
                for file, text in texts:
                    pathlib.Path(folder, file).parent.mkdir(exist_ok=True)
                    pathlib.Path(folder, file).write_text(text, encoding="utf-8")
                self.assert_figure(name, [*words, *(["--shaders", folder] if texts else [])], (100, 60))
        self.assertEqual(self.page.run("document.querySelectorAll('#pixel').length"), 1)
        self.open("chapter12")
        self.page.wait("Book.book.figures.every(({drawn}) => drawn)")
        live = self.page.run("Book.book.figures.findIndex(({name}) => name === 'PointLightedCube_animation')")
        where = "#" + self.page.run(f"Book.book.figures[{live}].where.id")
        self.point((200, 200), canvas=where + " canvas")
        words = shlex.split(self.text(where + " .command"))
        self.assert_figure(words[1], words[2:], (200, 200))
        self.assertTrue(self.text(where + " .read").startswith("200,200: "))
        # Another moment: the same place of the new picture.
        self.page.run("delete document.getElementById('pixel').dataset.milliseconds")
        self.page.run(f"Book.book.figures[{live}].seconds = 2; Book.schedule()")
        self.explained()
        self.assert_figure(words[1], ["--time", "2"], (200, 200))
        self.assertEqual(self.page.complaints(), [])

    def test_formulas_of_the_book(self):
        """Below each the pixel's numbers, which give what stands after the last equals sign; nothing where the figure has none."""
        self.page.resize(1000, 12000)
        asked = ((7, 0, (200, 230), 1), (8, 0, (200, 170), 1), (11, 0, (200, 111), 1), (12, 0, (200, 111), 1), (13, 0, (60, 60), 2),
                 (13, 1, (205, 150), 2), (14, 0, (380, 120), 1), (15, 0, (140, 150), 1), (15, 1, (70, 106), 1), (17, 0, (100, 200), 0), (17, 3, (80, 430), 1))
        for chapter, figure, pixel, count in asked:
            with self.subTest(chapter=chapter, figure=figure):
                self.open(f"chapter{chapter:02}")
                self.page.wait("Book.book.figures.every(({drawn}) => drawn)")
                where = "#" + self.page.run(f"Book.book.figures[{figure}].where.id")
                self.assertEqual(self.filled(), [])
                self.point(pixel, canvas=where + " canvas")
                words = shlex.split(self.text(where + " .command"))
                self.assert_figure(words[1], words[2:], pixel)
                filled = self.filled()
                self.assertEqual(len(filled), count)
                self.assertEqual(self.page.run("document.querySelectorAll('#pixel-said p + .at').length"), count)
                for first, *lines in filled:
                    self.assertTrue(first.endswith(f", pixel {pixel[0]}, {pixel[1]}:") and lines, first)
                    for line in lines:
                        self.assert_sum(line)
                self.page.run("document.querySelector('#pixel button').click()")
                self.assertEqual(self.filled(), [])

    def filled(self):
        """The lines below each formula, powers as **."""
        return self.page.run("""[...document.querySelectorAll("[data-at]:not([hidden])")].map(part => [...part.children].map(line =>
            line.innerHTML.replace(/<sup>(.*?)<.sup>/g, "**$1").replace(/<.*?>/g, "")))""")

    def assert_sum(self, line):
        """Three digits are shown of each number."""
        found = re.search(r"(?:I[sd]?|C · [(]N·L[)]|x) = ([^=]*) = ([^=:]*?)(?:, where.*|:.*)?$", line)
        if not found:
            return
        sides = [eval(re.sub(r"[(]([^()]*,[^()]*)[)]", r"Three(\1)", side.replace("−", "-").replace("·", "*")), {"Three": Three})
                 for side in found.groups()]
        for one, other in zip(*(side.values if isinstance(side, Three) else (side,) * 3 for side in sides)):
            self.assertAlmostEqual(one, other, delta=0.02 + 0.02 * abs(other), msg=line)

    def assert_figure(self, name, words, pixel):
        done = subprocess.run([os.path.join(EXAMPLES, name), *words, "--probe", "%d,%d" % pixel, "--format", "json"], check=True,
                              capture_output=True)
        self.assertEqual(self.page.run("Pixel.said()"), json.loads(done.stdout))

    def test_a_borrowed_device(self):
        """What is measured is in a link and a code; a page and a program draw as that device would."""
        self.open("precision")
        measured = self.text("#whose").split(": ", 1)[1]
        mediump = "24,-126,127" if IN_FIREFOX else "11,-14,15,kept"  # desktop OpenGL has none
        self.assertEqual(measured, f"llvmpipe;highp=24,-126,127;mediump={mediump}")
        self.assertTrue(self.text("#link").endswith("precision.html#" + measured))
        half = "highp=24,-126,127;mediump=9,-14,15"
        self.open("precision", half)
        self.assertIn("whose link this is: " + half, self.text("#whose"))
        if shutil.which("zbarimg"):
            self.page.run("document.getElementById('code').scrollIntoView()")
            with tempfile.NamedTemporaryFile(suffix=".png") as file:
                self.page.screenshot(file.name, whole=False)
                done = subprocess.run(["zbarimg", "-q", "--raw", file.name], capture_output=True, text=True)
            self.assertEqual(done.stdout.strip(), half)
        command = shlex.split(self.text("#command"))
        self.assertEqual(command[-4:-2], ["--arithmetic", half])
        link = self.page.run("document.getElementById('link').href")
        self.page.run(BYTES)
        drawn = []
        for device in (link, half):
            png = subprocess.run([os.path.join(EXAMPLES, "PhongBlinn"), "--precision", "mediump", "--arithmetic", device, "-o", "-"],
                                 check=True, capture_output=True).stdout
            drawn.append(self.page.run(NATIVE % base64.b64encode(png).decode()))
        self.assertEqual(*drawn)
        self.page.open(self.page.run("document.getElementById('as').href"))
        self.explained()
        self.page.wait("/ computes it\\.$/.test(document.getElementById('legend').textContent)")
        self.page.run(BYTES)
        self.assertEqual(self.page.run("bytes(document.getElementById('shown'))"), drawn[0])
        # Another one, and what is none.
        self.page.run("""(() => {
            const as = document.getElementById("pixel-as");
            as.value = "nonsense";
            as.dispatchEvent(new Event("change"));
        })()""")
        self.page.wait("/nonsense/.test(document.getElementById('pixel-said').textContent)")
        self.open("precision", "highp=<b>")
        self.assertIn("holds no device's numbers", self.text("#error"))
        self.assertEqual(self.page.complaints(), [])

    def test_keys_and_a_finger(self):
        self.open("Materials", "shape=sphere")
        self.page.run("document.getElementById('picture').focus()")
        self.page.key("Enter")
        self.page.wait("document.querySelector('#directions .cross') !== null")
        self.assertEqual(self.page.run("document.getElementById('pixel-line').ariaLive"), "polite")
        self.page.key("ArrowRight")
        self.page.key("ArrowUp", 8)  # Shift
        width, height = self.page.run("[document.getElementById('picture').width, document.getElementById('picture').height]")
        pixel = (width // 2 + 1, height // 2 - 10)
        self.page.key("Enter")
        self.explained()
        self.assert_told(pixel)
        self.assertEqual(self.page.run("document.activeElement.id"), "pixel-title")
        self.page.click("#pixel button")
        self.assertTrue(self.page.run("document.getElementById('pixel').hidden && document.activeElement.id === 'picture'"))
        self.page.key("Escape")  # then the arrows are the camera's again
        self.page.key("ArrowRight")
        self.settle()
        self.assertIn("--orbit", self.text("#command"))
        self.page.resize(360, 740)
        self.point((90, 90), finger=True)
        self.assert_told((90, 90))
        self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), 360)

    def test_one_file_and_what_is_refused(self):
        self.open("single/LightedCube")
        self.point((200, 200))
        self.assert_told((200, 200))
        self.assertEqual([asked for asked in self.page.requests() if "probe" in asked], [])
        self.open("FourLights", "samples=4")
        x, y = self.at((100, 100))
        self.page.mouse("mousePressed", x, y)
        self.page.mouse("mouseReleased", x, y)
        self.page.wait(CALCULATED)
        self.assertIn("several samples", self.text("#pixel-said"))
