#!/usr/bin/env python3
"""The book: its numbers, its figures' commands, and a place for every heading of the originals.

usage: book_test.py EXAMPLES_FOLDER_OF_THE_BUILD PAGE_NATIVE SOURCE_FOLDER [unittest's arguments]
"""
import gzip
import os
import pathlib
import re
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(__file__))
sys.path.insert(0, os.path.join(os.path.abspath(sys.argv[3]), "examples/web"))
import book
import claims
import costs
import prose
import svg
from claims import EXAMPLES, SOURCE

CHAPTERS = book.chapters()
LONG = int(os.environ.get("LIGHTING_TEST_LONG") or 0)


class Numbers(unittest.TestCase):
    def test_each_number_is_computed_again(self):
        """In the short form a twelfth of each chapter's."""
        step = 1 if LONG else 12
        for number, chapter in enumerate(CHAPTERS):
            for text, expression in chapter.checks[number % step::step]:
                with self.subTest(chapter.path.name, number=text, by=expression):
                    right, value = claims.holds(text, expression)
                    self.assertTrue(right, f"it is {value}")

    def test_the_findings_are_the_tables(self):
        """So a table that is made anew leaves no old number in the study's text, from which the chapters take theirs."""
        page = " ".join(pathlib.Path(SOURCE, "examples/study/README.md").read_text(encoding="utf-8").split())
        for line in pathlib.Path(__file__).with_name("findings.txt").read_text(encoding="utf-8").splitlines()[2:]:
            pattern, _, expression = line.partition(" = ")
            with self.subTest(pattern):
                right, value = claims.holds(re.search(pattern, page)[1], expression)
                self.assertTrue(right, f"it is {value}")

    def test_every_number_is_computed_or_of_a_kind(self):
        for chapter in CHAPTERS:
            with self.subTest(chapter.path.name):
                self.assertEqual(prose.unmarked(chapter), [])

    def test_equations_of_numbers_hold(self):
        found = 0
        for chapter in CHAPTERS:
            for formula in re.findall(r"\$([^$]+)\$", chapter.text.replace("$$", "")):
                sides = prose.equation(formula)
                if sides:
                    found += 1
                    with self.subTest(chapter.path.name, formula=formula):
                        for side in sides[1:]:
                            self.assertAlmostEqual(claims.computed(sides[0]), claims.computed(side), 9)
        self.assertGreater(found, 3)

    def test_other_numbers_are_found(self):
        """In each place where a number may stand, and beside what is exempt."""
        figure = "![A ball of %s divisions.](program: SmoothFlat --slices 64)"
        for text, found in (("It takes 7 steps.", 1), ("Within 0.5 steps.", 1), ("| 12 | `13` |", 1), ("- 40 texels", 1), ("0 pixels, 1 step", 2),
                            ("from 0 to 1, of 255; 1/255, $x_3 + 2$, $1 + 3 = 4$, `7`, in chapter 3, [lab\n3](a_33.md), OpenGL 1.1, in 1977, 16-bit", 0),
                            ("2049, 255 operations", 2), ("$L = (0, 3, 4)$", 2), ("$0.2$", 1), ("two steps, Half a degree, Five million units", 3),
                            ("two faces, three lights", 0), ("[two]{check=\"1 + 1\"} steps", 0), (figure % 64, 0), (figure % 32, 1), (figure % 64 + "\n\nMore? `--slices 8`\n:   8, not 64 or 9.", 1),
                            (figure % 64 + "\n\nAfter 64 divisions", 1), ("[29]{check=\"cell('shiny8')\"} steps with 8, not 9", 1)):
            with self.subTest(text):
                chapter = book.Chapter(pathlib.Path("01-a.md"), "# A\n\n" + text)
                self.assertEqual(len(prose.unmarked(chapter)), found, prose.unmarked(chapter))

    def test_numbers_are_read_as_words_and_formulas(self):
        for text, right, wrong in (("Four", "4.1", "3.5"), ("half a", "0.5", "0.4"), ("Five million", "5e6", "6e6"), ("$(0.5, 1.43)$", "(0.5, 1.434)", "(0.5, 1.5)"),
                                   ("$(1, 2)$", "(1, 2.3)", "(1, 2, 3)"), ("$1/2048$", "2 ** -11", "2 ** -10"), ("$10^{-16}$", "1e-16", "1e-15"),
                                   ("−3", "-3.4", "3"), ("24%", "24.4", "25")):
            with self.subTest(text):
                self.assertTrue(claims.holds(text, right)[0])
                self.assertFalse(claims.holds(text, wrong)[0])


