"""What is taken from a page elsewhere and what comes to it, and how it is worked with: steps back, two pictures at once."""
import base64
import html
import io
import json
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import time
import zipfile
import zlib

import browser
from pages import EXAMPLES, IN_FIREFOX, SITE, Case, address, differences

CONTROL = 2
VALUE = "document.querySelector('.source').value"
KEPT = "Object.keys(localStorage).filter(key => key.startsWith('lighting LightedCube'))"


def packed(data):
    """As a link has it."""
    squeeze = zlib.compressobj(9, zlib.DEFLATED, -15)
    return base64.urlsafe_b64encode(squeeze.compress(data) + squeeze.flush()).decode().rstrip("=")


class Sharing(Case):
    def setUp(self):
        self.open("LightedCube")
        self.page.run("localStorage.clear()")
        self.open("LightedCube")

    def copied(self, button):
        self.page.run("document.getElementById('status').textContent = ''")
        self.page.click(button)
        self.page.wait("document.getElementById('status').textContent.startsWith('Copied')")
        return self.page.run("navigator.clipboard.readText()")

    def choose(self, *paths):
        self.page.run("document.querySelector('.said').textContent = ''")
        self.page.choose_files(".chosen", *paths)
        self.page.wait("document.querySelector('.said').textContent")

    def test_an_edited_shader_travels_in_the_link(self):
        """It is drawn when the reader says so; the reader's own text stays."""
        original, before = self.page.run(VALUE), self.shown()
        self.edit("vec4(diffuse, a_Color.a)", "vec4(diffuse.bgr, a_Color.a)")
        self.page.wait("document.querySelector('.said').textContent.startsWith('Drawn with')")
        self.page.click("#forward")
        self.settle()
        edited = self.shown()
        self.assertNotEqual(edited, before)
        link = self.copied("#copy-link")
        self.assertRegex(link, r"LightedCube.html#time=0.1&text=[\w-]+$")
        self.assertLess(len(link), 2000)
        self.assertNotIn("text=", self.page.run("location.hash"))
        # Another reader, who has a text, too.
        self.page.click(".revert")
        self.page.click("#back")
        self.edit("void main", "void /* own */ main")
        self.page.wait("document.querySelector('.said').textContent.startsWith('Drawn with')")
        self.page.open(link)
        self.assertTrue(self.page.run("document.getElementById('lent').offsetHeight"))
        self.assertRegex(self.text("#lent-said"), "LightedCube.vert.*neither yours")
        self.assertIn("diffuse.bgr", self.page.run(VALUE))
        self.assertNotEqual(self.shown(), edited)
        self.assertNotIn("--shaders", self.text("#command"))
        # Not even when something is typed.
        self.edit("void main", "void  main")
        self.page.run("new Promise(done => setTimeout(done, 700))")
        self.assertNotIn("--shaders", self.text("#command"))
        self.page.click("#draw-it")
        self.page.wait("document.getElementById('lent-said').textContent.startsWith('Drawn')")
        self.assertEqual(self.shown(), edited)
        # What is changed stays in the link, and in it alone.
        self.edit("void  main", "void /* changed */ main")
        self.page.wait(f"Link.unpack(Link.packed(location.hash)).then(texts => [...texts.values()].join().includes('changed'))")
        self.open("LightedCube")
        self.assertIn("/* own */", self.page.run(VALUE))
        self.page.open(link)
        self.page.click("#leave-it")
        self.settle()
        self.assertIn("/* own */", self.page.run(VALUE))
        self.assertEqual(self.page.run("location.hash"), "#time=0.1")
        self.assertFalse(self.page.run("document.getElementById('lent').offsetHeight"))
        # In a page that is open, and then kept.
        self.page.run(f"location.hash = {json.dumps(link.split('#')[1])}")
        self.page.wait("document.getElementById('lent').offsetHeight")
        self.page.run("window.refuses = true")
        self.page.click("#keep-it")
        self.assertTrue(self.page.run("document.getElementById('lent').offsetHeight"))
        self.page.run("window.refuses = false")
        self.page.click("#keep-it")
        self.assertEqual(self.page.run("asked[1]"), "Discard your own text of lecture/LightedCube.vert?")
        self.open("LightedCube")
        self.assertIn("diffuse.bgr", self.page.run(VALUE))
        self.page.click(".revert")
        self.assertEqual(self.page.run(VALUE), original)
        self.assertEqual(self.page.complaints(), [])

    def test_restoring_a_links_text_keeps_the_own(self):
        self.edit("void main", "void /* own */ main")
        texts = json.dumps([["lecture/LightedCube.frag", "void main() { gl_FragColor = vec4(0.5); }"]])
        self.page.open(address("LightedCube", "text=" + packed(texts.encode())))
        self.page.click("#draw-it")
        self.page.wait("document.getElementById('lent-said').textContent.startsWith('Drawn')")
        self.page.click(".revert")
        self.page.wait("document.getElementById('lent').hidden")
        self.assertEqual(self.page.run("location.hash"), "")
        self.assertIn("/* own */", self.page.run(VALUE))
        self.assertEqual(self.page.run(KEPT + ".length"), 1)

    def test_wrong_texts_of_a_link(self):
        before = self.shown()
        name = "lecture/LightedCube.frag"
        for text in ("!", "AAAA", packed(b"{"), packed(b"{}"), packed(b"[1]"), packed(b'[["a"]]'), packed(b'[[1, "a"]]'),
                     packed(json.dumps([["lighting/none.glsl", "<b>"]]).encode()), packed(b"\xff\xfe"),
                     packed(json.dumps([["<img src=x onerror=window.hacked=1>", ""]]).encode()),
                     packed(b"[" + b" " * 300000000), "A" * 200000):
            with self.subTest(text[:40]):
                self.page.open(address("LightedCube", "text=" + text))
                self.assertRegex(self.text("#error"), "^link: ")
                self.assertNotIn("\n", self.text("#error"))
                self.assertEqual(self.page.run("[location.hash, document.getElementById('lent').hidden]"), ["", True])
                self.assertEqual(self.shown(), before)
                self.assertEqual(self.page.complaints(), [])
        self.assertIsNone(self.page.run("window.hacked"))
        # A loop that would hang the page is refused as anywhere.
        wrong = "precision highp float; void main() { for (float x = 0.0; x < 1.0; x += 1e-9) gl_FragColor = vec4(x); }"
        self.page.open(address("LightedCube", "text=" + packed(json.dumps([[name, wrong]]).encode())))
        self.page.click("#draw-it")
        self.page.wait("document.querySelectorAll('.errors li').length")
        self.assertEqual(self.shown(), before)

    def test_a_part_of_another_page(self):
        self.open("Materials", "material=gold")
        self.page.click("#embed summary")
        self.page.click("#embed-controls input[value=shininess]")
        text = self.copied("#copy-iframe")
        self.assertEqual(text, self.page.run("document.getElementById('iframe').value"))
        found = re.match(r'<iframe src="(.*?)" width="(\d+)" height="(\d+)" title="Materials, drawn live"', text)
        self.assertEqual(found[1], "Materials.html?embed=shininess#material=gold")
        self.page.resize(int(found[2]), int(found[3]))
        self.page.open(pathlib.Path(SITE).as_uri() + "/" + html.unescape(found[1]))
        self.assert_native()
        self.assertIn("--material gold", self.text("#command"))
        self.assertEqual(self.page.run("""[...document.querySelectorAll("button, input, select, textarea, h1, summary")]
            .filter(part => part.offsetHeight).map(part => part.id || part.type)"""),
                         ["play", "back", "forward", "slider", "time", "option-shininess", "range"])
        self.assertLessEqual(self.page.run("document.documentElement.scrollHeight"), int(found[3]))
        self.page.run("""(field => { field.value = "90"; field.dispatchEvent(new Event("input")); })(
            document.getElementById("option-shininess"))""")
        self.assert_native()
        self.assertTrue(self.page.run("document.getElementById('whole').href").endswith(
            "Materials.html#material=gold&shininess=90"))
        # With another's text: it asks here, too.
        texts = [["lighting/output.glsl", "vec3 output_color(vec3 color) { return color.bgr; }"]]
        # After the # it is meant as before it.
        self.page.open(address("Materials", "material=gold&embed=shininess&time=2"), "document.body.matches('.embed') && document.body.dataset.ready")
        self.assertEqual(self.page.run("location.href.split('/').pop()"), "Materials.html?embed=shininess#material=gold&time=2")
        self.page.open(address("Materials").replace(".html", ".html?embed") + "#text=" + packed(json.dumps(texts).encode()))
        self.assertTrue(self.page.run("document.getElementById('draw-it').offsetHeight"))

    def test_the_picture_and_the_command_are_copied(self):
        self.open("LightedCube", "time=1")
        self.assertEqual(self.copied("#copy-command"), self.text("#command"))
        self.page.run("document.getElementById('status').textContent = ''")
        self.page.click("#copy-picture")
        self.page.wait("document.getElementById('status').textContent.startsWith('Copied')")
        same = self.page.run("""(async () => {
            const [item] = await navigator.clipboard.read();
            const image = await createImageBitmap(await item.getType("image/png"));
            const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext("2d");
            context.drawImage(image, 0, 0);
            const {data} = context.getImageData(0, 0, image.width, image.height);
            return data.join() === document.getElementById("picture").getContext("2d").getImageData(0, 0, image.width,
                image.height).data.join();
        })()""")
        self.assertTrue(same)

    def test_all_shader_files_in_an_archive(self):
        """As `--shaders mine` takes them; opened again, also as another program packs them."""
        before = self.shown()
        self.edit("vec4(diffuse, a_Color.a)", "vec4(diffuse.bgr, a_Color.a)")
        self.page.wait("document.querySelector('.said').textContent.startsWith('Drawn with')")
        edited = self.shown()
        with tempfile.TemporaryDirectory() as folder:
            path = self.saved(folder, ".all", "LightedCube-shaders.zip")
            with zipfile.ZipFile(path) as archive:
                self.assertIsNone(archive.testzip())
                self.assertEqual(sorted(archive.namelist()), ["mine/LightedCube.frag", "mine/LightedCube.vert"])
                archive.extractall(folder)
            words = shlex.split(self.text("#command"))
            self.assertEqual(words[2:], ["--shaders", "mine"])
            drawn = subprocess.run([os.path.join(EXAMPLES, words[1]), *words[2:], "-o", "-", "--format", "rgb"], check=True,
                                   stdout=subprocess.PIPE, cwd=folder).stdout
            self.assertEqual(differences(edited, drawn), (0, 0))
            self.page.click(".revert")
            self.choose(path)
            self.assertEqual(self.shown(), edited)
            self.page.click(".revert")
            other = pathlib.Path(folder, "other.zip")
            with zipfile.ZipFile(other, "w", zipfile.ZIP_DEFLATED) as archive:
                archive.writestr("readme.txt", "x" * 1000)
                archive.write(os.path.join(folder, "mine/LightedCube.vert"), "a/b/LightedCube.vert")
            self.choose(other)
            self.assertEqual(self.shown(), edited)
            self.page.click(".revert")
            self.choose(os.path.join(folder, "mine/LightedCube.vert"))
            self.assertEqual(self.shown(), edited)
            # Not without asking in place of another text.
            self.edit("diffuse.bgr", "diffuse.brg")
            self.page.run("window.refuses = true, window.asked = []")
            root = self.page.run(VALUE)
            self.page.choose_files(".chosen", path)
            self.page.wait("asked.length")
            self.assertEqual(self.page.run(VALUE), root)
            self.page.run("window.refuses = false")
            self.page.click(".revert")
            self.refuse_archives(folder, path.read_bytes(), before)

    def refuse_archives(self, folder, good, before):
        bomb = io.BytesIO()
        with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("LightedCube.vert", "/" * 50000000)
        none = io.BytesIO()
        with zipfile.ZipFile(none, "w") as archive:
            archive.writestr("lab05.frag", "void main() {}")
        for name, data, words in (("a.zip", b"no archive", "no ZIP archive"), ("b.zip", good.replace(b"main", b"mine"), "is damaged"),
                                  ("c.zip", good[:200] + good[-22:], ""), ("d.zip", bomb.getvalue(), "more than 1000000 bytes"),
                                  ("e.zip", none.getvalue(), "has none of these files: LightedCube.vert, LightedCube.frag"),
                                  ("f.zip", b"", "no ZIP archive")):
            with self.subTest(name):
                path = pathlib.Path(folder, name)
                path.write_bytes(data)
                self.choose(path)
                self.assertTrue(self.text(".said").startswith(name + ": "))
                self.assertIn(words, self.text(".said"))
                self.settle()
                self.assertEqual(self.shown(), before)
        self.assertEqual(self.page.complaints(), [])

    def test_a_film(self):
        with tempfile.TemporaryDirectory() as folder:
            self.page.click("#record")
            self.page.wait("Page.page.seconds > 0.5")
            path = self.saved(folder, "#record", "LightedCube.webm")
            self.assertEqual(path.read_bytes()[:4], b"\x1a\x45\xdf\xa3")  # EBML
            self.assertEqual(self.page.run("[Page.page.playing, document.getElementById('record').textContent]"),
                             [False, "Record WebM"])


