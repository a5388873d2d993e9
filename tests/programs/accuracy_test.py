#!/usr/bin/env python3
"""The study `accuracy` and the option --error: results, files and messages.

usage: accuracy_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

No test depends on speed. Exit code: 77 without a driver.
"""
import csv
import io
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import command_line_test as base

QUICK = ("--quick", "-s", "48x48")


class Study(base.Case):
    @classmethod
    def setUpClass(cls):
        """A cache of the tests' own, but Mesa's: to compile shaders takes half of a survey's time."""
        cache = tempfile.mkdtemp(prefix="accuracy_test-")
        cls.addClassCleanup(shutil.rmtree, cache)
        cls.own = {"XDG_CACHE_HOME": cache, "MESA_SHADER_CACHE_DIR":
                   os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")}

    def accuracy(self, *arguments, **more):
        return self.good(*arguments, program="accuracy", environment=self.own, **more).decode()

    def wrong(self, code, said, *arguments, program="accuracy", **more):
        more.setdefault("environment", self.own)
        return self.refused(code, rf"^{program}: {said}", *arguments, program=program, **more)

    def rows(self, folder="accuracy"):
        text = self.read(f"{folder}/results.csv").decode()
        return list(csv.DictReader(io.StringIO(text, newline="")))


class Surveys(Study):
    made = None  # what the survey of the cube prints, and its files

    def set_noise(self, noise):
        """As if the survey in the folder had been measured with this noise; returns what it says."""
        head, *rows = self.read("accuracy/results.csv").decode().splitlines()
        at = head.split(",").index("noise")
        rows = [",".join([*row.split(",")[:at], noise, *row.split(",")[at + 1:]]) for row in rows]
        self.make("accuracy/results.csv", "\n".join([head, *rows, ""]))
        return self.accuracy("--scene", "cube", *QUICK)

    def survey(self):
        """A survey of the cube as on an idle machine, made for the first test that asks and copied for
        the others."""
        if not Surveys.made:
            self.accuracy("--scene", "cube", *QUICK)
            text = self.set_noise("0.05")
            names = os.listdir(self.path("accuracy"))
            Surveys.made = text, {name: self.read(f"accuracy/{name}") for name in names}
        text, files = Surveys.made
        for name, content in files.items():
            self.make(f"accuracy/{name}", content)
        return text

    def test_help_tells_scenes_axes_and_files(self):
        text = self.accuracy("--help")
        for word in ("--budget", "--time-budget", "--quick", "shiny128",
                     "[phong] gouraud flat", "results.csv", "Try:"):
            self.assertIn(word, text)
        self.assertNotIn("--samples", text)
        self.assertEqual(self.everything(), {})

    @base.in_long_form
    def test_a_bound_is_proved_for_all_points(self):
        text = self.accuracy("--prove", "sphere", "-s", "100x100")
        self.assertRegex(text, r"^sphere, 100 rows\nhighp:\n  object 1: at most 0\.\d+ steps")
        self.assertRegex(text, r"\nmediump:\n  object 1: at most .* of them from .*triangles in \d+ pieces")
        self.assertIn("Assumed: the errors that were measured of ", text)
        self.assertEqual(self.everything(), {})
        text = self.accuracy("--prove", "sphere", "-s", "100x100", "--cameras", "-1:1,0:0.5")
        self.assertRegex(text, r"object 1: at most [0-9.]+ steps .*, near --orbit ")
        self.wrong(2, "--cameras: goes with --prove", "--cameras", "0:1,0:1")
        for bad in "0:1", "1:0,0:1", "0:1,0:1,0:1", "0:1,0:1x", "0:nan,0:1":
            self.wrong(2, f"--cameras {bad}: must be ranges", "--prove", "sphere", "--cameras", bad)
        self.wrong(2, "--prove: names its scene", "--prove", "sphere", "--scene", "cube")

    @base.in_long_form
    def test_a_scene_gives_table_rows_plots_and_sheets(self):
        text = self.survey()
        self.assertLessEqual(text.count("\n"), 12)
        self.assertRegex(text, r"^llvmpipe.*: 1 scene; half the times")
        self.assertRegex(text, r"\ncube: 0\.5 steps: Phong interpolation [\d.]+ ms, Gouraud [\d.]+ ms")
        self.assertRegex(text, r"\nmediump +[# ]{7}\|[# ]{7} [a-z:, ]+ \(time x [\d.]+; error \+0\.\d steps, cube\)\n")
        self.assertRegex(text, r"\n4 samples .* rms error \d+\.\d to \d+\.\d, cube\)\n")
        page = self.read("accuracy/index.html").decode()
        for name, verdict, time in re.findall(r"\n([\w ]+?) +[# ]{7}\|[# ]{7} (.*?) \((time x [^;]*); ", text):
            self.assertIn(f"<p><b>{name}</b>: {verdict}</p>", page)
            self.assertIn(f"<p>{time}<br>", page)
        for name in "mediump", "shadows":
            self.assertIn(f'<img src="glance-{name}.png" ', page)
            self.assertEqual(self.png(f"accuracy/glance-{name}.png").width, 2 * 240 + 8)
        self.assertRegex(text, r"\nBlinn-Phong: \d+ to \d+ steps .*\naccuracy/index\.html: .*table\.txt.*\n$")
        rows = self.rows()
        self.assertEqual(len(rows), 15)
        self.assertEqual({row["scene"] for row in rows}, {"cube"})
        self.assertEqual({row["seed"] for row in rows}, {"1"})
        # A flat cube, lit at every fragment by 32-bit floats: rounding to 8 bits is all there is.
        usual = [row for row in rows if row["precision"] == "highp" and
                 row["output"] == "nearest" and row["interpolation"] == "phong" and
                 row["samples"] == "0" and row["supersample"] == "1"]
        self.assertGreater(len(usual), 2)
        for row in usual:
            self.assertLess(float(row["interior_maximum"]), 0.51)
            self.assertGreater(float(row["time"]), 0)
        for row in rows:
            self.assertGreater(int(row["vertex_operations"]), 0, row)
            self.assertGreaterEqual(int(row["fragment_operations"]), 0, row)
        sheet = self.png("accuracy/cube-usual.png")
        self.assertGreater(len(set(zip(*[iter(sheet.pixels)] * sheet.channels))), 50)
        for name in ("cube.png", "cube.svg", "finding-precision.svg",
                     "finding-shadows-sphere.png", "finding-shadows-sphere.svg",
                     "finding-shadows-sphere-time.png", "finding-shadows-sphere-time.svg"):
            self.assertGreater(len(self.read("accuracy/" + name)), 500)

    def on_screen(self, columns, **environment):
        """The first screen on a terminal: rows of characters, each with its two colours, and the text alone. Without
        gnuplot, which would take half of the time."""
        clean = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "COLORTERM")}
        code, said = base.on_terminal(
            [os.path.join(base.EXAMPLES, "accuracy"), "--scene", "cube", *QUICK], "stdout", columns, cwd=self.folder,
            env={**clean, **self.own, "PATH": "", "TERM": "xterm", **environment})
        self.assertEqual(code, 0, said)
        rows, colors = [[]], {}
        for escape, character in re.findall(r"\x1b\[([\d;]+)m|([^\x1b\r])", said):
            codes = [int(code) for code in escape.split(";") if code]
            if codes == [0]:
                colors = {}
            elif codes and codes[0] in (38, 48):
                colors = {**colors, codes[0]: codes[1:]}
            elif character == "\n":
                rows.append([])
            elif character:
                rows[-1].append((character, colors.get(38), colors.get(48)))
        return rows, "\n".join("".join(cell[0] for cell in row) for row in rows), said

    def cells(self, rows, text, across):
        """The pixels of each picture on the screen, by the name of its file."""
        lines = text.split("\n")
        top = next(number for number, line in enumerate(lines) if "\u2580" in line)
        for cell in range(6):
            first, left = top + 5 * (cell // across), 40 * (cell % across)
            name = lines[first][left + 10:left + 28].strip().lower()
            file = [file for file in ("mediump", "gouraud", "samples", "viewer", "guards", "shadows") if file in name]
            halves = [[spot[half] for spot in rows[first + line][left:left + 9]] for line in range(5) for half in (1, 2)]
            self.assertEqual(halves.pop(), 9 * [None], name)  # the gap below
            yield file[0], halves

    @base.in_long_form
    def test_a_terminal_shows_the_pages_pictures(self):
        """Each pixel has the lightest colour of the part of the page's picture that it stands for: in 24 bits that colour;
        of the 256, one of a cube whose values are at most 95 apart, so that rounding is off by 48 at most."""
        def lightness(color):
            return 2 * color[0] + 7 * color[1] + color[2]

        def color_of(codes):
            if codes[0] == 2:
                return codes[1:]
            if codes[1] >= 232:
                return 3 * [8 + 10 * (codes[1] - 232)]
            return [(0, 95, 135, 175, 215, 255)[(codes[1] - 16) // place % 6] for place in (36, 6, 1)]

        self.survey()
        for across, off, more in (2, 0, {"COLORTERM": "truecolor"}), (3, 48, {}):
            rows, text, _ = self.on_screen(40 * across, **more)
            self.assertLessEqual(max(len(line) for line in text.split("\n")), 40 * across)
            self.assertLessEqual(text.count("\n"), 24)
            shown = dict(self.cells(rows, text, across))
            self.assertEqual(len(shown), 6)
            self.assertGreater(len({str(pixel) for row in shown["mediump"] for pixel in row}), 3)
            for name, pixels in shown.items():
                page = self.png(f"accuracy/glance-{name}.png")
                for at in range(81):
                    spots = [(y * page.width + 248 + x) * page.channels for y in range(at // 9 * 240 // 9, (at // 9 + 1) * 240 // 9)
                             for x in range(at % 9 * 240 // 9, (at % 9 + 1) * 240 // 9)]
                    part = [page.pixels[spot:spot + 3] for spot in spots]
                    most = max(map(lightness, part))
                    found = color_of(pixels[at // 9][at % 9])
                    self.assertTrue(any(lightness(color) == most and max(abs(a - b) for a, b in zip(color, found)) <= off
                                        for color in part), (name, at, found))

    @base.in_long_form
    def test_pictures_are_for_terminals_with_colours_and_room(self):
        printed = self.survey()
        self.assertNotIn("\u2580", printed)
        for columns, more in ((80, {"NO_COLOR": "1"}), (59, {}), (80, {"TERM": "dumb"})):
            _, text, said = self.on_screen(columns, **more)
            self.assertNotIn("\x1b", said)
            self.assertEqual([line[:34] for line in text.split("\n")][1:6], [line[:34] for line in printed.split("\n")][1:6])

    def test_a_scene_of_your_own_is_surveyed(self):
        self.good("--save-scene", "own.gltf", program="SpotLight")
        self.assertRegex(self.accuracy("--scene-file", "own.gltf", *QUICK), r"^file-[0-9a-f]{12}, 48x48; ")
        rows = self.rows()
        self.assertEqual(len({row["scene"] for row in rows}), 1)
        self.assertEqual({row["divisions"] for row in rows}, {rows[0]["divisions"]})
        self.assertTrue({"mediump", "highp"} <= {row["precision"] for row in rows})
        self.assertTrue({"gouraud", "phong"} <= {row["interpolation"] for row in rows})
        self.wrong(1, "none.glb: No such file", "--scene-file", "none.glb", *QUICK)
        self.wrong(2, "--scene and --scene-file: one", "--scene-file", "own.gltf", "--scene", "cube", *QUICK)

    @base.in_long_form
    def test_shadows_are_measured_by_each_way(self):
        self.survey()
        # Of each way and size: the error near edges, of all pixels, pixels that are wrong, times.
        rows = re.findall(r"\nsphere {2,}(\w[^:\n]*?)(?:: (\d+))? {2,}([\d.]+) +([\d.]+) +(\d+) +([\d.]+) \[.*?\] +([\d.]+) \[",
                          self.read("accuracy/table.txt").decode())
        self.assertEqual([row[:2] for row in rows], [("volumes", ""), *((name, size) for name in ("map", "map, 2x2")
                                                                        for size in ("64", "512", "4096"))])
        for row in rows:
            self.assertGreater(min(float(row[5]), float(row[6])), 0, row)
        self.assertEqual(rows[0][4], "0")
        for of_sizes in rows[1:4], rows[4:]:
            errors = [float(row[2]) for row in of_sizes]
            self.assertEqual(errors, sorted(errors, reverse=True), of_sizes)
            self.assertGreater(errors[0], 2 * float(rows[0][2]), of_sizes)
        for name in ("", "-time"):  # every way is a line of the plot
            plot = self.read(f"accuracy/finding-shadows-sphere{name}.svg").decode()
            for word in ("map", "2x2", "volumes", "4096"):
                self.assertIn(word, plot, name)

    @base.in_long_form
    def test_the_page_has_sentence_and_plots(self):
        self.survey()
        page = self.read("accuracy/index.html").decode()
        for part in (r'<section id="cube">', r'class="says">0\.5 steps: Phong interpolation ',
                     r'<img src="cube\.svg" alt="Error over time of the settings of cube; [^"]+" ',
                     r'<a href="cube\.png">', r"<h2>Conclusions</h2>",
                     r'<a href="table\.txt">'):
            self.assertRegex(page, part)
        self.assertNotRegex(page, r"https?:|src=\"//|<script src|<link|@import|<img(?![^>]* alt=\"[^\"])")
        for name in re.findall(r'(?:href|src)="([^"]+)"', page):
            self.assertTrue(os.path.exists(self.path("accuracy/" + name)), name)

    @base.in_long_form
    def test_plots_can_be_read_and_show_pictures(self):
        self.survey()
        for name in os.listdir(self.path("accuracy")):
            if not name.endswith(".svg"):
                continue
            plot = self.read("accuracy/" + name).decode()
            sizes = {float(size) for size in re.findall(r'font-size="([\d.]+)"', plot)}
            self.assertGreaterEqual(min(sizes), 700 / 40, name)
            if name == "cube.svg":
                self.assertRegex(plot, r"href='data:image/png;base64,")
                self.assertNotRegex(plot, r"href='(?!data:|#)")
        pins = [name for name in os.listdir(self.path("accuracy")) if "-pin-" in name]
        self.assertIn("cube-pin-1.png", pins)
        self.assertLessEqual(len(pins), 5)
        self.assertEqual(self.png("accuracy/cube-pin-1.png").width, 2 * 240 + 8)

    @base.in_long_form
    def test_times_of_a_busy_machine_are_compared_nowhere(self):
        self.survey()
        text = self.set_noise("0.2")
        page, plot, table = (self.read("accuracy/" + name).decode()
                             for name in ("index.html", "cube.svg", "table.txt"))
        self.assertRegex(text, r"^llvmpipe.*: the machine was busy in 1 of 1 scenes: ")
        self.assertRegex(text, r"\nmediump {19}\|.* \(time: too noisy to tell; ")
        self.assertNotRegex(text, r"time x|\| *#|# *\|")
        self.assertNotIn('<i class="', page)
        self.assertNotRegex(text + page, r"Phong interpolation [\d.]+ ms")
        self.assertRegex(page, r'<p class="busy">llvmpipe.*: the machine was busy in 1 of 1 scenes: ')
        self.assertNotRegex(page, r"efficient ones|finding-(guards|interpolation)")
        self.assertNotRegex(plot, ">efficient<|<image")
        self.assertIn("The machine was busy", plot)
        self.assertNotRegex(table.split("\n\nmodel")[0], r"\n[*=] ")
        self.assertEqual([name for name in os.listdir(self.path("accuracy")) if "-pin-" in name], [])

    @base.in_long_form
    def test_two_folders_are_compared_row_by_row(self):
        self.survey()
        text = self.read("accuracy/results.csv").decode()
        head, *rows = text.splitlines()
        names = head.split(",")
        for number, row in enumerate(csv.reader(rows)):
            if row[names.index("precision")] == "mediump":  # twice as slow, and 3 steps worse
                for name in ("time", "time_lower", "time_upper", "run_1", "run_2", "run_3"):
                    row[names.index(name)] = str(40 * float(row[names.index(name)]))
                row[names.index("interior_maximum")] = str(3 + float(row[names.index("interior_maximum")]))
                rows[number] = ",".join([f'"{cell}"' if "," in cell else cell for cell in row[:-1]] + [f'"{row[-1]}"'])
        self.make("other/results.csv", "\n".join([head, *rows, ""]))
        files = self.everything()
        said = self.accuracy("--compare", "accuracy", "other")
        self.assertNotIn("\ncube: interpolation=gouraud divisions=12 ", said)
        self.assertRegex(said, r"\n15 settings are in both; 1 have another error in B, most of all cube: precision=mediump\n")
        self.assertRegex(said, r"\ncube: precision=mediump +\d\.\d\d +\d\.\d\d +\+3\.00 .* x 40\.00, ")
        self.assertRegex(said, r"\ncube: guards=off .* \+0\.00 .* the same\n")
        self.assertIn("\ncube: interpolation=gouraud divisions=12 ", self.accuracy("--compare", "accuracy", "other", "--all-rows"))
        self.assertEqual(self.everything(), files)
        self.wrong(2, "--compare a: needs one other folder", "--compare", "a")
        self.wrong(2, "b: not an option", "b")
        self.wrong(1, "none/results.csv: has no results", "--compare", "none", "accuracy")

    @base.in_long_form
    def test_existing_rows_are_not_measured_again(self):
        self.survey()
        before = self.read("accuracy/results.csv")
        text = self.accuracy("--scene", "cube", "--markdown", *QUICK)
        self.assertEqual(self.read("accuracy/results.csv"), before)
        self.assertRegex(text, r"^.* cores; .*; LP_NUM_THREADS .*\n\n")
        for head in ("divisions | Phong: error", "scene | usual: error", "antialiasing |",
                     "model | s |", "setting | ns |", "scene | shadows |"):
            self.assertRegex(text, rf"\n\| {re.escape(head)}.*\n\|---")
        self.assertRegex(text, r"\n\| cube \| 0\.50 \| [\d.]+ \|")
        self.accuracy("--scene", "cube", "--fresh", "--seed", "7", *QUICK)
        self.assertEqual({row["seed"] for row in self.rows()}, {"7"})

    @base.in_long_form
    def test_broken_rows_are_named_and_measured_again(self):
        self.survey()
        lines = self.read("accuracy/results.csv").splitlines(keepends=True)
        taken = self.rows()[0]["time"].encode()  # by the usual setting, the measure of all
        lines[1] = lines[1].replace(b"," + taken + b",", b",,", 1)
        lines[3] = lines[3].replace(b",", b";")
        lines[-1] = lines[-1][:40]  # cut, as by a full disk
        self.make("accuracy/results.csv", b"".join(lines))
        result = self.run_it("--scene", "cube", *QUICK, program="accuracy", environment=self.own)
        error = result.stderr.decode()
        self.assertEqual(result.returncode, 0, error)
        self.assertRegex(error, r"accuracy/results\.csv:4: ")
        self.assertRegex(error, rf"accuracy/results\.csv:{len(lines)}: ")
        self.assertEqual(error.count("\n"), 2)
        now = self.read("accuracy/results.csv")
        for line in lines[:3] + lines[4:-1]:
            self.assertIn(line, now)
        rows = [row for row in self.rows() if row["threads"]]  # the last column
        # 13 of the 15 were whole. Times are relative to the usual setting's: without it all are
        # measured again.
        self.assertEqual([row["time"] == "" for row in rows], [True] + (12 + 15) * [False])

    @base.in_long_form
    def test_an_interrupted_survey_goes_on(self):
        """Twice; to the end: test_killed_parts_go_on, and from broken rows."""
        command = [os.path.join(base.EXAMPLES, "accuracy"), "--scene", "shiny8", "-s", "32x32"]
        path = self.path("accuracy/results.csv")
        before = b"-" * 500
        for again in (False, True):
            process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, env={**os.environ, **self.own})
            deadline = time.monotonic() + base.PATIENCE
            while not (os.path.exists(path) and os.path.getsize(path) > len(before)):
                self.assertIsNone(process.poll())
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            out, error = process.communicate(timeout=base.PATIENCE)
            self.assertEqual((process.returncode, out), (1, b""))
            self.assertRegex(error.decode(), r"^accuracy: interrupted; \d+ of \d+ rows are in "
                                             r"accuracy/results\.csv; the same command goes on\n$")
            after = self.read("accuracy/results.csv")
            self.assertTrue(not again or after.startswith(before))
            before = after

    @base.in_long_form
    def test_parts_are_merged_into_the_rows_of_one_survey(self):
        """Parts made of one survey's rows, the second from a machine that takes twice the time."""
        self.survey()
        draw = ("--scene", "cube", *QUICK, "--merge", "-o", "parts")
        one = self.read("accuracy/results.csv")
        head, usual, *rows = one.splitlines(keepends=True)
        timed = {i for i, name in enumerate(head.decode().strip().split(","))
                 if re.search("time|run_", name)}

        def doubled(row):
            fields = next(csv.reader([row.decode()]))
            text = io.StringIO()
            csv.writer(text, lineterminator="\n").writerow(
                [repr(2 * float(field)) if i in timed and field else field
                 for i, field in enumerate(fields)])
            start, _, renderer = text.getvalue().rpartition(",")
            return f'{start},"{renderer.strip()}"\n'.encode()

        os.mkdir(self.path("parts"))
        self.wrong(1, "parts: has no results of parts", *draw)
        self.make("parts/results-1-of-2.csv", head + usual + b"".join(rows[1::2]))
        second = [doubled(row) for row in (usual, *rows[0::2])]
        self.make("parts/results-2-of-2.csv", head + b"".join(second[:-1]))
        self.wrong(1, "parts: 1 rows of its part 2/2 are missing; run it to the end", *draw)
        self.make("parts/results-2-of-2.csv", head + b"".join(second) + second[-1][:50])
        os.mkdir(self.path("bin"))  # without gnuplot
        result = self.run_it(*draw, program="accuracy",
                             environment={**self.own, "PATH": self.path("bin")})
        self.assertEqual(result.returncode, 0, result.stderr)  # says that a row is cut
        self.assertIn(b"cube", result.stdout)
        self.assertEqual(self.read("parts/results.csv").decode(), one.decode())
        self.wrong(1, r"parts/results\.csv: has rows already; --fresh drops them", *draw)
        self.make("parts/results-1-of-3.csv", head)
        self.wrong(1, "parts: has parts of . and of .; remove", *draw, "--fresh")

    @base.in_long_form
    def test_killed_parts_go_on(self):
        self.survey()
        dice = random.Random(int(os.environ.get("LIGHTING_TEST_SEED", 1)))
        draw = ("--scene", "cube", *QUICK, "-o", "parts")
        for part in ("1/2", "2/2"):
            for _ in range(6):
                process = subprocess.Popen(
                    [os.path.join(base.EXAMPLES, "accuracy"), *draw, "--part", part],
                    cwd=self.folder, stderr=subprocess.PIPE, env={**os.environ, **self.own})
                try:
                    process.communicate(timeout=dice.uniform(0, 6))
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.communicate()
            # Both say on standard error which rows were cut by a kill.
            for last in (("--part", part), *((("--merge",),) if part == "2/2" else ())):
                result = self.run_it(*draw, *last, program="accuracy", environment=self.own)
                self.assertEqual(result.returncode, 0, result.stderr)
        measured = re.compile("time|run_|noise")
        one, merged = ([{key: value for key, value in row.items() if not measured.search(key)}
                        for row in self.rows(folder)] for folder in ("accuracy", "parts"))
        self.assertEqual(one, merged)

    @base.in_long_form
    def test_without_gnuplot_the_rest_is_there(self):
        self.survey()
        for name in os.listdir(self.path("accuracy")):
            if name != "results.csv":
                os.remove(self.path("accuracy", name))
        os.mkdir(self.path("bin"))
        printed = self.says(0, r"(?s)^renderer: .*accuracy: no plots: .*gnuplot-nox\n$", "--scene", "cube", "--verbose",
                            *QUICK, program="accuracy", environment={**self.own, "PATH": self.path("bin")})
        for table in printed.stdout.decode(), self.read("accuracy/table.txt").decode():
            self.assertRegex(table, r"cube, 48x48; .*LP_NUM_THREADS")
            self.assertRegex(table, r"\n[*]")
            self.assertRegex(table, r"Blinn-Phong, fitted")
            self.assertRegex(table, r"matrices=compensated order=lecture")
        found = os.listdir(self.path("accuracy"))
        for name in ("results.csv", "table.txt", "cube-usual.png"):
            self.assertIn(name, found)
        self.assertNotIn("cube.svg", found)

    def test_one_setting_is_measured_and_shown(self):
        text = self.accuracy("--scene", "sphere", "--setting",
                             "interpolation=gouraud divisions=12", "-s", "64x64")
        self.assertIn("interpolation=gouraud", text)
        self.assertTrue(text.endswith("accuracy/sphere-setting.png\n"))
        self.assertEqual(os.listdir(self.path("accuracy")), ["sphere-setting.png"])

    def test_usage_errors_and_failures_are_said(self):
        for said, *arguments in (
                (r"--scene shiny: there is none; did you mean shiny8\?", "--scene", "shiny"),
                (r"--scene nothing: must be sphere, cube", "--scene", "nothing"),
                (r"--setting: flat: must be AXIS=CHOICE", "--scene", "cube", "--setting", "flat"),
                (r"--setting: divisions=5: must be one of 6, 8", "--scene", "cube", "--setting",
                 "divisions=5"),
                (r"--budget: needs a scene", "--budget", "1"),
                (r"--time-budget: needs a scene", "--time-budget", "1"),
                (r"--part 3/2: must be I/N", "--part", "3/2"),
                (r"--part and --merge: one of them", "--part", "1/2", "--merge"),
                (r"--part: goes with a survey", "--part", "1/2", "--scene", "cube", "--setting",
                 "usual"),
                (r"--setting: needs a scene", "--setting", "usual"),
                (r"--budget and --time-budget: one of them", "--scene", "cube", "--budget", "1",
                 "--time-budget", "1"),
                (r"--budget -2: must be a number", "--scene", "cube", "--budget=-2"),
                (r"--budget -0\.5: must be 0 or more, or -1", "--scene", "cube", "--budget=-0.5"),
                (r"--time-budget -0\.5: must be", "--scene", "cube", "--time-budget=-0.5"),
                (r"--fresh: --setting keeps no rows", "--scene", "cube", "--setting", "usual",
                 "--fresh"),
                (r"--rms: goes with", "--scene", "cube", "--rms"),
                (r"--output -: a study is a folder", "-o", "-"),
                (r"--samples: no such option", "--samples", "4"),
                (r"x: not an option", "x")):
            self.wrong(2, said, *arguments)
        self.make("file")
        self.wrong(1, "file: exists and is not a folder", "-o", "file")
        self.says(1, r"^accuracy: EGL: .*LIBGL_DRIVERS_PATH.*: unset it\n$", "-o", "new",
                  program="accuracy", environment={**self.own, **base.NO_DRIVER})
        os.makedirs(self.path("other"))
        self.make("other/results.csv", "name,age\nme,7\n")
        self.wrong(1, r"other/results\.csv", "-o", "other", "--scene", "cube", *QUICK)
        os.makedirs(self.path("odd/results.csv"))
        self.wrong(1, r"odd/results\.csv", "-o", "odd", "--scene", "cube", *QUICK)

    def test_a_full_disk_keeps_the_rows_before_it(self):
        os.mkdir(self.path("accuracy"))
        os.symlink("/dev/full", self.path("accuracy/results.csv"))
        self.says(1, r"^accuracy: accuracy/results\.csv: .*\n$", "--scene", "cube", *QUICK,
                  program="accuracy", environment=self.own)


class Choices(Study):
    @base.in_long_form
    def test_the_cheapest_within_a_budget_is_named_and_confirmed(self):
        text = self.accuracy("--scene", "sphere", "--budget", "8", *QUICK)
        busy = r"the machine is busy: .*; none is compared\nmost usual: "
        for part in (rf"^(cheapest: (.*\n)+(the next cheaper: |there is none|measured)|{busy})",
                     r"\nmeasured with .*LP_NUM_THREADS default, 48x48, seed 1\n$"):
            self.assertRegex(text, part)
        for error in text.split("largest error ")[1:2]:
            self.assertLessEqual(float(error.split()[0]), 8)
        self.assertRegex(self.accuracy("--scene", "sphere", "--budget", "1", "--rms", *QUICK),
                         rf"^(cheapest|{busy[:-2]}): .*\n  rms error ")

    @base.in_long_form
    def test_a_budget_out_of_reach_says_the_best(self):
        said = r"--budget 0: no setting of sphere is so exact; the best has 0\.\d+$"
        self.says(1, "^accuracy: " + said, "--scene", "sphere", "--budget", "0", *QUICK,
                  program="accuracy", environment=self.own)

    @base.in_long_form
    def test_the_most_exact_within_a_time_is_named(self):
        text = self.accuracy("--scene", "sphere", "--time-budget", "1000000", *QUICK)
        self.assertRegex(text, r"^(the machine is busy: .*\n)?most exact: .*\n")
        self.assertNotIn("the next slower", text)
        self.says(1, r"no setting of sphere is so fast; the best takes", "--scene", "sphere",
                  "--time-budget", "0", *QUICK, program="accuracy", environment=self.own)

    @base.in_long_form
    def test_error_says_what_it_leaves_away(self):
        for error in ("1", "30"):
            self.says(0, rf"view 0: .*; error [\d.]+ of {error} allowed inside objects "
                      r"\(plain: [\d.]+\), expected cost \d+ \(plain: \d+\); not counted, but off by more than .*; [\d.]+ of the plain time\n", "--error", error, "-v",
                      "-o", error + ".png", program="ShadingModels", environment=self.own)
        self.assertNotEqual(self.png("1.png").pixels, self.png("30.png").pixels)
        self.says(0, "view 0: .*; [\\d.]+ of the plain time; from the cache\n", "--error", "30", "-v",
                  "-o", "again.png", program="ShadingModels", environment=self.own)
        self.assertEqual(self.png("again.png").pixels, self.png("30.png").pixels)

    def test_error_says_what_does_not_count(self):
        # A coarser torus moves its shadow; the plain picture's is right.
        options = ("-t", "6.11", "-s", "130x130", "--orbit=-55.1,-35.3,1.5", "--spot", "off",
                   "--error", "4")
        said = (r"not counted, but off by more than 4: (\d+) of \d+ pixels inside objects, at edges of "
                r"shadows, by up to [\d.]+ \(plain: \d+.*?\); \d+ pixels at outlines, by up to "
                r"[\d.]+ \(plain: \d+, by up to [\d.]+\)")
        verbose = self.says(0, said, *options, "-v", "-o", "x.png", program="Shadows",
                            environment=self.own).stderr.decode()
        explained = self.run_it(*options, "--explain", program="Shadows",
                                environment=self.own).stdout.decode()
        found = re.search(said, verbose)
        self.assertGreater(int(found[1]), 0)
        self.assertIn(found[0], " ".join(explained.split()))

    @base.in_long_form
    def test_each_way_of_shadows_has_a_choice_of_its_own(self):
        choices = [self.run_it("--spot", "off", "--point", "off", "--error", "8", "-v", "--shadows", way,
                               "-s", "40x40", "-o", "x.png", program="Shadows", environment=self.own).stderr.decode()
                   for way in ("map:16", "volumes", "map:16")]
        self.assertEqual(["from the cache" in choice for choice in choices], [False, False, True])

    @base.in_long_form
    def test_error_draws_the_best_where_it_cannot_be_kept(self):
        self.says(0, r"^ShadingModels: --error 0.001 is unreachable: the best is 0\.\d+, inside "
                  r"objects; drawing that\n$", "--error", "0.001", "-s", "40x40",
                  program="ShadingModels", environment=self.own)
        # One line for three views.
        self.says(0, r"^PhongBlinn: --error 0.001 is unreachable: the best is 0\.\d+, inside "
                  r"objects of view \d; drawing that\n$", "--error", "0.001", "-s", "60x40",
                  program="PhongBlinn", environment=self.own)
        self.wrong(2, "--error -1: must be", "--error=-1", program="ShadingModels")
        self.wrong(2, "--error: no such option", "--error", "1", program="LightedCube",
                   lines=1)

    @base.in_long_form
    def test_error_keeps_the_options_that_are_given(self):
        for more in (["--interpolation", "flat"], ["--interpolation", "phong"],
                     ["--interpolation", "gouraud"], ["--precision", "mediump"]):
            text = self.says(0, "view 0: ", "--error", "16", "-v", "-s", "50x50", *more,
                             program="ShadingModels", environment=self.own).stderr.decode()
            self.assertNotRegex(text, "lit per")
            self.assertEqual("mediump" in more, "precision of fragment shaders: mediump" in text)
        simpler = r"lights (at infinity|without highlight|off)"
        for more, found in ([], True), (["--red", "on"], False), (["--terms", "diffuse"], False):
            text = self.says(0, "view 0: ", "--error", "16", "-v", "-s", "40x30", *more,
                             program="FourLights", environment=self.own).stderr.decode()
            self.assertEqual(bool(re.search(simpler, text)), found, more)

    @base.in_long_form
    def test_without_a_cache_error_draws_the_same(self):
        self.make("file", "no folder")
        pictures = []
        for number, cache in enumerate((self.path("cache"), self.path("file"), "", "/dev/null")):
            # Mesa says where it keeps no shaders.
            self.says(0, "^", "--error", "8", "-s", "100x100", "-o", f"{number}.png", program="SpotLight",
                      environment={"XDG_CACHE_HOME": cache, "HOME": ""})
            pictures.append(self.png(f"{number}.png").pixels)
        self.assertEqual(pictures, pictures[:1] * 4)

    def test_an_animation_keeps_its_error_by_one_choice(self):
        text = self.says(0, r"at 17 moments, and [\d.]+ in reserve", "--error", "8", "-s", "80x80",
                         "-v", "-n", "60", "-o", "x%d.png", program="SpotLight",
                         environment=self.own).stderr.decode()
        self.assertEqual(text.count("view 0: "), 1)


if __name__ == "__main__":
    sys.exit(base.main())
