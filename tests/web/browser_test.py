#!/usr/bin/env python3
"""The pages in a real browser: the same pictures as natively, and every control used as a person would.

usage: browser_test.py EXAMPLES_FOLDER_OF_THE_BUILD PAGE_NATIVE SOURCE_FOLDER [unittest's arguments]

Builds the pages with examples/run web. The browser is Chromium, with a selection in Firefox (firefox_pages.py); all is in
Firefox with LIGHTING_TEST_BROWSER=firefox in the environment. Exit code: 77 without emscripten or the browser; without
firefox-esr the rest is tested.
"""
import base64
import io
import json
import multiprocessing
import os
import pathlib
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.parse
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(__file__))
import browser
import sizes
import firefox_pages
from book_pages import Book
from firefox_pages import InFirefox
from labs_pages import Accessible, Corpus, Labs, Verdicts
from model_pages import Models
from pixel_pages import Pixels
from report_pages import Report
from sharing_pages import Sharing, Working
from pages import CONFIRM, EXAMPLES, IN_FIREFOX, LONG, RENDERER, SITE, SOURCE, Case, address, differences, make, native, part

# Draws by a module of its own: no page in between.
HARNESS = """(async () => {
    window.own = await Engine.open(Page.page.compiled, document.createElement("canvas"));
    window.rgb = (lines) => {
        const code = own.run(lines), values = code ? {} : own.json("values");
        const [a, e, d] = (values.orbit || "0,0").split(",").map(Number);
        if (code || !own.draw(Number(values.time), [a, e, d || 1]))
            return "! " + own.message;
        const {data} = own.picture();
        let text = "";
        for (let i = 0; i < data.length; i += 4)
            text += String.fromCharCode(data[i], data[i + 1], data[i + 2]);
        return btoa(text);
    };
})()"""
MOMENTS = [["--time=0"], ["--time=1.3"], ["--time=7.25"]]
OPTIONS = [["--samples=4"], ["--precision=highp"], ["--precision=mediump"], ["--orbit=30,20,0.9"], ["--size=257x131"]]
OF_SCENES = [["--linear-light"], ["--full"], ["--clamp=vertex"], ["--terms=diffuse"], ["--clamp-dots=off"]]
OF_ONE = {"Shadows": [["--shadows=map"], ["--shadows=volumes", "--sheet=on"]],
          "SpotLight": [["--shadows=volumes"], ["--shadows=volumes", "--samples=4"], ["--light-color=0,0.2,1,0.5"]]}
# Its axes are two pixels wide where each pixel is the mean of four. Firefox has lines of one alone (ALIASED_LINE_WIDTH_RANGE): three
# of some 130 pixels, half as thick.
THIN_LINES = OF_ONE["SpotLight"][1]


def decode_png(data):
    """Of those that a page saves: rows of filter 0."""
    chunks, at = {}, 8
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        chunks[name] = chunks.get(name, b"") + data[at + 8:at + 8 + size]
        at += 12 + size
    width, height, _, kind = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
    channels = {2: 3, 6: 4}[kind]
    rows = zlib.decompress(chunks[b"IDAT"])
    row = 1 + channels * width
    return chunks, b"".join(rows[y * row + 1:(y + 1) * row] for y in range(height))