class Working(Case):
    """What helps those who work with a page."""

    def put(self, name, value):
        self.page.run(f"""(input => {{ input.value = {json.dumps(value)}; input.dispatchEvent(new Event("input")); }})(
            document.getElementById("option-{name}"))""")

    def test_options_are_undone(self):
        self.open("Materials", "material=gold")
        start = self.page.run("location.hash")
        steps = [start]
        for what in (lambda: self.put("shape", "torus"), lambda: self.put("material", "jade"),
                     lambda: self.page.click("#default"), lambda: self.page.drag("#picture", 40, 10),
                     lambda: self.page.click("#reset"), lambda: self.page.click("#tries button")):
            what()
            self.settle()
            steps.append(self.page.run("location.hash"))
        shown = self.shown()
        # One after the other, by the button and by keys.
        for i, link in enumerate(reversed(steps[:-1])):
            if i % 2:
                self.page.click("#undo")
            else:
                self.page.run("document.getElementById('picture').focus()")
                self.page.key("z", CONTROL)
            self.settle()
            self.assertEqual(self.page.run("location.hash"), link)
            self.assert_native()
        self.page.click("#undo")
        self.assertEqual(self.text("#status"), "Nothing to undo.")
        for link in steps[1:]:
            self.page.click("#redo")
            self.settle()
            self.assertEqual(self.page.run("location.hash"), link)
        self.assertEqual(self.shown(), shown)
        # What is typed into a field the browser undoes; a slider that is moved is one step.
        self.page.run("""(() => {
            const slider = document.querySelector("#option-shininess + input");
            for (const value of [10, 20, 30, 40]) {
                slider.value = value;
                slider.dispatchEvent(new Event("input"));
            }
        })()""")
        self.page.click("#undo")
        self.settle()
        self.assertEqual(self.page.run("location.hash"), steps[-1])
        self.assertEqual(self.page.complaints(), [])

    def test_back_goes_to_the_page_one_came_from(self):
        self.page.open(pathlib.Path(SITE, "index.html").as_uri())
        self.page.run("setTimeout(() => document.querySelector('a[href=\"Materials.html\"]').click())")
        self.page.wait("location.pathname.endsWith('Materials.html') && document.body?.dataset.ready")
        self.put("material", "gold")
        self.put("shape", "torus")
        self.page.click("#forward")
        self.page.click("#undo")
        self.settle()
        self.page.run("setTimeout(() => history.back())")
        self.page.wait("location.pathname.endsWith('index.html') && document.body?.dataset.ready")

    def test_before_and_after(self):
        """Both pictures are those of their commands, also when time and camera change."""
        upper = """(() => {
            const canvas = document.getElementById("before");
            const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            return btoa(data.reduce((text, byte, i) => i % 4 < 3 ? text + String.fromCharCode(byte) : text, ""));
        })()"""
        self.open("LightedCube")
        self.page.click("#forward")
        self.settle()
        original = self.shown()
        field = "document.querySelector('.source')"
        self.page.run(f"""{field}.value = {field}.value.replace("vec4(diffuse,", "vec4(diffuse.bgr,");
                          {field}.dispatchEvent(new Event("input"))""")
        self.page.wait("document.querySelector('.said').textContent.startsWith('Drawn with')")
        self.page.click("#back")
        self.page.click("#wipe-on")
        self.page.wait("document.getElementById('wipe-said').textContent.startsWith('Left: by the original')")
        self.page.click("#forward")
        self.settle()
        self.assertEqual(base64.b64decode(self.page.run(upper)), original)
        self.assertNotEqual(self.shown(), original)
        self.page.run("""(slider => { slider.value = 25; slider.dispatchEvent(new Event("input")); })(
            document.getElementById("wipe"))""")
        self.assertIn("75%", self.page.run("document.getElementById('before').style.clipPath"))
        box = "JSON.stringify(document.getElementById('{}').getBoundingClientRect())"
        self.assertEqual(self.page.run(box.format("before")), self.page.run(box.format("picture")))
        self.page.click("#wipe-on")
        self.assertFalse(self.page.run("document.getElementById('before').offsetHeight"))
        self.page.click(".revert")
        # Of options: those of when it was switched on.
        self.open("Materials")
        before = self.shown()
        self.page.click("#wipe-on")
        self.page.wait("document.getElementById('wipe-said').textContent.startsWith('Left: with the options')")
        self.put("material", "gold")
        self.settle()
        self.assertEqual(base64.b64decode(self.page.run(upper)), before)
        self.assert_native()
        self.assertNotEqual(self.shown(), before)

    def test_an_old_picture_is_marked(self):
        self.open("LightedCube")
        field = "document.querySelector('.source')"
        for text, old in (("#error here", True), ("", False)):
            self.page.run(f"{field}.value += {json.dumps(text)}; {field}.dispatchEvent(new Event('input'))"
                          if text else f"{field}.value = {field}.value.replace('#error here', ''); "
                          f"{field}.dispatchEvent(new Event('input'))")
            self.page.wait(f"Boolean(document.getElementById('old').offsetHeight) === {json.dumps(old)}")
        self.page.click(".revert")

    def test_loading_is_said(self):
        with self.page.before("WebAssembly.instantiate = () => new Promise(() => {});"):
            for name, place in (("Materials", "#status"), ("lab05_per_fragment", "#compared")):
                self.page.open(address(name), "document.readyState === 'complete'")
                self.assertTrue(self.text(place).startswith("Loading"), name)
                self.assertNotEqual(self.page.run("getComputedStyle(document.querySelector('canvas')).backgroundColor"),
                                    "rgb(0, 0, 0)")

    def test_the_assembled_shader(self):
        """Has no condition left, and compiles to the same picture in place of the file."""
        for name, link in (("Materials", ""), ("FourLights", ""), ("Shadows", "shadows=map"), ("Materials", "interpolation=phong"),
                           ("TwoSidedLighting", "interpolation=phong")):
            with self.subTest(name, link=link):
                self.open(name, link)
                self.page.click("#assembled summary")
                self.page.wait("document.querySelector('#assembled pre').textContent")
                text = self.page.run("document.querySelector('#assembled pre').textContent")
                self.assertNotRegex(text, r"#\s*(if|el|endif|line)")
                # The receipt is what the program prints, and each of its lines that is here has its effect. Maps have other texels here.
                words = shlex.split(self.text("#command"))
                done = subprocess.run([os.path.join(EXAMPLES, words[1]), *words[2:], "--explain", "--verbose"], check=True,
                                      capture_output=True, text=True)
                effects = re.compile(r"^# [^\n]*, view 0, object 0$.*?^$", re.MULTILINE | re.DOTALL)
                receipt = self.page.run("document.querySelectorAll('#assembled pre')[1].textContent")
                if link != "shadows=map":
                    self.assertEqual(effects.search(receipt)[0], effects.search(done.stdout)[0])
                marked = self.page.run("""[...document.querySelectorAll("#assembled [data-by]")].map(mark =>
                    [mark.previousSibling.data.replace(/\\/\\/.*/, "").trim(), mark.dataset.by])""")
                self.assertGreater(len(marked), 3)
                for line, by in marked:
                    self.assertIn("  " + line[:60], receipt, by)
                self.assertIn("void main()", text)
                stage = "vert" if "gl_Position" in text else "frag"
                self.assertEqual(stage == "vert", "#define VERTEX_LIGHTS" in text)
                before = self.shown()
                log = self.page.run(f"""(() => {{
                    const gl = document.createElement("canvas").getContext("webgl2");
                    const shader = gl.createShader(gl.{"VERTEX" if stage == "vert" else "FRAGMENT"}_SHADER);
                    gl.shaderSource(shader, {json.dumps(text)});
                    gl.compileShader(shader);
                    return gl.getShaderInfoLog(shader) || "";
                }})()""").strip("\0")
                if IN_FIREFOX:  # desktop OpenGL warns of what a function reads that main sets, which comes below
                    log = re.sub(r".*: warning: `webgl_\w+' used uninitialized\n", "", log)
                self.assertEqual(log, "")
                self.assertEqual(self.shown(), before)

    def test_the_comparison_is_seen(self):
        self.page.resize(1280, 600)
        self.open("PhongBlinn")
        self.page.click("#compare")
        self.page.wait("!document.getElementById('exact').hidden")
        self.settle()
        self.assertTrue(self.page.run("""(box => box.top < innerHeight && box.bottom <= innerHeight + 1)(
            document.getElementById("exact").getBoundingClientRect())"""))

    def test_a_swipe_over_the_picture_scrolls(self):
        self.page.resize(360, 700)
        self.open("Materials")
        self.page.run("scrollTo(0, 0)")
        for kind, places in (("touchStart", [350]), *(("touchMove", [y]) for y in (330, 300, 250, 200)), ("touchEnd", [])):
            self.page.touch(kind, *((150, y) for y in places))
        self.page.wait("scrollY > 50")
        self.assertEqual(self.page.run("String(Page.page.orbit)"), "0,0,1,0")

    def test_labs_beside_and_over(self):
        self.open("lab06_phong")
        self.page.click("#wipe-on")
        boxes = self.page.run("""["drawn", "expected"].map(id => document.getElementById(id).getBoundingClientRect().toJSON())""")
        self.assertEqual(boxes[0], boxes[1])
        self.page.run("""(slider => { slider.value = 40; slider.dispatchEvent(new Event("input")); })(
            document.getElementById("wipe"))""")
        self.assertIn("60%", self.page.run("document.getElementById('drawn').style.clipPath"))
        self.page.click("#wipe-on")
        self.assertEqual(self.page.run("document.getElementById('drawn').style.clipPath"), "")
        # On a phone the pictures and the editor come before the table.
        self.page.resize(360, 700)
        order = self.page.run("['h1', '.task p', '#drawn', '.source', 'table'].map(name => "
                              "document.querySelector(name).getBoundingClientRect().top)")
        self.assertEqual(order, sorted(order))
        self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), 360)
