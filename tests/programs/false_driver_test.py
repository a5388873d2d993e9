#!/usr/bin/env python3
"""A driver that lies about its precision (tests/support/false_driver.c): nothing believes it.

usage: false_driver_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]
"""
import json
import os
import re
import sys
import unittest

import command_line_test as base

FALSE_DRIVER = os.path.join(base.EXAMPLES, "../tests/libfalse_driver.so")
LIES = ("highp", "mediump", "none", "more")
PROGRAMS = ("PointLightedSphere_perFragment", "PhongBlinn", "Materials")


class Lies(base.Case):
    def setUp(self):
        super().setUp()
        self.make("vendor.json", json.dumps({"file_format_version": "1.0.0",
                                             "ICD": {"library_path": os.path.realpath(FALSE_DRIVER)}}))
        self.own = {"XDG_CACHE_HOME": self.path("cache")}

    def lying(self, lie):
        return {"__EGL_VENDOR_LIBRARY_FILENAMES": self.path("vendor.json"), "LIGHTING_FALSE_DRIVER": lie,
                "XDG_CACHE_HOME": self.path("cache", lie), "LIGHTING_BACKEND": "egl"}

    def pixels(self, program, precision, lie=None):
        return self.drawn("-s", "90x60", "--precision", precision, program=program,
                          environment=self.lying(lie) if lie else self.own).pixels

    @base.in_long_form
    def test_every_picture_is_drawn_as_the_driver_computes(self):
        computed = {("highp", "highp"): "mediump", ("mediump", "mediump"): "highp"}
        for program in PROGRAMS[::base.step(9)]:
            honest = {name: self.pixels(program, name) for name in ("highp", "mediump")}
            for lie in LIES:
                for name in honest:
                    self.assertTrue(self.pixels(program, name, lie) ==
                                    honest[computed.get((lie, name), name)], (program, lie, name))

    def test_highp_that_is_not_there_is_named(self):
        self.refused(1, r"^PhongBlinn: .*precision highp: .* has none in fragment shaders$",
                     "--precision", "highp", program="PhongBlinn",
                     environment=self.lying("without"))
        self.good(*base.SMALL, "--precision", "mediump", program="PhongBlinn",
                  environment=self.lying("without"))

    @base.in_long_form
    def test_reports_do_not_repeat_what_is_claimed(self):
        for program, option in (("LightedCube", "--doctor"), ("PhongBlinn", "--explain")):
            def said(environment):
                result = self.run_it(option, program=program, environment=environment)
                return (result.returncode, result.stderr,
                        re.sub(r"[\d.]+ m?s\b", "TIME", result.stdout.decode()))

            honest = said({**self.own, "LIGHTING_BACKEND": "egl"})
            for lie in ("none", "more")[::base.step(2)]:  # the pictures are those of an honest driver
                self.assertEqual(said(self.lying(lie)), honest, (option, lie))

    @base.in_long_form
    def test_an_error_allowed_is_that_of_the_picture(self):
        """highp of 16 bits has the error of mediump, not that of highp."""
        command = ("-s", "60x20", "--error", "4", "-v", "-o", "a.png")

        def said(environment, *more):
            text = self.run_it(*command, *more, program="ShininessRow",
                               environment=environment).stderr.decode()
            return float(re.search(r"; error ([\d.]+) of 4 allowed", text)[1]), self.png(
                "a.png").pixels

        error, pixels = said(self.lying("highp"), "--precision", "highp")
        self.assertLessEqual(error, 4)
        exact = said(self.own, "--precision", "mediump")
        self.assertTrue((error, pixels) == exact, (error, exact[0]))


if __name__ == "__main__":
    sys.exit(base.main())
