#!/usr/bin/env python3
"""lessons: its pictures are the lecture programs' own, and below them is what the files say.

usage: lessons_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]
"""
import os
import re
import shutil
import sys

import command_line_test as base

SIDE, TOP, LEFT = 400, 72, (20, 440, 860)  # of the pictures in a page of its own size
TEXT = 508  # the lines begin below
ADDED, REMOVED, ADDED_ON_WHITE = (140, 240, 150), (255, 165, 155), (0, 90, 20)
SHADERS = os.path.join(base.SOURCE, "shaders/lecture")


def predecessors():
    with open(os.path.join(base.SOURCE, "README.md"), encoding="utf-8") as file:
        rows = re.findall(r"^\| !\[\].*?\| `(\w+)` \|[^|]*\| (?:`(\w+)` )?\|$", file.read(), re.M)
    return [(name, before) for name, before in rows if name in base.PROGRAMS]


def part(png, number):
    stride = png.width * png.channels
    return b"".join(png.pixels[stride * (TOP + row) + png.channels * LEFT[number]:][:3 * SIDE]
                    for row in range(SIDE))


def below(png):
    return png.pixels[png.width * png.channels * TEXT:]


def count(pixels, color):
    """Exact pixels of a color, as the stems of letters have."""
    return sum(pixels[i:i + 3] == bytes(color) for i in range(0, len(pixels), 3))


def luminance(color):
    """WCAG 2.1's."""
    linear = [(c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4) for c in color]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


