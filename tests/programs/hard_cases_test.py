#!/usr/bin/env python3
"""The study `hard_cases` as it is used: what it draws, says and refuses.

usage: hard_cases_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

No test depends on how long anything takes. Exit code: 77 where nothing can be drawn.
"""
import os
import re
import struct
import sys
import unittest

import command_line_test as base

PROGRAM = "hard_cases"
SMALL = ("-s", "70x54")


def width(panel):
    """Of a sheet of one case: margins, panels, text."""
    return 2 * 28 + 3 * (panel + 8) + 372


def shader(name):
    with open(os.path.join(base.SOURCE, "shaders", name), encoding="utf-8") as file:
        return [line.strip() for line in file]


class Study(base.Case):
    def hard_cases(self, *arguments, **more):
        return self.good(*arguments, program=PROGRAM, **more).decode()

    def wrong(self, code, said, *arguments, **more):
        return self.refused(code, rf"^{PROGRAM}: {said}", *arguments, program=PROGRAM, **more)

    def names(self):
        return [line.split()[0] for line in self.hard_cases("--list").splitlines()]

    def rows(self, text):
        """By name: the naive error, the share of wrong pixels in percent, the stable error."""
        table = text.split("\n\n")[0]
        lines = [line.split() for line in table.splitlines()[1:]]
        return {words[0]: (float(words[1]), float(words[2].rstrip("%")), float(words[3]))
                for words in lines}

    def assert_kept(self, row, name):
        naive, share, stable = row
        self.assertLessEqual(stable, 1, name)
        self.assertGreater(naive, 10, name)
        self.assertGreater(naive, stable, name)
        self.assertGreaterEqual(share, 0, name)

    def size(self, name):
        """Of a PNG, from its header: to read all of a sheet takes seconds."""
        data = self.read(name)
        self.assertEqual(data[:8] + data[12:16], b"\x89PNG\r\n\x1a\nIHDR", name)
        self.assertEqual(data[-8:-4], b"IEND", name)
        return struct.unpack(">II", data[16:24])

    def colors(self, name):
        sheet = self.png(name)
        return len(set(zip(*[iter(sheet.pixels)] * sheet.channels)))


