#!/usr/bin/env python3
"""Films and galleries made by several processes.

usage: parts_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

What the parts make together has the bytes of one run, also if they are killed and run again.
"""
import filecmp
import os
import random
import re
import shutil
import subprocess
import sys
import time
import unittest

import command_line_test as base

SEED = base.seed()
TURN = ("-s", "40x30", "-n", "12")
SOME = ("LightedCube", "Materials", "NormalMatrix")


class Parts(base.Case):
    def film(self, *arguments, **more):
        return self.good(*TURN, *arguments, program="LightedCube_animation", **more)

    def wrong(self, code, said, *arguments, program="LightedCube_animation", **more):
        return self.refused(code, f"^{program}: {said}", *arguments, program=program, **more)

    def killed(self, kills, parts, command):
        """Runs all parts of a command to their ends, after `kills` of them were killed."""
        dice = random.Random(SEED)
        seconds = 0.5
        left = list(range(1, parts + 1))
        while left:
            part = dice.choice(left)
            start = time.monotonic()
            process = subprocess.Popen([*command, "--part", f"{part}/{parts}"], cwd=self.folder,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            try:
                error = process.communicate(
                    timeout=dice.uniform(0, seconds) if kills else base.PATIENCE)[1]
            except subprocess.TimeoutExpired:
                process.kill()
                error = process.communicate()[1]
                kills -= 1
                continue
            self.assertEqual((process.returncode, error), (0, b""), f"LIGHTING_TEST_SEED={SEED}")
            seconds = time.monotonic() - start
            if not kills:  # else it stays, to be killed in another run
                left.remove(part)

    def assert_whole(self, folder):
        for name in os.listdir(self.path(folder)):
            if name.endswith(".png"):
                base.Png(self.read(f"{folder}/{name}"))
            else:
                self.assertRegex(name, r"^\.lighting-\d+-\d+$")  # of one that was killed


    def copy_shaders(self, *names):
        """Copies of shaders in the folder `mine`: their paths."""
        os.makedirs(self.path("mine"), exist_ok=True)
        return [shutil.copy(os.path.join(base.SOURCE, "shaders", name), self.path("mine"))
                for name in names]

    def edit(self, path):
        with open(path, "a") as file:
            file.write("// edited\n")

    def inodes(self, folder):
        return {name: os.stat(self.path(folder, name)).st_ino for name in os.listdir(self.path(folder))}


class Films(Parts):
    def assert_mixture_is_refused(self, program, draw, changed, change):
        """After a change between the parts, of the file `changed`."""
        draw = (*TURN, *draw, "-o", "a.gif")
        for part in (1, 2):
            self.good(*draw, "--part", f"{part}/2", program=program)
            change()
        self.wrong(1, rf"a\.gif\.parts/000001\.png: was drawn from another {changed} than those before "
                      "it", *draw, "--merge", program=program)
        self.assertNotIn("a.gif", os.listdir(self.folder))
        for part in (1, 2):
            self.good(*draw, "--part", f"{part}/2", program=program)
        if os.path.exists(base.MODULE):
            self.good(*draw, "--merge", program=program)
            self.good(*draw[:-1], "one.gif", program=program)
            self.assertTrue(self.read("a.gif") == self.read("one.gif"))
            os.remove(self.path("a.gif"))
        shutil.rmtree(self.path("a.gif.parts"))

    @base.in_long_form
    def test_parts_of_different_shaders_models_or_programs_are_not_merged(self):
        lecture, scene = self.copy_shaders("lecture/LightedCube_animation.frag", "lighting/cone.glsl")
        own = ("--shaders", "mine")
        self.assert_mixture_is_refused("LightedCube_animation", own,
                                       r"LightedCube_animation\.frag", lambda: self.edit(lecture))
        self.assert_mixture_is_refused("FourLights", own, r"cone\.glsl", lambda: self.edit(scene))
        points = ["v 0 0 0\nv 1 0 0\nv 0 1 0\n"]

        def move():
            points[0] += "v 0 0 1\n"
            self.make("a b.obj", points[0] + "f 1 2 3\n" + "f 1 2 4\n" * (points[0].count("v") > 3))

        move()
        if os.path.exists(os.path.join(base.EXAMPLES, "../common/model_assimp.so")):
            self.assert_mixture_is_refused("ShadingModels", ("--model", "a b.obj"), r"a b\.obj", move)
        # What the model names, too, and what that names in a folder.
        triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl one\nf 1 2 3\n"
        self.make("its/m.obj", "mtllib m.mtl\n" + triangle)
        self.make("its/m.mtl", "newmtl one\nKd 1 0 0\nmap_Kd sub/wood.png\n")
        self.make("its/sub/wood.png", self.good("-s", "4x4", "-o", "-", program="LightedCube"))
        for name in "m.mtl", "wood.png":
            path = self.path("its", "sub" * (name == "wood.png"), name)
            self.assert_mixture_is_refused("Scene", ("its/m.obj",), re.escape(name), lambda: self.edit(path))

    @base.in_long_form
    def test_parts_of_different_programs_are_not_merged(self):
        draw = (*TURN, "--shaders", os.path.join(base.SOURCE, "shaders"), "-o", "a.gif")
        other = self.path("build/examples/LightedCube_animation")
        os.makedirs(os.path.dirname(other))
        for name in "common", "source_root":  # its plugins
            os.symlink(os.path.join(base.EXAMPLES, "..", name), self.path("build", name))
        shutil.copy(os.path.join(base.EXAMPLES, "LightedCube_animation"), other)
        with open(other, "ab") as file:
            file.write(b"changed")
        self.good(*draw, "--part", "1/2", program="LightedCube_animation")
        subprocess.run([other, *draw, "--part", "2/2"], cwd=self.folder, check=True)
        self.wrong(1, r"a\.gif\.parts/000001\.png: was drawn from another LightedCube_animation than ",
                   *draw, "--merge")

    def test_a_part_that_is_run_again_keeps_what_matches(self):
        lecture = self.copy_shaders("lecture/LightedCube_animation.frag")[0]
        folder = "a.gif.parts"
        draw = ("--shaders", "mine", "-o", "a.gif", "--part", "1/2")
        self.film(*draw)
        drawn, pictures = self.inodes(folder), self.everything()
        names = sorted(drawn, key=lambda name: int(name[:-4]))
        os.remove(self.path(folder, names[1]))
        self.make(f"{folder}/{names[2]}", self.read(f"{folder}/{names[2]}")[:-30])
        self.make(f"{folder}/{names[3]}", self.read(f"{folder}/{names[0]}"))
        before = self.inodes(folder)
        self.film(*draw)
        after = self.inodes(folder)
        # The first tells what a picture is drawn from.
        self.assertEqual([name for name in names if after[name] == before.get(name)], names[4:])
        self.assertTrue(self.everything() == pictures)
        self.edit(lecture)
        self.film(*draw)
        last = self.inodes(folder)
        self.assertEqual([name for name in names if last[name] == after[name]], [])

    def test_pictures_with_numbers_are_kept_while_nothing_changes(self):
        shader = self.copy_shaders("lecture/LightedCube_animation.frag")[0]
        draw = ("-o", "a%d.png", "--part", "3/3", "--shaders", "mine")
        self.film(*draw)
        os.remove(self.path("a8.png"))
        before = self.inodes(".")
        for drawn in (["a2.png", "a8.png"], ["a11.png", "a2.png", "a5.png", "a8.png"]):
            self.film(*draw)
            after = self.inodes(".")
            self.assertEqual(sorted(name for name in after if after[name] != before.get(name) and name[-1] == "g"), drawn)
            before = after
            self.edit(shader)

    @base.in_long_form
    def test_pictures_with_numbers_are_those_of_one_run(self):
        self.film("-o", "one%d.png")
        for part in (3, 1, 2):
            self.film("-o", "part%d.png", "--part", f"{part}/3")
            if part == 3:
                self.assertEqual({name for name in os.listdir(self.folder) if "part" in name},
                                 {"part%d.png.3-of-3", *(f"part{i}.png" for i in (2, 5, 8, 11))})
        for i in range(12):
            self.assertTrue(self.read(f"one{i}.png") == self.read(f"part{i}.png"), i)
        before = self.everything()
        self.film("-o", "part%d.png", "--part", "40/50")  # has none
        self.assertEqual(self.everything(), before)

    @unittest.skipUnless(os.path.exists(base.MODULE), "without OpenImageIO")
    def test_a_film_has_the_bytes_of_one_run_after_kills(self):
        suffixes = ("gif", "webp", "apng", "mp4", "webm") if shutil.which("ffmpeg") else ("gif",)
        command = [os.path.join(base.EXAMPLES, "LightedCube_animation"), *TURN, "-o", "100%.gif"]
        self.killed(100 // base.LONG if base.LONG else 4, 3, command)
        self.assert_whole("100%.gif.parts")
        for suffix in suffixes[::base.step(9)]:
            self.film("-o", "one." + suffix)
            if suffix != "gif":
                os.rename(self.path("100%.gif.parts"), self.path(f"100%.{suffix}.parts"))
            self.film("-o", "100%." + suffix, "--merge")
            self.assertTrue(self.read("one." + suffix) == self.read("100%." + suffix), suffix)
            if suffix != "gif":
                os.rename(self.path(f"100%.{suffix}.parts"), self.path("100%.gif.parts"))

    @unittest.skipUnless(base.DIAGRAMS and os.path.exists(base.MODULE), "without cairo")
    def test_diagrams_have_parts(self):
        for output in ("one.gif", "one%d.svg"):
            draw = ("-s", "60x60", "-n", "3", "-o", output)
            self.good(*draw, program="Vectors")
            before = self.everything()
            for name in before:
                os.remove(name)
            for part in ("1/2", "2/2"):
                self.good(*draw, "--part", part, program="Vectors")
            if output == "one.gif":
                self.good(*draw, "--merge", program="Vectors")
                shutil.rmtree(self.path("one.gif.parts"))
            self.assertTrue(self.everything() == before)
            for name in before:
                os.remove(name)

    @unittest.skipUnless(os.path.exists(base.MODULE), "without OpenImageIO")
    @base.in_long_form
    def test_what_is_missing_or_of_another_command_is_said(self):
        draw = (*TURN[:2], "-n", "3", "-o", "a.gif")
        self.wrong(1, r"a\.gif\.parts: 3 of 3 pictures are missing, the first is 000000\.png; "
                      "--part draws them", *draw, "--merge")
        for part in ("1/2", "2/2"):
            self.good(*draw, "--part", part, program="LightedCube_animation")
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.gif.parts"])
        whole = self.read("a.gif.parts/000001.png")
        for content, said in (
                (self.read("a.gif.parts/000000.png"), "is not of this command but of: .* 40x30;"),
                (whole[:-20], "is no whole PNG picture"), (b"", "is no whole PNG picture"),
                (b"GIF89a", "is no whole PNG picture"),
                (self.good(*TURN[:2], "-t", "0.03333333333333333", "-o", "-",
                                program="LightedCube_animation",
                                environment={"GALLIUM_OVERRIDE_CPU_CAPS": "sse4.1",
                                             "LP_NATIVE_VECTOR_WIDTH": "128"}),
                 "was drawn by .*128 bits.*--deterministic")):
            if b"128 bits" in content and b"128 bits" in whole:
                continue  # an older processor
            self.make("a.gif.parts/000001.png", content)
            self.wrong(1, r"a\.gif\.parts/000001\.png: " + said, *draw, "--merge")
        self.make("a.gif.parts/000001.png", whole)
        self.wrong(1, r"a\.gif\.parts/000000\.png: is not of this command", *draw, "-t", "1",
                   "--merge")
        self.good(*draw, "--merge", program="LightedCube_animation")

    def test_usage_errors(self):
        several = r"--part 1/2: is one of several pictures that go to files"
        for said, *arguments in (
                ("--part 0/2: must be I/N", "--part", "0/2"),
                ("--part 3/2: must be I/N", "--part", "3/2"),
                ("--part 2: must be I/N", "--part", "2"),
                (several, "--part", "1/2"), (several, "--part", "1/2", "-o", "a.gif"),
                (several, *TURN, "--part", "1/2", "-o", "-", "--format", "y4m"),
                (several, *TURN, "--part", "1/2", "-o", "a%d.png", "--watch"),
                ("--merge: puts an animation together", "--merge"),
                ("--merge: puts an animation together", *TURN, "--merge"),
                ("--part and --merge: one of them", *TURN, "--merge", "--part", "1/2")):
            self.wrong(2, said, *arguments)


class Galleries(Parts):
    def gallery(self, *arguments, **more):
        return self.good(*base.SMALL, *arguments, program="gallery", **more).decode()

    @base.in_long_form
    def test_parts_make_the_gallery_of_one_run_after_kills(self):
        command = [os.path.join(base.EXAMPLES, "gallery"), *base.SMALL, *SOME, "-o", "parts"]
        self.gallery(*SOME, "-o", "one")
        self.killed(100 // base.LONG if base.LONG else 3, 2, command)
        self.assert_whole("parts.parts")
        self.assertNotIn("parts", os.listdir(self.folder))
        self.gallery(*SOME, "-o", "parts", "--merge")
        self.assertEqual(filecmp.cmpfiles(self.path("one"), self.path("parts"), os.listdir(self.path("one")), False)[1:],
                         ([], []))

    def test_merging_what_is_not_there_fails(self):
        self.gallery("LightedCube", "--part", "1/1", "-o", "g")
        self.wrong(1, r"g\.parts/Materials\.png: cannot read", *base.SMALL, "LightedCube", "Materials",
                   "--merge", "-o", "g", program="gallery")
        self.wrong(1, r"g\.parts/LightedCube\.png: is not of this command", "-s", "41x41", "LightedCube",
                   "--merge", "-o", "g", program="gallery")
        self.assertEqual(os.listdir(self.folder), ["g.parts"])

    @base.in_long_form
    def test_parts_of_two_versions_of_a_shader_are_no_gallery(self):
        mine = self.copy_shaders("lighting/cone.glsl")
        draw = ("Materials", "ColoredLights", "--shaders", "mine", "-o", "g")
        self.gallery(*draw, "--part", "1/2")
        self.edit(mine[0])
        self.gallery(*draw, "--part", "2/2")
        self.wrong(1, r"g\.parts/ColoredLights\.png: was drawn from another cone\.glsl ", *base.SMALL,
                   *draw, "--merge", program="gallery")
        self.assertNotIn("g", os.listdir(self.folder))
        self.gallery(*draw, "--part", "1/2")
        self.gallery(*draw, "--merge")


if __name__ == "__main__":
    sys.exit(base.main())
