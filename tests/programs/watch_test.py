#!/usr/bin/env python3
"""The programs with --watch: shaders are edited while they run, and the picture follows.

usage: watch_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

No test fails for being slow alone: PATIENCE is for what never comes. Exit code: 77 where nothing
can be drawn.
"""
import difflib
import os
import queue
import re
import shutil
import statistics
import subprocess
import sys
import threading
import time
import unittest

import command_line_test as base

PATIENCE = base.PATIENCE
SMALL = base.SMALL
FRAGMENT = "mine/LightedCube.frag"
READY = r"^\w+: watching its shader files; Ctrl-C ends$"


class Watching:
    """A program that runs, and what it says on standard error, line by line."""

    def __init__(self, case, program, *arguments, environment=None, **more):
        clean = {key: value for key, value in os.environ.items() if key != "LIGHTING_SHADERS"}
        self.case = case
        self.process = subprocess.Popen(
            [os.path.join(base.EXAMPLES, program), "--watch", *arguments], cwd=case.folder,
            env={**clean, **(environment or {})}, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more)
        self.lines, self.said = queue.Queue(), []
        self.reader = threading.Thread(target=self.read)
        self.reader.start()
        case.addCleanup(self.end)

    def read(self):
        for line in self.process.stderr:
            self.lines.put(line.rstrip("\n"))
        self.lines.put(None)

    def end(self):
        """Its exit status, having been interrupted as by Ctrl-C; the first time that it is asked."""
        if self.process.poll() is None:
            self.process.send_signal(2)
        try:
            status = self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        self.reader.join()
        self.process.stdout.close()
        self.process.stderr.close()
        return status

    def next_line(self):
        try:
            line = self.lines.get(timeout=PATIENCE)
        except queue.Empty:
            self.case.fail(f"it said nothing more after: {self.said}")
        self.case.assertIsNotNone(line, f"it ended, having said: {self.said}")
        self.said.append(line)
        return line

    def expect(self, *patterns):
        """The next lines are these."""
        for pattern in patterns:
            self.case.assertRegex(self.next_line(), pattern)

    def ready(self):
        while not re.search(READY, self.next_line()):
            pass
        return self

    def drew(self, changed, output="out.png", how="(changed|is gone)"):
        """The next redraw, which names this file; errors may come before."""
        while True:
            line = self.next_line()
            if " drew " in line:
                break
        self.case.assertRegex(line, rf"^\w+: {re.escape(changed)} {how}; "
                                    rf"drew {re.escape(output)} in \d+ ms$")

    def refused(self, pattern):
        """It says this, perhaps after messages about earlier edits."""
        while not re.search(pattern, self.next_line()):
            pass

    def silent(self, seconds=0.3):
        try:
            self.case.fail(f"unexpected output: {self.lines.get(timeout=seconds)}")
        except queue.Empty:
            pass


