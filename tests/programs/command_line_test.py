#!/usr/bin/env python3
"""The programs' command line: options, faults, streams and every kind of file.

usage: command_line_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

Exit codes are those of --help: 1 if the machine, a file or a driver does not allow it, 2 for a bad
command line. A failing program writes one line and no file, and changes none. Exit code of the test:
77 without a driver.
"""
import array
import fcntl
import functools
import glob
import itertools
import json
import os
import pty
import pwd
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import time
import unittest
import zlib

# The tests end programs by signals, which may be inherited as ignored, as under nohup.
for number in (signal.SIGINT, signal.SIGHUP):
    if signal.getsignal(number) == signal.SIG_IGN:
        signal.signal(number, signal.SIG_DFL)

# Hundreds of processes: without the leak checker. Leaks show in the tests in C.
SANITIZED = "ASAN_OPTIONS" in os.environ  # as .ci/run sets it
if SANITIZED:
    os.environ["ASAN_OPTIONS"] += ":detect_leaks=0"

EXAMPLES, SOURCE = (os.path.abspath(path) for path in sys.argv[1:3])
PROGRAMS = sorted(name[:-2] for name in os.listdir(os.path.join(SOURCE, "examples/lecture"))
                  if name.endswith(".c"))
SCENES = sorted(name[:-2] for name in os.listdir(os.path.join(SOURCE, "examples/lighting"))
                if name.endswith(".c"))
# Built where cairo is.
DIAGRAMS = [name for name in ("Vectors",) if os.path.exists(os.path.join(EXAMPLES, name))]
EVERY = PROGRAMS + SCENES + DIAGRAMS + ["lessons", "gallery", "accuracy", "hard_cases", "precision", "check"] + sorted(
    name for name in os.listdir(os.path.join(SOURCE, "examples/labs")) if re.match(r"lab\d", name)
    and "." not in name)
MODULE = os.path.join(EXAMPLES, "../common/image_oiio.so")
PLACEHOLDERS = {"R,G,B": "0.25,0.1,1", "X,Y,Z": "0.5,2,1", "DEG": "30"}
NO_DRIVER = {"__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent", "LIBGL_DRIVERS_PATH": "/nonexistent"}
# A user whom permissions bind: as root, a bug could replace a device.
SOMEBODY = {"user": 65534, "group": 65534, "extra_groups": []} if os.getuid() == 0 else {}
SMALL = ("-s", "40x40")
# Seconds after which a program counts as hanging, also on a busy machine.
PATIENCE = 600
LONG = int(os.environ.get("LIGHTING_TEST_LONG") or 0)
SAMPLE = "LIGHTING_TEST_SAMPLE" in os.environ  # as tests/systems/run --sample sets it


def step(number):
    """Of many similar cases: the short form takes every `4 * number`-th, the long one every LIGHTING_TEST_LONG-th at
    least, which tests/run sets; AddressSanitizer, which needs code rather than cases, and another system a quarter of the
    short one's."""
    return min(LONG, 2 * number) if LONG else 16 * number if SANITIZED or SAMPLE else 4 * number


def in_long_form(test):
    """A case that costs much and that a change seldom breaks: the short form leaves it out."""
    return test if LONG else None  # which is no case


def seed():
    """Of random cases, printed: the same in every run, which only a change of the program may fail, and another with
    tests/run --all. LIGHTING_TEST_SEED replaces it."""
    number = int(os.environ.get("LIGHTING_TEST_SEED", random.SystemRandom().randrange(1 << 30) if LONG == 1 else 1))
    print(f"LIGHTING_TEST_SEED={number}", file=sys.stderr)
    return number


def terminal():
    """The two ends of a pseudo-terminal, which a chroot or a container may lack."""
    try:
        return pty.openpty()
    except OSError as error:
        raise unittest.SkipTest("this machine has no pseudo-terminals; mount /dev/pts") from error


def on_terminal(command, stream="stderr", columns=0, **more):
    """The status, and what a command writes to a terminal that is its standard error or output."""
    ours, theirs = terminal()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("4H", 24 if columns else 0, columns, 0, 0))
    process = subprocess.Popen(command, **{"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL,
                                           stream: theirs, **more})
    os.close(theirs)
    said = b""
    try:
        while chunk := os.read(ours, 65536):
            said += chunk
    except OSError:  # EIO: nobody has it open any more
        pass
    os.close(ours)
    return process.wait(), said.decode()


