#!/usr/bin/env python3
"""The study `precision` as it is used: what it measures, prints and refuses.

usage: precision_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

Exit code: 77 where nothing can be drawn.
"""
import json
import os
import sys

import command_line_test as base

PROGRAM = "precision"
FEW = ("--inputs", "17")


class Precision(base.Case):
    def precision(self, *arguments, **more):
        return self.good(*arguments, program=PROGRAM, **more).decode()

    def test_help_measures_nothing(self):
        text = self.precision("--help", environment=base.NO_DRIVER)
        for word in ("--inputs", "--json", "--markdown", "Try:"):
            self.assertIn(word, text)
        self.assertEqual(self.everything(), {})

    def test_json_is_what_the_folder_has(self):
        text = self.precision("--json", "-o", "found", *FEW)
        self.assertEqual(text.encode(), self.read("found/precision.json"))
        self.assertEqual(sorted(os.listdir(self.path("found"))),
                         ["precision.json", "precision.png", "precision.svg"])
        found = json.loads(text)
        for stage in ("vertex", "fragment"):
            for precision in ("highp", "mediump", "lowp"):
                of = found[stage][precision]
                self.assertGreaterEqual(of["bits"], 8)
                self.assertGreater(of["functions"]["pow"]["inputs"], 100000)
                for name in ("+", "*"):
                    self.assertTrue(0.3 < of["functions"][name]["largest"] <= 1, (stage, name))
            self.assertGreaterEqual(found[stage]["highp"]["bits"], 16)
            # Each 16-bit number was tried where there are no others.
            if found[stage]["mediump"]["bits"] == 11:
                self.assertEqual(found[stage]["mediump"]["functions"]["exp2"]["inputs"], 40705)
        self.assertEqual(found["raster"]["edge_twice"] + found["raster"]["edge_missed"], 0)
        self.assertGreaterEqual(found["raster"]["depth_bits"], 16)
        for steps in found["pictures"].values():
            self.assertTrue(0 <= steps["highp"] <= steps["mediump"] + 1e-4 <= 256, steps)

    def test_a_processor_without_16_bits_is_told_apart(self):
        caps = {"GALLIUM_OVERRIDE_CPU_CAPS": "sse4.1", "XDG_CACHE_HOME": self.path("cache")}
        text = self.precision(*FEW, environment=caps)
        lines = text.splitlines()
        self.assertLess(len(lines), 56)
        if "llvmpipe" not in lines[0]:
            self.skipTest("not llvmpipe")
        self.assertRegex(text, r"\nhighp, mediump, lowp +24 +2\^-126 to 2\^128 ")
        self.assertIn("mediump is computed as highp", text)
        doctor = self.good("--doctor", program=PROGRAM, environment=caps).decode()
        self.assertIn("fragment shaders compute with 24 bits in highp, 24 in mediump, 24 in lowp",
                      doctor)
        other = self.good("--doctor", program=PROGRAM,
                          environment={"XDG_CACHE_HOME": self.path("cache")}).decode()
        self.assertIn("its arithmetic was not measured", other)

    def test_what_is_wrong_is_said(self):
        for code, said, *arguments in (
                (2, r"--json and --markdown: one of them", "--json", "--markdown"),
                (2, r"--inputs 5: must be 17 to 32, or 0", "--inputs", "5"),
                (2, r"--inputs x: must be 17 to 32, or 0", "--inputs", "x")):
            self.refused(code, rf"^{PROGRAM}: {said}", *arguments, program=PROGRAM)
        self.refused(1, rf"^{PROGRAM}: ", program=PROGRAM, environment=base.NO_DRIVER)


if __name__ == "__main__":
    sys.exit(base.main())
