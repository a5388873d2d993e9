#!/usr/bin/env python3
"""The study `precision` as it is used: what it measures, prints and refuses.

usage: precision_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

Exit code: 77 where nothing can be drawn.
"""
import json
import os
import re
import sys
import unittest

import command_line_test as base

PROGRAM = "precision"
FALSE_DRIVER = os.path.join(base.EXAMPLES, "../tests/libfalse_driver.so")
FEW = ("--inputs", "17")


class Precision(base.Case):
    def precision(self, *arguments, **more):
        return self.good(*arguments, program=PROGRAM, **more).decode()

    def test_help_measures_nothing(self):
        text = self.precision("--help", environment=base.NO_DRIVER)
        for word in ("--inputs", "--json", "--markdown", "Try:"):
            self.assertIn(word, text)
        self.assertEqual(self.everything(), {})

    def found(self, text):
        """What JSON says, looked through."""
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
        self.assertTrue(1 <= found["raster"]["depth_step"] <= 3, found["raster"])
        for steps in found["pictures"].values():
            self.assertTrue(0 <= steps["highp"] <= steps["mediump"] + 1e-4 <= 256, steps)
        return found

    def page_says_so(self, found):
        """The page's table of what errors can add up to in highp, where it is of this version of the driver. A digit is rounded there;
        fewer inputs and narrower vectors, as here, move what is measured of functions by up to 11%, and so by less than 20."""
        with open(os.path.join(base.SOURCE, "examples/study/tables/precision.md"), encoding="utf-8") as file:
            page = file.read()
        if re.search(r"LLVM [\d.]+", page)[0] not in found["renderer"]:
            return
        rows = dict(re.findall(r"^\| (.*) \| ([\d.]+) \| [\d.]+ \|$", page.partition("| in pictures of")[2], re.MULTILINE))
        self.assertEqual(set(rows), set(found["pictures"]))
        for name, highp in rows.items():
            bound = found["pictures"][name]["highp"]
            without_rounding = bound - 0.5 if bound >= 0.5 else bound
            self.assertAlmostEqual(float(highp), bound, msg=name, delta=0.2 * without_rounding + 0.5 * 0.1 ** len(highp.split(".")[1]))

    @base.in_long_form
    def test_a_processor_without_16_bits_is_told_apart(self):
        cache = {"XDG_CACHE_HOME": self.path("cache"), "MESA_SHADER_CACHE_DIR":
                 os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")}
        caps = {"GALLIUM_OVERRIDE_CPU_CAPS": "sse4.1", **cache}
        text = self.precision("--json", "-o", "found", *FEW, environment=caps)
        self.assertEqual(text.encode(), self.read("found/precision.json"))
        self.assertEqual(sorted(os.listdir(self.path("found"))),
                         ["precision.json", "precision.png", "precision.svg"])
        found = self.found(text)
        if "llvmpipe" not in found["renderer"]:
            return
        self.assertEqual(found["fragment"]["mediump"]["bits"], 24)
        self.page_says_so(found)
        # What is measured of depth is what every program says of it.
        self.assertIn(f"# depth: {found['raster']['depth_bits']} bits from ",
                      self.good("--explain", program="FourLights").decode())
        doctor = self.good("--doctor", program=PROGRAM, environment=caps).decode()
        self.assertIn("fragment shaders compute with 24 bits in highp, 24 in mediump, 24 in lowp",
                      doctor)
        other = self.good("--doctor", program=PROGRAM, environment=cache).decode()
        self.assertIn("  precision        unknown: run precision once", other)

    @base.in_long_form
    def test_text_is_a_screen_of_lines(self):
        text = self.precision(*FEW)
        lines = text.splitlines()
        self.assertLess(len(lines), 56)
        self.assertLessEqual(max(map(len, lines)), 132)
        found = self.found(self.read("precision/precision.json"))
        bits = found["fragment"]["mediump"]["bits"]
        self.assertRegex(text, rf"\n\S*(highp, )?mediump, lowp +{bits} +2\^-")
        self.assertIn("pow alone, shininess 128", text)
        self.assertEqual("mediump is computed as highp" in text, bits == 24)

    @unittest.skipUnless(os.path.exists(FALSE_DRIVER), "without the driver that lies")
    def test_a_highp_that_is_none_is_named(self):
        self.make("vendor.json", json.dumps({"file_format_version": "1.0.0",
                                             "ICD": {"library_path": os.path.realpath(FALSE_DRIVER)}}))
        self.refused(1, rf"^{PROGRAM}: .*: highp of the fragment shader has fewer than 24 bits, "
                     "whatever the driver says", program=PROGRAM, environment={
                         "__EGL_VENDOR_LIBRARY_FILENAMES": self.path("vendor.json"),
                         "LIGHTING_FALSE_DRIVER": "highp", "LIGHTING_BACKEND": "egl"})

    @unittest.skipUnless(base.LONG and os.path.exists(FALSE_DRIVER), "takes as long as the others")
    def test_false_claims_are_said(self):
        self.make("vendor.json", json.dumps({"file_format_version": "1.0.0",
                                             "ICD": {"library_path": os.path.realpath(FALSE_DRIVER)}}))
        for lie, said in (("mediump", "of mediump in fragment shaders, says 11 bits, computes with 24"),
                          ("more", "of highp in vertex shaders, says 113 bits, computes with 24")):
            text = self.precision(*FEW, environment={
                "__EGL_VENDOR_LIBRARY_FILENAMES": self.path("vendor.json"), "LIGHTING_FALSE_DRIVER": lie,
                "LIGHTING_BACKEND": "egl"})
            self.assertIn(said, text)

    def test_what_is_wrong_is_said(self):
        for code, said, *arguments in (
                (2, r"--json and --markdown: one of them", "--json", "--markdown"),
                (2, r"--inputs 5: must be 17 to 32, or 0", "--inputs", "5"),
                (2, r"--inputs x: must be 17 to 32, or 0", "--inputs", "x")):
            self.refused(code, rf"^{PROGRAM}: {said}", *arguments, program=PROGRAM)
        self.refused(1, rf"^{PROGRAM}: ", program=PROGRAM, environment=base.NO_DRIVER)


if __name__ == "__main__":
    sys.exit(base.main())
