"""The page of `accuracy`, as a small survey writes it."""
import csv
import os
import pathlib
import subprocess
import tempfile

from pages import EXAMPLES, Case

WIDTHS = (360, 390, 800, 1280, 2560)
# What is wider than its window, is cut by what it is in, or is not there.
CUT = """[...document.querySelectorAll("img, .bar, p, h1, h2, li")].filter(part => {
    const {left, right, width, height} = part.getBoundingClientRect(), around = part.parentElement.getBoundingClientRect();
    return left < around.left - 1 || right > around.right + 1 || left < 0 || right > innerWidth || part.scrollWidth > part.clientWidth + 1 &&
        part.clientWidth || !width || !height || part.matches("img") && !part.naturalWidth;
}).map(part => part.outerHTML.slice(0, 80))"""


class Report(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.survey("--quick", "--part", "1/1", "-s", "16x16")
        # As on an idle machine: then the page has all plots, and bars.
        results = cls.folder / "results-1-of-1.csv"
        with results.open(newline="") as file:
            rows = list(csv.DictReader(file))
        with results.open("w", newline="") as file:
            writer = csv.DictWriter(file, rows[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows({**row, "noise": "0.05"} for row in rows)
        cls.survey("--quick", "--merge", "-s", "16x16")

    @classmethod
    def survey(cls, *options):
        subprocess.run([os.path.join(EXAMPLES, "accuracy"), "--scene", "cube", *options, "-o", cls.folder], check=True,
                       stdout=subprocess.DEVNULL)

    def test_nothing_is_cut(self):
        """From a phone to a large screen, dark and light."""
        self.page.open((self.folder / "index.html").as_uri(), "true")
        self.assertGreater(self.page.run("document.querySelectorAll('.plot img').length"), 5)
        self.assertGreater(self.page.run("document.querySelectorAll('.bar i').length"), 3)
        for width in WIDTHS:
            for dark in (False, True):
                self.page.resize(width, 800)
                self.page.media(dark=dark)
                with self.subTest(width=width, dark=dark):
                    self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), width)
                    self.assertEqual(self.page.run(CUT), [])
        self.page.media()
        self.assert_named("accuracy")
        self.assertEqual(self.page.complaints(), [])