class Png:
    """An RGB or RGBA PNG of 8 bits: its size, pixels and texts. Every checksum is checked."""

    def __init__(self, data):
        assert data[:8] == b"\x89PNG\r\n\x1a\n", "no PNG signature"
        at, packed, self.texts, kind = 8, b"", {}, b""
        while at < len(data):
            length, kind = struct.unpack(">I4s", data[at:at + 8])
            body = data[at + 8:at + 8 + length]
            assert struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0] == zlib.crc32(
                kind + body), f"wrong checksum of {kind}"
            at += 12 + length
            if kind == b"IHDR":
                self.width, self.height, depth, color = struct.unpack(">IIBB", body[:10])
                assert depth == 8 and color in (2, 6) and body[10:] == b"\0\0\0", body
                self.channels = 3 if color == 2 else 4
            elif kind == b"tEXt":
                key, text = body.split(b"\0", 1)
                self.texts[key.decode("latin-1")] = text.decode("latin-1")
            elif kind == b"IDAT":
                packed += body
        assert kind == b"IEND", "no end"
        self.raw = zlib.decompress(packed)
        assert len(self.raw) == (self.width * self.channels + 1) * self.height, "wrong length"

    @functools.cached_property
    def pixels(self):
        raw, stride, step = self.raw, self.width * self.channels, self.channels
        above, pixels = bytearray(stride), bytearray()
        for start in range(0, len(raw), stride + 1):
            kind, row = raw[start], bytearray(raw[start + 1:start + 1 + stride])
            if kind == 1:  # the programs' own, fast: the low bytes of the sums from the left
                for c in range(step):
                    sums = array.array("I", itertools.accumulate(row[c::step]))
                    if sys.byteorder == "big":
                        sums.byteswap()
                    row[c::step] = sums.tobytes()[::sums.itemsize]
                kind = 0
            for i in range(stride if kind else 0):
                b = above[i]
                a, c = (row[i - step], above[i - step]) if i >= step else (0, 0)
                near = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
                row[i] = (row[i] + (0, a, b, (a + b) // 2, near)[kind]) & 255
            pixels += row
            above = row
        return bytes(pixels)

    def at(self, x, y):
        start = (y * self.width + x) * self.channels
        return tuple(self.pixels[start:start + self.channels])


class Case(unittest.TestCase):
    """A test in a folder of its own, in which the programs run."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="command_line_test-")
        os.chmod(self.folder, 0o755)
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def make(self, name, content=b"old"):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def png(self, name):
        return Png(self.read(name))

    def drawn(self, *arguments, **more):
        return Png(self.good(*arguments, "-o", "-", **more))

    def everything(self):
        """What the folder has, down to the bytes; pipes and folders by their kind alone."""
        found = {}
        for folder, folders, files in os.walk(self.folder):
            if "cache" in folders:
                folders.remove("cache")  # XDG_CACHE_HOME
            for name in folders + files:
                path = os.path.join(folder, name)
                if os.path.islink(path):
                    found[path] = os.readlink(path)
                elif os.path.isfile(path):
                    with open(path, "rb") as file:
                        found[path] = file.read()
                else:
                    found[path] = os.lstat(path).st_mode
        return found

    def run_it(self, *arguments, program="LightedCube", environment=None, shell="", cwd=None,
               **more):
        """`shell` are redirections: "2>&-"."""
        clean = {key: value for key, value in os.environ.items() if key != "LIGHTING_SHADERS"}
        command = [os.path.join(EXAMPLES, program), *arguments]
        if shell:
            command = ["sh", "-c", 'exec "$@" ' + shell, "sh", *command]
        more.setdefault("stdout", subprocess.PIPE)
        return subprocess.run(command, cwd=cwd or self.folder, env={**clean, **(environment or {})},
                              stderr=subprocess.PIPE, timeout=PATIENCE, **more)

    def good(self, *arguments, **more):
        result = self.run_it(*arguments, **more)
        self.assertEqual((result.returncode, result.stderr), (0, b""), arguments)
        return result.stdout

    def good_or_unused(self, *arguments, **more):
        """The same, but options may be named that do nothing here. Returns these names."""
        result = self.run_it(*arguments, **more)
        said = result.stderr.decode()
        self.assertEqual(result.returncode, 0, said)
        names = re.fullmatch(r"(?:\w+: (.*): ignored: has no effect here\n)?",
                             said)
        self.assertTrue(names, said)
        return set((names[1] or "").split(", ")) - {""}

    def says(self, code, said, *arguments, **more):
        """Ends with this code and a text that matches `said` on standard error."""
        result = self.run_it(*arguments, **more)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertRegex(result.stderr.decode(), said)
        return result

    def refused(self, code, said, *arguments, lines=1, **more):
        """Fails with this code, says a line that matches `said`, and leaves the folder alone."""
        before = self.everything()
        result = self.run_it(*arguments, **more)
        error = result.stderr.decode()
        with self.subTest(arguments=arguments):
            self.assertEqual(result.returncode, code, error)
            self.assertRegex(error, said)
            self.assertTrue(error.endswith("\n"))
            if lines:
                self.assertEqual(error.count("\n"), lines, error)
            self.assertFalse(result.stdout)
            self.assertEqual(self.everything(), before)
        return error

    def decimal_comma(self):
        """The environment of a locale that writes 0,5."""
        os.mkdir(self.path("locales"))
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", "./de_DE.UTF-8"], check=True,
                       cwd=self.path("locales"))
        made = {"LOCPATH": self.path("locales"), "LC_ALL": "de_DE.UTF-8"}
        text = subprocess.run(["printf", "%.1f", "0,5"], env={**os.environ, **made},
                              capture_output=True).stdout
        self.assertEqual(text, b"0,5")
        return made

    def need_osmesa(self):
        if self.run_it(*SMALL, "-b", "osmesa", "-o", "-").returncode != 0:
            self.skipTest("there is no OSMesa, which Mesa 25.1 removed")

    def need_somebody(self):
        try:
            self.good("--version", **SOMEBODY)
            subprocess.run(["test", "-x", os.path.join(SOURCE, "shaders")], check=True, **SOMEBODY)
        except (OSError, AssertionError, subprocess.CalledProcessError):
            self.skipTest("nobody may not enter the folder of the build or of the source")


class Options(Case):
    def test_every_program_answers_help_and_version(self):
        for program in PROGRAMS + SCENES + DIAGRAMS + ["gallery"]:
            with self.subTest(program=program):
                version = self.good("--version", program=program).decode()
                self.assertRegex(version, rf"^{program} \(lighting\) \d[\d.]*(-\d+-g\w+)?\n$")
                text = self.good("--help", program=program).decode()
                self.assertTrue(text.startswith(f"Usage: {program} [options]"))
                self.assertEqual(text, self.good("-h", "--bogus", program=program).decode())
                self.assertEqual("--explain" in text, program in SCENES)
        self.assertEqual(self.everything(), {})

    def test_every_program_draws_its_picture(self):
        for program in PROGRAMS:
            with self.subTest(program=program):
                self.assertEqual(self.good(program=program), b"")
                png = self.png(program + ".png")
                self.assertEqual((png.width, png.height, png.channels), (400, 400, 3))
                self.assertNotEqual(png.at(200, 200), png.at(0, 0))
        self.assertEqual(sorted(os.listdir(self.folder)), [name + ".png" for name in PROGRAMS])

    def test_usage_errors(self):
        """Every bad value of each option: tests/app/options_test.c. Here: the exit code, one line, and no file."""
        self.make("LightedCube.png")
        wanted = "must be"
        for said, *arguments in (
                ("no such option; did you mean --size", "--sise", "4x4"),
                ("no such option", "--xylophone"), ("-z: no such option", "-z"),
                ("-z: no such option", "--verbose", "-zv"),
                ("--precision.*--print-shader", "--pr"),
                ("needs a value", "--output"), ("needs a value", "-s"),
                ("takes no value", "--alpha=yes"), ("not an option", "picture.png"),
                ("no such backend; there is .*egl", "--backend", "vulkan"),
                *((wanted, option, "x") for option in ("--size", "--frames", "--fps", "--time", "--angle", "--samples",
                                                       "--compress", "--precision")),
                (wanted, "--print-shader=geometry"),
                ("name is empty", "--shaders", ""), ("name is empty", "-o", ""),
                ("number", "-n", "3", "-o", "a.png"), ("number", "-n", "3", "-o", "a%d%d.png"),
                ("number", "-n", "3", "-o", "a%s.png"), ("one picture", "-n", "3", "-o", "-"),
                ("is a folder", "-o", "folder/"), ("extension", "-o", "picture"),
                ("extension", "-o", ".png"),
                (r"unknown picture format .xyz; pictures: .png, .exr, .*, .gif; animations: .gif, "
                 r".webp, .apng, .mp4, .webm\n", "-o", "picture.xyz"),
                (r"unknown picture format .pgn; did you mean .png\?\n", "-o", "picture.pgn"),
                (r"--backend egk: no such backend; there is", "-b", "egk")):
            self.refused(2, "^LightedCube: .*" + said, *arguments)

    def test_more_samples_than_there_are_name_the_most(self):
        self.make("LightedCube.png")
        for samples in ("64", "999"):
            self.refused(1, rf"^LightedCube: {samples} samples: must be 0 to \d+, the most ", "--samples", samples)

    def test_sizes(self):
        for width, height in ((1, 1), (1, 400), (777, 3), (16384, 1)):
            png = self.drawn("-s", f"{width}x{height}")
            self.assertEqual((png.width, png.height), (width, height))

    @in_long_form
    def test_texts_say_what_the_picture_is(self):
        texts = self.drawn("--size=30x20", "-t", "1.5", "--samples", "4", "--precision", "highp",
                           "--alpha", program="PointLightedCube_animation").texts
        self.assertEqual(texts["Title"], "PointLightedCube_animation")
        self.assertRegex(texts["Software"], r"^lighting \d")
        self.assertEqual(texts["Time"], "1.5 s")
        for part in ("--size 30x20", "--samples 4", "--precision highp", "--alpha"):
            self.assertIn(part, texts["Command"])
        self.assertIn("egl", texts["Driver"])

    def test_alpha_makes_the_background_transparent(self):
        opaque, clear = self.drawn(*SMALL), self.drawn(*SMALL, "--alpha")
        self.assertEqual((opaque.channels, clear.channels), (3, 4))
        self.assertEqual(clear.at(0, 0)[3], 0)
        self.assertEqual(clear.at(20, 20), (*opaque.at(20, 20), 255))

    @in_long_form
    def test_samples_smooth_the_edges(self):
        colors = []
        for samples in ("0", "4"):
            png = self.drawn("--samples", samples)
            colors.append(len({png.at(x, y) for x in range(400) for y in range(400)}))
        self.assertGreater(colors[1], 2 * colors[0])  # a cube has few colours, its edges have many

    @in_long_form
    def test_frames_are_the_pictures_of_their_times(self):
        move = {"program": "LightedCube_animation"}
        self.good(*SMALL, "--frames", "5", "--fps", "2", "-t", "0.25", "-o", "f%02d.png", **move)
        self.assertEqual(sorted(os.listdir(self.folder)), [f"f{i:02}.png" for i in range(5)])
        pictures = [self.png(f"f{i:02}.png") for i in range(5)]
        self.assertEqual(len({picture.pixels for picture in pictures}), 5)
        for i, picture in enumerate(pictures):
            one = self.drawn(*SMALL, "-t", str(0.25 + i / 2), **move)
            self.assertEqual((one.pixels, one.texts), (picture.pixels, picture.texts))
        self.good(*SMALL, "-n", "2", **move)
        self.assertTrue(os.path.exists(self.path("LightedCube_animation0001.png")))

    @in_long_form
    def test_an_angle_is_a_time(self):
        for program, moves in (("LightedCube_animation", True), ("LightedCube", False)):
            for name, option, value in (("a.png", "-a", "75"), ("t.png", "-t", "2.5"),
                                        ("0.png", "--angle", "0")):
                self.good(*SMALL, option, value, "-o", name, program=program)
            self.assertEqual(self.read("a.png"), self.read("t.png"))
            self.assertEqual(self.png("a.png").pixels != self.png("0.png").pixels, moves)

    @in_long_form
    def test_compressing_changes_the_size_alone(self):
        for level in "09":
            self.good("--compress", level, "-o", level + ".png")
        self.assertLess(len(self.read("9.png")), len(self.read("0.png")) // 2)
        self.assertEqual(self.png("9.png").pixels, self.png("0.png").pixels)

    def test_printing_a_shader_draws_nothing(self):
        for stage, has in (("vert", "gl_Position"), ("frag", "gl_FragColor")):
            text = self.good("--print-shader=" + stage, program="PointLightedCube").decode()
            self.assertTrue(text.startswith("#version 100\n"))
            self.assertIn(has, text)
        both = self.good("--print-shader").decode()
        self.assertEqual(both.count("#version 100\n"), 2)
        high = self.good("--print-shader=frag", "--precision", "highp").decode()
        self.assertIn("#define mediump highp", high)
        self.assertEqual(self.everything(), {})

    def test_verbose_speaks_on_standard_error(self):
        for option in ("-v", "--verbose"):
            result = self.run_it(*SMALL, option, "-o", "-")
            self.assertEqual(result.returncode, 0)
            self.assertEqual(Png(result.stdout).width, 40)
            for word in ("backend: egl", "renderer: ", "40x40", "precision", " ms"):
                self.assertIn(word, result.stderr.decode())

    @in_long_form
    def test_a_backend_can_be_named(self):
        self.good(*SMALL, "-o", "a.png")
        self.good(*SMALL, "-b", "egl", "-o", "b.png")
        self.assertEqual(self.read("a.png"), self.read("b.png"))
        self.good(*SMALL, "-o", "c.png", environment={"LIGHTING_BACKEND": "egl"})
        self.assertEqual(self.read("a.png"), self.read("c.png"))
        self.refused(2, "^LightedCube: --backend glut: no such backend; there is egl, osmesa, window$",
                     "-b", "glut")
        self.refused(1, "^LightedCube: LIGHTING_BACKEND: glut: no such backend; there is egl",
                     environment={"LIGHTING_BACKEND": "glut"})

    @in_long_form
    def test_osmesa_draws_what_egl_draws(self):
        """In mediump too, which both compute in 16 bits."""
        self.need_osmesa()
        for precision in ("highp", "mediump"):
            for backend in "egl", "osmesa":
                self.good(*SMALL, "-b", backend, "--precision", precision, "-o", backend,
                          program="gallery")
            for program in PROGRAMS + SCENES + DIAGRAMS:
                pictures = [self.png(f"{backend}/{program}.png").pixels
                            for backend in ("egl", "osmesa")]
                apart = [abs(a - b) for a, b in zip(*pictures)]
                # A line's edge through one of a pixel's four samples may cover it or not.
                self.assertLessEqual(max(apart), 64, (program, precision))
                self.assertLessEqual(sum(d > 1 for d in apart), len(apart) // 500,
                                     (program, precision))

    @in_long_form
    def test_the_doctor_says_what_works(self):
        text = self.good("--doctor").decode()
        self.assertRegex(text, r"(?s)egl.*works.*renderer.*This machine can draw\.\n$")
        self.assertTrue(text.startswith("packages:\n  EGL "), text)
        # What a backend computes with stands beside its displays, and not below one of them.
        self.assertRegex(text, r"(?m)^  precision        \S")
        for works in re.findall(r"^ *works: .*$", text, re.M):  # of every backend in the same words
            self.assertRegex(works, r"renderer \S.* \((software|hardware)\), OpenGL ")
        self.assertEqual(self.everything(), {})

    @in_long_form
    def test_the_doctor_begins_with_the_packages(self):
        """Each is there or not, with its version if it tells one, and with what it gives."""
        def packages(**environment):
            lines = self.run_it("--doctor", environment=environment).stdout.decode().split("\n")
            self.assertEqual(lines[0], "packages:")
            end = next(i for i, line in enumerate(lines) if line.startswith("egl: "))
            return {line[2:15].strip(): line[15:] for line in lines[1:end]}

        gives = {"EGL": "pictures without a display", "OSMesa": "pictures without a display and without EGL",
                 "GLFW": "windows", "libpng": "PNG files",
                 "OpenImageIO": "picture files other than PNG",
                 "ffmpeg": "animations: .webp, .apng, .mp4 and .webm", "Assimp": "model files", "cairo": "diagrams",
                 "Dear ImGui": "the panel of windows"}
        there = packages()
        self.assertEqual(list(there), list(gives))
        for name, said in there.items():
            self.assertRegex(said, rf"^([\d.]+: found, gives {gives[name]}$|found, gives {gives[name]}$"
                                   rf"|missing, gives {gives[name]}: .*install )", name)
        for name in "EGL", "libpng":
            self.assertRegex(there[name], r"^\d")
        # The loader takes an empty file for the library, and fails.
        needed = {"EGL": ["libEGL.so.1"], "GLFW": ["libglfw.so.3"],
                  "OSMesa": ["libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"],
                  "OpenImageIO": re.findall(r"libOpenImageIO\.so\S*", subprocess.run(
                      ["ldd", MODULE], capture_output=True, text=True).stdout)}
        for names in needed.values():
            for name in names:
                self.make(name, b"")
        without = packages(LD_LIBRARY_PATH=self.folder, PATH="/nonexistent")
        for name, said in without.items():
            if name in needed or name == "ffmpeg":
                self.assertRegex(said, rf"^missing, gives {gives[name]}: .*install the package", name)
            else:
                self.assertEqual(said, there[name])

    @in_long_form
    def test_the_doctor_tells_what_is_not_built_yet_from_what_is_missing(self):
        """A copy of the build folder has the program, but no module except its own."""
        os.makedirs(self.path("build/examples"))
        os.makedirs(self.path("build/common"))
        shutil.copy(os.path.join(EXAMPLES, "../common/app.so"), self.path("build/common"))
        program = shutil.copy(os.path.join(EXAMPLES, "LightedCube"), self.path("build/examples"))
        shutil.copy(os.path.join(EXAMPLES, "../source_root"), self.path("build"))
        text = self.good("--doctor", program=program).decode()
        for file, name in (("image_oiio.so", "OpenImageIO"), ("model_assimp.so", "Assimp"),
                           ("drawing_cairo.so", "cairo"), ("panel_imgui.so", "Dear ImGui")):
            there = os.path.exists(os.path.join(EXAMPLES, "../common", file))
            self.assertRegex(text, rf"(?m)^  {name} +" + (r"installed, gives .*; not built yet: built when needed$"
                                                          if there else "missing, gives"))
        os.remove(self.path("build/common/app.so"))
        self.refused(1, "app: its module, common/app.so, is not built yet: .*examples/run", "--help", program=program)
        self.good(program=program)  # the picture needs none
        with open(os.path.join(EXAMPLES, "../common/app.so"), "rb") as file:
            module = file.read()
        with open(os.path.join(EXAMPLES, "../common/base/build_id.h"), "rb") as file:
            build = file.read().split(b'"')[1]
        self.make("build/common/app.so", module.replace(build, build[::-1]))
        self.refused(1, "app: its module, common/app.so, is of another build than the program: .*examples/run", *SMALL,
                     program=program)
        self.make("build/common/app.so", module)
        if os.path.exists(MODULE):
            self.refused(1, "OpenImageIO: its module, common/image_oiio.so, is not built yet: .*examples/run",
                         *SMALL, "-o", "a.exr", program=program)

    @in_long_form
    def test_the_first_picture_is_the_plugins(self):
        """What a program of the lecture draws by itself has the same bytes as with any option; what goes wrong, or is
        to be warned of, the plugin says."""
        with open(os.path.join(SOURCE, "shaders/lecture/LightedCube.vert"), encoding="ascii") as file:
            text = file.read()
        for name in "LightedCube", "PointLightedSphere_perFragment":
            self.good(program=name)
            alone = self.read(name + ".png")
            self.good("-o", "a.png", program=name)
            self.assertEqual(self.read("a.png"), alone)
        self.make("shaders/LightedCube.vert", text.replace("vec4", "vec5", 1).encode())
        for arguments, environment in ((), {"LIGHTING_SHADERS": "shaders"}), (("--shaders", "shaders"), {}):
            self.says(1, "hint: vec5 is no type", *arguments, environment=environment)
        for arguments in (), ("-t", "0"):
            self.says(1, "^LightedCube: EGL: no platform gives .*: unset it", *arguments, environment=NO_DRIVER)

    @in_long_form
    def test_verbose_reports_programs_once(self):
        result = self.says(0, "opening", "-v", "-n", "4", "-s", "40", "-o", "p%d.png", program="LightTypes")
        self.assertEqual(result.stderr.decode().count("programs so far"), 1)

    @in_long_form
    def test_raw_pictures_are_drawn_by_threads(self):
        """Nothing else needs the processor; encoders would. The driver names its threads."""
        def threads(*arguments):
            with subprocess.Popen([os.path.join(EXAMPLES, "FourLights"), "-n", "9", *arguments], cwd=self.folder,
                                  env={key: value for key, value in os.environ.items()
                                       if key != "LP_NUM_THREADS"},
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
                process.stdout.read(1)  # the rest fills the pipe
                tasks = glob.glob(f"/proc/{process.pid}/task/*/comm")
                names = [open(task).read() for task in tasks]
                process.kill()
            return sum(name.startswith("llvmpipe") for name in names)

        if os.cpu_count() > 1 and "llvmpipe" in self.run_it("-v", "-o", "-").stderr.decode():
            self.assertGreater(threads("-o", "-", "--format", "rgb"), 0)

    def test_a_named_pipe_gets_a_png(self):
        os.mkfifo(self.path("pipe"))
        with subprocess.Popen(["cat", self.path("pipe")], stdout=subprocess.PIPE) as reader:
            self.run_it("-s", "8", "-o", "pipe")
            self.assertEqual(Png(reader.stdout.read()).pixels, self.drawn("-s", "8x8").pixels)

    @in_long_form
    def test_a_cache_of_pipes_is_not_waited_for(self):
        """Of what the programs keep, and Mesa, which opens each file that its index does not rule out."""
        for program in ("FourLights", *DIAGRAMS):
            for spared in ("index", "none")[::step(2)]:
                draw = {"program": program, "environment": {"XDG_CACHE_HOME": self.path("cache")}}
                picture = self.good(*SMALL, "-o", "-", **draw)
                if os.path.exists(self.path("cache/mesa_shader_cache_db")):
                    self.skipTest("this Mesa keeps a database, and waits for pipes in its place")
                for folder, _, files in os.walk(self.path("cache")):
                    for path in (os.path.join(folder, file) for file in files if file != spared):
                        os.remove(path)
                        os.mkfifo(path)
                self.assertEqual(self.good(*SMALL, "-o", "-", **draw), picture)
                shutil.rmtree(self.path("cache"), ignore_errors=True)

    def test_without_a_driver_one_line_names_the_cause(self):
        """The variable that chooses none; otherwise the packages."""
        self.make("LightedCube.png")
        self.refused(1, '^LightedCube: EGL: .*; LIBGL_DRIVERS_PATH is "/nonexistent": unset it',
                     environment=NO_DRIVER)
        self.refused(1, '\nLightedCube: EGL: .*; GALLIUM_DRIVER is "nonsense": unset it',
                     environment={"GALLIUM_DRIVER": "nonsense"}, lines=0)
        self.refused(1, 'LightedCube: EGL: LP_NATIVE_VECTOR_WIDTH is "7", .*: unset it',
                     environment={"LP_NATIVE_VECTOR_WIDTH": "7"})
        self.refused(1, '^LightedCube: EGL: .*; MESA_GLES_VERSION_OVERRIDE is "1.0": unset it',
                     environment={"MESA_GLES_VERSION_OVERRIDE": "1.0"})
        self.make("none/libEGL.so.1", "")
        none = {"LD_LIBRARY_PATH": self.path("none")}
        self.refused(1, "^LightedCube: EGL: .*install the packages libegl1 ", environment=none)
        result = self.run_it("--doctor", environment=none)
        self.assertEqual(result.stderr, b"")
        self.assertRegex(result.stdout.decode(), {
            0: r"(?s)libegl1.*can draw with --backend osmesa\.\n$",
            1: r"(?s)libegl1.*libosmesa6.*cannot draw yet\.\n$"}[result.returncode])


    @unittest.skipIf(SANITIZED, "a sanitizer takes terabytes of addresses")
    def test_too_little_memory_for_a_driver_is_said_before_it_is_loaded(self):
        """It would crash, or say so itself in many lines."""
        for megabytes in 64, 1023:
            limit = (megabytes << 20,) * 2
            self.refused(1, fr"^LightedCube: EGL: the limit of memory is {megabytes} MB \(ulimit -v\): raise it to 1024\n$",
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit))


class Terminal(Case):
    """What is said on a terminal alone."""

    def on_terminal(self, *arguments, program="LightedCube", **environment):
        clean = {key: value for key, value in os.environ.items() if key != "NO_COLOR"}
        return on_terminal([os.path.join(EXAMPLES, program), *arguments], cwd=self.folder,
                           env={**clean, "TERM": "xterm", **environment})

    @in_long_form
    def test_what_was_written_is_said(self):
        for said, program, *arguments in (
                ("wrote LightedCube.png, 40x40", "LightedCube"),
                ("wrote f0.png to f2.png, 40x40", "LightedCube", "-n", "3", "-o", "f%d.png"),
                ("wrote a.svg, 40x40", "Vectors", "-o", "a.svg"),
                ("wrote a.gif, 3 pictures, 40x40", "LightedCube", "-n", "3", "-o", "a.gif"),
                ("", "LightedCube", "-o", "-"), ("", "LightedCube", "--print-shader"),
                ("", "Materials", "--explain")):
            if program in EVERY:
                code, text = self.on_terminal(*SMALL, *arguments, program=program)
                self.assertEqual((code, text), (0, f"{program}: {said}\r\n" if said else ""))

    def test_errors_and_warnings_are_in_colour(self):
        red, yellow, plain = "\x1b[31m", "\x1b[33m", "\x1b[0m"
        self.assertEqual(self.on_terminal("--sise"), (
            2, f"{red}LightedCube:{plain} --sise: no such option; did you mean --size?\r\n"))
        for more in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
            self.assertEqual(self.on_terminal("--sise", **more), (
                2, "LightedCube: --sise: no such option; did you mean --size?\r\n"))
        self.assertIn("\x1b[31m", self.on_terminal("--sise", NO_COLOR="")[1])
        for name in "vert", "frag":
            shutil.copy(os.path.join(SOURCE, "shaders/lecture/LightedCube." + name), self.folder)
        text = self.read("LightedCube.vert").decode()
        self.make("LightedCube.vert", text.replace("u_LightColor", "u_LightColour"))
        code, said = self.on_terminal(*SMALL, "--shaders", ".")
        self.assertEqual(code, 0)
        self.assertRegex(said, rf"^{re.escape(yellow)}\S*LightedCube.vert:\d+:{re.escape(plain)} "
                               r"warning: u_LightColour: u_LightColor\?\r\n")
        self.make("LightedCube.vert", "what;\n")
        code, said = self.on_terminal(*SMALL, "--shaders", ".")
        self.assertEqual(code, 1)
        self.assertRegex(said, rf"^{re.escape(red)}\S*LightedCube.vert:1:{re.escape(plain)} error: ")

    @unittest.skipUnless("check" in os.listdir(EXAMPLES), "check is not built")
    def test_verdicts_are_in_colour(self):
        for folder, verdict in (("examples/labs/lab01_diffuse", "\x1b[31mwrong\x1b[0m, "),
                                ("shaders/labs/solutions/lab01_diffuse", "\x1b[32mright\x1b[0m, ")):
            _, said = on_terminal([os.path.join(EXAMPLES, "check"), "1", os.path.join(SOURCE, folder)], "stdout",
                                  cwd=self.folder, env={**os.environ, "TERM": "xterm"})
            self.assertTrue(said.startswith("lab01_diffuse: " + verdict), said)


class Generated(Case):
    """Man pages and completion, against --help."""

    def options(self, program):
        """The names and the letters in --help."""
        text = self.good("--help", program=program).decode()
        found = re.findall(r"^  (?:-(\w), |    )--([\w-]+)", text, re.MULTILINE)
        return [name for _, name in found], [letter for letter, _ in found if letter]

    def generate(self, form, program="LightedCube"):
        self.make(form, self.good("--generate", form, program=program))
        return self.read(form).decode()

    def shell(self, *command):
        result = subprocess.run(command, cwd=self.folder, capture_output=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (0, b""), command)
        return result.stdout.decode()

    def test_no_program_has_two_options_of_one_name(self):
        for program in EVERY:
            for names in self.options(program):
                self.assertIn("size" if len(names[0]) > 1 else "s", names)
                self.assertEqual(len(names), len(set(names)), program)

    def test_an_exact_name_is_no_abbreviation(self):
        exact, longer, neither = (self.drawn(*SMALL, *arguments, program="ShadingModels").pixels
                                  for arguments in (["--linear"], ["--linear-light"], []))
        self.assertEqual(exact, longer)
        self.assertNotEqual(exact, neither)
        self.refused(2, "--lin: could be --linear-light or --linear", "--lin", program="LightTypes")
        self.refused(2, "^SpotLight: --save-scene x.glb: a scene is written as text; name a .gltf$", "--save-scene", "x.glb", program="SpotLight")

    @in_long_form
    def test_all_have_the_options_of_help(self):
        for program in EVERY:
            names, letters = self.options(program)
            text = self.generate("man", program).replace("\\-", "-")
            self.assertEqual(re.findall(r"^(?:\\fB-\w\\fR, )?\\fB--([\w-]+)", text, re.M), names)
            text = self.generate("bash", program)
            self.assertEqual(re.search("words='(--.*) '", text)[1], " ".join("--" + n for n in names))
            text = self.generate("fish", program)
            self.assertEqual(re.findall(r"^complete -c \w+ -l (\S+)", text, re.M), names)
            self.assertEqual(re.findall(r" -l \S+ -s (\w) ", text), letters)
            text = self.generate("zsh", program)
            self.assertEqual(re.findall(r"^    '(?:\(-\w )?--([\w-]+)", text, re.M), names)
            for shell in "bash", "zsh", "fish":
                if shutil.which(shell):
                    self.assertEqual(self.shell(shell, "-n", shell), "")

    def test_ranges_are_said_as_people_say_them(self):
        machine = r"\de[+]?\d|\d{7}|\bTEXT\b"
        for program in EVERY[::step(9)]:
            text = self.good("--help", program=program).decode()
            self.assertNotRegex(text, machine)
            for name in re.findall(r"^ .*--([\w-]+) (?:\S+\.\.\S+|N|F|E|SECONDS|DEG|NUMBER)(?: |$)",
                                   text, re.M):
                result = self.run_it(f"--{name}=x", program=program)
                self.assertEqual(result.returncode, 2)
                self.assertNotRegex(result.stderr.decode(), machine)
        for said, *arguments in (("--frames x: must be a whole number, 1 to 1 million", "-n", "x"),
                                 ("--time x: must be a number, -1 billion to 1 billion", "-t", "x"),
                                 ("--fps 0: must be a number, 0.001 to 1 million", "--fps", "0")):
            self.refused(2, f"^LightedCube: {said}\n$", *arguments)
        self.refused(2, "^check: --seed x: must be a whole number, -1 or more\n$", "--seed", "x", "1",
                     ".", program="check")

    def test_man_pages_name_exit_codes_and_environment(self):
        for program, has in (("LightedCube", True), ("Vectors", False), ("check", True)):
            if program in EVERY and os.path.exists(os.path.join(EXAMPLES, program)):
                text = self.generate("man", program)
                for word in ".TP\n2\n", "NO_COLOR", "XDG_CACHE_HOME", "SOURCE_DATE_EPOCH":
                    self.assertIn(word, text)
                self.assertEqual("LIGHTING_SHADERS" in text.partition(".SH ENVIRONMENT")[2], has)

    @in_long_form
    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_man_pages_are_typeset_without_warnings(self):
        for program in EVERY:
            self.generate("man", program)
            text = self.shell("groff", "-man", "-ww", "-Tascii", "-P-c", "man")
            text = " ".join(re.sub(".\b", "", text).split())
            self.assertIn(f"NAME {program} - ", text)
            self.assertIn("-s, --size WxH in pixels", text)

    @unittest.skipUnless(shutil.which("bash"), "bash is not installed")
    def test_bash_completes_options_and_values(self):
        self.generate("bash")
        for words, expected in (("--siz", "--size"), ("--pr", "--precision --print-shader --probe"),
                                ("--alpha --backend o", "osmesa"), ("-b e", "egl"),
                                ("--precision = m", "mediump"), ("--format =", "png y4m rgb json"),
                                ("a", ""), ("-o --siz", "--size")):
            said = self.shell("bash", "-c", f". ./bash; COMP_WORDS=(LightedCube {words}); "
                              "COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _LightedCube; "
                              "echo ${COMPREPLY[*]}")
            self.assertEqual(said, expected + "\n", words)

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_completes_options_and_values(self):
        self.generate("fish")
        for line, expected in (("--siz", "--size"), ("--backend o", "osmesa")):
            said = self.shell("fish", "-c", f". ./fish; complete -C 'LightedCube {line}'")
            self.assertEqual(said.split()[0], expected)


class Outputs(Case):
    def test_an_output_that_cannot_be_written_is_a_failure(self):
        self.make("file")
        os.mkdir(self.path("folder.png"))
        os.symlink("loop.png", self.path("loop.png"))
        os.symlink("missing/a.png", self.path("lost.png"))
        for output, said in (("missing/a.png", "folder missing/ does not exist"),
                             ("folder.png", "is a folder"), ("file/a.png", "Not a directory"),
                             ("loop.png", "symbolic links"), ("lost.png", "does not exist"),
                             ("n" * 300 + ".png", "too long")):
            self.refused(1, "^LightedCube: .*" + said, *SMALL, "-o", output)
        self.refused(1, "folder missing0/ does not exist", "-n", "2", "-o", "missing%d/a.png")

    @in_long_form
    def test_devices_are_written_through(self):
        self.need_somebody()
        os.symlink("/dev/full", self.path("full.png"))
        os.symlink("/dev/null", self.path("null.png"))
        expected = self.good(*SMALL, "-o", "-")
        for output in ("/dev/null", "null.png"):
            self.assertEqual(self.good(*SMALL, "-o", output, **SOMEBODY), b"")
        # What /dev/stdout leads to, in a folder where nothing can be replaced.
        self.assertEqual(self.good(*SMALL, "-o", "/proc/self/fd/1"), expected)
        for output in ("/dev/full", "full.png"):
            self.refused(1, "^LightedCube: .*No space left", *SMALL, "-o", output, **SOMEBODY)
        self.assertEqual(sorted(os.listdir(self.folder)), ["full.png", "null.png"])

    def test_protected_files_stay(self):
        self.need_somebody()
        self.make("read_only.png")
        self.make("protected/old.png")
        os.chmod(self.path("read_only.png"), 0o444)
        os.chmod(self.path("protected"), 0o555)
        self.addCleanup(os.chmod, self.path("protected"), 0o755)
        for output in ("read_only.png", "protected/old.png", "protected/new.png"):
            self.refused(1, "^LightedCube: .*Permission denied", "-o", output, **SOMEBODY)

    def test_a_file_is_replaced_and_keeps_its_permissions(self):
        self.make("a.png")
        os.chmod(self.path("a.png"), 0o640)
        self.good(*SMALL, "-o", "a.png")
        self.assertEqual(self.png("a.png").width, 40)
        self.assertEqual(os.stat(self.path("a.png")).st_mode & 0o777, 0o640)
        self.assertEqual(os.listdir(self.folder), ["a.png"])

    def test_a_file_too_large_for_the_limit_leaves_the_old_one(self):
        self.make("a.png")
        limit = 'ulimit -f 8; trap "" XFSZ; exec "$@"'  # 8 blocks of 512 or 1024 bytes
        for number in ((), ("-n", "3")):
            before = self.everything()
            name = "b%d.png" if number else "a.png"
            result = subprocess.run(["sh", "-c", limit, "sh", os.path.join(EXAMPLES, "LightedCube"),
                                     "--compress", "0", *number, "-o", name], cwd=self.folder,
                                    capture_output=True, timeout=PATIENCE)
            self.assertEqual((result.returncode, result.stdout), (1, b""))
            self.assertRegex(result.stderr.decode(), r"^LightedCube: \w+\.png: cannot write: .*\n$")
            self.assertEqual(self.everything(), before)

    @in_long_form
    @unittest.skipUnless(os.path.exists(MODULE), "built without OpenImageIO")
    def test_a_format_that_is_cut_at_the_limit_is_not_written(self):
        """OpenImageIO does not notice that the end of an OpenEXR file is missing."""
        for blocks in 0, 1:
            command = ["sh", "-c", 'exec 2>&1; ulimit -f "$0" && exec "$@"', str(blocks),
                       os.path.join(EXAMPLES, "LightedCube"), *SMALL, "-o", "a.exr"]
            result = subprocess.run(command, cwd=self.folder, stdout=subprocess.PIPE, timeout=PATIENCE)
            self.assertEqual((result.returncode, result.stdout), (1, b"LightedCube: cannot write exr: File too large\n"))
            self.assertEqual(self.everything(), {})

    @in_long_form
    def test_links_and_pipes_are_written_through(self):
        self.make("target.png")
        os.symlink("target.png", self.path("link.png"))
        self.good(*SMALL, "-o", "link.png")
        self.assertTrue(os.path.islink(self.path("link.png")))
        expected = self.read("target.png")
        self.assertEqual(Png(expected).width, 40)

        got = []
        os.mkfifo(self.path("pipe.png"))
        reader = threading.Thread(target=lambda: got.append(self.read("pipe.png")))
        reader.start()
        self.good(*SMALL, "-o", "pipe.png")
        reader.join(PATIENCE)
        self.assertEqual(got, [expected])
        self.assertEqual(sorted(os.listdir(self.folder)), ["link.png", "pipe.png", "target.png"])

    def test_a_dash_is_standard_output(self):
        self.good(*SMALL, "-o", "a.png")
        self.assertEqual(self.good(*SMALL, "-o", "-"), self.read("a.png"))
        self.assertEqual(os.listdir(self.folder), ["a.png"])

    def test_what_shaders_compute_is_drawn_instead(self):
        result = self.run_it(*SMALL, "--show", "v_Color", "-o", "shown.png")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr.decode(), r"^v_Color: as a colour, from 0 to [\d.]+; black: no triangle\n$")
        drawn = self.run_it(*SMALL, "-o", "drawn.png")
        self.assertEqual(drawn.returncode, 0)
        self.assertEqual(self.png("shown.png").pixels, self.png("drawn.png").pixels)
        self.refused(2, "--show v_Colour: no shader here has it; there are v_Color, ", *SMALL, "--show", "v_Colour")
        self.refused(2, "--show error: makes one picture; leave out --frames", *SMALL, "--show", "error",
                     "--frames", "2", "-o", "a%d.png")
        self.refused(1, "--show: a pixel of several samples", *SMALL, "--show", "error", "--samples", "4")

    @in_long_form
    def test_a_loop_that_does_not_end_is_not_waited_for_at_each_pixel(self):
        self.make("mine/LightedCube.frag", "precision mediump float;\nvarying vec4 v_Color;\nvoid main() {\n"
                  "    gl_FragColor = v_Color;\n    while (true) gl_FragColor.r += 0.001;\n}\n")
        for what in ("error", "blame", "v_Color"):
            result = self.run_it("-s", "200x200", "--shaders", "mine", "--show", what, "-o", "a.png")
            self.assertEqual(result.returncode, 0)
            self.assertRegex(result.stderr.decode(), r"(^|\n)a loop does not end: .*\n.*" + what)
        said = self.good("-s", "200x200", "--shaders", "mine", "--probe", "100,100").decode()
        self.assertLess(said.count("\n"), 30)
        self.assertIn("line 5: the loop does not end", said)

    @in_long_form
    def test_a_picture_as_another_device_would_draw_it(self):
        """Exactly what the driver draws, if the device is this one; with two digits, something else."""
        with open(os.path.join(self.folder, "measured.json"), "w") as file:
            file.write('{"arithmetic": "highp=2,-126,127;mediump=2,-126,127"}')
        pictures = []
        for device in "float", "highp=24,-126,127;mediump=24,-126,127", "measured.json":
            self.good(*SMALL, "--arithmetic", device, "-o", "a.png")
            pictures.append(self.png("a.png").pixels)
        self.good(*SMALL, "-o", "drawn.png")
        self.assertEqual(pictures[0], self.png("drawn.png").pixels)
        self.assertEqual(pictures[1], pictures[0])
        self.assertNotEqual(pictures[2], pictures[0])
        self.good(*SMALL, "--arithmetic", "highp=24,-126,127;mediump=24,-126,127;bytes=4", "-o", "a.png")
        cut = self.png("a.png").pixels  # 16 levels of a colour
        self.assertTrue(all(0 <= whole - few <= 16 for whole, few in zip(pictures[0], cut)))
        self.assertNotEqual(cut, pictures[0])
        self.refused(1, "--arithmetic phone: neither a file with what precision measured nor one of llvmpipe ", *SMALL,
                     "--arithmetic", "phone")
        self.refused(2, "--arithmetic half: makes one picture", *SMALL, "--arithmetic", "half", "--frames", "2", "-o", "a%d.png")

    @in_long_form
    def test_mediump_of_nvidia_is_as_an_h200_drew_it(self):
        """Where the real picture is smooth, which leaves out edges, axes and the white point of the light: all but one of
        18,542 and 49,873 pixels are within one step, and 99.7% and 99.87% equal. With dot products in any other order or
        form tried, 97.3% of the first at most are equal, with varyings rounded where they are copied 97.5% of
        PointLightedCube's. What is left are products that its compiler fuses into sums, which the evaluator does not,
        and the corners' weights, which have 32 bits there and 53 here."""
        for program, least in ("TwoSidedLighting", 0.995), ("PointLightedCube_perFragment", 0.998):
            with open(os.path.join(os.path.dirname(__file__), "nvidia", program + ".png"), "rb") as file:
                real = Png(file.read())
            mine = self.drawn("--precision", "mediump", "-s", "400x400", "-t", "1.3", "--arithmetic", "nvidia", program=program)
            pixels = [[picture.pixels[i:i + 3] for i in range(0, len(picture.pixels), picture.channels)]
                      for picture in (real, mine)]

            def apart(a, b):
                return max(abs(x - y) for x, y in zip(a, b))
            inside = [i for i in range(400, len(pixels[0]) - 400)
                      if pixels[0][i] not in (pixels[0][0], b"\xff" * 3)
                      and all(apart(pixels[0][i], pixels[0][i + to]) <= 16 for to in (-400, -1, 1, 400))]
            differences = [apart(pixels[0][i], pixels[1][i]) for i in inside]
            self.assertGreater(len(inside), 18000, program)
            self.assertGreaterEqual(differences.count(0), least * len(inside), program)
            self.assertGreaterEqual(differences.count(0) + differences.count(1), 0.999 * len(inside), program)
            self.assertLessEqual(max(differences), 2, program)

    def test_a_pixel_is_explained_as_text_and_json(self):
        for program in "LightedCube", "PhongBlinn":
            probe = "-s", "60x60", "--precision", "mediump", "--probe", "30,25"
            text = self.run_it(*probe, program=program).stdout.decode()
            data = json.loads(self.run_it(*probe, "--format", "json", program=program).stdout)
            self.assertIn(f"verdict: {data['verdict']['text']}\n", text)
            self.assertIn("born", data["verdict"])
            last = data["assignments"][-1]
            self.assertEqual(last["name"], "gl_FragColor")
            self.assertIn("gl_FragColor = ", last["source"])
            for drawn, driver in zip(data["drawn"], last["driver"]):
                self.assertLess(abs(255 * drawn - 255 * min(driver, 1)), 0.51)
        self.assertRegex(text, r"\ngroup\.glsl:\d+  float n_dot_l = dot\(normal, to_light\);\n +n_dot_l: ")
        self.refused(2, "--format json: is of --probe", "--format", "json")

    @in_long_form
    def test_elements_of_an_array_have_their_numbers(self):
        """Of names up to 127 characters; a sanitizer says it where a longer one leaves its place."""
        program = "PointLightedCube_perFragment"
        with open(os.path.join(SOURCE, "shaders", "lecture", program + ".frag")) as file:
            text = file.read()
        for name in "few", "long" * 35:
            lines = f"vec3 none = {name}[1] * 0.5;\n    gl_FragColor = vec4(none, 0.0) +"
            self.make(f"mine/{program}.frag", text.replace("gl_FragColor =", lines).replace(
                "varying vec4", f"uniform vec3 {name}[2];\nvarying vec4"))
            said = self.good("-s", "60x60", "--precision", "highp", "--shaders", "mine", "--probe", "30,30",
                             program=program).decode()
            self.assertEqual("= (0, 0, 0) * 0.5\n" in said, name == "few", said)

    @in_long_form
    def test_each_effect_has_the_lines_that_it_brings_in(self):
        """But those that are no lines: what is left out, culling, and that a light is there."""
        none = re.compile(r"#|$|as view | *without |light |culling |normals not |  dot products clamped|operations|in the full")
        for program, *options in (("FourLights",), ("TwoSidedLighting",), ("NormalMatrix", "--linear-light"),
                                  ("LightTypes", "--show-clipped"), ("Shadows", "--clamp-dots", "off")):
            said = self.run_it("--explain", "--verbose", *options, program=program).stdout.decode()
            for text in re.findall(r"^# \w+, view \d+, object \d+\n(.+?)\n\n", said, re.M | re.S):
                lines, told = text.split("\n") + [""], set()
                for line, after in zip(lines, lines[1:]):
                    effect = line.split(":")[0]
                    if line.startswith("      ") or none.match(line) or effect in told:
                        continue
                    told.add(effect)
                    self.assertRegex(after, r"^ {6}(written|\w+\.\w+:\d+)  \S", (program, line))
        self.assertIn("\nsRGB encoding: requested\n      lighting.frag:",
                      self.run_it("--explain", "-v", "--linear-light", program="PhongBlinn").stdout.decode())

    @in_long_form
    def test_what_interpolation_changes_is_what_a_program_per_fragment_mends(self):
        """The next program of the lecture computes the same equation at each fragment."""
        for program in "PointLightedCube", "PointLightedSphere":
            for pixel in ("200,200", "230,150", "180,230")[::step(2)]:
                probe = "--precision", "highp", "--probe", pixel, "--format", "json"
                coarse, fine = (json.loads(self.good(*probe, program=program + rest))
                                for rest in ("", "_perFragment"))
                apart = max(abs(255 * min(a, 1) - 255 * min(b, 1))
                            for a, b in zip(coarse["computed"][:3], fine["exact"][:3]))
                if program == "PointLightedCube":  # the spheres are of different triangles
                    # The vertices are rounded to floats, and highp's numbers.
                    self.assertAlmostEqual(coarse["verdict"]["steps"], apart, delta=1e-3)
                self.assertGreater(coarse["verdict"]["interpolation"], 0.01)
                self.assertAlmostEqual(fine["verdict"]["interpolation"], 0, delta=1e-3)
                for a, b in zip(fine["verdict"]["against"], fine["exact"]):
                    self.assertAlmostEqual(a, b, delta=1e-5)
        text = self.good("--probe", "200,200", program="PointLightedCube").decode()
        self.assertRegex(text, r"\ncomputed: .*; exactly, the same text: .*; at the pixel itself: [0-9.]+, [0-9.]+, [0-9.]+\n")

    @in_long_form
    def test_the_terms_that_probe_tells_make_their_numbers_and_the_sum(self):
        def color(text):
            numbers = [float(number) for number in text.split(", ")]
            return numbers * 3 if len(numbers) == 1 else numbers
        term = re.compile(r"(?m)^( *)(.*): \(([^)]*)\) \* \(([^)]*)\)(?: \* N\.L ([\d.e-]+))?"
                          r"(?: \* \((?:R\.V|N\.H) ([\d.e-]+)\)\^([\d.]+)(, behind the surface)?)? = (.*)")
        for program, place, *options in (
                ("ShadingModels", "200,150", "--emission", ".1,.2,0", "--global-ambient", ".2,.3,.1"),
                ("ShadingModels", "260,150", "--reflection", "blinn-phong"), ("FourLights", "200,180"),
                ("SpotLight", "224,299"), ("SpotLight", "209,296", "--cutoff", "20"),
                ("LightTypes", "518,437"), ("Shadows", "221,317"), ("Shadows", "250,300"),
                ("ShadingModels", "200,200", "--lighting", "off")):
            text = self.good("--probe", place, *options, program=program).decode()
            equation, = re.findall(r"(?s)^exact picture: [^\n]*\n(.*)^computed:", text, re.M)
            total = [0, 0, 0]
            for line in equation.splitlines():
                plain = re.fullmatch("(emission|diffuse colour, without lighting): (.*)", line)
                share = re.fullmatch(r"light \d, ([\d.e-]+) of it arrives:", line)
                found = term.fullmatch(line)
                if share:
                    arrives = float(share[1])
                elif plain:
                    total = [a + b for a, b in zip(total, color(plain[2]))]
                elif found:
                    indent, _, light, surface, n_dot_l, cosine, exponent, behind, result = found.groups()
                    factor = float(n_dot_l or 1) * float(cosine or 1) ** float(exponent or 1) * (not behind)
                    for i, number in enumerate(color(result)):
                        self.assertAlmostEqual(color(light)[i] * color(surface)[i] * factor, number,
                                               delta=1e-4, msg=line)
                        total[i] += (arrives if indent else 1) * number
                else:
                    self.assertRegex(line, r"^(sum: |light \d, 0 of it arrives: outside its cone$)")
            for told, made in zip(color(re.search("(?m)^sum: (.*)", equation)[1]), total):
                self.assertAlmostEqual(told, made, delta=1e-4, msg=text)
        self.assertNotIn("ambient", equation)  # of what is not lit

    def test_output_that_does_not_arrive_is_a_failure(self):
        for arguments in (("--help",), ("--version",), ("-o", "-"), ("--print-shader",),
                          ("--doctor",)):
            for shell in (">&-", ">/dev/full")[::1 if arguments[0] != "--doctor" else step(2)]:
                self.refused(1, "^LightedCube: standard output: cannot write: ", *SMALL, *arguments,
                             shell=shell)

    @in_long_form
    def test_a_reader_that_leaves_ends_a_program_quietly(self):
        for program, *arguments in (
                ("LightedCube", "--help"), ("LightedCube", "-o", "-"),
                ("LightedCube", "--print-shader"), ("LightedCube", "--doctor"),
                ("LightedCube", "--generate", "man"), ("SpotLight", "--explain")):
            reading, writing = os.pipe()
            os.close(reading)
            self.good(*SMALL, *arguments, program=program, stdout=writing)
            os.close(writing)
            self.good(*SMALL, *arguments, program=program, shell="| head -n 1")
        self.assertEqual(self.everything(), {})

    @in_long_form
    def test_closed_streams_do_no_harm(self):
        self.good(*SMALL, "-o", "right.png")
        for shell in ("<&-", ">&-", "2>&-", "<&- >&- 2>&-"):
            result = self.run_it(*SMALL, "-v", "-o", "a.png", shell=shell)
            self.assertEqual(result.returncode, 0)
            self.assertEqual(self.read("a.png"), self.read("right.png"))
        for shell in ("2>&-", "2>/dev/full", "<&- >&- 2>&-"):
            for code, arguments in ((2, ("--bogus",)), (1, ("-o", "missing/a.png"))):
                self.assertEqual(self.run_it(*arguments, shell=shell).returncode, code)

    @in_long_form
    def test_programs_run_from_any_folder_and_under_any_name(self):
        os.makedirs(self.path("a b/h\u00e9"))
        self.good(*SMALL, "-o", self.path("a.png"), cwd="/")
        self.good(*SMALL, "-o", "a.png", cwd=self.path("a b/h\u00e9"))
        self.assertEqual(self.read("a.png"), self.read("a b/h\u00e9/a.png"))
        os.symlink(os.path.join(EXAMPLES, "LightedCube"), self.path("linked"))
        self.good(*SMALL, "-o", "b.png", program=self.path("linked"))
        self.assertEqual(self.read("a.png"), self.read("b.png"))

    @in_long_form
    @unittest.skipIf(SANITIZED, "a sanitizer needs /proc")
    def test_programs_run_without_proc(self):
        """As in a plain chroot: they find their plugins and shaders, and start again."""
        hide = ["unshare", "--mount", *(["--map-root-user"] if os.getuid() else []), "sh", "-c",
                'mount -t tmpfs none /proc && exec "$@"', "sh"]
        if not shutil.which("unshare") or subprocess.run([*hide, "true"], capture_output=True).returncode:
            self.skipTest("nothing may be mounted here")
        for program, *more in (("FourLights",), ("LightedCube",), ("LightedCube", "--deterministic")):
            drawn = self.good(*SMALL, *more, "-o", "-", program=program)
            result = subprocess.run([*hide, os.path.join(EXAMPLES, program), *SMALL, *more, "-o", "a.png"], cwd=self.folder,
                                    capture_output=True, timeout=PATIENCE)
            self.assertEqual((result.returncode, result.stderr), (0, b""))
            self.assertEqual(self.read("a.png"), drawn)

    @unittest.skipUnless(os.path.exists(MODULE), "built without OpenImageIO")
    @in_long_form
    def test_other_formats(self):
        for extension, start in (("exr", b"\x76\x2f\x31\x01"), ("tif", b"II*\0"), ("webp", b"RIFF"),
                                 ("jpg", b"\xff\xd8\xff"), ("PNG", b"\x89PNG"))[::step(2)]:
            self.good(*SMALL, "-o", "a." + extension)
            self.assertTrue(self.read("a." + extension).startswith(start), extension)
        # The channels of an OpenEXR file: a name, and 2 for 32-bit float.
        channels = self.read("a.exr").split(b"channels\0chlist\0", 1)[1][4:]
        self.assertEqual(channels[:6], b"B\0" + struct.pack("<I", 2))
        self.refused(1, "folder missing/ does not exist", "-o", "missing/a.exr")

    @in_long_form
    def test_a_cache_that_cannot_be_made_is_no_word(self):
        """Mesa would say so: in a home that is read-only, or where XDG_CACHE_HOME is no folder."""
        self.make("file")
        for cache in ("", "/proc/none", self.path("file"), self.path("no", "folder")):
            self.good(*SMALL, "-o", "-", environment={"XDG_CACHE_HOME": cache})
        self.good(*SMALL, "-o", "-", environment={"MESA_SHADER_CACHE_DIR": "/proc/none"})
        self.good(*SMALL, "--error", "2", "-o", "-", environment={"XDG_CACHE_HOME": "/proc/none"},
                  program="SpotLight")
        self.need_somebody()
        home = next((user for user in pwd.getpwall() if user.pw_uid and os.getuid() == 0 and
                     user.pw_dir.startswith("/usr/") and os.path.isdir(user.pw_dir)), None)
        if home:  # "daemon", in /usr/sbin
            self.good(*SMALL, "-o", "-", user=home.pw_uid, group=home.pw_gid, extra_groups=[])

    @in_long_form
    def test_captions_need_a_font_and_no_plugin(self):
        result = self.run_it("-o", "a.png", program="PhongBlinn",
                             environment={"LD_DEBUG": "files"})
        self.assertEqual(result.returncode, 0)
        self.assertIn(b"libpng", result.stderr)
        self.assertNotIn(b"image_oiio", result.stderr)
        no_font = {"LIGHTING_FONT": "missing.ttf"}
        said = "missing.ttf: cannot read the font: .*; install the package fonts-dejavu-core$"
        self.refused(1, "^PhongBlinn: " + said, program="PhongBlinn", environment=no_font)


class Shaders(Case):
    def setUp(self):
        super().setUp()
        self.make("LightedCube.png")
        self.lecture = os.path.join(SOURCE, "shaders/lecture")
        os.mkdir(self.path("mine"))

    def original(self, name="LightedCube.frag"):
        with open(os.path.join(self.lecture, name), encoding="utf-8") as file:
            return file.read()

    @in_long_form
    def test_an_edited_shader_is_found_and_drawn(self):
        # Always 1, but no compiler knows, so that no variable becomes unused.
        red = ("precision mediump float;\nvarying vec4 v_Color;\nvoid main() {\n"
               "    float one = step(-9.0, v_Color.r + v_Color.g + v_Color.b);\n"
               "    gl_FragColor = vec4(one, 0.0, 0.0, 1.0);\n}\n")
        blue = red.replace("one, 0.0, 0.0", "0.0, 0.0, one")
        self.make("by_name/LightedCube.frag", red)
        self.make("by_path/lecture/LightedCube.frag", blue)
        for color, arguments, environment in (
                ((255, 0, 0), ("--shaders", "by_name"), {}),
                ((0, 0, 255), ("--shaders", "by_path"), {}),
                ((255, 0, 0), (), {"LIGHTING_SHADERS": "by_name"}),
                ((0, 0, 255), ("--shaders", "by_path"), {"LIGHTING_SHADERS": "by_name"})):
            self.assertEqual(self.drawn(*SMALL, *arguments, environment=environment).at(20, 20), color)

    def test_missing_folders_are_named(self):
        self.refused(1, "^LightedCube: nowhere: no such shader folder", "--shaders", "nowhere")
        self.refused(1, "^LightedCube: LightedCube.png: no such shader folder", "--shaders",
                     "LightedCube.png")
        self.refused(1, "^LightedCube: LIGHTING_SHADERS=nowhere: ",
                     environment={"LIGHTING_SHADERS": "nowhere"})

    @in_long_form
    def test_a_folder_without_a_shader_of_the_program_is_said(self):
        self.make("mine/SpotLight.frag")
        for program in "LightedCube", "ShadingModels":
            self.says(0, r"^\w+: mine: ignored: no shader file of this program is "
                      r"there\n$", *SMALL, "--shaders", "mine", program=program)

    @in_long_form
    def test_a_file_that_is_almost_one_of_the_program_is_said(self):
        for program, name, near in (
                ("LightedCube", "LightedCube.frag", "lightedcube.frag"),
                ("LightedCube", "LightedCube.frag", "LigthedCube.frag"),
                ("LightedCube", "LightedCube.frag", "lightedcube.frag.txt"),
                ("LightedCube", "LightedCube.frag", "LightedCube.FRAG"),
                ("ShadingModels", "lighting.vert", "Lighting.vert")):
            source = os.path.join(SOURCE, "shaders", "lecture" if "Cube" in name else "", name)
            other = source[:-4] + ("vert" if name.endswith("frag") else "frag")
            self.make("mine/" + near, "wrong")
            shutil.copy(other, self.path("mine"))
            self.says(0, rf"^{program}: mine/{near}: ignored: the file looked for is {name}\n$",
                      *SMALL, "--shaders", "mine", program=program)
            shutil.rmtree(self.path("mine"))

    def test_a_broken_shader_is_said_with_its_line(self):
        original = self.original()
        lines = original.count("\n")
        mine = "mine/LightedCube.frag"
        long = ("//" + "x" * 47 + "\n") * 16383
        for content, said, count in (
                ("", rf"^{mine}:1: the file is empty\n", 1),
                (b"\x7fELF\0\1\2", rf"^{mine}:1: byte 0x7F: ", 1),
                (b"int a;\n\0", rf"^{mine}:2: byte 0x00: ", 1),
                (bytes(10 << 20), rf"^LightedCube: {mine}: has 10485760 bytes", 1),
                ("#version 300 es\n", rf"^{mine}:1: only #version 100", 1),
                ("\nint a = 1.0;\n" + original, rf"^{mine}:2: .*\n  2 \| int a = 1\.0;\n", 0),
                (original + "int wrong = ;\n",
                 rf"^{mine}:{lines + 1}: .*\n  {lines + 1} \| int wrong = ;\n", 0),
                (original.replace("\n", "\r\n") + "int wrong = ;\r\n",
                 rf"^{mine}:{lines + 1}: .*\n  {lines + 1} \| int wrong = ;\n", 0),
                (long + "wrong;\n", rf"^{mine}:16384: .*\n  16384 \| wrong;\n", 0),
                ("\n#include \"LightedCube.frag\"\n", rf"^{mine}:2: .*includes itself\n", 1),
                ("#include \"missing.glsl\"\n",
                 rf"^{mine}:1: missing.glsl: no such .*\n  tried mine/missing.glsl\n", 0),
                ("#include \"part.glsl\"\n" + original,
                 r"^mine/part.glsl:2: .*\n  2 \| int p = q;\n", 0),
                ("precision mediump float;\nvarying vec3 v_Color;\nvoid main() {\n"
                 "    gl_FragColor = vec4(v_Color, 1.0);\n}\n",
                 rf"^{mine}:2: linking: .*\n  2 \| varying vec3 v_Color;\n", 0)):
            self.make("mine/part.glsl", "\nint p = q;\n")
            self.make(mine, content)
            self.refused(1, said, "--shaders", "mine", lines=count)

    @in_long_form
    def test_a_broken_shader_gets_a_hint(self):
        """In a teacher's words, beside the driver's."""
        for program, old, new, said in (
                ("LightedCube", "u_LightColor *", "u_LightColour *",
                 r"`u_LightColour' undeclared\n  \d+ \|.*\n  hint: u_LightColour is not declared: did you mean u_LightColor\?"),
                ("LightedCube", "normalize(", "normalise(",
                 r"(?s)normalise.*\n  hint: there is no function normalise: did you mean normalize\?"),
                ("LightedCube", "0.0);\n", "0);\n", r"candidates are:\n  \d+ \|.*\n  hint: max\(.*: .* a float, 0 an int: write 0\.0\n"),
                ("LightedCube", "gl_Position =", "gl_Position = vec3(1.0); gl_Position =",
                 r"\n  hint: gl_Position is a vec4, vec3\(1\.0\) a vec3: write vec4\(vec3\(1\.0\), 1\.0\)"),
                ("LightedCube", "normalize(", "inverse(", r"\n  hint: GLSL ES 1\.00 has no inverse here: compute it in the program"),
                ("LightedCube", "max(", "saturate(", r"\n  hint: GLSL ES 1\.00 has no saturate here: write clamp\("),
                ("LightedCube", "normalize(", "sinh(", r"\n  hint: GLSL ES 1\.00 has no sinh here: write it with exp"),
                ("LightedCube", ";\n}", "\n}", r"\n  hint: a semicolon is missing, probably at the end of line \d+"),
                ("Materials", "a_Normal", "a_Norml", r"(?s)\n  hint: .*did you mean a_Normal\?")):
            with self.subTest(new=new):
                path = "lighting" if program == "Materials" else "lecture/" + program
                for suffix in ".vert", ".frag":
                    os.makedirs(self.path("mine"), exist_ok=True)
                    shutil.copy(os.path.join(SOURCE, "shaders", path + suffix), self.path("mine"))
                name = f"mine/{os.path.basename(path)}.vert"
                text = self.read(name).decode()
                self.assertIn(old, text)
                head, _, tail = text.rpartition(old)
                self.make(name, head + new + tail)
                self.refused(1, said, "--shaders", "mine", lines=0, program=program)

    @in_long_form
    def test_a_labs_unknown_variable_is_said_with_its_place(self):
        shutil.copytree(os.path.join(SOURCE, "examples/labs/lab06_phong"), self.path("mine"),
                        dirs_exist_ok=True)
        text = self.read("mine/lab06.frag").decode()
        self.make("mine/lab06.frag", text.replace("u_AmbientLight", "u_AmbientLigth"))
        line = 1 + text[:text.index("u_AmbientLight")].count("\n")
        self.refused(1, rf"^mine/lab06.frag:{line}: error: uniform u_AmbientLigth does not exist in "
                        r"this lab; did you mean u_AmbientLight\?\n$", "--shaders", "mine",
                     program="lab06_phong")

    def warned(self, warning, program="LightedCube", **more):
        """Draws, with this one line on standard error; the picture."""
        result = self.run_it(*SMALL, "--shaders", "mine", "-o", "-", program=program, **more)
        self.assertEqual((result.returncode, result.stderr.decode()), (0, warning + "\n"))
        return Png(result.stdout)

    @in_long_form
    def test_each_variable_of_each_shader_can_become_unused(self):
        for program in PROGRAMS[::step(24)]:
            for name in (program + ".vert", program + ".frag"):
                text = self.original(name)
                for kind, variable in re.findall(r"^(?:uniform|attribute) (\w+) (\w+);", text, re.M):
                    body = text.index("void main")
                    line = text[:text.index(f"{kind} {variable};")].count("\n") + 1
                    # A declaration alone, and none.
                    used = text[body:].replace(variable, kind + "(1.0)")
                    self.make("mine/" + name, text[:body] + used)
                    self.warned(f"mine/{name}:{line}: warning: {variable} is not used", program)
                    self.make("mine/" + name, re.sub(rf".* {variable};.*", "", text[:body]) + used)
                    files = [("mine/" if name.endswith(end) else self.lecture + "/") + program + end
                             for end in (".vert", ".frag")]
                    self.warned(f"{files[0]}, {files[1]}: warning: {variable} is not declared", program)
                    # Mistyped.
                    self.make("mine/" + name, text.replace(variable, variable + "s"))
                    self.warned(f"mine/{name}:{line}: warning: {variable}s: {variable}?", program)
                    os.remove(self.path("mine", name))

    @in_long_form
    def test_several_unused_variables_are_one_line(self):
        text = self.original("LightedCube.vert")
        self.make("mine/LightedCube.vert", text.replace("v_Color = vec4(diffuse, a_Color.a)",
                                                        "v_Color = vec4(0.2, 0.4, 0.6, 1.0)"))
        png = self.warned("mine/LightedCube.vert:4: warning: a_Color is not used, a_Normal is not "
                          "used, u_LightColor is not used, u_LightDirection is not used")
        self.assertEqual(png.at(20, 20), (51, 102, 153))
        # The gallery says it once too.
        self.says(0, r"^mine/[^\n]*u_LightDirection is not used\n$", "LightedCube", *SMALL,
                  "--shaders", "mine", program="gallery")

    def test_a_shader_must_be_a_regular_file(self):
        os.mkfifo(self.path("mine/LightedCube.frag"))
        self.refused(1, "LightedCube.frag: is not a regular file", "--shaders", "mine")
        os.remove(self.path("mine/LightedCube.frag"))
        os.mkdir(self.path("mine/LightedCube.frag"))
        self.refused(1, "LightedCube.frag: is not a regular file", "--shaders", "mine")

    @in_long_form
    def test_precision_changes_the_shader_and_hardly_the_picture(self):
        high, medium = (self.drawn(*SMALL, "--precision", name).pixels
                        for name in ("highp", "mediump"))
        # One step of rounding: a driver may take mediump's ten bits at its word.
        self.assertLessEqual(max(abs(a - b) for a, b in zip(high, medium)), 1)


class Scenes(Case):
    @in_long_form
    def test_every_scene_draws_the_same_with_the_full_program(self):
        for program in SCENES[::step(9)]:
            with self.subTest(program=program):
                # Costs are left out where the full program is drawn.
                plain = ("--costs", "off") if program == "TermsApart" else ()
                self.good(*plain, program=program)
                self.good(*plain, "--full", "-o", "full.png", program=program)
                lean, full = self.png(program + ".png"), self.png("full.png")
                self.assertGreater(len(set(zip(*[iter(lean.pixels)] * 3))), 50)
                self.assertEqual((lean.width, lean.height), (full.width, full.height))
                apart = [abs(a - b) for a, b in zip(lean.pixels, full.pixels)]
                # The programs round differently, and then once to a level; where a spot's edge
                # or the sign of a normal decides, a pixel may be on either side.
                self.assertLess(sum(a > 1 for a in apart), 1e-4 * len(apart))

    @in_long_form
    def test_the_full_program_without_a_light(self):
        self.good(*SMALL, "--lighting", "off", program="Shadows")
        self.good(*SMALL, "--lighting", "off", "--full", "-o", "full.png", program="Shadows")
        self.assertEqual(self.png("Shadows.png").pixels, self.png("full.png").pixels)

    @in_long_form
    def test_every_scene_explains_itself_and_draws_nothing(self):
        for program in SCENES[::step(3)]:
            with self.subTest(program=program):
                text = self.good("--explain", program=program).decode()
                self.assertRegex(text, r"lights? 0[: ]")
                self.assertIn("\noperations: ", text)
                self.assertIn("# what the model leaves out\n", text)
                self.assertNotIn("#version", text)
                # A screenful, and two matrices.
                self.assertLess(text.count("\n"), 74)
                self.assertLessEqual(max(map(len, text.splitlines())), 100)

    @in_long_form
    def test_what_an_explanation_folds_is_in_the_verbose_one(self):
        for program in ("LightTypes", "FourLights", "ColoredLights")[::step(3)]:
            short = self.good("--explain", program=program).decode()
            result = self.run_it("--explain", "--verbose", program=program)
            text = result.stdout.decode()
            self.assertEqual(result.returncode, 0)
            self.assertGreater(text.count("\n"), short.count("\n"))
            # Each difference that is named is a line there.
            said = re.sub(r"\n  (?=\S)", " ", short)
            for others in re.findall(r"^view \d+, object \d+: as .*?, but (.*)$", said, re.M):
                for other in others.split("; "):
                    other = re.sub(r"^lights? [\d to]+ (?=\D)", "", other)
                    other = re.sub(r"^lights (\d+) to \d+:", r"light \1:", other)
                    self.assertRegex(text, rf"(?m)^ *{re.escape(other)}$")
        self.assertEqual(self.everything(), {})

    @in_long_form
    def test_how_shadows_are_drawn_is_explained(self):
        for program, arguments, line in (
                ("Shadows", ("--shadows", "map:256"), r"light 0: map 0 of 1, 256x256: .* of 24 bits .*"),
                ("Shadows", (), "light 0: volumes"),
                ("SpotLight", ("--shadows", "on"),
                 r"light 0: none, because nothing can come between; that saves volumes of [1-9]\d* triangles, .*"),
                ("SpotLight", ("--shadows", "map:256"), r"light 0: none, .*; that saves a map of 256x256 .*")):
            with self.subTest(program=program, arguments=arguments):
                text = self.run_it("--explain", *arguments, program=program).stdout.decode()
                self.assertRegex(text, "(?m)^" + line + "$")

    @in_long_form
    def test_the_precision_of_depth_is_explained(self):
        """Values next to each other, as the buffer has them, are so far apart in depth."""
        for distance in (1, 27):
            text = self.good("--explain", "--orbit", f"0,0,{distance}", program="ShadingModels")
            bits, *numbers = re.search(
                r"\n# depth: (\d+) bits from (\S+) to (\S+), in steps of (\S+) in front and (\S+) "
                r"at the back\n", text.decode()).groups()
            near, far, *apart = map(float, numbers)
            for at, said in zip((near, far), apart):
                kept = (1 / near - 1 / at) / (1 / near - 1 / far)
                value = kept + (1 if at == near else -1) * 2.0 ** -int(bits)
                next_to_it = 1 / (1 / near - value * (1 / near - 1 / far))
                self.assertAlmostEqual(abs(next_to_it - at) / said, 1, delta=0.05)

    @in_long_form
    def test_antialiasing_changes_edges_alone(self):
        for program in SCENES[1::step(9)]:
            with self.subTest(program=program):
                plain = self.drawn(program=program).pixels
                smooth = self.drawn("--samples", "4", program=program).pixels
                apart = sum(abs(a - b) > 8 for a, b in zip(plain, smooth))
                # Edges, lines and the small spheres of a row are a few pixels in a hundred.
                self.assertTrue(0 < apart < 0.06 * len(plain), apart / len(plain))

    @in_long_form
    def test_each_option_of_a_scene_has_its_range(self):
        for program, said, *arguments in (
                ("SpotLight", "0 to 90", "--cutoff", "91"),
                ("SpotLight", "0 to 128", "--exponent", "-1"),
                ("SmoothFlat", "3 to 64", "--slices", "2"),
                ("SmoothFlat", "3 to 64", "--slices", "8.5"),
                ("SmoothFlat", "2 to 32", "--stacks", "33"),
                ("SmoothFlat", "smooth, flat or original; --show-normals on draws them", "--normals", "on"),
                ("Materials", "0 to 128", "--shininess", "129"),
                ("Materials", "0 to 1", "--diffuse", "0,0,1.1"),
                ("Materials", "R,G,B or one number", "--specular", "0,0"),
                ("Materials", "did you mean gold", "--material", "golf"),
                ("ShadingModels", "did you mean sphere", "--shape", "sphre"),
                ("ShadingModels", r"--shape square: must be cube, sphere, .* or \S+$", "--shape", "square"),
                ("ShadingModels", "blinn-phong, phong or original", "--reflection", "lambert"),
                ("FourLights", "on or off", "--red", "maybe"),
                ("ShadingModels", "--model: the name is empty", "--model", ""),
                ("PhongBlinn", "1 to 30", "--shininess", "31"),
                ("LightTypes", "vertex or end", "--clamp", "never"),
                ("LightedCube", "no such option", "--explain")):
            self.refused(2, f"^{program}: .*{said}", *arguments, program=program)

    @in_long_form
    def test_options_change_the_picture(self):
        plain = {}
        for program, *arguments in (
                ("ShadingModels", "--shape", "teapot"), ("ShadingModels", "--material", "ruby"),
                ("ShadingModels", "--interpolation", "gouraud"),
                ("ShadingModels", "--reflection", "blinn-phong"),
                ("ShadingModels", "--fixed-light", "off"), ("ShadingModels", "--time", "1"),
                ("ShadingModels", "--turning-kind", "directional"), ("ShadingModels", "--linear"),
                ("ShadingModels", "--material", "pearl", "--show-clipped"),
                ("NormalMatrix", "--normals", "on"), ("TwoSidedLighting", "--shape", "cylinder"),
                ("TwoSidedLighting", "--time", "6"), ("SpotLight", "--cutoff", "10"),
                ("SpotLight", "--exponent", "30"), ("ShininessRow", "--reflection", "blinn-phong"),
                ("Materials", "--sheet", "on"), ("Materials", "--material", "gold"),
                ("SmoothFlat", "--normals", "flat"), ("SmoothFlat", "--shape", "band"),
                ("SmoothFlat", "--edges", "on"), ("FourLights", "--green", "off"),
                ("FourLights", "--ambient", "off"), ("LightTypes", "--quadratic", "0"),
                ("LightTypes", "--linear", "0.9"), ("LightTypes", "--linear-light"),
                ("PhongBlinn", "--fit", "off"), ("PhongBlinn", "--interpolation", "gouraud"),
                ("NormalMatrix", "--matrix", "wrong"), ("NormalMatrix", "--matrix", "both"),
                ("NormalMatrix", "--material", "jade"), ("TwoSidedLighting", "--front-face", "cw"),
                ("TwoSidedLighting", "--back-material", "jade", "-t", "6"),
                ("SpotLight", "--material", "jade"), ("SpotLight", "--shape", "cube"),
                ("SpotLight", "--global-ambient", "0.5"), ("Materials", "--emission", "0.1"),
                ("Materials", "--viewer", "local"), ("Materials", "--light-diffuse", "1,0,0"),
                ("Materials", "--terms", "diffuse"), ("Materials", "--lighting", "off"),
                ("ShadingModels", "--terms", "0"), ("SmoothFlat", "--shape", "square"),
                ("SmoothFlat", "--interpolation", "constant"), ("FourLights", "--base", "off"),
                ("FourLights", "--orbit", "0,30"), ("ColoredLights", "--light", "0,1,1"),
                ("TermsApart", "--costs", "off"))[::step(5)]:
            with self.subTest(program=program, arguments=arguments):
                # Captions are left out where there is no room for them.
                size = ("-s", "600x300" if program == "TermsApart" else "120x120")
                if program not in plain:
                    plain[program] = self.drawn(*size, program=program).pixels
                changed = self.drawn(*size, *arguments, program=program).pixels
                self.assertNotEqual(plain[program], changed)

    @in_long_form
    def test_options_that_do_nothing_are_said(self):
        for program, unused, *arguments in (
                ("Materials", "--diffuse --shininess", "--sheet=on", "--diffuse=1,0,0",
                 "--shininess=3", "--light-diffuse=0.5"),
                ("Materials", "--opacity", "--opacity=0.5", "--material=gold"),
                ("Materials", "", "--opacity=0.5", "--alpha"),
                ("Materials", "--specular", "--terms=diffuse", "--specular=0.2"),
                ("Materials", "--shininess", "--specular=0", "--shininess=5"),
                ("SmoothFlat", "--normals --slices --stacks", "--shape=band", "--normals=flat",
                 "--slices=5", "--stacks=7"),
                ("SmoothFlat", "--stacks", "--shape=square", "--slices=5", "--stacks=9"),
                ("PhongBlinn", "", "--fit=off", "--shininess=20"),
                ("TermsApart", "", "--costs=off", "--shape=cube"),
                ("SpotLight", "", "--cutoff=10", "--exponent=3", "--shape=cube"),
                *((("Vectors", "--shininess", "--figure=rays", "--shininess=3"),)
                  if DIAGRAMS else ()))[::step(3)]:
            with self.subTest(program=program, arguments=arguments):
                size = "600x300" if program == "TermsApart" else "120x120"  # room for captions
                draw = functools.partial(self.good_or_unused, "-s", size, program=program)
                unused = set(unused.split())
                self.assertEqual(draw(*arguments, "-o", "all.png"), unused)
                for left_out in [one for one in arguments if one != "--alpha"]:
                    draw(*(one for one in arguments if one != left_out), "-o", "without.png")
                    self.assertEqual(self.png("all.png").pixels == self.png("without.png").pixels,
                                     left_out.split("=")[0] in unused, left_out)

    def test_no_line_of_help_ends_in_a_blank(self):
        for program in EVERY:
            if os.path.exists(os.path.join(EXAMPLES, program)):
                self.assertNotRegex(self.good("--help", program=program), rb"[ \t]\n", program)

    @in_long_form
    def test_terms_and_lights_that_are_not_there_are_said(self):
        has = "the scene has ambient, diffuse, specular"
        for program, said, terms in (
                ("LightTypes", f"--terms: there is no light 7; {has}; light 0", "7"),
                ("FourLights", "--terms: there is no light 4; .*; lights 0 to 3", "diffuse,3,4"),
                ("Materials", "--terms: there is no emission; the scene has diffuse, specular; light 0", "emission"),
                ("Materials", "--terms difuse,0: difuse: did you mean diffuse?", "difuse,0"),
                ("Materials", "--terms 32: must be some of ", "32"), ("Materials", "--terms : must be", "")):
            self.refused(2, f"^{program}: {said}", "--terms", terms, program=program)
        for option in "--light-at", "--light-color":
            self.refused(2, f"^FourLights: {option}: there is no light 4; the scene has lights 0 to 3",
                         option, "1,1,1,1/4,0,0,1", program="FourLights")

    @in_long_form
    def test_the_lights_are_listed_with_their_numbers(self):
        """With --light-at and --light-color, of which a line says what can be given."""
        text = self.good("--explain", "--light-at", "1,-5,7,0.25", "--light-color", "2,1,0.5,0,0,0,1",
                         program="FourLights").decode()
        self.assertTrue(text.startswith("# lights, by their numbers in "), text)
        for line in ("0: directional, from 0,0,1 of the viewer; colour 0.5,0.5,0.5",
                     "1: point, at -5,7,0.25; colour 0.5,0,0"):
            self.assertIn(f"\n{line}\n", text)
        self.assertRegex(text, r"\n2: point, at \S+; colour 1,0\.5,0, specular 0,0,1\n3: ")
        self.assertIn("\n0: view 6, point, ", self.good("--explain", program="TermsApart").decode())
        for option in "--light-color", "--light-at":
            self.refused(2, f"^FourLights: {option} 0,1: must be LIGHT,[^;]*, with LIGHT from 0 to 7",
                         option, "0,1", program="FourLights")

    @in_long_form
    def test_the_lamps_follow_their_lights(self):
        """Only the lamps emit: one that is moved is drawn where it goes, in its light's color."""
        def drawn(*arguments):
            return self.drawn("-s", "64x64", "--terms", "emission", *arguments, program="FourLights")

        def bright(png, channel):
            return [i // 3 for i in range(channel, len(png.pixels), 3) if png.pixels[i] > 60]

        self.assertTrue(bright(drawn(), 0))
        red = bright(drawn("--light-at", "1,0,12,0"), 0)
        self.assertTrue(red)
        middle = sum(place % 64 for place in red) / len(red)
        self.assertTrue(28 < middle < 36, middle)
        self.assertFalse(bright(drawn("--light-color", "1,0,0.5,0"), 0))

    @in_long_form
    def test_captions_are_true_with_and_without_shadows(self):
        sheet = "-s", "900x600", "--sheet", "on"
        without = self.drawn(*sheet, "--shadows", "off", program="Shadows")
        rows = [without.pixels[3 * 900 * y:][:3 * 600] for y in range(275, 300)]
        self.assertTrue(any(map(any, rows)))
        self.assertTrue(all(row[:900] == row[900:] for row in rows))  # two captions say the same
        costs = [self.drawn("--shadows", "volumes", "--costs", costs, program="TermsApart").pixels
                 for costs in ("off", "operations")]
        self.assertEqual(*costs)

    @in_long_form
    def test_shadows_that_fall_on_nothing_are_said(self):
        said = "SpotLight: --shadows: ignored: has no effect here\n"
        self.says(0, f"^{said}$", *SMALL, "--shadows", "volumes", "-o", "with.png", program="SpotLight")
        self.assertEqual(self.png("with.png").pixels, self.drawn(*SMALL, program="SpotLight").pixels)
        self.says(0, "^ShadingModels: --shadows, --opacity: ignored: has no effect here", *SMALL, "--shadows",
                  "volumes", "--opacity", "0.5", program="ShadingModels")
        for program, *arguments in (("Materials", "--shadows", "volumes"),
                                    ("Shadows", "--shadows", "off"), ("Shadows", )):
            self.good(*SMALL, *arguments, program=program)

    @in_long_form
    def test_clamp_dots_that_changes_nothing_is_said(self):
        """Only N.L of a light without shadows, whose diffuse light a surface reflects, is not clamped."""
        off = "--clamp-dots", "off"
        for program, *arguments in (("ShadingModels", "--terms", "specular"), ("ShadingModels", "--lighting", "off"),
                                    ("Shadows", )):
            with self.subTest(program=program, arguments=arguments):
                self.says(0, f"^{program}: --clamp-dots: ignored: has no effect here\n$", *SMALL, *arguments, *off,
                          "-o", "off.png", program=program)
                self.assertEqual(self.png("off.png").pixels, self.drawn(*SMALL, *arguments, program=program).pixels)
        for program, *arguments in (("ShadingModels", ), ("Shadows", "--shadows", "off")):
            with self.subTest(program=program, arguments=arguments):
                self.assertNotEqual(self.drawn(*SMALL, *arguments, *off, program=program).pixels,
                                    self.drawn(*SMALL, *arguments, program=program).pixels)

    @in_long_form
    def test_the_caption_of_a_difference_says_how_many_times_it_is_shown(self):
        """The captions differ where the pictures are the same: where there is no difference."""
        def drawn(gain):
            picture = self.drawn("--gain", gain, "--light-specular", "0", program="PhongBlinn")
            above, captions = picture.pixels[:3 * 900 * 270], picture.pixels[3 * 900 * 270:]
            return above, [captions[i + 1800:i + 2700] for i in range(0, len(captions), 2700)]

        (one, single), (four, times) = drawn("1"), drawn("4")
        self.assertEqual(one, four)
        widths = [max(i // 3 for row in rows for i in range(900) if row[i]) -
                  min(i // 3 for row in rows for i in range(900) if row[i]) for rows in (single, times)]
        self.assertGreater(widths[1], widths[0] + 30)  # "difference", "4 x the difference"

    @in_long_form
    def test_a_light_has_the_color_that_it_is_given(self):
        """As the option for the colors of all of them, in a scene with one."""
        of_all = "--light-diffuse", "1,0.5,0", "--light-specular", "0,0,1"
        wanted = self.drawn(*SMALL, *of_all, program="Materials").pixels
        own = self.drawn(*SMALL, "--light-color", "0,1,0.5,0,0,0,1", program="Materials")
        self.assertEqual(own.pixels, wanted)
        self.assertIn("--light-color 0,1,0.5,0,0,0,1", own.texts["Command"])
        both = self.drawn(*SMALL, "--light-color", "0,1,0.5,0", program="Materials").pixels
        self.assertEqual(both, self.drawn(*SMALL, "--light-diffuse", "1,0.5,0",
                                          "--light-specular", "1,0.5,0", program="Materials").pixels)

    @in_long_form
    def test_a_named_material_can_be_changed_in_any_order(self):
        mixed = self.drawn("--material", "gold", "--diffuse", "0,0,1", program="Materials").pixels
        self.assertEqual(mixed, self.drawn("--diffuse", "0,0,1", "--material", "gold",
                                           program="Materials").pixels)
        self.assertNotEqual(mixed, self.drawn("--material", "gold", program="Materials").pixels)

    @in_long_form
    def test_the_light_of_the_viewer_follows_the_camera(self):
        """A sphere looks the same from all sides; its mesh turns, by at most a few steps."""
        plain = self.drawn("--shape", "sphere", program="Materials").pixels
        behind = self.drawn("--shape", "sphere", "--orbit", "180,0", program="Materials").pixels
        self.assertLess(max(abs(a - b) for a, b in zip(plain, behind)), 8)

    @in_long_form
    def test_every_distance_shows_the_scene(self):
        for distance in ("0.3", "3", "27")[::step(2)]:
            for program in ("ShadingModels", "Materials", "FourLights", "ShininessRow"):
                with self.subTest(program=program, distance=distance):
                    pixels = self.drawn("--orbit", "20,10," + distance, program=program).pixels
                    self.assertGreater(len(set(pixels)), 3) # the background has three at most


class Index(Case):
    @in_long_form
    def test_every_command_of_the_index_draws_another_picture_than_without_its_options(self):
        """examples/README.md, where each section is shown; and no option is ignored."""
        with open(os.path.join(SOURCE, "examples/README.md")) as file:
            index = file.read().split("## Where each section is shown")[1]
        commands = [command.split() for command in re.findall(r"`(\w+ --[^`]+)`", index)]
        commands = [words for words in commands if words[0] in PROGRAMS + SCENES + DIAGRAMS and "--explain" not in words]
        commands = [words for words in commands if words[1] != "--costs"] # so that a page draws the same
        self.assertGreater(len(commands), 20)
        size, plain = ("-s", "120x120"), {}
        for program, *options in commands[::step(6)]:
            with self.subTest(program=program, options=options):
                if program not in plain:
                    plain[program] = self.drawn(*size, program=program).pixels
                self.assertNotEqual(self.drawn(*size, *options, program=program).pixels, plain[program])


class Reflections(Case):
    """What the page of the lighting model says of Phong's and Blinn-Phong's reflection."""
    MODELS = ("phong", "blinn-phong")
    ONE = ("--interpolation", "phong", "--turning-light", "off")

    @in_long_form
    def test_blinn_phong_saves_operations_only_if_light_and_viewer_are_at_infinity(self):
        """There L + V is one vector for all fragments, and R is not."""
        def operations(reflection, *more):
            said = self.good(*self.ONE, "--shape", "sphere", "--reflection", reflection, *more, "--explain",
                             program="ShadingModels").decode()
            return int(re.search(r"^operations: .* (\d+) per fragment", said, re.M)[1])

        near = [operations(model) for model in self.MODELS]
        far = [operations(model, "--viewer", "infinite", "--fixed-kind", "directional") for model in self.MODELS]
        self.assertLess(near[0], near[1])
        self.assertGreater(far[0], far[1])
        with open(os.path.join(SOURCE, "examples/lighting/README.md")) as file:
            said = " ".join(file.read().split())
        page = re.search(r"(\d+) operations per fragment against Phong's (\d+)\. Otherwise H costs more than R: "
                         r"(\d+) against (\d+)", said)
        for counted, told in zip((far[1], far[0], near[1], near[0]), page.groups()):
            self.assertEqual(counted, int(told))

    @in_long_form
    def test_blinn_phongs_highlight_is_drawn_out_at_a_grazing_angle(self):
        """Across the view it is less than half as wide as Phong's, on the top of a cube."""
        widths = []
        for model in self.MODELS:
            picture = self.drawn(*self.ONE, "-s", "300x300", "--shape", "cube", "--reflection", model, "--orbit", "0,8",
                                 "--light-at", "0,-4,2.6,-6", program="ShadingModels")
            row = [picture.at(x, 85)[0] for x in range(60, 240)]
            widths.append(sum(value > max(row) / 2 for value in row))
        self.assertGreater(widths[0], 2 * widths[1])


class Gallery(Case):
    def gallery(self, *arguments, **more):
        return self.good(*arguments, program="gallery", **more)

    def moved(self, program):
        return ["--time", "1"] if program.endswith("_animation") else []

    @in_long_form
    def test_animations_have_moved_unless_the_time_is_given(self):
        """Else they look like the program before them."""
        names = "LightedCube", "LightedCube_animation"
        for folder, *time in (("moved", ), ("zero", "-t", "0"), ("angle", "-a", "0")):
            self.gallery(*names, *SMALL, *time, "-o", folder)
            still, moving = (self.png(f"{folder}/{name}.png") for name in names)
            self.assertEqual(still.pixels == moving.pixels, bool(time), folder)
        self.gallery(*names, *SMALL, "--part", "2/2", "-o", "part")
        self.assertEqual(self.png("part.parts/LightedCube_animation.png").texts["Time"], "1 s")

    @in_long_form
    def test_every_picture_is_the_one_that_its_program_draws(self):
        self.assertEqual(self.gallery(*SMALL, "-o", "pictures"), b"pictures/index.html\n")
        self.assertEqual(sorted(os.listdir(self.path("pictures"))),
                         sorted([name + ".png" for name in PROGRAMS + SCENES + DIAGRAMS] +
                                ["index.html"]))
        page = self.read("pictures/index.html").decode()
        self.assertNotRegex(page, r'<img(?![^>]* alt="[A-Z]\w+: [^"]{10,}")')
        for number, program in enumerate(PROGRAMS + SCENES + DIAGRAMS):
            smooth = [] if program in DIAGRAMS else ["--samples", "4"]
            smooth = [*self.moved(program), *smooth]
            if number % step(4) == 0:
                self.assertEqual(self.drawn(*SMALL, *smooth, program=program).pixels,
                                 self.png(f"pictures/{program}.png").pixels)
            said = " ".join([program, "--size 40x40", *smooth])
            self.assertIn(f"<code>examples/run {said}</code>", page)

    @in_long_form
    def test_lines_and_markers_are_smooth_with_samples_alone(self):
        sharp = self.drawn(program="TwoSidedLighting")
        smooth = self.drawn("--samples", "4", program="TwoSidedLighting")
        blue, gray, white = (0, 0, 255), (128, 128, 128), (255, 255, 255)
        line = {y: (sharp.at(120, y), smooth.at(120, y)) for y in range(305, 322)}
        self.assertLessEqual({color for color, _ in line.values()}, {blue, gray})
        self.assertTrue({color for _, color in line.values()} - {blue, gray})
        marker = [(sharp.at(x, 223), smooth.at(x, 223)) for x in range(208, 228)]
        self.assertIn((white, white), marker)
        edges = [b for a, b in marker if max(abs(i - j) for i, j in zip(a, b)) > 20]
        self.assertTrue(1 <= len(edges) <= 2, edges)

    @in_long_form
    def test_the_page_has_the_commands_that_draw_its_pictures(self):
        # The second program has a size of its own.
        self.gallery("LightedCube", "ShininessRow", "--orbit", "30,-10", "--samples", "4",
                     "--alpha", "-t", "0.1", "--shaders", os.path.join(SOURCE, "shaders"))
        page = self.read("gallery/index.html").decode()
        for program in "LightedCube", "ShininessRow":
            said = f"{program} --time 0.1 --samples 4 --orbit 30,-10 --shaders ... --alpha"
            self.assertIn(f"<code>examples/run {said}</code>", page)
            words = said.replace("--shaders ...", "").split()[1:]
            self.assertEqual(self.drawn(*words, program=program).pixels,
                             self.png(f"gallery/{program}.png").pixels)
        self.gallery("ShininessRow", "-s", "400x400", "--samples", "0")
        self.assertIn("<code>examples/run ShininessRow --size 400x400</code>",
                      self.read("gallery/index.html").decode())

    @in_long_form
    def test_named_programs_are_drawn_into_the_default_folder(self):
        self.gallery("PointLightedCube", *SMALL, "LightedCube")
        self.assertEqual(sorted(os.listdir(self.path("gallery"))),
                         ["LightedCube.png", "PointLightedCube.png", "index.html"])

    @in_long_form
    def test_the_lecture_is_nine_pictures_and_a_page(self):
        """In the lecture's order; also beside others that are named."""
        self.assertEqual(len(PROGRAMS), 9)
        rest = ["index.html"]
        self.assertEqual(self.gallery("--lecture", *SMALL, "-o", "nine"), b"nine/index.html\n")
        self.assertEqual(sorted(os.listdir(self.path("nine"))), sorted([name + ".png" for name in PROGRAMS] + rest))
        shown = re.findall(r'<img[^>]* src="(\w+)\.png"', self.read("nine/index.html").decode())
        with open(os.path.join(SOURCE, "examples/meson.build")) as file:
            order = re.search(r"lecture_programs = \[(.*?)\]", file.read(), re.DOTALL)[1]
        self.assertEqual(shown, re.findall(r"'(\w+)'", order))
        for program in PROGRAMS[::step(4)]:
            self.assertEqual(self.drawn(*SMALL, *self.moved(program), "--samples", "4", program=program).pixels,
                             self.png(f"nine/{program}.png").pixels)
        self.gallery("Materials", "--lecture", *SMALL, "-o", "ten")
        self.assertEqual(sorted(os.listdir(self.path("ten"))),
                         sorted([name + ".png" for name in PROGRAMS + ["Materials"]] + rest))

    def test_usage_errors_and_failures_are_said(self):
        self.make("file")
        for code, said, *arguments in (
                (2, "LightedCub: no such program; did you mean LightedCube", "LightedCub"),
                (2, "xylophone: no such program", "xylophone"), (2, "--frames: ", "-n", "2"),
                (2, "--fps: ", "--fps", "2"), (2, "--size 0x0: must be", "-s", "0x0"),
                (1, "file: exists and is not a folder", "-o", "file"),
                (1, "missing/deep: cannot create the folder", "-o", "missing/deep")):
            self.refused(code, "^gallery: " + said, *arguments, program="gallery")
        self.refused(1, "^gallery: EGL: .*unset", program="gallery", environment=NO_DRIVER)


class Again(Case):
    """The same command writes the same bytes, and a picture's text is such a command."""
    FORMATS = ("png", "exr", "tif", "jpg", "webp", "bmp", "tga", "ppm", "hdr", "dpx", "gif")
    FILMS = ("gif", "webp", "apng", "mp4", "webm")
    DRAW = PROGRAMS + SCENES + [program for program in EVERY if program.startswith("lab")]
    CUBE = ("v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv 0 0 1\n"
            "f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n")

    def values(self, program):
        """A value that is not the default's for each option that the program alone has."""
        text = self.good("--help", program=program).decode().partition("Options of this program")[2]
        found = []
        for name, form, rest in re.findall(r"^ +--(\S+) (\S+)((?:.*\n(?! +--|\n))*.*)", text,
                                           re.MULTILINE):
            form += "".join(rest.split()) if form.endswith("|") else ""
            usual = re.search(r"default\s+(\S+)", rest)
            if "differs from run to run" in " ".join(rest.split()):
                continue
            if name == "model":
                self.make("a model.obj", self.CUBE)
                value = self.path("a model.obj")
            elif form in PLACEHOLDERS:
                value = PLACEHOLDERS[form]
            elif ".." in form:
                low, high = map(float, form.split(".."))
                value = next(text for text in (f"{(low + high) // 2:g}", f"{(low + high) / 4:g}")
                             if not usual or text != usual[1])
            else:
                value = next(word for word in re.split(r"\||;", form)
                             if not usual or word != usual[1])
            found.append((name, value))
        self.assertTrue(found, program)
        return found

    def command(self, data):
        """What a picture says, as a shell has it."""
        if data[:4] == b"\x89PNG":
            text = Png(data).texts["Command"]
        elif data[:2] == b"II":  # TIFF: tag 270 of the first folder
            at = struct.unpack("<I", data[4:8])[0]
            tags = [struct.unpack("<HHII", data[at + 2 + 12 * i:at + 14 + 12 * i])
                    for i in range(struct.unpack("<H", data[at:at + 2])[0])]
            size, place = next((tag[2], tag[3]) for tag in tags if tag[0] == 270)
            text = data[place:place + size - 1].decode()
        else:  # OpenEXR: name, type, size, value
            place = data.index(b"Command\0string\0") + 15
            size = struct.unpack("<I", data[place:place + 4])[0]
            text = data[place + 4:place + 4 + size].decode()
        return subprocess.run(["sh", "-c", f"printf '%s\\0' {text}"], stdout=subprocess.PIPE,
                              check=True).stdout.decode().split("\0")[:-1]

    def test_pictures_of_the_pages_are_current(self):
        """Drawn again by the command that they contain; but for rounding, and letters by FreeType."""
        pictures = sorted(glob.glob(os.path.join(SOURCE, "examples", "**", "pictures", "*.png"),
                                    recursive=True))
        self.assertGreater(len(pictures), 20)
        for path in pictures[::step(15)]:
            data = self.read(path)
            if b"Command" not in data:
                continue  # of a window or a page
            picture, (program, *words) = Png(data), self.command(data)
            result = self.run_it(*words, "-o", "-", program=program, cwd=os.path.dirname(path))
            self.assertEqual((result.returncode, result.stderr == b""), (0, "--show" not in words), path)
            again = Png(result.stdout)
            self.assertEqual((picture.width, picture.height), (again.width, again.height), path)
            other = sum(abs(a - b) > 8 for a, b in zip(picture.pixels, again.pixels))
            # A diagram is full of letters, each of which another FreeType places otherwise.
            share = 1 / 50 if program == "Vectors" else 1 / 1000
            self.assertLess(other, share * len(again.pixels), path)

    def assert_again(self, program, *arguments, suffix="png", **more):
        self.good_or_unused(*arguments, "-o", "first." + suffix, program=program, **more)
        first = self.read("first." + suffix)
        name, *words = self.command(first)
        with self.subTest(program=program, arguments=arguments, suffix=suffix, words=words):
            self.assertEqual(name, program)
            os.makedirs(self.path("elsewhere"), exist_ok=True)
            self.good_or_unused(*words, program=name, cwd=self.path("elsewhere"))
            self.assertEqual(os.listdir(self.path("elsewhere")), [f"{program}.{suffix}"])
            self.assertTrue(self.read(f"elsewhere/{program}.{suffix}") == first)
        shutil.rmtree(self.path("elsewhere"))
        return words

    @in_long_form
    def test_every_program_says_how_to_draw_its_picture_again(self):
        common = ("-t", "0.7", "--orbit=-20,10,0.9", "--samples", "2", "--alpha", "--compress", "9")
        for program in self.DRAW[::step(21)]:
            self.assert_again(program, *SMALL, *common, "--precision", "mediump", "--deterministic")
        for program in self.DRAW[::step(33)] + DIAGRAMS:
            self.assert_again(program)
        for program in SCENES[::step(18)]:
            self.assert_again(program, *SMALL, "--clamp", "vertex", "--linear-light",
                              "--show-clipped", "--full", "--terms", "diffuse,specular,0")
            self.assert_again(program, *SMALL, "--error", "2")
            if LONG:
                self.assert_again(program, *SMALL, "--lighting", "off")

    @in_long_form
    def test_a_programs_own_options_are_said(self):
        for program in SCENES[::step(12)]:
            values = self.values(program)
            self.assert_again(program, *SMALL, *(f"--{name}={value}" for name, value in values))
            for name, value in values[::3 * step(15)]:
                words = self.assert_again(program, *SMALL, f"--{name}={value}")
                if words[2:]:  # the one that was given
                    self.assertEqual(words[2:], ["--" + name, value])

    @in_long_form
    @unittest.skipUnless(os.path.exists(MODULE), "without OpenImageIO")
    def test_exr_and_tiff_say_it_too(self):
        for number, suffix in enumerate(("exr", "tif", "tiff")):
            for program in (self.DRAW + DIAGRAMS)[number::3]:
                self.assert_again(program, *SMALL, "-t", "1.1", suffix=suffix)
            self.assert_again("Materials", *SMALL, "--material", "gold", "--alpha", suffix=suffix)

    @in_long_form
    def test_shaders_and_backends_are_said(self):
        folder = self.path("my shaders'")
        shutil.copytree(os.path.join(SOURCE, "shaders/lecture"), folder)
        self.assert_again("LightedCube", *SMALL, "--shaders", folder)
        words = self.assert_again("LightedCube", *SMALL,
                                  environment={"LIGHTING_SHADERS": folder})
        self.assertIn(folder, words)
        if self.run_it(*SMALL, "-b", "osmesa", "-o", "-").returncode == 0:
            for more in ({}, {"environment": {"LIGHTING_BACKEND": "osmesa"}}):
                words = self.assert_again("LightedCube", *SMALL, "-b", "osmesa", **more)
                self.assertIn("osmesa", words)

    @in_long_form
    def test_pictures_of_a_gallery_and_of_frames_say_it(self):
        self.good(*SMALL, "-t", "0.3", "-o", "all", program="gallery")
        self.good(*SMALL, "-n", "3", "--fps", "7", "-o", "f%d.png", program="LightedCube_animation")
        for path, program in (("all/Materials.png", "Materials"), ("all/LightedCube.png",
                              "LightedCube"), ("f2.png", "LightedCube_animation")):
            name, *words = self.command(self.read(path))
            self.assertEqual(name, program)
            self.assertTrue(self.good(*words, "-o", "-", program=program) == self.read(path))

    @in_long_form
    @unittest.skipUnless(os.path.exists(MODULE), "without OpenImageIO")
    def test_every_format_has_the_same_bytes_in_every_environment(self):
        """What the clock says changes between the first picture of each format and its last."""
        environments = (
            {}, {"TZ": "Asia/Tokyo", "LC_ALL": "C", "LP_NUM_THREADS": "0"},
            {"TZ": "America/Lima", "LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8",
             "LP_NUM_THREADS": "1", "HOME": "/nonexistent"},
            *(({**self.decimal_comma(), "LP_NUM_THREADS": "2", "OPENIMAGEIO_THREADS": "1"},) if LONG else ()))
        extra = () if LONG else environments[1:2]
        films = self.FILMS if shutil.which("ffmpeg") else ("gif",)
        draws = ([(suffix, "LightedCube", (*SMALL, "-t", "0.5"))
                  for suffix in (self.FORMATS if LONG else ("png", "exr", "tif", "webp", "dpx"))] +
                 [(suffix, "LightedCube_animation", ("-s", "64x48", "-n", "12"))
                  for suffix in films])
        first = {}
        environments, draws = environments[::step(9)] + extra, draws[::step(6)]
        for number, environment in enumerate(environments):
            folder = self.path(f"folder {number}")
            os.mkdir(folder)
            time.sleep(1.1 if number == 1 else 0)  # seconds are what dates in files count
            core = {number % os.cpu_count()} if number % 2 else None
            for suffix, program, arguments in draws:
                name = f"{program}.{suffix}"
                self.good(*arguments, "-o", name, program=program, cwd=folder,
                          environment=environment,
                          preexec_fn=core and (lambda: os.sched_setaffinity(0, core)))
                with open(os.path.join(folder, name), "rb") as file:
                    data = file.read()
                with self.subTest(name=name, environment=environment):
                    self.assertTrue(first.setdefault(name, data) == data)
        for name, data in first.items():
            self.assertNotIn(time.strftime("%Y:%m").encode(), data, name)

    # What --deterministic sets, so that an emulated program does not start itself again, which
    # would be on the real processor.
    LEAST = {"GALLIUM_OVERRIDE_CPU_CAPS": "sse4.1", "LP_NATIVE_VECTOR_WIDTH": "128",
             "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}

    @in_long_form
    def test_deterministic_caps_the_processor(self):
        draw = ("-s", "90x60", "--deterministic", "-o", "-")
        picture = self.good(*draw, program="PhongBlinn")
        renderer = Png(picture).texts["Driver"]
        if "llvmpipe" in renderer:
            self.assertIn("128 bits", renderer)
        for environment in (self.LEAST, {"GALLIUM_OVERRIDE_CPU_CAPS": "nosse"},
                            {"LP_NATIVE_VECTOR_WIDTH": "512", "GLIBC_TUNABLES": ""}):
            self.assertTrue(self.good(*draw, program="PhongBlinn", environment=environment) ==
                            picture, environment)
        self.good("LightedCube", *draw[:3], "-o", "g", "Materials", program="gallery")
        self.assertEqual(set(os.listdir(self.path("g"))),
                         {"LightedCube.png", "Materials.png", "index.html"})
        words = self.good("-s", "9x9", "-t", "1", "-o", "-", "--deterministic", "--compress", "0")
        self.assertIn("--deterministic", self.command(words))

    @unittest.skipUnless(LONG and shutil.which("qemu-x86_64") and os.uname().machine == "x86_64",
                         "the long form, on x86-64 with qemu-user")
    def test_deterministic_pictures_are_those_of_other_processors(self):
        """An emulated one compiles the shaders: every program on two, every processor once."""
        processors = ("Penryn", "Nehalem", "SandyBridge", "Haswell", "EPYC", "max")
        for number, program in enumerate(("PhongBlinn", "PointLightedSphere_perFragment", "Materials")):
            draw = ("-s", "90x60", "--deterministic", "-o", "-")
            picture = self.good(*draw, program=program)
            for processor in processors[number::3]:
                result = subprocess.run(
                    ["qemu-x86_64", "-cpu", processor, os.path.join(EXAMPLES, program), *draw],
                    env={**os.environ, **self.LEAST, "LP_NUM_THREADS": "0"}, capture_output=True)
                self.assertTrue(result.stdout == picture, (program, processor, result.stderr))

    @in_long_form
    @unittest.skipUnless(os.path.exists(MODULE), "without OpenImageIO")
    def test_a_date_is_that_of_source_date_epoch(self):
        for suffix in ("exr", "tif"):
            for epoch, date in (("86399", b"1970:01:01 23:59:59"), (None, b"1970:01:01 00:00:00"),
                                ("4102444800", b"2100:01:01 00:00:00")):
                environment = {"SOURCE_DATE_EPOCH": epoch} if epoch else {}
                self.good(*SMALL, "-o", "a." + suffix, environment=environment)
                self.assertIn(date, self.read("a." + suffix))
            os.remove(self.path("a." + suffix))
            for epoch in ("today", "", "-1", "253402300800", "1e3"):
                self.refused(1, "SOURCE_DATE_EPOCH=" + epoch, *SMALL, "-o", "a." + suffix,
                             environment={"SOURCE_DATE_EPOCH": epoch})


def run_tests():
    """The test's exit code; says what was not checked, which `tests/run` repeats."""
    test = unittest.main(argv=[sys.argv[0], *sys.argv[3:]], exit=False).result
    failed = {case.id().split(" ")[0] for case, _ in test.failures + test.errors}
    failed |= {case.id() for case in test.unexpectedSuccesses}
    for case, reason in test.skipped:
        print(f"not checked: {case.id()}: {reason}")
    print(f"{test.testsRun - len(failed) - len(test.skipped)} passed, {len(failed)} failed")
    return 1 if failed else 0


def main():
    if subprocess.run([os.path.join(EXAMPLES, "LightedCube"), "-s", "1x1", "-o", "-"], capture_output=True).returncode:
        print("skipped: this machine cannot draw; LightedCube --doctor says why")
        return 77
    return run_tests()


if __name__ == "__main__":
    sys.exit(main())
