"""A pixel of a page's picture, pointed at as a person would: the same as natively with --probe and --show."""
import base64
import json
import os
import pathlib
import shlex
import subprocess
import tempfile

from pages import EXAMPLES, SOURCE, Case

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


class Pixels(Case):
    def native(self, *more):
        """What the command of the page says, with more options."""
        words = shlex.split(self.text("#command"))
        return subprocess.run([os.path.join(EXAMPLES, words[1]), *words[2:], *more], check=True, capture_output=True)

    def at(self, pixel):
        """The pixel's middle in the window."""
        return self.page.run(f"""(() => {{
            const canvas = document.getElementById("picture");
            canvas.scrollIntoView({{block: "center"}});
            const box = canvas.getBoundingClientRect();
            return [box.left + ({pixel[0]} + 0.5) / canvas.width * box.width,
                    box.top + ({pixel[1]} + 0.5) / canvas.height * box.height];
        }})()""")

    def explained(self):
        """Whether the pixel that is explained is told of, once more."""
        self.page.wait(CALCULATED)
        self.page.wait("document.getElementById('pixel-values').options.length > 3")

    def point(self, pixel, finger=False):
        x, y = self.at(pixel)
        self.page.run("delete document.getElementById('pixel')?.dataset.milliseconds")
        if finger:
            self.page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
            self.page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
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
