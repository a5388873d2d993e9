"""What the tests of the pages share: where the pages are, and a page that is open."""
import base64
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import time
import unittest

import browser
import firefox

# The one that all tests drive, but those of firefox_pages.py.
BROWSER = os.environ.get("LIGHTING_TEST_BROWSER", "chromium")
assert BROWSER in ("chromium", "firefox"), f"LIGHTING_TEST_BROWSER={BROWSER}: must be chromium or firefox"
IN_FIREFOX = BROWSER == "firefox"
# Firefox makes desktop OpenGL of the shaders, which has no mediump: what it draws is natively that of highp.
MORE = ("--precision=highp",) if IN_FIREFOX else ()
EXAMPLES, PAGE_NATIVE, SOURCE = (os.path.abspath(path) for path in sys.argv[1:4])
SITE = os.environ.get("SITE") or os.path.join(os.path.dirname(EXAMPLES), "pages")

RENDERER = """(() => {
    const gl = Page.page.engine.module.canvas.getContext("webgl2");
    return gl.getParameter(gl.getExtension("WEBGL_debug_renderer_info").UNMASKED_RENDERER_WEBGL);
})()"""
# A dialog would hold the test up.
CONFIRM = "window.asked = []; window.confirm = text => { asked.push(text); return !window.refuses; };"


LONG = int(os.environ.get("LIGHTING_TEST_LONG") or 1)


def part(things, first=0, fewer=1):
    """Of many similar cases, every LIGHTING_TEST_LONG-th, or of those that cost most `fewer` times as few; all without."""
    every = LONG * fewer if LONG > 1 else 1
    return list(things)[first % every::every]


def make():
    """Builds the pages with examples/run web; 0, or what a test exits with."""
    for tool in ("emcc", "chromium", "pyftsubset", *(firefox.NEEDS if IN_FIREFOX else ())):
        if not shutil.which(tool):
            print(f"{tool}: not found; the pages are not tested")
            return 77
    return subprocess.run([os.path.join(SOURCE, "examples/run"), "web", "-o", SITE], stdout=sys.stderr,
                          env={**os.environ, "LIGHTING_BUILD": os.path.dirname(EXAMPLES)}).returncode


def address(name, link=""):
    return pathlib.Path(SITE, name + ".html").as_uri() + (link and "#" + link)


def native(name, arguments):
    """Rows of red, green, blue, as the browser is to draw."""
    return subprocess.run([os.path.join(EXAMPLES, name), *arguments, *MORE, "-o", "-", "--format", "rgb"], check=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE).stdout


def differences(one, other):
    """How many bytes differ, and by more than one step."""
    assert len(one) == len(other), (len(one), len(other))
    if one == other:
        return 0, 0
    apart = [abs(a - b) for a, b in zip(one, other) if a != b]
    return len(apart), sum(step > 1 for step in apart)


class Case(unittest.TestCase):
    options = browser.MESA

    @classmethod
    def start(cls):
        return firefox.Firefox() if IN_FIREFOX else browser.Browser(*cls.options)

    @classmethod
    def setUpClass(cls):
        cls.page = cls.start()
        cls.addClassCleanup(cls.page.close)
        cls.page.before_pages(CONFIRM)

    def edit(self, old, new):
        """Selects a part of the text and types over it."""
        self.page.run(f"""(() => {{
            const field = document.querySelector(".source"), at = field.value.indexOf({json.dumps(old)});
            field.focus();
            field.setSelectionRange(at, at + {len(old)});
        }})()""")
        self.page.type(new)

    def tearDown(self):
        self.page.resize(1280, 900)

    def open(self, name, link=""):
        self.page.open(address(name, link))
        if name.startswith("chapter"):  # which load what draws when the reader reads on
            self.page.run("dispatchEvent(new Event('scroll'))")
            self.page.wait("Book.book.figures.length || !document.querySelector('.live, .formula') || document.body.matches('.still')")

    def text(self, selector):
        return self.page.run(f"document.querySelector({json.dumps(selector)}).textContent.trim()")

    def shown(self):
        """Red, green, blue of the page's picture."""
        data = base64.b64decode(self.page.run("""(() => {
            const canvas = document.getElementById("picture");
            const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            let text = "";
            for (let i = 0; i < data.length; i += 4)
                text += String.fromCharCode(data[i], data[i + 1], data[i + 2]);
            return btoa(text);
        })()"""))
        return data

    def saved(self, folder, button, name):
        """The whole file that a button saves."""
        self.page.downloads(folder)
        self.page.click(button)
        path, deadline = pathlib.Path(folder, name), time.monotonic() + browser.PATIENCE
        while not path.exists() or not path.stat().st_size or list(path.parent.glob("*.part")):  # as Firefox names what is not whole
            self.assertLess(time.monotonic(), deadline, f"{name} is not saved: {os.listdir(folder)}")
            time.sleep(0.05)
        return path

    def settle(self):
        """After what was scheduled for the next frame."""
        self.page.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    def assert_native(self):
        """The picture is that of the command that the page shows."""
        self.settle()
        words = shlex.split(self.text("#command"))
        self.assertEqual(words[0], "examples/run")
        self.assertEqual(differences(self.shown(), native(words[1], words[2:])), (0, 0), words)

    def assert_exact_bits(self, names):
        lines = [name + " --size=90x60" + " --samples=4" * (i % 2) for i, name in enumerate(names)]
        answers = subprocess.run([PAGE_NATIVE], input="\n".join(lines), stdout=subprocess.PIPE, text=True, check=True).stdout
        for line, answer in zip(lines, answers.splitlines()):
            with self.subTest(line):
                result = self.page.run(f"""ErrorWorker.compute({{compiled: Page.page.compiled, texts: new Map(),
                    lines: {json.dumps(line.split())}, seconds: 0, orbit: [0, 0, 1]}}).then(r => r.error || r)""")
                self.assertEqual(result, json.loads(answer))

    def assert_named(self, name):
        """What is focusable has a name for a screen reader."""
        unnamed, named = self.page.unnamed()
        self.assertEqual(unnamed, [], name)
        self.assertGreater(named, 0, name)

    def programs(self):
        return self.page.run("Page.page.engine.json('programs')")