class Figures(unittest.TestCase):
    def test_each_command_draws(self):
        """Those of figures, of answers and within sentences; in the short form a few of them."""
        step = LONG or 50
        for number, chapter in enumerate(CHAPTERS):
            for command in sorted({*book.commands(chapter.text), *self.answers(chapter)})[number % step::step]:
                name, *words = command.replace(" --alpha", "").split()
                if name == "hard_cases" or "--explain" in words:
                    continue  # draws more than a picture, and has its own tests
                with self.subTest(chapter.path.name, command=command):
                    done = subprocess.run([os.path.join(EXAMPLES, name), *words, "--size", "60x60", "-o", "-", "--format", "rgb"],
                                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=False)
                    self.assertEqual((done.returncode, len(done.stdout)), (0, 3 * 60 * 60), done.stderr.decode())

    @staticmethod
    def answers(chapter):
        """The command of each question: that of the figure above with other options, or its own."""
        base, found = "", []
        for match in re.finditer(r"\((?:program|formula): *([^)]*)\)$|^.*`([^`]+)`\n+:   ", chapter.text, re.MULTILINE):
            if match[1]:
                base = (match[1].partition(" live: ")[2].partition(" plain:")[0] or match[1].partition("controls:")[0]).strip()
            elif match[2].startswith("--"):
                found.append(book.merge(base, match[2]))
            else:
                found.append(match[2])
        return found

    def test_controls_are_options(self):
        for chapter in CHAPTERS:
            for figure in chapter.figures:
                if figure.live:
                    options = claims.run(figure.name, "--help").decode()
                    for name in filter(None, figure.controls.split(",")):
                        with self.subTest(figure.number, control=name):
                            self.assertTrue(name in ("time", "error", "plot") or f"--{name} " in options)

    def test_each_figure_has_two_questions(self):
        for chapter in CHAPTERS:
            parts = book.FIGURE.split(chapter.text)[4::4]
            for figure, text in zip(chapter.figures, parts):
                if figure.kind != "change":
                    with self.subTest(figure.number):
                        self.assertGreaterEqual(len(re.findall(r"^:   ", text, re.MULTILINE)), 2)


    def test_each_step_of_the_lecture_has_its_change(self):
        """As lessons.c lists them, once, in a chapter that shows the later program."""
        text = pathlib.Path(SOURCE, "examples/lessons/lessons.c").read_text(encoding="utf-8")
        steps = [(before, after) for after, before in re.findall(r"^    X\((\w+), &(\w+)\)", text, re.MULTILINE)]
        self.assertEqual(len(steps), text.count("    X(") - 1)  # the first has no predecessor
        shown = [(*figure.words, chapter) for chapter in CHAPTERS for figure in chapter.figures if figure.kind == "change"]
        self.assertEqual(sorted(step[:2] for step in shown), sorted(steps))
        for _, after, chapter in shown:
            with self.subTest(after):
                drawn = [*book.commands(chapter.text), *filter(None, chapter.commands())]
                self.assertIn(after, [command.split()[0] for command in drawn])


class Costs(unittest.TestCase):
    def test_each_chapter_says_what_accuracy_costs(self):
        """Once, where it speaks of that: error, cost and what is left out; in the short form what a few of the programs say."""
        programs, step = pathlib.Path(EXAMPLES), LONG or 50
        for number, chapter in enumerate(CHAPTERS):
            with self.subTest(chapter.path.name):
                marks = [(heading, words) for heading, text in chapter.sections() for words in costs.MARK.findall(text)]
                self.assertEqual(len(marks), 1)
                (heading, words), = marks
                self.assertTrue(heading.startswith("What accuracy costs") or chapter.title == "What accuracy costs", heading)
                self.assertGreaterEqual(len(words.split(";")), 2)
                if number % step == 0:
                    self.assert_complete(costs.rows(programs, words), words)
                    self.assert_shown(costs.table(words, programs, 216))

    def assert_complete(self, found, words):
        made, chosen = found
        self.assertEqual(len(made), len(words.split(";")) + 1)
        for options, error, vertex, _, cost in made:
            self.assertTrue(error > 0 and vertex > 0 and cost > 0, options)
        self.assertLessEqual(made[-1][1], max(float(costs.ALLOWED), made[0][1]))
        self.assertTrue(chosen)

    def assert_shown(self, table):
        for row in re.findall(r"<tr.*?>(.*?)</tr>", table)[1:]:
            self.assertRegex(row, r"<td>[\d.]+</td><td>\d+</td><td>\d+</td><td>\d+\.\d\d</td>")
        self.assertRegex(" ".join(table.split()), r"<b>Left out</b> of the shader, for this scene has no use for it: [a-z].*?\. Left out of the model: [\da-z]")

    def test_the_errors_are_those_of_the_pages(self):
        """--explain says of the plain picture what the pages' own comparison finds."""
        command = "ShadingModels --shape teapot --turning-light off"
        self.assertAlmostEqual(costs.searched(pathlib.Path(EXAMPLES), command, "255")[2], claims.largest(command), 1)


