#!/usr/bin/env python3
"""The study `accuracy` and the option --error as they are used: what they find, keep and say.

usage: accuracy_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

No test depends on how long anything takes. Exit code: 77 where nothing can be drawn.
"""
import csv
import io
import json
import os
import signal
import subprocess
import sys
import time
import unittest

import command_line_test as base

QUICK = ("--quick", "-s", "48x48")


class Study(base.Case):
    def setUp(self):
        super().setUp()
        self.own = {"XDG_CONFIG_HOME": self.path("config"), "LIGHTING_EFFICIENT": ""}

    def accuracy(self, *arguments, **more):
        return self.good(*arguments, program="accuracy", environment=self.own, **more).decode()

    def wrong(self, code, said, *arguments, program="accuracy", **more):
        more.setdefault("environment", self.own)
        return self.refused(code, rf"^{program}: {said}", *arguments, program=program, **more)

    def rows(self, folder="accuracy"):
        text = self.read(f"{folder}/results.csv").decode()
        return list(csv.DictReader(io.StringIO(text, newline="")))


class Surveys(Study):
    def test_help_tells_scenes_axes_and_files(self):
        text = self.accuracy("--help")
        for word in ("--budget", "--time-budget", "--calibrate", "--quick", "shiny128",
                     "[phong] gouraud flat", "results.csv", "Try:"):
            self.assertIn(word, text)
        self.assertNotIn("--samples", text)
        self.assertEqual(self.everything(), {})

    def test_a_scene_gives_table_rows_plots_and_sheets(self):
        text = self.accuracy("--scene", "cube", *QUICK)
        self.assertRegex(text, r"cube, 48x48; .*LP_NUM_THREADS")
        self.assertRegex(text, r"\n\* ")
        self.assertRegex(text, r"Blinn-Phong, fitted")
        self.assertRegex(text, r"matrices=compensated order=lecture")
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
        for row in rows:  # glslangValidator took each program
            self.assertGreater(int(row["vertex_operations"]), 0, row)
            self.assertGreaterEqual(int(row["fragment_operations"]), 0, row)
        data = json.loads(self.read("accuracy/results.json"))
        self.assertEqual(len(data["rows"]), 15)
        self.assertIn("cube, 48x48", self.read("accuracy/table.txt").decode())
        sheet = self.png("accuracy/cube-usual.png")
        self.assertGreater(len(set(zip(*[iter(sheet.pixels)] * sheet.channels))), 50)
        for name in ("cube.png", "cube.svg", "models.csv", "finding-precision.svg"):
            self.assertGreater(len(self.read("accuracy/" + name)), 500)

    def test_what_was_measured_is_not_measured_again(self):
        self.accuracy("--scene", "cube", *QUICK)
        before = self.read("accuracy/results.csv")
        self.accuracy("--scene", "cube", *QUICK)
        self.assertEqual(self.read("accuracy/results.csv"), before)
        self.accuracy("--scene", "cube", "--fresh", "--seed", "7", *QUICK)
        self.assertEqual({row["seed"] for row in self.rows()}, {"7"})

    def test_broken_rows_are_named_and_measured_again(self):
        self.accuracy("--scene", "cube", *QUICK)
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
        rows = json.loads(self.read("accuracy/results.json"))["rows"]
        # 13 of the 15 were whole. Times are told in terms of the usual one's: all are measured anew.
        self.assertEqual([row["time"] is None for row in rows], [True] + (12 + 15) * [False])

    def test_an_interrupted_survey_goes_on(self):
        command = [os.path.join(base.EXAMPLES, "accuracy"), "--scene", "shiny8", "-s", "32x32"]
        process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, env={**os.environ, **self.own})
        path = self.path("accuracy/results.csv")
        deadline = time.monotonic() + 50
        while not (os.path.exists(path) and os.path.getsize(path) > 500):
            self.assertIsNone(process.poll())
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        out, error = process.communicate(timeout=50)
        self.assertEqual((process.returncode, out), (1, b""))
        self.assertRegex(error.decode(), r"^accuracy: interrupted; \d+ of \d+ rows are in "
                                         r"accuracy/results\.csv; the same command goes on\n$")
        before = self.read("accuracy/results.csv")
        self.accuracy("--scene", "shiny8", "--quick", "-s", "32x32")
        self.assertTrue(self.read("accuracy/results.csv").startswith(before))

    def test_without_gnuplot_the_rest_is_there(self):
        os.mkdir(self.path("bin"))
        result = self.run_it("--scene", "cube", *QUICK, program="accuracy",
                             environment={**self.own, "PATH": self.path("bin")})
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr.decode(), r"^accuracy: no plots: .*gnuplot-nox\n$")
        found = os.listdir(self.path("accuracy"))
        for name in ("results.csv", "results.json", "table.txt", "cube-usual.png"):
            self.assertIn(name, found)
        self.assertNotIn("cube.svg", found)

    def test_one_setting_is_measured_and_shown(self):
        text = self.accuracy("--scene", "sphere", "--setting",
                             "interpolation=gouraud divisions=12", "-s", "64x64")
        self.assertIn("interpolation=gouraud", text)
        self.assertTrue(text.endswith("accuracy/sphere-setting.png\n"))
        self.assertEqual(os.listdir(self.path("accuracy")), ["sphere-setting.png"])

    def test_what_is_wrong_is_said(self):
        for said, *arguments in (
                (r"--scene shiny: there is none; did you mean shiny8\?", "--scene", "shiny"),
                (r"--scene nothing: must be sphere, cube", "--scene", "nothing"),
                (r"--setting: flat: must be AXIS=CHOICE", "--scene", "cube", "--setting", "flat"),
                (r"--setting: divisions=5: must be one of 6, 8", "--scene", "cube", "--setting",
                 "divisions=5"),
                (r"--budget: needs a scene", "--budget", "1"),
                (r"--time-budget: needs a scene", "--time-budget", "1"),
                (r"--setting: needs a scene", "--setting", "usual"),
                (r"--budget and --time-budget: one of them", "--scene", "cube", "--budget", "1",
                 "--time-budget", "1"),
                (r"--budget -2: must be a number", "--scene", "cube", "--budget=-2"),
                (r"--budget -0\.5: must be 0 or more, or -1", "--scene", "cube", "--budget=-0.5"),
                (r"--time-budget -0\.5: must be", "--scene", "cube", "--time-budget=-0.5"),
                (r"--fresh: --setting keeps no rows", "--scene", "cube", "--setting", "usual",
                 "--fresh"),
                (r"--rms: goes with", "--scene", "cube", "--rms"),
                (r"--calibrate: takes all", "--calibrate", "--scene", "cube"),
                (r"--output -: a study is a folder", "-o", "-"),
                (r"--samples: no such option", "--samples", "4"),
                (r"x: not an option", "x")):
            self.wrong(2, said, *arguments)
        self.make("file")
        self.wrong(1, "file: is there already and no folder", "-o", "file")
        result = self.run_it("-o", "new", program="accuracy",
                             environment={**self.own, **base.NO_DRIVER})
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr.decode(), "^accuracy: EGL: .*install.*\n$")
        os.makedirs(self.path("other"))
        self.make("other/results.csv", "name,age\nme,7\n")
        self.wrong(1, r"other/results\.csv", "-o", "other", "--scene", "cube", *QUICK)
        os.makedirs(self.path("odd/results.csv"))
        self.wrong(1, r"odd/results\.csv", "-o", "odd", "--scene", "cube", *QUICK)

    def test_a_full_disk_keeps_the_rows_before_it(self):
        os.mkdir(self.path("accuracy"))
        os.symlink("/dev/full", self.path("accuracy/results.csv"))
        result = self.run_it("--scene", "cube", *QUICK, program="accuracy", environment=self.own)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr.decode(), r"^accuracy: accuracy/results\.csv: .*\n$")