class Lessons(base.Case):
    def page(self, *arguments):
        return self.drawn(*arguments, program="lessons")

    @base.in_long_form
    def test_pictures_are_those_of_the_programs(self):
        lessons = predecessors()
        self.assertEqual(len(lessons), 9)
        taken = list(enumerate(lessons, 1))[::base.step(9)]
        names = {name for _, pair in taken for name in pair if name}
        pictures = {name: self.drawn("-t", "1", program=name).pixels for name in names}
        opaque = {name: [alpha == 255 for alpha in self.drawn("-t", "1", "--alpha", program=name).pixels[3::4]]
                  for name in names}
        for number, (name, before) in taken:
            page = self.page("-t", "1", "--lesson", str(number))
            self.assertEqual((page.width, page.height, page.channels), (1280, 960, 3))
            self.assertTrue(part(page, 1) == pictures[name], name)
            if not before:
                continue
            self.assertTrue(part(page, 0) == pictures[before], before)
            apart = [abs(a - b) for a, b in zip(pictures[before], pictures[name])]
            inside = [by for i, by in enumerate(apart) if opaque[before][i // 3] and opaque[name][i // 3]]
            factor = 255 // (max(inside) or max(1, *apart))
            self.assertTrue(part(page, 2) == bytes(min(factor * by, 255) for by in apart), name)

    def test_the_difference_of_two_spheres_shows_although_their_outlines_do_not_match(self):
        """More than 1000 pixels are at least half as bright as can be; 220 were if outlines decided the scale."""
        page = part(self.page("--lesson", "9"), 2)
        self.assertGreater(sum(value >= 128 for value in page[::3]), 1000)

    @base.in_long_form
    def test_a_name_is_as_good_as_a_number(self):
        by_number = self.page("--lesson", "3")
        by_name = self.page("--lesson", "LightedCube_ambient")
        self.assertEqual(by_number.pixels, by_name.pixels)
        self.assertEqual(by_number.texts["Command"], "lessons --lesson LightedCube_ambient")
        self.refused(2, "^lessons: --lesson 10: must be LightedCube, ", "--lesson", "10",
                     program="lessons")
        self.refused(2, "did you mean LightedCube_ambient[?]", "--lesson", "lightedcube_ambint",
                     program="lessons")

    @base.in_long_form
    def test_changed_lines_have_their_colors(self):
        first, ambient = self.page(), self.page("--lesson", "3")
        self.assertEqual(count(below(first), ADDED) + count(below(first), REMOVED), 0)
        self.assertGreater(count(below(ambient), ADDED), count(below(ambient), REMOVED))
        self.assertGreater(count(below(ambient), REMOVED), 50)

    @base.in_long_form
    def test_a_copy_of_a_shader_is_compared_too(self):
        """The picture stays where a comment is added, and below is one more line."""
        os.mkdir(self.path("mine"))
        for name in "LightedCube.vert", "LightedCube_ambient.vert":
            shutil.copy(os.path.join(SHADERS, name), self.path("mine", name))
        high = "--lesson", "3", "-s", "1280x1600"  # room for a line more in the same letters
        before = self.page(*high)
        own = *high, "--shaders", "mine"
        self.assertEqual(self.page(*own).pixels, before.pixels)
        with open(self.path("mine/LightedCube_ambient.vert"), "a", encoding="utf-8") as file:
            file.write("// MMMMMMMMMMMMMMMMMMMM\n")
        after = self.page(*own)
        for number in range(3):
            self.assertEqual(part(after, number), part(before, number))
        self.assertGreater(count(below(after), ADDED), count(below(before), ADDED))

    def test_a_broken_shader_is_one_error(self):
        self.make("mine/LightedCube.vert", "void main() { gl_Position = nothing; }\n")
        self.refused(1, "^mine/LightedCube.vert:1: error: ", "--lesson", "3", "--shaders", "mine",
                     program="lessons", lines=0)

    @base.in_long_form
    def test_any_size(self):
        for size in "1x1", "100x400", "400x100":
            page = self.page("-s", size, "--lesson", "7")
            self.assertEqual(f"{page.width}x{page.height}", size)
        plain = "-s", "320x240", "--lesson", "2"
        self.assertNotEqual(self.page(*plain, "--samples", "4").pixels, self.page(*plain).pixels)

    def test_each_lesson_shows_a_difference_in_picture_and_code(self):
        """Lesson 2 turns from the same place, and lessons 5, 6 and 8 change constants too."""
        for number in range(2, 10, base.step(3)):
            page = self.page("--lesson", str(number))
            self.assertTrue(any(part(page, 2)), number)
            self.assertGreater(count(below(page), ADDED), 20, number)

    @base.in_long_form
    def test_a_light_page(self):
        """The same pictures and lines, dark on white: contrasts of letters are at least 7 to 1 on both."""
        dark, light = self.page("--lesson", "7"), self.page("--lesson", "7", "--light", "on")
        for number in range(3):
            self.assertEqual(part(dark, number), part(light, number))
        self.assertEqual((dark.pixels[:3], light.pixels[:3]), (bytes((16, 18, 22)), bytes((255, 255, 255))))
        self.assertGreater(count(below(light), ADDED_ON_WHITE), 20)
        with open(os.path.join(base.SOURCE, "examples/lessons/page.c"), encoding="utf-8") as file:
            text = file.read()
        papers, *letters = re.findall(r"{+(?:[.]color = )?{([\d, ]+)}+, {(?:[.]color = )?{?([\d, ]+)}+", text)
        self.assertEqual(len(letters), 6)
        for pair in letters:
            for paper, letter in zip(papers, pair):
                one, other = sorted(luminance([int(c) for c in color.split(",")]) for color in (paper, letter))
                self.assertGreaterEqual((other + 0.05) / (one + 0.05), 7, letter)

    @base.in_long_form
    def test_columns_do_not_touch(self):
        """Between two columns, and at the right, there is nothing but background."""
        for size, number in (("400x300", 5), ("400x300", 7), ("640x480", 5), ("1280x960", 5)):
            page = self.page("--lesson", str(number), "-s", size)
            stride, scale = 3 * page.width, page.width / 1280
            for x in page.width // 2 - 1, page.width - 3:
                column = {page.pixels[stride * y + 3 * x:][:3]
                          for y in range(int(TEXT * scale) + 6, page.height)}
                self.assertEqual(len(column), 1, (size, number, x))

    @base.in_long_form
    def test_a_second_column_has_the_lines_that_the_first_has_no_room_for(self):
        """The title of the next file, at its top: of the first lesson, which is cut in one column,
        and where the letters leave rows to spare."""
        for size, lesson, top in (("640x480", "1", 253), ("800x600", "4", 316)):
            page = self.page("--lesson", lesson, "-s", size)
            row, half = 3 * page.width, 3 * (page.width // 2)
            title = b"".join(page.pixels[row * y + half:row * (y + 1)] for y in range(top, top + 10))
            blue = sum(title[i + 2] > title[i] + 60 for i in range(0, len(title), 3))
            self.assertGreater(blue, 20, size)

    def test_an_animation_has_both_move(self):
        self.good("--lesson", "7", "-s", "320x240", "-t", "0", "-n", "2", "--fps", "1", "-o", "l%d.png",
                  program="lessons")
        self.assertNotEqual(self.png("l0.png").pixels, self.png("l1.png").pixels)
        self.assertEqual(self.png("l1.png").pixels,
                         self.page("--lesson", "7", "-s", "320x240").pixels)


if __name__ == "__main__":
    sys.exit(base.main())