class Watched(base.Case):
    def copy(self, *names, to="mine"):
        for name in names:
            path = self.path(to, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            shutil.copy(os.path.join(base.SOURCE, "shaders", name), path)

    def copy_cube(self):
        os.makedirs(self.path("mine"), exist_ok=True)
        for kind in ("vert", "frag"):
            shutil.copy(os.path.join(base.SOURCE, "shaders/lecture/LightedCube." + kind),
                        self.path("mine"))

    def watch(self, *arguments, program="LightedCube", **more):
        return Watching(self, program, "-o", "out.png", *SMALL, *arguments, **more)

    def watch_cube(self):
        self.copy_cube()
        return self.watch("--shaders", "mine")

    def edit(self, name, old, new):
        """As most editors do: whole, then renamed."""
        text = self.read(name).decode()
        self.assertIn(old, text)
        self.make(name + ".new", text.replace(old, new))
        os.replace(self.path(name + ".new"), self.path(name))

    def is_as_drawn(self, *arguments, program="LightedCube", name="out.png", **more):
        """The picture is, to the byte of a pixel, what the program draws now without --watch."""
        self.good("-o", "plain.png", *SMALL, *arguments, program=program, **more)
        self.assertEqual(self.png(name).pixels, self.png("plain.png").pixels)
        return self.read(name)


class Pictures(Watched):
    def test_edit_break_mend(self):
        watching = self.watch_cube()
        watching.expect(r"^LightedCube: drew out\.png in \d+ ms$", READY)
        first = self.is_as_drawn("--shaders", "mine")

        self.edit(FRAGMENT, "= v_Color", "= v_Color.bgra")
        watching.drew(FRAGMENT)
        second = self.is_as_drawn("--shaders", "mine")
        self.assertNotEqual(self.png("out.png").pixels, base.Png(first).pixels)

        for old, new in (("= v_Color", "= v_Colour"), ("= v_Colour", "= 1 + v_Color")):
            self.edit(FRAGMENT, old, new)
            watching.refused(r"^mine/LightedCube\.frag:8: ")
            watching.refused(r"^  8 \|     gl_FragColor = " + re.escape(new[2:]))
            self.assertEqual(self.read("out.png"), second)
        self.edit(FRAGMENT, "= 1 + v_Color", "= v_Color")
        watching.drew(FRAGMENT)
        self.assertEqual(self.is_as_drawn("--shaders", "mine"), second)
        self.edit(FRAGMENT, "= v_Color.bgra", "= v_Color")
        watching.drew(FRAGMENT)
        self.assertEqual(self.png("out.png").pixels, base.Png(first).pixels)
        self.assertEqual(watching.end(), -2)
        self.assertEqual(sorted(os.listdir(self.folder)), ["mine", "out.png", "plain.png"])

    @base.in_long_form
    def test_every_way_of_saving(self):
        watching = self.watch_cube().ready()
        swaps = ("v_Color.grba", "v_Color.brga", "v_Color.rgba")

        def in_place(text):
            self.make(FRAGMENT, text)

        def in_two_steps(text):
            with open(self.path(FRAGMENT), "w") as file:
                file.write(text[:40])
                file.flush()
                file.write(text[40:])

        def with_backup(text):
            os.rename(self.path(FRAGMENT), self.path(FRAGMENT + "~"))
            self.make(FRAGMENT, text)
            os.remove(self.path(FRAGMENT + "~"))

        def removed_before(text):
            os.remove(self.path(FRAGMENT))
            self.make(FRAGMENT, text)

        def as_a_link(text):
            self.make("elsewhere/new.frag", text)
            os.symlink("../elsewhere/new.frag", self.path("mine/link"))
            os.replace(self.path("mine/link"), self.path(FRAGMENT))

        def through_the_link(text):
            self.make("elsewhere/new.frag", text)

        for i, save in enumerate((in_place, in_two_steps, with_backup, removed_before, as_a_link,
                                  through_the_link)):
            with self.subTest(save=save.__name__):
                text = self.read(FRAGMENT).decode()
                save(re.sub(r"= v_Color(\.\w+)?;", f"= {swaps[i % 3]};", text))
                watching.drew(FRAGMENT)
                self.is_as_drawn("--shaders", "mine")

    def test_an_unchanged_text_draws_nothing(self):
        watching = self.watch_cube().ready()
        before = os.stat(self.path("out.png"))
        os.utime(self.path(FRAGMENT))
        self.make(FRAGMENT, self.read(FRAGMENT))
        self.make("mine/another.frag", "x")
        watching.silent()
        after = os.stat(self.path("out.png"))
        self.assertEqual((before.st_ino, before.st_mtime_ns), (after.st_ino, after.st_mtime_ns))

    @base.in_long_form
    def test_a_copy_that_comes_later_is_found(self):
        os.mkdir(self.path("mine"))
        watching = self.watch("--shaders", "mine").ready()
        self.copy("lecture/LightedCube.frag", to="other")
        self.edit("other/lecture/LightedCube.frag", "= v_Color", "= v_Color.bgra")
        os.rename(self.path("other/lecture/LightedCube.frag"), self.path(FRAGMENT))
        watching.drew(FRAGMENT)
        self.is_as_drawn("--shaders", "mine")
        os.makedirs(self.path("mine/lecture"))
        self.copy("lecture/LightedCube.frag")
        watching.drew("mine/lecture/LightedCube.frag")
        self.is_as_drawn()
        os.remove(self.path("mine/lecture/LightedCube.frag"))
        watching.drew("mine/lecture/LightedCube.frag", how="is gone")
        self.is_as_drawn("--shaders", "mine")

    def test_the_sample_of_a_shader_of_ones_own_draws_in_steps(self):
        """Background, ambient light alone, and three steps of 0.8 of light; the file takes no more of the
        lecture's than its way to round the cosine."""
        program, folder = "PointLightedSphere_perFragment", os.path.join(base.SOURCE, "shaders/toon")
        picture = self.drawn("--shaders", folder, "-s", "300x300", program=program)
        greys = sorted(set(zip(*[iter(picture.pixels)] * 3)))
        expected = [0, *(255 * (0.2 + 0.8 * step / 3) for step in range(4))]
        self.assertEqual(len(greys), len(expected), greys)
        for grey, value in zip(greys, expected):
            self.assertEqual(len(set(grey)), 1)
            self.assertLessEqual(abs(grey[0] - value), 1)  # rounding, in mediump
        with open(os.path.join(base.SOURCE, "examples/pictures/toon.png"), "rb") as file:
            self.assertEqual(base.Png(file.read()).pixels, picture.pixels)
        texts = []
        for part in "lecture", "toon":
            with open(os.path.join(base.SOURCE, f"shaders/{part}/{program}.frag")) as file:
                texts.append([line for line in file.read().split("\n") if line and not line.startswith("//")])
        code = [line for line in difflib.ndiff(*texts) if line[0] in "+-" and not line[1:].strip().startswith("//")]
        self.assertTrue(all(re.search("STEPS|toon|nDotL;", line) for line in code), code)

    def test_the_folder_of_the_environment(self):
        self.copy_cube()
        environment = {"LIGHTING_SHADERS": self.path("mine")}
        watching = self.watch(environment=environment).ready()
        self.edit(FRAGMENT, "= v_Color", "= v_Color.bgra")
        watching.drew(self.path(FRAGMENT))
        self.is_as_drawn(environment=environment)
        os.rename(self.path("mine"), self.path("away"))
        watching.refused(r"LIGHTING_SHADERS=.*: there is no such folder")
        os.rename(self.path("away"), self.path("mine"))
        watching.drew(self.path("mine/LightedCube.vert"))  # which is read first

    @base.in_long_form
    def test_an_include_of_a_scene(self):
        self.copy("lighting.vert", "lighting.frag", *(
            "lighting/" + name
            for name in os.listdir(os.path.join(base.SOURCE, "shaders/lighting"))))
        output = "mine/lighting/output.glsl"
        options = ("--shaders", "mine")
        watching = self.watch(*options, program="SpotLight").ready()
        self.edit(output, "return color", "return color * vec3(1.0, 0.5, 0.0)")
        watching.drew(output)
        drawn = self.is_as_drawn(*options, program="SpotLight")
        self.edit(output, "return color", "return colour")
        watching.refused(r"^mine/lighting/output\.glsl:4: ")
        self.assertEqual(self.read("out.png"), drawn)
        os.remove(self.path(output))
        watching.drew("mine/lighting/output.glsl")  # the source's own, which is found after it
        self.is_as_drawn(*options, program="SpotLight")
        self.make(output, "vec3 output_color(vec3 color) { return color.bbb; }\n")
        watching.drew(output)
        self.is_as_drawn(*options, program="SpotLight")

    @base.in_long_form
    def test_a_file_that_an_edit_includes_is_watched(self):
        watching = self.watch_cube().ready()
        self.edit(FRAGMENT, "void main", '#include "swap.glsl"\nvoid main')
        watching.refused(r"^mine/LightedCube\.frag:7: swap\.glsl: no such shader file")
        self.edit(FRAGMENT, "= v_Color", "= swap(v_Color)")
        watching.refused(r"^mine/LightedCube\.frag:7: swap\.glsl: no such shader file")
        self.make("mine/swap.glsl", "vec4 swap(vec4 color) { return color.bgra; }\n")
        watching.drew("mine/swap.glsl")
        self.is_as_drawn("--shaders", "mine")
        self.edit("mine/swap.glsl", "bgra", "grba")
        watching.drew("mine/swap.glsl")
        self.is_as_drawn("--shaders", "mine")

    @base.in_long_form
    def test_a_uniform_can_become_unused(self):
        watching = self.watch_cube().ready()
        vertex = "mine/LightedCube.vert"
        for old, new, warning in (
                ("u_LightColor * a_Color", "a_Color", "u_LightColor is not used"),
                (" a_Color.rgb * nDotL", " vec3(nDotL)", "u_LightColor is not used"),
                ("max(dot(u_LightDirection, normal), 0.0)", "a_Color.r",
                 "a_Normal is not used, u_LightColor is not used, u_LightDirection is not used")):
            self.edit(vertex, old, new)
            watching.expect(rf"^{vertex}:\d+: warning: {warning}$",
                            rf"^LightedCube: {vertex} changed; drew out\.png in \d+ ms$")
        self.copy_cube()
        watching.drew(vertex)
        self.is_as_drawn("--shaders", "mine")

    @base.in_long_form
    def test_it_can_begin_with_a_broken_shader(self):
        self.copy_cube()
        self.edit(FRAGMENT, "= v_Color", "= v_Colour")
        self.make("out.png", "old")
        watching = self.watch("--shaders", "mine")
        watching.refused(r"^mine/LightedCube\.frag:8: ")
        watching.ready()
        self.assertEqual(self.read("out.png"), b"old")
        self.edit(FRAGMENT, "= v_Colour", "= v_Color")
        watching.drew(FRAGMENT)
        self.is_as_drawn("--shaders", "mine")

    @base.in_long_form
    def test_numbered_pictures(self):
        self.copy_cube()
        watching = Watching(self, "LightedCube", "-o", "out%d.png", *SMALL, "-n", "3", "--shaders",
                            "mine").ready()
        self.edit(FRAGMENT, "= v_Color", "= v_Color.bgra")
        watching.drew(FRAGMENT, output="out%d.png")
        for i in range(3):
            self.is_as_drawn("--shaders", "mine", "-t", str(i / 30), name=f"out{i}.png")

    def test_a_picture_that_cannot_be_written_does_not_end_it(self):
        watching = self.watch_cube().ready()
        os.remove(self.path("out.png"))
        os.mkdir(self.path("out.png"))
        self.edit(FRAGMENT, "= v_Color", "= v_Color.bgra")
        watching.refused(r"^LightedCube: out\.png: is a folder")
        os.rmdir(self.path("out.png"))
        self.edit(FRAGMENT, "= v_Color.bgra", "= v_Color.brga")
        watching.drew(FRAGMENT)
        self.is_as_drawn("--shaders", "mine")


class Faults(Watched):
    def test_conflicting_options(self):
        for said, *arguments in (
                (r"--output -: standard output takes one picture, and --watch draws many; name",
                 "-o", "-"),
                (r"--watch and --print-shader: one of them", "--print-shader=frag"),
                (r"--watch and --explain: one of them", "--explain")):
            self.refused(2, rf"^SpotLight: {said}", "--watch", *arguments, program="SpotLight")
        self.refused(1, r"none: no such shader folder", "--watch", "--shaders", "none")
        self.refused(1, r"none\.obj: ", "--watch", "--model", "none.obj", program="SpotLight")
        self.refused(1, r"none/out\.png: the folder none/ does not exist", "--watch", "-o",
                     "none/out.png")


class Latency(Watched):
    TIMES = int(os.environ.get("LIGHTING_TEST_TIMES", "5"))

    def measure(self, program, name, old, news):
        """From the moment that the shader has its name to that when the picture has its own."""
        found = []
        watching = Watching(self, program, "-o", "out.png", "--shaders", "mine").ready()
        for i in range(self.TIMES):
            before = os.stat(self.path("out.png")).st_ino
            self.edit(name, old, news[i % 2])
            start = time.monotonic()
            while os.stat(self.path("out.png")).st_ino == before:
                self.assertLess(time.monotonic() - start, PATIENCE)
                time.sleep(0.0005)
            found.append(1e3 * (time.monotonic() - start))
            old = news[i % 2]
            watching.drew(name)
        print(f"{program}, 400x400: {statistics.median(found):.0f} ms from the edit to the "
              f"picture, at worst {max(found):.0f}, of {len(found)}")

    def test_latency(self):
        self.copy_cube()
        self.measure("LightedCube", FRAGMENT, "= v_Color;", ("= v_Color.bgra;", "= v_Color;"))
        self.copy("lighting.vert", "lighting.frag", "lighting/output.glsl")
        self.measure("SpotLight", "mine/lighting/output.glsl", "return color;",
                     ("return color.bgr;", "return color;"))


if __name__ == "__main__":
    sys.exit(base.main())