class Choices(Study):
    def test_the_cheapest_within_a_budget_is_named_and_confirmed(self):
        text = self.accuracy("--scene", "sphere", "--budget", "8", *QUICK)
        for part in (r"^cheapest: ", r"\nconfirmed: ", r"\n(the next cheaper: |there is none)",
                     r"\nmeasured with .*LP_NUM_THREADS default, 48x48, seed 1\n$"):
            self.assertRegex(text, part)
        for error in text.split("largest error ")[1:3]:
            self.assertLessEqual(float(error.split()[0]), 8)
        self.assertRegex(self.accuracy("--scene", "sphere", "--budget", "1", "--rms", *QUICK),
                         r"^cheapest: .*\n  rms error ")

    def test_a_budget_out_of_reach_says_the_best(self):
        said = r"--budget 0: no setting of sphere is so exact; the best has 0\.\d+$"
        result = self.run_it("--scene", "sphere", "--budget", "0", *QUICK, program="accuracy",
                             environment=self.own)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr.decode(), "^accuracy: " + said)

    def test_the_most_exact_within_a_time_is_named(self):
        text = self.accuracy("--scene", "sphere", "--time-budget", "1000000", *QUICK)
        self.assertRegex(text, r"^most exact: .*\n")
        self.assertIn("there is none that is more exact", text)
        result = self.run_it("--scene", "sphere", "--time-budget", "0", *QUICK,
                             program="accuracy", environment=self.own)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr.decode(), r"no setting of sphere is so fast; the best takes")

    def test_calibration_asks_first_where_its_table_can_be(self):
        self.own = {"XDG_CONFIG_HOME": "", "HOME": "", "LIGHTING_EFFICIENT": ""}
        self.wrong(1, "nowhere to keep the table: neither HOME", "--calibrate", "--quick")
        self.own["LIGHTING_EFFICIENT"] = self.path("none/table.csv")
        self.wrong(1, r".*none/table\.csv: ", "--calibrate", "--quick")
        self.assertEqual(self.everything(), {})

    def test_calibration_makes_the_table_that_error_chooses_from(self):
        text = self.accuracy("--calibrate", "--quick", "-s", "32x32")
        self.assertRegex(text, r"^.*config/lighting/efficient\.csv: \d+ settings for 6 classes")
        for program in base.SCENES:
            result = self.run_it("--error", "60", "-v", "-s", "64x64", "-o", "x.png",
                                 program=program, environment=self.own)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stderr.decode(),
                             r"view 0: class \w+: .* error at most [\d.]+ steps of 1/255 in "
                             r".*config/lighting/efficient\.csv")
        self.make("named.csv", "# nothing\n")
        self.own["LIGHTING_EFFICIENT"] = self.path("named.csv")
        self.wrong(1, r"--error: .*named\.csv has no row for scenes of the class spot", "--error",
                   "5", program="SpotLight")

    def test_the_committed_table_is_there_without_another(self):
        for error in ("1", "4", "30"):
            self.good("--error", error, "-o", error + ".png", program="ShadingModels",
                      environment=self.own)
        self.assertNotEqual(self.png("1.png").pixels, self.png("30.png").pixels)
        result = self.run_it("--error", "0.001", program="ShadingModels", environment=self.own)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr.decode(), r"--error 0\.001: no setting is so exact for "
                                                 r"scenes of the class shiny128; the least is")
        self.wrong(2, "--error -1: must be", "--error=-1", program="ShadingModels")
        self.wrong(2, "--error and --precision: one of them", "--error", "1", "--precision",
                   "mediump", program="ShadingModels")
        os.mkfifo(self.path("pipe"))
        self.own["LIGHTING_EFFICIENT"] = self.path("pipe")
        self.wrong(1, r".*pipe: is no regular file", "--error", "1", program="ShadingModels")
        self.wrong(2, "--error: no such option", "--error", "1", program="LightedCube",
                   lines=1)


if __name__ == "__main__":
    sys.exit(base.main())