class Diagrams(unittest.TestCase):
    def test_a_short_diagram_is_the_same(self):
        """Each point within a tenth: half of it by the outline's beginning, half by the point's place from there."""
        whole = claims.run("Vectors --figure ambient -o - --format svg").decode()
        short = svg.shorten(whole)
        paths = [list(map(self.points, re.findall(r' d="([^"]*)"', text))) for text in (whole, short)]
        self.assertGreater(sum(map(len, paths[0])), 5000)
        for one, other in zip(*paths, strict=True):
            for a, b in zip(one, other, strict=True):
                self.assertLess(max(abs(a[0] - b[0]), abs(a[1] - b[1])), 0.1001)
        self.assertEqual(*(re.sub(' d="[^"]*"', "", text) for text in (whole, short)))
        self.assertLess(3 * len(gzip.compress(short.encode())), len(gzip.compress(whole.encode())))

    @staticmethod
    def points(path):
        """Of all commands, in absolute coordinates."""
        found, at = [], (0, 0)
        for command, rest in re.findall("([A-Za-z])([^A-Za-z]*)", path):
            values = list(map(float, re.findall(r"-?(?:\d+\.?\d*|\.\d+)", rest)))
            from_ = at if command.islower() else (0, 0)
            places = [(x + from_[0], y + from_[1]) for x, y in zip(values[::2], values[1::2])]
            found += places
            start = places[0] if command == "M" else start
            at = places[-1] if places else start
        return found


class Formulas(unittest.TestCase):
    def test_what_a_pixel_fills_in_is_known(self):
        """Terms of the lighting equation as terms.js names them, corners and variables of the shaders."""
        terms = set("k_a k_d k_s k_g i_a i_d i_s I_a I_d I_s I e g t f h α w gl_FragColor N V L R H N·L R·V N·H A B C ABC bytes".split())
        shaders = "".join(path.read_text(encoding="utf-8") for path in book.SHADERS.rglob("*.*"))
        for chapter in CHAPTERS:
            for text in book.AT.findall(chapter.text):
                for name in re.findall(r"{(.*?)}", text):
                    with self.subTest(chapter.path.name, name=name):
                        self.assertTrue(name in terms or re.search(rf"\b(?:vec\d|float) {name.rstrip('=')}\b", shaders))

    def test_each_formula_has_its_numbers(self):
        """But for those whose vectors only diagrams have, and matrices."""
        for chapter in CHAPTERS:
            if any(figure.live for figure in chapter.figures):
                with self.subTest(chapter.path.name):
                    self.assertEqual(len(book.AT.findall(chapter.text)), len(re.findall(r"^\$\$.*\$\$$", chapter.text, re.MULTILINE)))


class Text(unittest.TestCase):
    def test_the_chapters_are_in_order(self):
        self.assertEqual([chapter.number for chapter in CHAPTERS], list(range(1, len(CHAPTERS) + 1)))

    def test_a_chapter_is_400_to_900_words(self):
        for chapter in CHAPTERS:
            text = re.sub(r"\$\$.*?\$\$|<!--.*?-->|\]\((?:program|change|formula)[^)]*\)", "", chapter.text, flags=re.DOTALL)
            words = len(book.plain(text).split())
            with self.subTest(chapter.path.name, words=words):
                self.assertTrue(400 <= words <= 900)

    def test_a_chapter_has_a_hard_case(self):
        """Under a heading of its own, but in the chapter of nothing else."""
        without = [chapter.title for chapter in CHAPTERS if "A hard case" not in dict(chapter.sections())]
        self.assertEqual(without, ["When formulas fail"])

    def test_each_lab_is_in_one_chapter(self):
        labs = [lab for chapter in CHAPTERS for lab in sorted(set(re.findall(r"\]\(\.\./labs/(lab\w+)/", chapter.text)))]
        self.assertEqual(sorted(labs), sorted(path.parent.name for path in pathlib.Path(SOURCE, "examples/labs").glob("lab*/TASK.md")))

    def test_links_lead_somewhere(self):
        for chapter in CHAPTERS:
            for target in re.findall(r"\]\((?!program|change|precision|formula)([^)#]+)[^)]*\)", chapter.text):
                with self.subTest(chapter.path.name, target=target):
                    self.assertTrue((book.FOLDER / target).exists() or re.fullmatch(r"\w+\.html", target))


class Places(unittest.TestCase):
    def test_every_heading_of_the_originals_has_a_place(self):
        found, unknown = book.places()
        self.assertEqual([heading for heading, where in found.items() if not where], [])
        self.assertEqual(unknown, [])

    def test_the_table_is_that_of_the_book(self):
        table = subprocess.run([sys.executable, "-B", os.path.join(SOURCE, "examples/web/book.py"), "--places"], check=True,
                               stdout=subprocess.PIPE, text=True).stdout
        with open(os.path.join(SOURCE, "examples/README.md"), encoding="utf-8") as file:
            self.assertIn(table.strip(), file.read(), "examples/README.md: tests/tables book.py writes the table")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