class Parity(Case):
    def test_every_program_draws_what_it_draws_natively(self):
        self.open("LightedCube")
        self.assertIn("llvmpipe", self.page.run(RENDERER))
        programs = self.programs()
        self.page.run(HARNESS)
        count = 0
        for program in programs:
            cases = MOMENTS + OPTIONS + (OF_SCENES if program["scene"] else []) + OF_ONE.get(program["name"], [])
            for arguments in part(cases + [self.joined(words["arguments"]) for words in program["tries"]], count):
                if "--costs=time" in arguments:  # which differs from run to run
                    continue
                drawn = self.page.run(f"rgb({json.dumps([program['name'], *arguments])})")
                with self.subTest(program["name"], arguments=arguments):
                    self.assertNotIn("!", drawn[:1])
                    bytes_apart, more = differences(base64.b64decode(drawn), native(program["name"], arguments))
                    if arguments == THIN_LINES and IN_FIREFOX:
                        self.assertTrue(0 < bytes_apart <= 3 * 400, bytes_apart)
                    else:
                        self.assertEqual((bytes_apart, more), (0, 0))
                count += 1
        self.assertGreater(count, 200 // LONG)

    def test_what_is_refused_is_refused_natively(self):
        """With the same first line; where the words are the compiler's, they name the same line."""
        name = "lecture/LightedCube.frag"
        text = pathlib.Path(SOURCE, "shaders", name).read_text()
        self.open("LightedCube")
        self.page.run(HARNESS)
        for words, wrong in (("999999", "/" * 1000000), ("byte 0x00", text + "\0"), ("is empty", "\n"),
                             ("itself", text + '#include "LightedCube.frag"\n'), ("#version", "\n#version 300 es\n" + text),
                             ("no such shader file", text + '#include "none.glsl"\n'), ("", "#if 1\n" + text),
                             ("", text + "#endif\n"), ("", text + "\n#error here\n")):
            with self.subTest(words, end=wrong[-40:]), tempfile.TemporaryDirectory() as folder:
                pathlib.Path(folder, "LightedCube.frag").write_text(wrong)
                done = subprocess.run([os.path.join(EXAMPLES, "LightedCube"), "--shaders", folder, "-o", "-"],
                                      stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                natively = done.stderr.split("\n")[0].replace("LightedCube: ", "").replace(folder, "lecture")
                drawn = self.page.run(f"own.replace(new Map([[{json.dumps(name)}, {json.dumps(wrong)}]])) "
                                      "? rgb(['LightedCube']) : '! ' + own.message")
                here = drawn[2:].replace("/tmp/shaders/", "").split("\n")[0]
                self.assertEqual((done.returncode, drawn[:2]), (1, "! "))
                self.assertIn(words, here)
                self.assertEqual(here if words else here.split(": ")[0], natively if words else natively.split(": ")[0])

    @staticmethod
    def joined(words):
        """"--a 1 --b" as arguments of a link."""
        arguments = []
        for word in words.split():
            if word.startswith("--"):
                arguments.append(word)
            else:
                arguments[-1] += "=" + word
        return arguments

    def test_the_exact_picture_has_the_same_bits(self):
        self.open("LightedCube")
        self.assert_exact_bits(part((program["name"] for program in self.programs() if program["scene"]), 1))


def far_from_edges(one, other, width):
    """How many pixels differ by more than one step, of those whose neighbours in `other` are all within 4 steps."""
    def apart(a, i, b, k):
        return max(abs(a[i + c] - b[k + c]) for c in range(3))

    count, height = 0, len(other) // 3 // width
    for i in range(0, len(other), 3):
        if one[i:i + 3] == other[i:i + 3] or apart(one, i, other, i) <= 1:
            continue
        x, y = i // 3 % width, i // 3 // width
        around = [3 * (v * width + u) for v in range(max(0, y - 1), min(height, y + 2))
                  for u in range(max(0, x - 1), min(width, x + 2))]
        count += all(apart(other, i, other, k) <= 4 for k in around)
    return count


@unittest.skipIf(IN_FIREFOX, "Chromium alone has SwiftShader")
class SwiftShader(Case):
    """Another renderer: in highp at most one step off, edges apart."""
    options = browser.SWIFTSHADER

    def test_other_renderers_differ_by_a_step(self):
        self.open("LightedCube")
        self.assertIn("SwiftShader", self.page.run(RENDERER))
        programs = self.programs()
        self.page.run(HARNESS)
        for program in part(programs):
            name, arguments = program["name"], ["--precision=highp", "--time=1.3"]
            if name == "PhongBlinn":  # else its difference of two pictures is drawn eight times as bright
                arguments.append("--gain=1")
            drawn = base64.b64decode(self.page.run(f"rgb({json.dumps([name, *arguments])})"))
            width = int(self.page.run("own.json('values').size").split("x")[0])
            expected = native(name, arguments)
            with self.subTest(name):
                self.assertLess(differences(drawn, expected)[1] / len(drawn), 0.004)
                self.assertLessEqual(far_from_edges(drawn, expected, width), 4)  # at faint edges


# The texts of LightedCube that the browser keeps; the labs keep theirs in the same place.
KEPT = "Object.keys(localStorage).filter(key => key.startsWith('lighting LightedCube')).length"


class Pages(Case):
    def test_controls_change_the_picture_and_its_command(self):
        self.open("Materials")
        before = self.shown()
        self.page.run("document.getElementById('option-shininess').value = ''")
        self.page.click("#option-shininess")
        self.page.type("90")
        self.page.run("""(() => {
            const select = document.getElementById("option-material");
            select.value = "gold";
            select.dispatchEvent(new Event("input", {bubbles: true}));
        })()""")
        self.assert_native()
        self.assertEqual(self.text("#command"), "examples/run Materials --material gold --shininess 90")
        self.assertNotEqual(self.shown(), before)
        # What follows from another option is shown.
        self.assertNotEqual(self.page.run("document.getElementById('option-diffuse').value"), "0.6")
        self.page.click("#options summary")
        self.page.click("#option-show-clipped")
        self.settle()
        self.assertIn("--show-clipped", self.text("#command"))
        link = self.page.run("location.href")
        shown = self.shown()
        self.page.open(link)
        self.assertEqual(self.shown(), shown)
        self.assert_native()
        self.page.click("#default")
        self.settle()
        self.assertEqual(self.shown(), before)

    def test_a_wrong_value_is_said_and_changes_nothing(self):
        self.open("Materials")
        before = self.shown()
        self.page.run("document.getElementById('option-shininess').value = ''")
        self.page.click("#option-shininess")
        self.page.type("1000")
        self.settle()
        self.assertRegex(self.text("#error"), "^--shininess 1000: must be .*128")
        self.assertEqual(self.page.run("document.getElementById('option-shininess').getAttribute('aria-invalid')"), "true")
        self.assertEqual(self.shown(), before)

    def test_a_refused_link_changes_neither_time_nor_camera(self):
        self.open("Materials", "time=2&orbit=10,20")
        before = self.shown()
        state = "JSON.stringify([Page.page.seconds, Page.page.orbit, [...Page.page.values]])"
        good = self.page.run(state)
        for link in ("time=abc", "orbit=60,40&bogus=1", "time=5&material=bogus"):
            self.page.run(f"location.hash = {json.dumps(link)}")
            self.page.wait("document.getElementById('error').textContent")
            self.assertEqual(self.page.run(state), good, link)
            self.assertEqual(self.page.run("location.hash"), "#time=2&orbit=10,20,1,0")
            self.page.run("document.getElementById('error').textContent = ''")
        self.page.run("""(() => {
            const field = document.getElementById("option-orbit");
            field.value = "0,0,-1";
            field.dispatchEvent(new Event("input"));
        })()""")
        self.assertIn("--orbit 0,0,-1", self.text("#error"))
        self.assertEqual(self.page.run(state), good)
        self.page.click("#forward")
        self.page.click("#back")
        self.settle()
        self.assertEqual(self.shown(), before)

    def test_a_refused_link_is_not_in_the_address_bar(self):
        for link in ("material=gold&bogus=1", "time=5&shininess=1000", "orbit=10,20&=1", "alpha=5"):
            self.open("Materials", link)
            self.assertTrue(self.text("#error"))
            self.assertEqual(self.page.run("[location.hash, Page.page.seconds, String(Page.page.orbit)]"), ["", 0, "0,0,1,0"])
            self.assert_native()

    def test_link_command_and_picture_are_one(self):
        """Whatever time and camera came from."""
        def one(what):
            self.assert_native()
            shown = self.shown()
            link = self.page.run("location.href")
            self.page.open(link)
            self.assertEqual(self.shown(), shown, (what, link))
            self.assert_native()
        self.open("FourLights", "time=1.23456789&orbit=12.3456789,-7.654321,0.987654321,3.14159265")
        one("a link")
        self.open("FourLights")
        self.page.click("#play")
        self.page.wait("Page.page.seconds > 0.3")
        self.page.click("#play")
        one("playing")
        self.page.run("document.getElementById('picture').focus()")
        for script in ("Page.page.orbit[2]", "Page.page.orbit[2]"):
            for key in ("ArrowRight", "+", "+", "+"):
                self.page.key(key)
            self.page.drag("#picture", 7, 3)
            one("the camera")
            self.assertNotEqual(self.page.run(script), 1)
            self.page.run("document.getElementById('picture').focus()")
        self.page.run("""(canvas => { canvas.focus(); canvas.dispatchEvent(new WheelEvent("wheel", {deltaY: 37})); })(
            document.getElementById("picture"))""")
        one("the wheel")
        self.page.run("document.getElementById('time').value = ''")
        self.page.click("#time")
        self.page.type("2.71828182845")
        self.page.key("Tab")
        one("a time that was typed")

    def test_options_that_are_unset_leave_nothing(self):
        """Each control of each page, set and unset by itself, and all of them by Default options."""
        set_and_unset = """(() => {
            const canvas = document.getElementById("picture"), wrong = [];
            const shown = () => new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height)
                .data.buffer).reduce((hash, pixel) => Math.imul(hash ^ pixel, 16777619), canvas.width);
            const put = (input, value) => {
                input[input.type === "checkbox" ? "checked" : "value"] = value;
                input.dispatchEvent(new Event("input"));
            };
            const standard = shown(), small = () => Page.start(new Map([["size", "60x40"]]));
            small();
            const fresh = shown();
            let count = 0;
            for (const {name, kind, choices, min, max, value} of Page.page.program.options) {
                const input = document.getElementById("option-" + name);
                if (!input || name === "size")
                    continue;
                const others = kind === "flag" ? [true] : choices.length ? choices.filter(one => one !== value).slice(0, 3) :
                    kind === "color" ? ["0.9,0.1,0.3", "0,1,2,3"] : min !== undefined ? [min, Math.min(max, min + 37)] :
                    ["1", "0,1,2,3"];
                for (const other of others) {
                    const none = kind === "flag" ? false : choices.length && kind !== "text" ? value : "";
                    const same = (picture, what) => shown() === picture || wrong.push([name, other, what].join(" "));
                    put(input, other);
                    const refused = document.getElementById("error").textContent, set = shown();
                    put(input, none);
                    if (name !== "angle") /* which has become the time */
                        same(fresh, "unset");
                    if (refused)
                        continue;
                    count++;
                    put(input, other);
                    same(set, "again");
                    document.getElementById("default").click();
                    same(standard, "Default options");
                    if (Page.page.noted !== "")
                        wrong.push(Page.page.noted);
                    small();
                }
            }
            return {wrong, count};
        })()"""
        self.open("LightedCube")
        count = 0
        for program in part(self.programs()):
            self.open(program["name"])
            with self.subTest(program["name"]):
                found = self.page.run(set_and_unset)
                self.assertEqual(found["wrong"], [])
                # A browser takes some links a second.
                self.page.wait("location.hash === '#size=60x40'")
                count += found["count"]
        self.assertGreater(count, 350 if LONG == 1 else 40)

    def test_the_camera_by_mouse_touch_and_keys(self):
        self.open("FourLights")
        before = self.shown()
        self.page.drag("#picture", 60, 20)
        self.assert_native()
        self.assertRegex(self.text("#command"), "--orbit=-30,10")
        self.page.click("#reset")
        self.settle()
        self.assertEqual(self.shown(), before)
        self.page.run("document.getElementById('picture').focus()")
        for key in ("ArrowRight", "ArrowUp", "+"):
            self.page.key(key)
        self.assert_native()
        self.assertIn("--orbit 10,10,0.909", self.text("#command"))
        self.page.key("Home")
        self.settle()
        self.assertEqual(self.shown(), before)
        x, y = self.page.place("#picture")
        for kind, points in (("touchStart", [[0, 0]]), ("touchMove", [[40, 0]]), ("touchEnd", [])):
            self.page.touch(kind, *((x + dx, y + dy) for dx, dy in points))
        self.assert_native()
        self.assertIn("--orbit=-20,0", self.text("#command"))
        for kind, points in (("touchStart", [[-20, 0], [20, 0]]), ("touchMove", [[-40, 0], [40, 0]]), ("touchEnd", [])):
            self.page.touch(kind, *((x + dx, y + dy) for dx, dy in points))
        self.assert_native()
        self.assertRegex(self.text("#command"), "--orbit=-20,0,0.5")

    def test_time(self):
        self.open("PointLightedCube_animation")
        self.page.click("#forward")
        self.assert_native()
        self.assertIn("--time 0.1", self.text("#command"))
        self.page.click("#play")
        self.page.wait("Page.page.seconds > 0.5")
        self.page.click("#play")
        self.assertEqual(self.text("#play"), "Play")
        self.assert_native()
        self.page.run("document.getElementById('time').value = ''")
        self.page.click("#time")
        self.page.type("2.5")
        self.page.key("Tab")
        self.assert_native()
        self.assertIn("--time 2.5", self.text("#command"))
        self.page.click("#play")
        self.assertEqual(self.text("#play"), "Pause")
        self.page.run("Page.page.engine.draw = () => false")
        self.page.wait("document.getElementById('play').textContent === 'Play'")

    def test_the_editor(self):
        self.open("LightedCube")
        before = self.shown()
        self.assertIn("attribute vec4 a_Position;", self.page.run("document.querySelector('.source').value"))
        self.edit("v_Color = vec4(diffuse, a_Color.a);", "v_Color = vec4(diffuse.bgr, a_Color.a);")
        self.page.wait("document.querySelector('.said').textContent.startsWith('Drawn with')")
        edited = self.shown()
        self.assertNotEqual(edited, before)
        self.assertIn("--shaders mine", self.text("#command"))
        self.edit("a_Color.a);", "a_Colour.a);")
        self.page.wait("document.querySelectorAll('.errors li').length")
        self.assertRegex(self.text(".errors li"), r"^lecture/LightedCube.vert:\d+: .*a_Colour")
        self.assertRegex(self.text(".said"), r"^Errors: \d")
        line = int(self.text(".errors li").split(":")[1])
        self.assertIn(f"✖ {line}", self.text(".gutter"))
        self.assertEqual(self.shown(), edited)
        self.page.click(".errors button")
        self.assertIn("a_Colour", self.page.run(
            "(() => { const s = document.querySelector('.source');"
            " return s.value.slice(s.selectionStart, s.selectionEnd); })()"))
        # The text outlives the page, and is not applied by itself.
        self.open("LightedCube")
        self.assertIn("a_Colour", self.page.run("document.querySelector('.source').value"))
        self.assertEqual(self.shown(), before)
        self.page.click(".revert")
        self.settle()
        self.assertEqual(self.shown(), before)
        self.assertNotIn("--shaders", self.text("#command"))
        self.assertEqual(self.page.run(KEPT), 0)
        self.assertEqual(self.page.run("asked"), ["Discard your text of lecture/LightedCube.vert?"])

    def test_the_editor_has_colours(self):
        """The same letters in the same places, above the field's own."""
        self.open("PointLightedCube_perFragment")
        for size in (1280, 360):
            self.page.resize(size, 700)
            self.edit("void main", '#define ONE 1.0 /* <b> */\nvoid main')
            said = self.page.run("""(() => {
                const field = document.querySelector(".source"), shown = document.querySelector(".colours pre");
                const style = element => ["font", "lineHeight", "padding", "letterSpacing", "tabSize", "whiteSpace"].map(
                    name => getComputedStyle(element)[name]).join();
                field.scrollTop = 30;
                field.scrollLeft = 20;
                field.dispatchEvent(new Event("scroll"));
                const a = field.getBoundingClientRect(), b = shown.getBoundingClientRect();
                const words = [...shown.children].map(span => span.className + " " + span.textContent);
                return [field.value.includes(shown.textContent), style(field) === style(shown), b.left - a.left, b.top - a.top,
                        field.scrollLeft, field.scrollTop, words];
            })()""")
            self.assertEqual(said[:2], [True, True])
            self.assertEqual(said[2:4], [-said[4], -said[5]])  # from the first line, which is above the field
            self.assertGreater(said[5], 0)
            for word in ("special #define", "number 1.0", "comment /* <b> */", "word void", "special gl_FragColor"):
                self.assertIn(word, said[6])
        # A long line has none: it is to be typed in without a pause.
        self.page.run("(field => { field.value = '/'.repeat(60000); field.dispatchEvent(new Event('input')); })"
                      "(document.querySelector('.source'))")
        self.page.wait("!document.querySelector('.colours').textContent")
        self.assertNotEqual(self.page.run("getComputedStyle(document.querySelector('.source')).webkitTextFillColor"),
                            "rgba(0, 0, 0, 0)")
        self.page.click(".revert")
        self.page.wait("document.querySelector('.colours').textContent.includes('void main')")

    def test_the_keys_of_the_editor(self):
        self.open("LightedCube")
        value, focused = "document.querySelector('.source').value", "document.activeElement.className"
        text = self.page.run(value)
        selected = """(field => field.value.slice(field.selectionStart, field.selectionEnd))(document.querySelector(".source"))"""
        # Who passes by passes.
        self.page.run("document.querySelector('.live').focus()")
        for name in ("source", "apply"):
            self.page.key("Tab")
            self.assertEqual(self.page.run(focused), name)
        # Who types indents.
        self.edit("void main() {", "void main() {")
        self.page.key("Enter")
        self.page.key("Tab")
        self.page.type("float x;")
        self.page.key("Enter")
        self.page.type("float y;")
        self.assertIn("void main() {\n    float x;\n    float y;\n", self.page.run(value))
        self.page.key("Tab", browser.SHIFT)
        self.assertIn("    float x;\nfloat y;\n", self.page.run(value))
        self.page.run("""(field => field.setSelectionRange(field.value.indexOf("    float x"),
                                                           field.value.indexOf("float y;") + 9))(document.activeElement)""")
        self.page.key("Tab")
        self.assertEqual(self.page.run(selected), "        float x;\n    float y;")
        self.page.key("Tab", browser.SHIFT)
        self.page.key("Tab", browser.SHIFT)
        self.page.key("Tab", browser.SHIFT)
        self.assertIn("void main() {\nfloat x;\nfloat y;\n", self.page.run(value))
        for _ in range(30):
            self.page.run("document.execCommand('undo')")
        self.assertEqual(self.page.run(value), text)
        # Escape leaves, in both directions.
        for modifiers, name in ((0, "apply"), (browser.SHIFT, "live")):
            self.edit("void", "void")
            self.page.key("Home")
            self.page.key("Escape")
            self.page.key("Tab", modifiers)
            self.assertEqual(self.page.run(focused), name)
        self.assertEqual(self.page.complaints(), [])
        self.page.click(".revert")

    def test_texts_are_kept(self):
        """One by one; those of earlier versions, which were kept together, are taken over."""
        key, other = "lighting LightedCube", "localStorage.getItem('lighting LightedCube: lighting/other.glsl')"
        pairs = [["x", 5], "ab", None, ["lighting/other.glsl", "of other options"], ["lecture/LightedCube.frag", "mine"]]
        self.open("LightedCube")
        for hostile in ("5", "null", "{", '"<b>"', json.dumps(pairs)):
            self.page.run(f"localStorage.setItem({json.dumps(key)}, {json.dumps(hostile)})")
            self.open("LightedCube")
            self.assertEqual(self.page.complaints(), [])
        self.assertEqual(self.page.run("document.querySelector('.source').value"), "mine")
        self.page.click(".live")
        self.edit("mine", "not drawn")
        self.open("LightedCube")
        self.assertEqual(self.page.run("document.querySelector('.source').value"), "not drawn")
        self.assertEqual(self.page.run(other), "of other options")
        self.page.run("window.refuses = true")
        self.page.click(".revert")
        self.assertEqual(self.page.run(other), "of other options")
        self.page.run("window.refuses = false")
        self.page.click(".revert")
        self.assertEqual(self.page.run(f"[asked.length, {KEPT}]"), [2, 0])
        self.page.click(".revert")  # nothing is lost
        self.assertEqual(self.page.run("asked.length"), 2)

    def test_two_tabs(self):
        """What one has kept the other shows, and does not drop."""
        value = "document.querySelector('.source').value"
        self.open("LightedCube")
        first = self.page.new_tab()
        self.page.before_pages(CONFIRM)
        self.open("LightedCube")
        second = self.page.tab
        try:
            self.choose("lecture/LightedCube.frag")
            self.edit("void main", "void /* second */ main")
            self.page.show_tab(first)
            self.edit("void main", "void /* first */ main")
            self.page.show_tab(second)
            self.choose("lecture/LightedCube.vert")
            self.page.wait(value + ".includes('/* first */')")
            # Both in one file, one after the other.
            self.edit("/* first */", "/* first */ /* then second */")
            self.page.show_tab(first)
            self.page.wait(value + ".includes('/* then second */')")
            self.edit("/* first */", "/* first again */")
            self.page.click(".apply")
            self.page.wait("document.querySelector('.said').textContent.startsWith('Drawn with')")
            self.open("LightedCube")
            self.assertIn("/* first again */ /* then second */", self.page.run(value))
            self.choose("lecture/LightedCube.frag")
            self.assertIn("/* second */", self.page.run(value))
            self.page.click(".revert")
            self.page.show_tab(second)
            self.page.wait("!" + value + ".includes('/*')")
            self.assertEqual(self.page.run(KEPT), 0)
        finally:
            self.page.show_tab(second)
            self.page.close_tab(first)

    def choose(self, name):
        self.page.run(f"""(files => {{ files.value = {json.dumps(name)}; files.dispatchEvent(new Event("change")); }})(
            document.querySelector(".files"))""")

    def test_undo(self):
        """Undoes what was typed here, and never puts one file's text into another."""
        value = "document.querySelector('.source').value"
        self.open("LightedCube")
        texts = {}
        for name in ("lecture/LightedCube.frag", "lecture/LightedCube.vert"):
            self.choose(name)
            texts[name] = self.page.run(value)
        self.edit("void main", "void /* mine */ main")
        self.page.run("document.execCommand('undo')")
        self.assertEqual(self.page.run(value), texts["lecture/LightedCube.vert"])
        self.assertEqual(self.page.run(KEPT), 0)
        self.page.run("document.execCommand('redo')")
        self.assertIn("/* mine */", self.page.run(value))
        self.choose("lecture/LightedCube.frag")
        self.page.run("document.querySelector('.source').focus()")
        for _ in range(3):
            self.page.run("document.execCommand('undo')")
        self.assertEqual(self.page.run(value), texts["lecture/LightedCube.frag"])
        self.choose("lecture/LightedCube.vert")
        self.assertIn("/* mine */", self.page.run(value))
        self.page.click(".revert")

    def test_back_and_forward(self):
        self.open("Materials", "time=2&material=gold")
        before = self.shown()
        self.page.click("#forward")
        self.settle()
        moved = self.shown()
        self.page.navigate(address("index"))
        self.page.wait("location.pathname.endsWith('index.html') && document.body?.dataset.ready")
        self.page.run("setTimeout(() => history.back())")  # the answer comes before the page goes
        self.page.wait("location.pathname.endsWith('Materials.html') && document.body?.dataset.ready")
        self.assertEqual(self.page.run("location.hash"), "#material=gold&time=2.1")
        self.assert_native()
        self.assertEqual(self.shown(), moved)
        self.page.run("location.hash = '#time=2&material=gold'")
        self.page.wait("Page.page.seconds === 2")
        self.settle()
        self.assertEqual(self.shown(), before)
        self.page.run("setTimeout(() => history.back())")
        self.page.wait("Page.page.seconds === 2.1")
        self.assert_native()
        self.assertEqual(self.shown(), moved)
        self.page.run("setTimeout(() => history.forward())")
        self.page.wait("Page.page.seconds === 2")
        self.assert_native()
        self.assertEqual(self.shown(), before)

    def test_a_long_text_is_typed_in(self):
        """A change costs what shows, not the whole: it was 6 s at 10,000 lines. The browser's own text field takes some 30 ms
        for so many lines, and this machine may be busy."""
        self.open("LightedCube")
        self.page.click(".live")
        cost = self.page.run("""(async () => {
            const field = document.querySelector(".source"), costs = [];
            field.value = "precision mediump float; // a line of the text\\n".repeat(10000);
            field.dispatchEvent(new Event("input"));
            field.focus();
            for (let i = 0; i < 9; i++) {
                const at = Math.floor(field.value.length * i / 9), start = performance.now();
                field.setSelectionRange(at, at);
                document.execCommand("insertText", false, "x");
                field.dispatchEvent(new Event("scroll"));
                costs.push(performance.now() - start);
            }
            for (let frame = 0; frame < 2; frame++) // Firefox scrolls to what is typed with the next
                await new Promise(requestAnimationFrame);
            field.scrollTop = 5000 * (field.scrollHeight / 10001);
            field.dispatchEvent(new Event("scroll"));
            return costs.sort((a, b) => a - b)[4];
        })()""")
        self.assertLess(cost, 300)
        # The numbers are beside their lines, however long the text is.
        said = self.page.run("""(() => {
            const box = name => document.querySelector(name).getBoundingClientRect();
            const [first] = document.querySelector(".gutter > span").children, field = document.querySelector(".source");
            const padding = parseFloat(getComputedStyle(document.querySelector(".colours pre")).paddingTop);
            return [Number(first.textContent), box(".gutter > span").top, box(".colours pre").top + padding, box(".source").top,
                    document.querySelector(".colours").textContent.split("\\n")[0]];
        })()""")
        self.assertAlmostEqual(said[0], 5000, delta=2)
        self.assertLess(abs(said[1] - said[2]), 1)
        self.assertLess(abs(said[2] - said[3]), 45)
        self.assertIn("mediump", said[4])
        # 420 kB, which spreading its 120,000 lines into arguments does not take.
        self.page.run("""(field => { field.value = "//\\n\\n".repeat(105000); field.dispatchEvent(new Event("input")); })(
            document.querySelector(".source"))""")
        self.assertEqual(self.page.complaints(), [])
        self.open("LightedCube")
        self.assertEqual(self.page.run("document.querySelector('.source').value.length"), 420000)
        self.page.click(".revert")

    def test_loops_that_would_hang_the_page(self):
        """Are not drawn: neither while they are typed nor after a reload."""
        sines = "void main() { float x = 0.0;" + "".join(
            f" for (int {i} = 0; {i} < 10000; {i}++)" for i in "ijk") + " x += sin(float(i)); gl_FragColor = vec4(x); }"
        step = "void main() { for (float x = 0.0; x < 1.0; x += %s) gl_FragColor = vec4(x); }"
        self.open("LightedCube")
        before = self.shown()
        for text in (sines, step % "1e-9", step % "-0.1",
                     "#define N 1000\n#define M N * N\n" + sines.replace("10000", "M"),
                     "float f() { float x; for (int i = 0; i < 1000; ++i) x += 1.0; return x; }" +
                     step.replace("= vec4(x)", "= vec4(f())") % "0.001"):
            with self.subTest(text):
                text = "precision highp float;\n" + text
                self.choose("lecture/LightedCube.frag")
                self.page.run("document.querySelector('.source').focus(), document.querySelector('.source').select()")
                self.page.type(text)
                self.page.wait("document.querySelectorAll('.errors li').length")
                self.assertRegex(self.text(".errors li"), r"^lecture/LightedCube.frag:\d: error: this loop takes about \d+ steps")
                self.assertEqual(self.shown(), before)
                self.open("LightedCube")
                self.assertEqual(self.shown(), before)
                self.assertEqual(self.page.run("document.querySelector('.source').value"), text)
        # As many as are drawn are.
        self.page.run("document.querySelector('.source').focus(), document.querySelector('.source').select()")
        self.page.type("precision highp float;\n" + step % "0.01")
        self.page.wait("/Drawn with|Warnings/.test(document.querySelector('.said').textContent)")
        self.assertNotEqual(self.shown(), before)
        self.page.click(".revert")

    def test_a_shader_without_a_colour_draws(self):
        """Natively it draws what there is by chance, with a warning; WebGL alone would fail."""
        self.open("LightedCube")
        self.choose("lecture/LightedCube.frag")
        self.page.run("document.querySelector('.source').focus(), document.querySelector('.source').select()")
        self.page.type("// gl_FragColor\nvoid main() {}")
        self.page.wait("/never written/.test(document.querySelector('.said').textContent)")
        self.page.click(".revert")

    def test_a_dropped_file_leaves_the_page(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "<b>duck.obj")
            pathlib.Path(path).write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            for name in ("Materials", "LightedCube"):
                self.open(name)
                before = self.shown()
                self.edit("void main", "void /* mine */ main")
                for selector in ("#picture", ".source", "h1"):
                    self.page.run("document.getElementById('error').textContent = ''")
                    self.page.drop(selector, path)
                    if name == "Materials":
                        self.page.wait("document.getElementById('files-said').textContent.startsWith('<b>duck.obj is drawn')")
                    else:
                        self.page.wait("document.getElementById('error').textContent")
                        self.assertEqual(self.text("#error"), "<b>duck.obj: this page reads no files; Scene.html reads models and scenes")
                self.settle()
                self.assertEqual(self.shown() == before, name != "Materials")
                self.assertIn("/* mine */", self.page.run("document.querySelector('.source').value"))
                self.page.click(".revert")

    def test_an_angle_is_a_time(self):
        self.open("LightedCube_animation", "angle=45")
        self.assert_native()
        self.assertIn("--time 1.5", self.text("#command"))
        self.page.run("""(() => {
            const field = document.getElementById("option-angle");
            field.value = "90";
            field.dispatchEvent(new Event("input"));
        })()""")
        self.assert_native()
        self.assertIn("--time 3", self.text("#command"))
        self.page.click("#back")
        self.assert_native()
        self.assertIn("--time 2.9", self.text("#command"))

    def test_a_refused_file_changes_nothing(self):
        self.open("LightedCube")
        self.page.run(HARNESS)
        for texts in ({}, {"lecture/LightedCube.frag": "void main() { gl_FragColor = vec4(0.5); }"}):
            self.page.run(f"own.replace(new Map(Object.entries({json.dumps(texts)})))")
            before = self.page.run("rgb(['LightedCube'])")
            self.assertFalse(self.page.run("""own.replace(new Map([["lecture/LightedCube.vert", "void main() {}"],
                ["lecture/LightedCube.frag", "é".repeat(600000)]]))"""))
            self.assertIn("has 1200000 bytes; at most 999999 are read", self.page.run("own.message"))
            self.assertEqual(self.page.run("rgb(['LightedCube'])"), before)

    def test_an_included_file_is_edited(self):
        self.open("Materials")
        before = self.shown()
        self.page.run("""(() => {
            const files = document.querySelector(".files");
            files.value = "lighting/output.glsl";
            files.dispatchEvent(new Event("change"));
            const field = document.querySelector(".source");
            field.value += "\\n#error here\\n";
            field.dispatchEvent(new Event("input"));
        })()""")
        self.page.wait("document.querySelectorAll('.errors li').length")
        self.assertRegex(self.text(".errors li"), r"^lighting/output.glsl:\d+: ")
        self.assertEqual(self.shown(), before)
        self.page.click(".revert")
        self.settle()

    def test_a_long_shader_is_refused(self):
        self.open("LightedCube")
        before = self.shown()
        self.page.run("""(() => {
            const field = document.querySelector(".source");
            field.value = "/".repeat(10e6);
            field.dispatchEvent(new Event("input"));
        })()""")
        self.page.wait("document.querySelector('.said').textContent.includes('at most 999999')")
        self.assertEqual(self.shown(), before)
        self.page.click(".revert")
        self.settle()

    def test_the_error_in_a_worker(self):
        self.open("PhongBlinn")
        self.page.click("#compare")
        self.page.wait("!document.getElementById('exact').hidden")
        self.assertRegex(self.text("#compared"), r"Inside objects: \d+ pixels, largest \d")
        self.page.click("#forward")
        self.settle()
        self.assertIn("has changed", self.text("#compared"))
        self.open("PhongBlinn", "size=800x600")
        self.page.run("Page.compare(), document.getElementById('forward').click()")
        self.page.wait("document.getElementById('compared').textContent.includes('compare again')")

    def test_effects_are_explained(self):
        self.open("TwoSidedLighting")
        self.page.click("#explain summary")
        self.page.wait("document.getElementById('explained').textContent")
        explained = subprocess.run([os.path.join(EXAMPLES, "TwoSidedLighting"), "--explain"], stdout=subprocess.PIPE,
                                   text=True, check=True).stdout
        said = self.text("#explained")
        self.assertIn(explained.split("# programs")[0].strip(), said)

    def test_the_picture_is_saved(self):
        with tempfile.TemporaryDirectory() as folder:
            for link in ("", "alpha&samples=4"):
                self.open("SmoothFlat", link)
                path = self.saved(folder, "#save", "SmoothFlat.png")
                chunks, pixels = decode_png(path.read_bytes())
                path.unlink()
                arguments = ["--alpha", "--samples", "4"] if link else []
                file = os.path.join(folder, "native.png")
                subprocess.run([os.path.join(EXAMPLES, "SmoothFlat"), *arguments, "--compress", "0", "-o", file], check=True)
                self.assertEqual(pixels, decode_png(pathlib.Path(file).read_bytes())[1])
                self.assertIn(b"examples/run SmoothFlat" + b" --samples 4 --alpha" * bool(link), chunks[b"iTXt"])

    def test_hostile_links(self):
        attack = "<img src=x onerror=window.hacked=1>"
        for link in (attack, "size=99999x99999", "size=5000x10", "size=NaNxNaN", "time=NaN", "time=inf", "orbit=NaN,1",
                     f"material={attack}", "material=%E0%A4%A", "size=1x1%0A--output=x", "output=/etc/passwd", "model=/dev/zero",
                     "terms=" + "a" * 3000, "x" * 100000, "--help", "help", "shaders=/tmp", "=1", "javascript:alert(1)",
                     "constructor=1", "__proto__=1", "shininess=1e999", "error=1", "samples=65536"):
            with self.subTest(link[:60]):
                self.open("Materials", urllib.parse.quote(link, safe="=%"))
                said = self.text("#error")
                self.assertTrue(said)
                self.assertNotIn("\n", said)
                self.assertLess(len(said), 1200)
                self.assertEqual(self.text("#command"), "examples/run Materials")
                self.assertIsNone(self.page.run("window.hacked"))
                self.assertEqual(self.page.complaints(), [])

    def test_no_script_of_others_runs(self):
        self.open("Materials")
        self.page.run("""(() => {
            const script = document.createElement("script");
            script.textContent = "window.hacked = 1";
            document.body.append(script);
            const box = document.createElement("div");
            box.innerHTML = "<img src=x onerror='window.hacked = 1'>";
            document.body.append(box);
            try { new Function("window.hacked = 1")(); } catch {}
        })()""")
        self.settle()
        self.assertIsNone(self.page.run("window.hacked"))
        for name in ("Materials", "single/LightedCube", "index"):
            self.open(name)
            self.assertEqual([url for url in self.page.requests() if not url.startswith(("file:", "blob:", "data:", "about:"))],
                             [])
            self.assertEqual(self.page.complaints(), [])

    def test_a_lost_context_comes_back(self):
        self.open("FourLights", "time=2")
        before = self.shown()
        for _ in range(2):
            self.page.run("document.getElementById('status').textContent = ''")
            self.page.run("Page.page.engine.module.canvas.getContext('webgl2').getExtension('WEBGL_lose_context')"
                          ".loseContext()")
            self.page.wait("document.getElementById('status').textContent.startsWith('Drawn again')")
            self.page.click("#forward")
            self.page.click("#back")
            self.settle()
            self.assertEqual(self.shown(), before)

    def test_a_browser_without_webgl(self):
        for kind in ("webgl2", "webgl"):
            with self.page.before(f"""
                const real = HTMLCanvasElement.prototype.getContext;
                HTMLCanvasElement.prototype.getContext = function (kind, ...more) {{
                    return kind.startsWith({json.dumps(kind)}) ? null : real.call(this, kind, ...more);
                }};"""):
                self.page.open(address("Materials"), "document.getElementById('error').textContent")
                self.assertIn("WebGL 2: this browser gives none", self.text("#error"))

    def test_a_module_that_cannot_start(self):
        with self.page.before("""
            WebAssembly.instantiate = () => Promise.reject(new RangeError("no memory"));"""):
            self.page.open(address("Materials"), "document.getElementById('error').textContent")
            self.assertEqual(self.text("#error"), "This page cannot run: RangeError: no memory")

    def test_blocked_storage(self):
        with self.page.before("""
            Object.defineProperty(window, "localStorage", {get() { throw new DOMException("blocked"); }});"""):
            self.open("LightedCube")
            self.edit("diffuse,", "diffuse.bgr,")
            self.page.wait("document.querySelector('.said').textContent.includes('keeps nothing')")

    def test_names_for_a_screen_reader_and_keys_alone(self):
        for name in ("Materials", "PointLightedSphere", "index"):
            self.open(name)
            self.assert_named(name)
            if name == "index":
                continue
            reached = []
            self.page.run("document.activeElement.blur()")
            for _ in range(12):
                self.page.key("Tab")
                reached.append(self.page.run("document.activeElement.id"))
            for part in ("picture", "play", "slider", "time", "save"):
                self.assertIn(part, reached)

    def test_wide_pages(self):
        self.open("Materials")
        self.page.run("document.getElementById('exact').hidden = false")
        self.assertLessEqual(self.page.run("document.querySelector('.drawn').offsetHeight"), 900)
        sizes = self.page.run("""[...document.querySelectorAll("input[type=checkbox]")].map(box =>
            Math.min(box.offsetWidth, box.offsetHeight))""")
        self.assertGreaterEqual(min(sizes), 24)

    def test_nothing_moves_by_itself(self):
        """For who prefers that: what plays does so by its button."""
        self.addCleanup(self.page.media)
        self.page.media(reduced=True)
        for name in ("index", "labs", "precision", "LightedCube_animation", "chapter16", "lab01_diffuse"):
            self.open(name)
            self.page.run("for (const part of document.querySelectorAll('details')) part.open = true")
            self.page.wait("typeof Book === 'undefined' || Book.book.figures.every(figure => !figure.inSight || figure.drawn === figure.key())")
            moves = self.page.run("""(async () => {
                const moving = [...document.querySelectorAll("*")].filter(part => {
                    const {transitionDuration, animationName, scrollBehavior} = getComputedStyle(part);
                    return transitionDuration !== "0s" || animationName !== "none" || scrollBehavior !== "auto";
                }).map(part => part.tagName);
                const seen = () => String([scrollY, document.body.innerText,
                    ...[...document.querySelectorAll("canvas")].map(canvas => canvas.toDataURL())]);
                const before = seen();
                for (let frame = 0; frame < 10; frame++)
                    await new Promise(requestAnimationFrame);
                return [moving, document.getAnimations().length, seen() === before];
            })()""")
            self.assertEqual(moves, [[], 0, True], name)

    def test_narrow_pages(self):
        self.page.resize(360, 700)
        for name in ("index", "Materials", "PointLightedCube_perFragment", "single/TermsApart"):
            self.open(name)
            self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), 360, name)
        self.open("PointLightedCube_perFragment")
        self.edit("v_Normal", "v_Norma")
        self.page.wait("document.querySelectorAll('.errors li').length")
        self.page.click(".diff summary")
        self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), 360)
        self.page.click(".revert")

    def test_the_picture_stays_in_sight(self):
        """While a text or an option far below is changed: on a phone, and beside a lab's editor."""
        seen = """(selector => {
            const {left, top, width, height} = document.querySelector(selector).getBoundingClientRect();
            return document.elementFromPoint(left + width / 2, top + height / 2)?.id;
        })"""
        for name, picture, sizes in (("LightedCube", "picture", [(390, 800)]), ("Materials", "picture", [(390, 800), (800, 1000)]),
                                     ("lab01_diffuse", "drawn", [(390, 800), (1280, 900)])):
            for width, height in sizes:
                self.page.resize(width, height)
                self.open(name)
                self.page.run("document.querySelector('.apply').focus()")
                with self.subTest(name, width=width):
                    self.assertEqual(self.page.run(f"{seen}('#{picture}')"), picture)
                    self.assertTrue(self.page.run("document.querySelector('.apply').contains(document.elementFromPoint(...(({left, top}) => "
                                                  "[left + 5, top + 5])(document.querySelector('.apply').getBoundingClientRect())))"))
                    self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), width)

    def test_predecessors(self):
        self.open("PointLightedCube")
        self.page.click(".diff summary")
        self.assertIn("u_LightPosition", self.text(".diff ins"
                                                   if "u_LightPosition" in self.text(".diff ins") else ".diff pre"))
        self.assertTrue(self.page.run("document.querySelector('.diff a').href.endsWith('LightedTranslatedRotatedCube.html')"))
        # A page that is sent has no others beside it.
        self.open("single/PointLightedCube")
        self.assertIn("The predecessor is LightedTranslatedRotatedCube.", self.text(".diff"))
        self.assertEqual(self.page.run("document.querySelectorAll('a[href$=\".html\"]:not(#whole)').length"), 0)

    def test_one_file_draws_by_itself(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(os.path.join(SITE, "single/TermsApart.html"), folder)
            self.page.open(pathlib.Path(folder, "TermsApart.html").as_uri())
            self.assert_native()
            self.assertIn("reads no models", self.text("main"))
            self.page.click("#compare")
            self.page.wait("!document.getElementById('exact').hidden")

    def test_sizes(self):
        """At most 250 kB, 275 in one file, which explains pixels, too; and what the table of the pages says."""
        measured = list(sizes.sizes(SITE))
        said = {name: row for name, *row in sizes.read(pathlib.Path(SOURCE, "examples/web/README.md").read_text())}
        self.assertGreater(len(measured), 30)
        self.assertIn(pathlib.Path(SITE, "program.js"), sizes.loaded(pathlib.Path(SITE), "Materials"))
        for name, *row in measured:
            self.assertLess(max(row[:2]), 250000, name)
            self.assertLess(row[2], 275000, name)
            for new, old in zip(row, said.pop(name)):
                self.assertLess(abs(new - old), max(0.05 * old, 150), f"{name}: now {row}; run tests/tables sizes")
        self.assertEqual(said, {})


# Those that take longest first.
CLASSES = ["Parity", "Verdicts", "Corpus", "Book", "Accessible", "InFirefox", "Labs", "Pages", "Pixels", "Models", "Sharing", "Working",
           "SwiftShader", "Report"]


def run(name):
    """What the tests of a class say, and whether they passed."""
    said = io.StringIO()
    tests = unittest.defaultTestLoader.loadTestsFromName(name, sys.modules[__name__])
    passed = unittest.TextTestRunner(said, verbosity=2).run(tests).wasSuccessful()
    return said.getvalue(), passed


def main():
    code = make()
    if code:
        return code
    if firefox_pages.MISSING:
        print(f"not checked: the pages in Firefox, because {firefox_pages.MISSING} is not found")
    if sys.argv[4:]:
        return not unittest.main(argv=sys.argv[:1] + sys.argv[4:], exit=False, verbosity=2).result.wasSuccessful()
    tests = unittest.defaultTestLoader.loadTestsFromModule(sys.modules[__name__])
    assert {type(test).__name__ for suite in tests for test in suite} == set(CLASSES)
    # Each class has a browser of its own, and waits for it.
    with multiprocessing.get_context("fork").Pool(os.cpu_count()) as pool:
        failed = []
        for said, right in pool.imap_unordered(run, CLASSES):
            print(said, end="", file=sys.stderr, flush=True)
            if not right:
                failed.append(said)
    # Again at the end: of a test that fails meson shows the last hundred lines.
    for said in failed:
        print(said[said.find("=" * 70):], end="", file=sys.stderr)
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
