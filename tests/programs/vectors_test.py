#!/usr/bin/env python3
"""Vectors: its files as SVG, PDF and pixels, its options, and what it refuses.

usage: vectors_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

No figure needs a driver.
"""
import os
import re
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree

import command_line_test as base

FIGURES = ("vectors", "lobe", "incidence", "rays", "normals", "mirror", "winding", "spaces", "ambient",
           "attenuation", "reflectivity")
SVG = "{http://www.w3.org/2000/svg}"



class Case(base.Case):
    def run_it(self, *arguments, **more):
        more.setdefault("program", "Vectors")
        return super().run_it(*arguments, environment={**base.NO_DRIVER,
                                                       **more.pop("environment", {})}, **more)


class Files(Case):
    def test_svg_is_xml_of_the_size_and_without_text(self):
        for figure in FIGURES:
            self.good("--figure", figure, "-s", "640x360", "-o", "a.svg")
            root = xml.etree.ElementTree.fromstring(self.read("a.svg"))
            self.assertEqual(root.tag, SVG + "svg")
            self.assertEqual((root.get("width"), root.get("height"), root.get("viewBox")),
                             ("640px", "360px", "0 0 640 360"))
            # Letters are outlines: no font, no picture in it.
            for tag in "text", "image", "style", "script":
                self.assertEqual(root.findall(f".//{SVG}{tag}"), [])
            self.assertGreater(len(root.findall(f".//{SVG}path")), 30)

    def test_pdf_has_one_page_of_the_size(self):
        if not shutil.which("pdfinfo"):
            self.skipTest("no pdfinfo (poppler-utils)")
        for figure in FIGURES:
            self.good("--figure", figure, "-s", "640x360", "-o", "a.pdf")
            said = subprocess.run(["pdfinfo", self.path("a.pdf")], capture_output=True, text=True,
                                  check=True).stdout
            self.assertRegex(said, r"Pages: +1\n")
            self.assertRegex(said, r"Page size: +640 x 360 pts")
            self.assertNotIn("CreationDate", said)

    def test_a_page_shows_the_picture(self):
        if not shutil.which("pdftoppm"):
            self.skipTest("no pdftoppm (poppler-utils)")
        self.good("--rays", "parallel", "-s", "640x360", "-o", "a.pdf")
        subprocess.run(["pdftoppm", "-r", "72", "-singlefile", "a.pdf", "page"], check=True,
                       cwd=self.folder)
        header, size, _, page = self.read("page.ppm").split(b"\n", 3)
        self.assertEqual((header, size), (b"P6", b"640 360"))
        drawn = self.drawn("-s", "640x360").pixels
        # Areas are equal but for the rounding of a colour; edges, measured as 0.04 of the values, are
        # smoothed by another rasterizer, which rarely (0.0002) makes much of a difference.
        self.assertLess(sum(abs(a - b) > 1 for a, b in zip(page, drawn)), 0.08 * len(page))
        self.assertLess(sum(abs(a - b) > 64 for a, b in zip(page, drawn)), 0.002 * len(page))

    def test_the_same_command_writes_the_same_bytes(self):
        for name in "a.svg", "a.pdf", "a.png":
            for figure in FIGURES[::base.step(33)]:
                self.good("--figure", figure, "-o", name)
                first = self.read(name)
                self.good("--figure", figure, "-o", name, environment={
                    "SOURCE_DATE_EPOCH": "1", "TZ": "Asia/Seoul", "LC_ALL": "C"})
                self.assertEqual(first, self.read(name), (figure, name))

    def test_standard_output_takes_every_format(self):
        for name in "svg", "pdf":
            self.good("-o", "a." + name)
            self.assertEqual(self.good("-o", "-", "--format", name), self.read("a." + name))
        self.assertEqual(self.drawn().pixels, self.drawn("--format", "png").pixels)
        self.assertEqual(len(self.good("-o", "-", "--format", "rgb", "-s", "40x30", "-n", "2")),
                         2 * 3 * 40 * 30)

    def test_numbered_files_swing(self):
        self.good("--swing", "30", "-n", "3", "--fps", "1", "-o", "a%d.svg")
        files = [self.read(f"a{i}.svg") for i in range(3)]
        self.assertEqual(len(set(files)), 3)
        self.good("--light", "55", "-o", "b.svg")  # 40 + 30 sin 30 degrees, after a second
        self.assertEqual(files[1], self.read("b.svg"))

    def test_a_transparent_background(self):
        picture = self.drawn("--alpha")
        self.assertEqual((picture.channels, picture.at(1, 1)), (4, (0, 0, 0, 0)))
        self.good("-o", "white.svg")
        self.good("--alpha", "-o", "none.svg")
        self.assertLess(len(self.read("none.svg")), len(self.read("white.svg")))

    def test_nothing_is_half_written(self):
        self.make("a.svg")
        self.refused(1, "missing/a.svg: the folder missing/ does not exist", "-o", "missing/a.svg")
        self.refused(1, "a.svg/b.pdf: ", "-o", "a.svg/b.pdf")
        if os.path.exists("/dev/full"):
            for name in "svg", "pdf":
                os.symlink("/dev/full", self.path("full." + name))
                self.refused(1, "full.*No space", "-o", "full." + name)