class Cases(Study):
    def test_help_and_list_draw_nothing(self):
        text = self.hard_cases("--help")
        for word in ("--list", "--case", "hard_cases.png", "hard_shadows.png", "Try:"):
            self.assertIn(word, text)
        self.assertNotIn("--samples", text)
        lines = self.hard_cases("--list").splitlines()
        self.assertGreaterEqual(len(lines), 12)
        for line in lines:
            self.assertRegex(line, r"^[a-z-]+ +\w.{10,61}$")
        self.assertEqual(len(set(self.names())), len(lines))
        self.assertEqual(self.hard_cases("--list", environment=base.NO_DRIVER).splitlines(), lines)
        self.assertEqual(self.everything(), {})

    def test_one_case_is_one_picture(self):
        text = self.hard_cases("--case", "mirror")
        rows = self.rows(text)
        self.assertEqual(list(rows), ["mirror"])
        self.assert_kept(rows["mirror"], "mirror")
        self.assertRegex(text, r"mirror .* (within the noise|too noisy to tell|[+-]\d+% \(noise \d+%\))\n\nwrote "
                         r"hard_cases/mirror\.png\n$")
        self.assertEqual(os.listdir(self.path(PROGRAM)), ["mirror.png"])
        sheet = self.png("hard_cases/mirror.png")
        self.assertGreater(sheet.width, 3 * 280)
        self.assertGreater(self.colors("hard_cases/mirror.png"), 200)

    @base.in_long_form
    def test_a_case_of_a_shader_ends_with_the_line_that_the_stable_form_changes(self):
        for name, file in (("zero-normals", "unguarded.glsl"), ("cancelling", "unguarded.glsl"),
                           ("opposite", "unguarded.glsl"), ("touching", "unguarded.glsl"),
                           ("pow", "unguarded_pow.glsl"), ("negative", "highlight_plain.glsl"))[::base.step(2)]:
            text = self.hard_cases("--case", name)
            number = re.search(rf"\n(?:vertex \d+: )?{file}:(\d+): .* undefined\n(.*\n)*verdict: .*\n$", text)
            self.assertIsNotNone(number, text)
            stable = "highlight.glsl" if name == "negative" else "guards.glsl"
            self.assertNotIn(shader("study/" + file)[int(number[1]) - 1], shader("lighting/" + stable))
        # Those whose formula is another one; of "unit" the line is gone.
        for name, plain, stable in (("leak", "study/unguarded_facing.glsl", "lighting/guards.glsl"), ("unit", "lighting.frag", ""),
                                    ("two-sided", "study/side_by_normal.glsl", "lighting/side.glsl")):
            text = self.hard_cases("--case", name)
            number, line = re.search(rf"\n(?:the|only the) stable form has .*: {os.path.basename(plain)}:(\d+): (.*)\nverdict: ", text).groups()
            self.assertEqual(shader(plain)[int(number) - 1], line)
            self.assertNotIn(line, shader(stable) if stable else [])
            self.assertTrue(stable or "safe_normalize(normal)" in line)
        text = self.hard_cases("--case", "pow")  # drawn as in the table
        self.assertAlmostEqual(float(re.search(r"verdict: ([\d.]+) steps off as drawn", text)[1]), self.rows(text)["pow"][0], delta=0.01)
        # Those of mediump: where digits are lost, and what magnifies that.
        for name, lost, magnifier in (("spot", "dot(-to_light, ", "acos(along)"), ("wide", "dot(way, way)", ""),
                                      ("highlight", "", "pow(base, exponent)")):
            verdict = self.hard_cases("--case", name).splitlines()[-1]
            self.assertRegex(verdict, r"steps off: 0\.\d\d by the formula, .*, born in \S+ \(.*\)")
            self.assertIn(lost, verdict)
            self.assertIn(magnifier, verdict.partition("magnified ")[2])

    def test_markdown_is_a_table_below_the_machine(self):
        lines = self.hard_cases("--case", "leak", "--markdown", *SMALL).splitlines()
        self.assertRegex(lines[0], r"cores; .*Mesa .*LP_NUM_THREADS 0; \w+ [\d.]+ -O")
        self.assertEqual(lines[1], "")
        self.assertRegex(lines[2], r"^\| case \| plain formula: error \|")
        self.assertEqual({line.count("|") for line in lines[2:]}, {9})
        self.assertRegex(lines[4], r"^\| leak \| \d+\.\d\d \| [\d.]+% \|")

    @base.in_long_form
    def test_every_case_goes_wrong_and_is_kept(self):
        text = self.hard_cases("-o", "all", *(() if base.LONG else ("-s", "140x140")))
        names, rows = self.names(), self.rows(text)
        self.assertEqual(list(rows), names)
        for name, row in rows.items():
            self.assert_kept(row, name)
        self.assertEqual(sorted(os.listdir(self.path("all"))),
                         sorted([f"{name}.png" for name in names] + ["hard_cases.png", "hard_shadows.png"]))
        for name in names:
            self.assertEqual(self.size(f"all/{name}.png")[0], width(280), name)
        for name, least in ("hard_cases", 1500), ("hard_shadows", 700):
            across, down = self.size(f"all/{name}.png")  # shown at half of that
            self.assertTrue(1500 < across < 1900 and least < down <= 2000, (name, across, down))

    @base.in_long_form
    def test_another_size_is_drawn_and_small_ones_are_enlarged(self):
        self.hard_cases("--case", "leak", *SMALL)
        self.hard_cases("--case", "uneven", "-s", "300x200")
        self.assertEqual(self.size("hard_cases/leak.png")[0], width(280))
        self.assertEqual(self.size("hard_cases/uneven.png")[0], width(300))

    def test_the_exact_picture_is_as_sharp_as_the_drawn_ones(self):
        self.hard_cases("--case", "cancelling")
        sheet = self.png("hard_cases/cancelling.png")
        left, top = 28 + 2 * (280 + 8), 14 + 26 + 30
        colors = [sheet.at(left + 140, top + 8 * row + 4) for row in range(27)]
        ground = [color == colors[0] for color in colors]
        self.assertEqual(ground, [True] * 5 + [False] * 17 + [True] * 5)
        for color in colors[5:22]:  # ambient light alone: no blend with the background
            for a, b in zip(color, colors[13]):
                self.assertLessEqual(abs(a - b), 2)

    @base.in_long_form
    def test_without_a_font_there_is_no_text(self):
        self.hard_cases("--case", "pow", *SMALL)
        before = self.png("hard_cases/pow.png")
        self.hard_cases("--case", "pow", *SMALL, environment={"LIGHTING_FONT": "missing.ttf"})
        after = self.png("hard_cases/pow.png")
        self.assertEqual((after.width, after.height), (before.width, before.height))
        self.assertNotEqual(after.pixels, before.pixels)
        self.assertEqual(after.at(0, 20), before.at(0, 20))
        title = {after.at(x, y) for x in range(after.width) for y in range(14 + 26 + 30)}
        self.assertEqual(len(title), 1)

    def test_what_is_wrong_is_said(self):
        self.make("file")
        for code, said, *arguments in (
                (2, r"--case mirrow: there is none; did you mean mirror\?", "--case", "mirrow"),
                (2, r"--case 0123456789: must be singular, mirror", "--case", "0123456789"),
                (2, r"--case: ", "--case"),
                (2, r"--samples: no such option", "--samples", "4"),
                (2, r"--output -: a study is a folder", "-o", "-"),
                (2, r"--size 0x0: must be", "-s", "0x0"),
                (2, r"x: not an option", "x"),
                (1, r"file: exists and is not a folder", "-o", "file"),
                (1, r"missing/deep: cannot create the folder", "-o", "missing/deep")):
            self.wrong(code, said, *arguments)
        self.wrong(1, "EGL: .*unset", environment=base.NO_DRIVER)

    def test_a_picture_that_cannot_be_written_is_named(self):
        os.makedirs(self.path("hard_cases/leak.png"))
        self.wrong(1, r"hard_cases/leak\.png: ", "--case", "leak", *SMALL)


if __name__ == "__main__":
    sys.exit(base.main())
