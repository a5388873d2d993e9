#!/usr/bin/env python3
"""What the lecture and the textbook say in a sentence, seen in the pictures of the programs.

usage: sentences_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]
"""
import os
import re
import shutil
import sys
import unittest

import command_line_test as base


def view(png, columns, rows, number):
    """The pixels of one view, without its caption, by place."""
    width, height = png.width // columns, png.height // rows
    left, top = number % columns * width, number // columns * height
    return {(x, y): png.at(left + x, top + y) for x in range(width) for y in range(height * 4 // 5)}


def apart(a, b):
    return max(abs(x - y) for x, y in zip(a.pixels, b.pixels))


class Normals(base.Case):
    def drawn_without_normalize(self, program, *arguments):
        shutil.copytree(os.path.join(base.SOURCE, "shaders"), self.path(program))
        name = self.path(program, "lecture", program + ".frag")
        with open(name) as file:
            text = file.read()
        self.assertIn("normalize(v_Normal)", text)
        with open(name, "w") as file:
            file.write(text.replace("normalize(v_Normal)", "v_Normal"))
        return self.drawn("--shaders", program, *arguments, program=program)

    @base.in_long_form
    def test_normals_of_a_cube_stay_unit_and_those_of_a_sphere_get_shorter(self):
        cube, sphere = "PointLightedCube_perFragment", "PointLightedSphere_perFragment"
        # mediump, of 11 bits: two steps.
        self.assertLessEqual(apart(self.drawn("--angle", "40", program=cube),
                                   self.drawn_without_normalize(cube, "--angle", "40")), 2)
        right, wrong = self.drawn(program=sphere), self.drawn_without_normalize(sphere)
        self.assertGreater(apart(right, wrong), 5)
        self.assertLessEqual(max(b - a for a, b in zip(right.pixels, wrong.pixels)), 2)
        # Only between the vertices: the whole is hardly darker.
        self.assertGreater(sum(wrong.pixels), 0.97 * sum(right.pixels))

    def matrices(self, *arguments, program="NormalMatrix"):
        text = self.good("--explain", *arguments, program=program).decode()
        rows = re.findall(r"^(?:M =|   )((?: +\S+){3})    (?:N =|   )((?: +\S+){3})$", text, re.M)
        m, n = ([[float(word) for word in row[side].split()] for row in rows] for side in (0, 1))
        return m, n, text

    @base.in_long_form
    def test_both_matrices_are_printed_and_equal_if_orthogonal(self):
        m, n, text = self.matrices("--scale", "2,0.5,4")
        self.assertEqual(m, [[2, 0, 0], [0, 0.5, 0], [0, 0, 4]])
        self.assertEqual(n, [[0.5, 0, 0], [0, 2, 0], [0, 0, 0.25]])
        self.assertIn("N is not M", text)
        for program, arguments in (("NormalMatrix", ("--scale", "1")),
                                   ("NormalMatrix", ("--scale", "1", "--rotate", "30")), ("TwoSidedLighting", ("--time", "1"))):
            m, n, text = self.matrices(*arguments, program=program)
            self.assertEqual(len(m), 3)
            self.assertEqual(m, n)
            self.assertIn("M is orthogonal: N = M\n", text)
        m, _, _ = self.matrices("--scale", "1", "--rotate", "30")
        self.assertEqual(m, [[0.866, 0, 0.5], [0, 1, 0], [-0.5, 0, 0.866]])
        m, n, text = self.matrices("--scale=-2")
        self.assertEqual((m[1][1], n[1][1]), (-2, -0.5))
        self.assertIn("N is a multiple of M", text)
        self.assertIn("; the scene has M for normals, too", self.matrices("--matrix", "wrong")[2])

    @base.in_long_form
    def test_the_scale_is_an_option(self):
        wrong = [self.drawn("--scale", scale, "--matrix", "wrong", program="NormalMatrix")
                 for scale in ("1,1,1", "2,0.7,0.7")]
        right = [self.drawn("--scale", scale, program="NormalMatrix") for scale in ("1", "2,0.7,0.7")]
        self.assertLessEqual(apart(right[0], wrong[0]), 1)
        self.assertGreater(apart(right[1], wrong[1]), 50)
        self.assertEqual(right[1].pixels, self.drawn(program="NormalMatrix").pixels)
        both = self.drawn("--scale", "1", "--rotate", "30", "--matrix", "both", "-s", "400x200",
                          program="NormalMatrix")
        # Below the captions, two equal halves.
        rows = [both.pixels[1200 * y:][:1200] for y in range(170)]
        self.assertTrue(all(max(abs(a - b) for a, b in zip(row[:600], row[600:])) <= 1 for row in rows))
        self.refused(2, "--scale 1,2: must be X,Y,Z, each -5 to 5", "--scale", "1,2", program="NormalMatrix")

    @base.in_long_form
    def test_normals_are_drawn_in_every_scene(self):
        yellow, blue = (255, 255, 0), (102, 204, 255)
        def colors(*arguments):
            png = self.drawn(*arguments[1:], program=arguments[0])
            return {png.at(x, y) for x in range(png.width) for y in range(png.height)}
        for scene in base.SCENES[::base.step(4)]:
            name = "--show-normals" if scene == "SmoothFlat" else "--normals"
            self.assertTrue(yellow in colors(scene, name, "on"), scene)
        self.assertTrue({yellow, blue} <= colors("TwoSidedLighting", "--normals", "on"))
        self.assertFalse(blue in colors("TwoSidedLighting", "--normals", "on", "--two-sided", "off"))
        self.assertFalse({yellow, blue} & colors("TwoSidedLighting"))

    def test_flat_faces_are_told_apart(self):
        """Four faces around the middle, and those of the band beside each other."""
        png = self.drawn("--normals", "flat", "--light-at", "0,-0.4,0.7,1", program="SmoothFlat")
        greys = sorted(png.at(150 + x, 150 + y)[0] for x in (-20, 20) for y in (-20, 20))
        self.assertGreater(min(b - a for a, b in zip(greys, greys[1:])), 15, greys)
        png = self.drawn("--shape", "band", program="SmoothFlat")
        row = [png.at(x, 175)[0] for x in range(35, 170)]
        # Runs of one shade: a face each.
        faces = [value for value, next_value in zip(row, row[1:]) if value == next_value]
        shades = [a for a, b in zip(faces, faces[1:] + [-1]) if a != b]
        self.assertGreaterEqual(len(shades), 4)
        self.assertGreater(min(abs(b - a) for a, b in zip(shades, shades[1:])), 8, shades)


class Lights(base.Case):
    @base.in_long_form
    def test_a_negative_cosine_takes_from_ambient_light(self):
        scene = ("--turning-light", "off", "--global-ambient", "0.5")
        clamped = self.drawn(*scene, program="ShadingModels")
        signed = self.drawn(*scene, "--clamp-dots", "off", program="ShadingModels")
        taken = [a - b for a, b in zip(clamped.pixels, signed.pixels)]
        self.assertEqual(min(taken), 0)
        self.assertGreater(sum(d > 20 for d in taken), 2000)
        # Under lights that cast shadows nothing arrives from behind.
        for options in (("--shadows", "volumes"), ("--shadows", "map")):
            self.says(0, "--clamp-dots: ignored", *options, "--clamp-dots", "off", "-o", "off.png", program="Shadows")
            self.assertEqual(self.png("off.png").pixels, self.drawn(*options, program="Shadows").pixels)
        text = self.good("--explain", "--clamp-dots", "off", program="SpotLight").decode()
        self.assertIn("dot products not clamped: requested", text)

    def test_attenuation_is_the_formulas(self):
        """The fourth view is the second one, attenuated; here to a half."""
        png = self.drawn("--constant", "2", "--linear", "0", "--quadratic", "0", "--terms", "diffuse",
                         program="LightTypes")
        plain, faded = view(png, 3, 2, 1), view(png, 3, 2, 3)
        seen = [place for place in plain if 20 < plain[place][0] < 255]
        self.assertGreater(len(seen), 8000)
        for place in seen:
            self.assertLessEqual(abs(faded[place][0] - plain[place][0] / 2), 1, place)

    def test_the_chapter_shows_attenuation_brightly(self):
        with open(os.path.join(base.SOURCE, "examples/chapter/17-two-sides-spot-attenuation.md")) as file:
            row = re.search(r"^By the square of the distance\. `(.*?)`", file.read(), re.M)[1]
        floor = view(self.drawn(*row.split(), program="LightTypes"), 3, 2, 3)
        greys = [g for r, g, b in floor.values() if r == g == b and 0 < g < 255]
        self.assertGreater(max(greys), 100)
        self.assertGreater(max(greys) - min(greys), 40)

    def test_a_light_only_has_to_be_on_for_its_ambient_light(self):
        scene = ("--terms", "ambient", "--light-ambient", "1")
        for lights, options in ((2, ()), (1, ("--turning-light", "off"))):
            png = self.drawn(*scene, *options, program="ShadingModels")
            for value, reflected in zip(png.at(240, 270), (0.24725, 0.1995, 0.0745)):
                self.assertLessEqual(abs(value - 255 * lights * reflected), 1)

    def test_ambient_light_of_the_scene_and_of_the_lights_are_apart(self):
        png = self.drawn(program="TermsApart")
        views = [view(png, 5, 2, number) for number in range(10)]
        seen = 0
        for place in views[0]:
            emission, scene, lights, _, _, ambient, first, second, _, whole = (v[place] for v in views)
            for k in range(3):
                self.assertLessEqual(abs(scene[k] + lights[k] - ambient[k]), 1, place)
                if whole[k] < 255:
                    self.assertLessEqual(abs(emission[k] + scene[k] + first[k] + second[k] - whole[k]), 2, place)
            seen += scene[1] > 10 and lights[1] > 10
        self.assertGreater(seen, 5000)


if __name__ == "__main__":
    sys.exit(base.main())
