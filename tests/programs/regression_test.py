"""gallery --verify DIR: what rounding and edges can have moved between two drivers passes; a mistake is named with its line."""
import os
import re
import sys

import command_line_test as base

NAMES = ("LightedTranslatedRotatedCube", "PointLightedSphere_perFragment", "ShininessRow")
ROUNDED = re.compile(r"\w+: \d+ pixels? moved(?: \(\d+ at edges\))? by up to \d+ steps?: all by rounding(?: or at edges)?")


DRIVERS = {"llvmpipe": {"GALLIUM_DRIVER": "llvmpipe"}, "softpipe": {"GALLIUM_DRIVER": "softpipe"},
           "128 bits": {"GALLIUM_DRIVER": "llvmpipe", "LP_NATIVE_VECTOR_WIDTH": "128"}}


class Regression(base.Case):
    def gallery(self, *arguments, code=0, driver=None):
        said = self.run_it("--samples", "0", "-s", "150x150", *arguments, program="gallery", environment=DRIVERS.get(driver))
        self.assertEqual((said.returncode, said.stderr), (code, b""), said.stdout)
        return said.stdout.decode().splitlines()

    @base.in_long_form
    def test_drivers_differ_by_rounding_and_edges(self):
        names = () if base.LONG == 1 else NAMES  # all programs
        pairs = (("llvmpipe", "softpipe"), ("softpipe", "llvmpipe"), ("llvmpipe", "128 bits"), ("softpipe", "128 bits"))[::base.step(4)]
        for driver in {before for before, _ in pairs}:
            self.gallery(*names, "-o", driver, driver=driver)
        for before, now in pairs:
            said = self.gallery("--verify", before, "-o", "report", driver=now)
            moved = [line for line in said if ROUNDED.fullmatch(line)]
            self.assertEqual(bool(moved), "softpipe" in (before, now))
            self.assertEqual(len(moved) + (2 if moved else 1), len(said), said)
            self.assertIn(f", {len(moved)} moved by rounding, 0 cannot have, 0 cannot be judged", said[len(moved)])
            page = self.read("report/index.html").decode() if moved else ""
            for line in moved:
                self.assertIn(line.partition(": ")[2], page)
                name = line.partition(":")[0]
                self.assertTrue(self.png(f"report/{name}-difference.png").pixels)
                # Both over each other, and what moves their border.
                self.assertRegex(page, rf'"{name}-now[.]png".*class="before" src="{name}-before[.]png".*\n<input type="range"[^>]*{name}:.*clipPath')

    @base.in_long_form
    def test_a_mistake_is_named_with_its_line(self):
        self.gallery(*NAMES[1:], "-o", "before", "--keep-shaders")
        # Mistakes of the labs, each of more than two steps of 1/255.
        for name, was, now, variable in (
                ("PointLightedSphere_perFragment.frag", "normalize(v_Normal)", "v_Normal", "normal"),
                ("PointLightedSphere_perFragment.frag", "u_LightPosition - v_Position", "u_LightPosition - 0.5 * v_Position", "lightDirection"),
                ("PointLightedSphere_perFragment.frag", "max(dot(lightDirection, normal), 0.0)", "dot(lightDirection, normal)", "nDotL"),
                ("PointLightedSphere_perFragment.vert", "vec3(u_ModelMatrix", "0.5 * vec3(u_ModelMatrix", "v_Position"))[::base.step(4)]:
            with open(os.path.join(base.SOURCE, "shaders/lecture", name), encoding="utf-8") as file:
                text = file.read()
            self.assertEqual(text.count(was), 1)
            self.make("mine/" + name, text.replace(was, now))
            line = text[:text.index(was)].count("\n") + 1
            said = self.gallery("PointLightedSphere_perFragment", "--shaders", "mine", "--verify", "before", code=1)
            self.assertIn(f" cannot be by rounding: {variable}, in {name}:{line}: ", said[-3])
            self.assertIn(f": {name} has changed", said[1])
            os.remove(self.path("mine/" + name))
        said = self.gallery("ShininessRow", "--orbit", "5,0", "--verify", "before", code=1)
        self.assertRegex(said[0], "^ShininessRow: its command was ShininessRow .*, and is ShininessRow .*--orbit 5,0")
        self.assertRegex(said[1], r"cannot be by rounding; most like the change is \w+.*, in \w+\.\w+:\d+: ")

    def test_an_edge_that_is_moved_is_no_rounding(self):
        self.gallery("SpotLight", "-o", "before", "--keep-shaders")
        with open(os.path.join(base.SOURCE, "shaders/lighting/group.glsl"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn("in_cone(along, u_Spot[i].w)", text)
        self.make("mine/lighting/group.glsl", text.replace("in_cone(along, u_Spot[i].w)", "in_cone(along, u_Spot[i].w * 1.01)"))
        said = self.gallery("SpotLight", "--shaders", "mine", "--verify", "before", code=1)
        self.assertRegex(said[2], r"pixels moved.* by up to \d{3} steps: \d+ cannot be by rounding: group.glsl:\d+: +share \*= in_cone")

    def test_what_is_no_folder_of_pictures_is_refused(self):
        self.gallery(NAMES[0], "-o", "before")
        os.mkdir(self.path("empty"))
        self.refused(1, "^gallery: empty: has no picture of a program", "--verify", "empty", program="gallery")
        self.refused(1, "^gallery: before: has the earlier pictures", "--verify", "before", "-o", "before", program="gallery")
        self.refused(2, "^gallery: --verify before: leave out", "--verify", "before", "--keep-shaders", program="gallery")
        self.refused(1, "ShininessRow.png", "--verify", "before", "ShininessRow", program="gallery")
        self.refused(1, "^gallery: before/Light.*: is of 150x150 pixels, not 400x400; draw as it was drawn, with --size 150x150 --samples 0\n",
                     "--verify", "before", program="gallery")
        self.refused(1, "^gallery: none: has no picture of a program", "--verify", "none", program="gallery")
        self.refused(2, "^gallery: --keep-shaders: goes with neither", "--keep-shaders", "--part", "1/2", program="gallery")


if __name__ == "__main__":
    sys.exit(base.main())