class Options(Case):
    def test_every_option_changes_the_picture(self):
        plain = {figure: self.drawn("--figure", figure).pixels for figure in FIGURES}
        for figure, *arguments in (
                ("vectors", "--light", "41"), ("vectors", "--eye", "11"),
                ("vectors", "--shininess", "11"), ("vectors", "--reflection", "blinn-phong"),
                ("vectors", "--material", "jade"), ("vectors", "--rays", "radiating"),
                ("vectors", "--swing", "10", "--time", "1"), ("lobe", "--shininess", "0"),
                ("lobe", "--reflection", "blinn-phong"), ("incidence", "--light", "60"),
                ("rays", "--light", "10"), ("normals", "--sides", "5"),
                ("normals", "--light", "0"), ("rays", "--distance", "20"), ("mirror", "--eye", "20"),
                ("winding", "--sides", "5"), ("winding", "--eye", "50"), ("spaces", "--eye", "50"),
                ("spaces", "--light", "0"), ("ambient", "--ambient", "0.5"),
                ("attenuation", "--constant", "0.5"), ("attenuation", "--linear", "1"),
                ("attenuation", "--quadratic", "1"), ("attenuation", "--distance", "3"),
                ("reflectivity", "--material", "jade"), ("reflectivity", "--material", "gold")):
            changed = self.drawn("--figure", figure, *arguments).pixels
            self.assertNotEqual(plain[figure], changed, arguments)

    def test_attenuation_is_that_of_light_types(self):
        """So that the figure is the curve of what that program draws."""
        helps = [self.good("--help", program=program).decode() for program in ("Vectors", "LightTypes")]
        for option in "constant", "linear", "quadratic":
            found = [re.search(rf"--{option} .*?default ([0-9.]+)", said, re.S) for said in helps]
            self.assertEqual(found[0].group(1), found[1].group(1), option)

    def test_the_colour_is_that_of_the_lighting_equation(self):
        """Of red rubber without a highlight, straight below the light: 0.2 ambient + diffuse."""
        picture = self.drawn("--material", "red_rubber", "--light", "0", "--eye", "90",
                             "--shininess", "128", "-s", "800x450")
        wanted = [round(255 * (0.2 * a + d)) for a, d in ((0.05, 0.5), (0, 0.4), (0, 0.4))]
        # The strip below the surface, wherever it is.
        self.assertIn(tuple(wanted), {picture.at(100, y) for y in range(450)})

    def test_what_a_diagram_has_not_is_refused(self):
        for option, *value in (("--samples", "4"), ("--orbit", "30,10"), ("--backend", "egl"),
                               ("--precision", "highp"), ("--print-shader",), ("--watch",),
                               ("--shaders", ".")):
            self.refused(2, f"^Vectors: {option}: a diagram is drawn without OpenGL", option,
                         *value)
        self.refused(2, "--explain: no such option", "--explain")
        self.assertNotIn("--samples", self.good("--help").decode())

    def test_usage_errors(self):
        for said, *arguments in (
                ("did you mean lobe", "--figure", "lob"), ("-180 to 180", "--light", "181"),
                ("-90 to 90", "--eye", "91"), ("0 to 128", "--shininess", "-1"),
                ("0 to 128", "--shininess", "nan"), ("1 to 16", "--sides", "0"),
                ("did you mean gold", "--material", "gol"), ("0.25 to", "--distance", "0"), ("animations: .*; drawings: .svg, .pdf", "-o", "a.xyz"),
                ("standard output takes one picture as svg", "-o", "-", "--format", "svg", "-n", "2"),
                ("--format svg: applies to standard output", "--format", "svg"),
                ("need a number", "-n", "2", "-o", "a.svg")):
            self.refused(2, said, *arguments)

    def test_other_programs_write_no_vectors(self):
        self.refused(2, "unknown picture format .svg", "-o", "a.svg", program="LightedCube")
        self.refused(2, "--format svg: ", "-o", "-", "--format", "svg", program="LightedCube")

    def test_missing_fonts_and_modules_are_said(self):
        name = os.path.join(base.EXAMPLES, "../common/drawing_cairo.so")
        self.assertTrue(os.path.exists(name))
        os.makedirs(self.path("build/examples"))
        shutil.copy(os.path.join(base.EXAMPLES, "Vectors"), self.path("build/examples/Vectors"))
        moved = subprocess.run([self.path("build/examples/Vectors"), "-o", "a.svg"],
                               cwd=self.folder, capture_output=True, text=True)
        if moved.returncode:  # unless it is installed
            self.assertRegex(moved.stderr, "^Vectors: cairo: .*libcairo2-dev.*\n$")
            self.assertFalse(os.path.exists(self.path("a.svg")))

    def test_no_other_program_loads_cairo(self):
        if not shutil.which("ldd"):
            self.skipTest("no ldd")
        for program in "LightedCube", "Vectors":
            said = subprocess.run(["ldd", os.path.join(base.EXAMPLES, program)],
                                  capture_output=True, text=True).stdout
            self.assertIsNone(re.search("cairo", said))


if __name__ == "__main__":
    sys.exit(base.run_tests())
