#!/usr/bin/env python3
"""Animations: pictures and times of every format, streams, and no partial files after an early end.

usage: animation_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

Reads formats with ffmpeg, and animated WebP with libwebpdemux, because ffmpeg does not. Signals
arrive at random moments, from a printed seed (LIGHTING_TEST_SEED sets it). Exit code: 77 without a driver
or one of these tools.
"""
import ctypes
import ctypes.util
import math
import os
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from fractions import Fraction

import command_line_test as base

PROGRAM = "PointLightedCube_animation"
FILES = ("gif", "webp", "apng", "mp4", "webm")
BY_FFMPEG = ("webp", "apng", "mp4", "webm")
RATES = ("30", "29.97", "0.5", "1000")
SEED = base.seed()


def tool(*arguments, **more):
    done = subprocess.run(arguments, capture_output=True, timeout=base.PATIENCE, check=False, **more)
    assert done.returncode == 0 and not done.stderr, (arguments, done.stderr)
    return done.stdout


def decode(path, size, pixels="rgb24", codec=()):
    """The pictures as ffmpeg reads them, each its bytes."""
    raw = tool("ffmpeg", "-v", "error", *codec, "-i", path, "-fps_mode", "passthrough", "-f",
               "rawvideo", "-pix_fmt", pixels, "-")
    assert len(raw) % size == 0, (path, len(raw), size)
    return [raw[at:at + size] for at in range(0, len(raw), size)]


def times(path):
    """When each picture begins, and for how long the last one stands, in seconds."""
    rows = tool("ffprobe", "-v", "error", "-of", "csv=p=0", "-show_entries",
                "packet=pts,duration:stream=time_base", path).decode().split()
    unit = Fraction(rows.pop())
    shown = sorted((int(pts), duration) for pts, duration, *_ in (row.split(",") for row in rows))
    last = shown[-1][1]
    return [pts * unit for pts, _ in shown], None if last == "N/A" else int(last) * unit


class WebP:
    """An animated WebP, as libwebpdemux plays it (webp/demux.h)."""

    class Data(ctypes.Structure):
        _fields_ = [("bytes", ctypes.c_char_p), ("size", ctypes.c_size_t)]

    class Info(ctypes.Structure):
        _fields_ = [(name, ctypes.c_uint32) for name in (
            "width", "height", "loops", "background", "frames", "p0", "p1", "p2", "p3")]

    LIBRARY = ctypes.util.find_library("webpdemux")

    def __init__(self, path):
        library = ctypes.CDLL(self.LIBRARY)
        library.WebPAnimDecoderNewInternal.restype = ctypes.c_void_p
        with open(path, "rb") as file:
            content = file.read()
        data, info = self.Data(content, len(content)), self.Info()
        decoder = ctypes.c_void_p(library.WebPAnimDecoderNewInternal(
            ctypes.byref(data), None, 0x107))
        assert decoder and library.WebPAnimDecoderGetInfo(decoder, ctypes.byref(info)), path
        self.width, self.height, self.loops = info.width, info.height, info.loops
        self.frames, self.ends = [], []
        rgba, end = ctypes.c_void_p(), ctypes.c_int()
        while library.WebPAnimDecoderHasMoreFrames(decoder):
            assert library.WebPAnimDecoderGetNext(decoder, ctypes.byref(rgba), ctypes.byref(end))
            self.frames.append(ctypes.string_at(rgba, 4 * info.width * info.height))
            self.ends.append(Fraction(end.value, 1000))
        library.WebPAnimDecoderDelete(decoder)

    def at(self, moment):
        """The picture shown at this time. The library merges equal pictures, and then does not know
        how long the last one is shown."""
        shown = (frame for frame, end in zip(self.frames, self.ends) if moment < end)
        return next(shown, self.frames[-1])


def apng_chunks(data):
    at, found = 8, []
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        found.append((kind, data[at + 8:at + 8 + length]))
        at += 12 + length
    return found


def nearest(value, unit):
    """`value` to the nearest multiple of 1 / `unit`."""
    return Fraction(math.floor(value * unit + Fraction(1, 2)), unit)


def rms(a, b):
    assert len(a) == len(b)
    return math.sqrt(sum((x - y)**2 for x, y in zip(a, b)) / len(a))


def luma(pixels):
    """ITU-R BT.709-6, section 3: 8 bits, 16 to 235."""
    return [16 + 219 * (0.2126 * r + 0.7152 * g + 0.0722 * b) / 255
            for r, g, b in zip(*[iter(pixels)] * 3)]


class Animations(base.Case):
    def draw(self, name, frames, *arguments, size=(40, 30), **more):
        return self.good("-s", "%dx%d" % size, "-n", str(frames), "-o", name, *arguments,
                         program=PROGRAM, **more)

    def start(self, *arguments, stderr=subprocess.PIPE, **more):
        return subprocess.Popen([os.path.join(base.EXAMPLES, PROGRAM), *arguments], cwd=self.folder,
                                stderr=stderr, **more)

    def numbered(self, frames, *arguments, size=(40, 30)):
        """The same pictures, one file each."""
        os.mkdir(self.path("png"))
        self.draw("png/%04d.png", frames, *arguments, size=size)
        pictures = [self.png("png/%04d.png" % i).pixels for i in range(frames)]
        shutil.rmtree(self.path("png"))
        return pictures


class Formats(Animations):
    def check_pixels(self, kind, name, wanted, size):
        count, (width, height) = len(wanted), size
        if kind == "webp":
            shown = WebP(self.path(name))
            for i, rgb in enumerate(wanted):
                frame = shown.at(Fraction(i, 10) + Fraction(1, 1000))
                self.assertEqual(bytes(c for k, c in enumerate(frame) if k % 4 != 3), rgb)
        elif kind in ("mp4", "webm"):
            odd = width % 2 or height % 2
            area, rows = width * height, ((width + 1) // 2) * ((height + 1) // 2)
            full = kind == "mp4" and odd
            shown = decode(self.path(name), area + 2 * (area if full else rows),
                           "yuv444p" if full else "yuv420p")
            self.assertEqual(len(shown), count)
            for yuv, rgb in zip(shown, wanted):
                # Visually lossless except near edges, which are everywhere in a picture this small.
                # With BT.601's matrix instead of BT.709's a red face would be off by 12 steps.
                self.assertLess(rms(yuv[:area], luma(rgb)), 3)
        else:
            shown = decode(self.path(name), 3 * width * height)
            self.assertEqual(len(shown), count)
            for got, rgb in zip(shown, wanted):
                colors = len({rgb[i:i + 3] for i in range(0, len(rgb), 3)})
                if kind == "gif" and colors > 256:
                    self.assertLess(rms(got, rgb), 1)
                else:
                    self.assertEqual(got, rgb)

    @base.in_long_form
    def test_a_gif_of_thousands_of_colors(self):
        """Of which each picture has 256; a cube of 6 levels per channel would be 15 steps off."""
        draw = "-s", "240x240", "-n", "2"
        for name in "a.gif", "%d.png":
            self.good(*draw, "-o", name, program="FourLights")
        for number, got in enumerate(decode(self.path("a.gif"), 3 * 240 * 240)):
            wanted = self.png(f"{number}.png").pixels
            self.assertGreater(len({wanted[i:i + 3] for i in range(0, len(wanted), 3)}), 5000)
            self.assertLess(rms(got, wanted), 3)

    def test_every_format_has_the_pictures(self):
        sizes = ((40, 30), 6), ((33, 17), 5), ((2, 1), 1), ((1, 1), 2)
        for size, count in sizes if base.LONG else sizes[1:2]:
            wanted = self.numbered(count, "-t", "0.5", "--fps", "10", size=size)
            for kind in FILES:
                if count == 1 and kind in ("gif", "webp"):
                    continue  # a single picture
                with self.subTest(kind=kind, size=size):
                    self.draw("a." + kind, count, "-t", "0.5", "--fps", "10", size=size)
                    self.check_pixels(kind, "a." + kind, wanted, size)

    @base.in_long_form
    def test_every_format_has_the_times(self):
        count = 40  # enough for a delay of 33 instead of 33 1/3 hundredths to add up
        for rate in RATES:
            exact = [i / Fraction(rate) for i in range(count + 1)]
            for kind in FILES:
                if (kind, rate) == ("gif", "1000"):
                    continue
                if (RATES.index(rate) + FILES.index(kind)) % base.step(6):
                    continue
                with self.subTest(kind=kind, rate=rate):
                    name = "a." + kind
                    self.draw(name, count, "--fps", rate, size=(8, 8))
                    unit = {"gif": 100, "webp": 1000, "webm": 1000}.get(kind)
                    wanted = [nearest(t, unit) if unit else t for t in exact]
                    if kind == "webp":
                        # The encoder merges equal pictures and adds their times.
                        ends = WebP(self.path(name)).ends
                        self.assertLessEqual(set(ends[:-1]), set(wanted))
                        # It does not know the last one's time, and uses the mean of the others.
                        self.assertLessEqual(abs(ends[-1] - exact[-1]), Fraction(2, 1000))
                        continue
                    if kind == "apng":
                        chunks = apng_chunks(self.read(name))
                        delays = [Fraction(*struct.unpack(">HH", body[20:24]))
                                  for what, body in chunks if what == b"fcTL"]
                        self.assertEqual(delays, [1 / Fraction(rate)] * count)
                        continue
                    begins, last = times(self.path(name))
                    self.assertEqual(begins, wanted[:-1])
                    if kind == "gif" or last and kind == "mp4":
                        self.assertEqual(begins[-1] + last, wanted[-1])

    @base.in_long_form
    def test_loops_are_endless(self):
        for kind in ("gif", "webp", "apng"):
            self.draw("a." + kind, 3)
        self.assertIn(b"!\xff\x0bNETSCAPE2.0\x03\x01\0\0\0", self.read("a.gif"))
        self.assertEqual(WebP(self.path("a.webp")).loops, 0)
        self.assertIn((b"acTL", struct.pack(">II", 3, 0)), apng_chunks(self.read("a.apng")))

    @base.in_long_form
    def test_alpha_is_kept_where_it_can_be(self):
        count, area = 4, 40 * 30
        wanted = self.numbered(count, "--alpha")
        self.assertTrue(any(0 < a < 255 or a == 0 for a in wanted[0][3::4]))
        for kind in ("webp", "apng"):
            self.draw("a." + kind, count, "--alpha")
        self.assertEqual(WebP(self.path("a.webp")).frames, wanted)
        self.assertEqual(decode(self.path("a.apng"), 4 * area, "rgba"), wanted)
        self.draw("a.webm", count, "--alpha")
        shown = decode(self.path("a.webm"), area * 5 // 2, "yuva420p", ("-c:v", "libvpx-vp9"))
        for yuva, rgba in zip(shown, wanted, strict=True):
            # Two values, and between them an edge that is coded as exactly as the colours.
            self.assertLess(rms(yuva[-area:], rgba[3::4]), 4)

    @base.in_long_form
    def test_an_animation_can_be_made_again(self):
        for kind in FILES:
            self.draw("a." + kind, 5)
            self.draw("b." + kind, 5)
            self.assertEqual(self.read("a." + kind), self.read("b." + kind), kind)

    @base.in_long_form
    def test_apng_is_compressed_as_told(self):
        for level in "09":
            self.draw(level + ".apng", 3, "--compress", level)
        self.assertLess(len(self.read("9.apng")), len(self.read("0.apng")) // 2)

    @base.in_long_form
    def test_one_picture_of_a_gif_or_webp_is_a_picture(self):
        for kind, start in (("gif", b"GIF89a"), ("webp", b"RIFF")):
            self.draw("a." + kind, 1)
            self.draw("b%d." + kind, 2)
            for name in ("a.", "b0.", "b1."):
                self.assertTrue(self.read(name + kind).startswith(start))
                self.assertEqual(len(decode(self.path(name + kind), 3600)), 1)
        self.draw("50%.gif", 2)
        self.assertEqual(len(decode(self.path("50%.gif"), 3600)), 2)

    @base.in_long_form
    def test_a_pipe_and_a_link_are_written_through(self):
        self.make("target.apng")
        os.symlink("target.apng", self.path("link.apng"))
        self.draw("link.apng", 3)
        self.assertTrue(os.path.islink(self.path("link.apng")))
        self.draw("file.mp4", 3)
        os.mkfifo(self.path("pipe.mp4"))
        with subprocess.Popen(["cat", "pipe.mp4"], cwd=self.folder,
                              stdout=subprocess.PIPE) as reader:
            self.draw("pipe.mp4", 3)
            self.assertEqual(reader.communicate(timeout=base.PATIENCE)[0], self.read("file.mp4"))
        self.draw("file.apng", 3)
        self.assertEqual(self.read("target.apng"), self.read("file.apng"))

    def test_usage_errors(self):
        self.make("a.gif")
        for said, *arguments in (
                ("gif has no alpha", "-n", "2", "-o", "a.gif", "--alpha"),
                ("mp4 has no alpha", "-o", "a.mp4", "--alpha"),
                ("y4m has no alpha", "-o", "-", "--format", "y4m", "--alpha"),
                ("rgb has no alpha", "-o", "-", "--format", "rgb", "--alpha"),
                ("gif has 0.001526 to 100", "-n", "2", "-o", "a.gif", "--fps", "100.1"),
                ("gif has 0.001526 to 100", "-n", "2", "-o", "a.gif", "--fps", "0.0015"),
                ("webp has 0.001 to 1000", "-n", "2", "-o", "a.webp", "--fps", "1001"),
                ("webm has 0.001 to 1000", "-o", "a.webm", "--fps", "1e6"),
                ("apng has 0.001 to 65535", "-o", "a.apng", "--fps", "65536"),
                ("webp has at most 16383", "-n", "2", "-o", "a.webp", "-s", "16384x1"),
                ("too large for ffmpeg", "-o", "a.mp4", "-s", "16384x16129"),
                ("png, y4m, rgb or json", "-o", "-", "--format", "gif"),
                ("to standard output", "-o", "a.gif", "--format", "y4m"),
                ("to standard output", "--format", "png"),
                ("format y4m or rgb", "-n", "2", "-o", "-", "--format", "png"),
                ("holds all the pictures", "-n", "2", "-o", "a%d.mp4"),
                ("a number in the name.*or a file", "-n", "2", "-o", "a.png")):
            self.refused(2, f"^{PROGRAM}: .*{said}", *arguments, program=PROGRAM)
        self.refused(2, "--format: ", "--format", "y4m", program="gallery")

    def test_unwritable_outputs_are_refused_before_drawing(self):
        os.mkdir(self.path("folder.mp4"))
        for kind in FILES:
            self.refused(1, "folder missing/ does not exist", "-n", "3", "-o", "missing/a." + kind)
        self.refused(1, "is a folder", "-o", "folder.mp4")


class Streams(Animations):
    def stream(self, kind, count, *arguments, size=(40, 30)):
        return self.draw("-", count, "--format", kind, *arguments, size=size)

    @base.in_long_form
    def test_rgb_is_the_pictures_and_nothing_else(self):
        for size, count in (((40, 30), 4), ((33, 17), 3), ((1, 1), 1)):
            self.assertEqual(self.stream("rgb", count, size=size),
                             b"".join(self.numbered(count, size=size)))

    def test_png_is_one_picture(self):
        self.draw("a.png", 1)
        self.assertEqual(self.stream("png", 1), self.read("a.png"))

    def y4m(self, data, size):
        """The header, and each picture in RGB: BT.601 backwards."""
        header, rest = data.split(b"\n", 1)
        area = size[0] * size[1]
        pictures = []
        while rest:
            assert rest.startswith(b"FRAME\n")
            planes = [rest[6 + i * area:6 + (i + 1) * area] for i in range(3)]
            rest = rest[6 + 3 * area:]
            picture = []
            for y, u, v in zip(*planes, strict=True):
                assert 16 <= y <= 235 and 16 <= u <= 240 and 16 <= v <= 240
                y, u, v = (y - 16) * 255 / 219, (u - 128) * 255 / 224, (v - 128) * 255 / 224
                r, b = y + 1.402 * v, y + 1.772 * u
                picture += [r, (y - 0.299 * r - 0.114 * b) / 0.587, b]
            pictures.append(picture)
        return header.decode(), pictures

    @base.in_long_form
    def test_y4m_is_what_it_says(self):
        for size, count in (((40, 30), 4), ((33, 17), 2), ((1, 1), 1)):
            wanted = self.numbered(count, size=size)
            data = self.stream("y4m", count, size=size)
            header, pictures = self.y4m(data, size)
            self.assertEqual(header, "YUV4MPEG2 W%d H%d F30:1 Ip A1:1 C444 XCOLORRANGE=LIMITED"
                             % size)
            for got, rgb in zip(pictures, wanted, strict=True):
                # Half a step of 219 in Y and half a step of 224 in Cb or Cr are at most
                # 0.582 + 1.772 * 0.569 = 1.59 of 255 in blue, and less in red and green.
                self.assertLessEqual(max(abs(a - b) for a, b in zip(got, rgb)), 1.6)
            self.make("a.y4m", data)
            shown = decode(self.path("a.y4m"), 3 * size[0] * size[1], "yuv444p")
            self.assertEqual(b"".join(b"FRAME\n" + frame for frame in shown),
                             data.split(b"\n", 1)[1])
            # ffmpeg's way back to RGB rounds once more, some of it in 8 bits.
            for got, rgb in zip(decode(self.path("a.y4m"), 3 * size[0] * size[1]), wanted):
                self.assertLessEqual(max(abs(a - b) for a, b in zip(got, rgb)), 4)
            begins, _ = times(self.path("a.y4m"))
            self.assertEqual(begins, [Fraction(i, 30) for i in range(count)])

    @base.in_long_form
    def test_rates_are_fractions(self):
        for given, said in (("29.97", "2997:100"), ("0.1", "1:10"), ("23.976", "2997:125"),
                            ("59.94005994005994", "60000:1001"), ("1000000", "1000000:1"),
                            ("0.001", "1:1000"), ("0.333333", "333333:1000000"), ("25", "25:1")):
            header = self.stream("y4m", 1, "--fps", given, size=(1, 1)).split(b"\n")[0].decode()
            self.assertIn(f" F{said} ", header, given)

    def test_a_terminal_is_refused(self):
        ours, theirs = base.terminal()
        self.addCleanup(os.close, ours)
        for kind in ("y4m", "rgb"):
            self.refused(2, "is a terminal", "-o", "-", "--format", kind, stdout=theirs)
        os.close(theirs)

    @base.in_long_form
    def test_a_reader_that_goes_away_ends_it_quietly(self):
        for kind in ("y4m", "rgb"):
            for size in (0, 1, 5000, 100000):
                with self.subTest(kind=kind, size=size):
                    reading, writing = os.pipe()
                    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
                    with self.start("-s", "40x30", "-n", "1000000", "-o", "-", "--format", kind,
                                    stdout=writing) as process:
                        os.close(writing)
                        while size > 0:
                            size -= len(os.read(reading, size))
                        os.close(reading)
                        # A million pictures would take minutes of processor time.
                        error = process.communicate(timeout=base.PATIENCE)[1]
                    self.assertEqual((process.returncode, error), (0, b""))
                    used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
                    self.assertLess(used, 50)
        self.assertEqual(self.everything(), {})

    @base.in_long_form
    def test_a_stream_that_does_not_arrive_is_a_failure(self):
        for kind in ("y4m", "rgb"):
            for shell in (">&-", ">/dev/full"):
                self.refused(1, "^LightedCube: standard output: cannot write: ", "-n", "3", "-o",
                             "-", "--format", kind, shell=shell)


class Encoders(Animations):
    def fake(self, script):
        os.makedirs(self.path("bin"), exist_ok=True)
        self.make("bin/ffmpeg", "#!/bin/sh\n" + script)
        os.chmod(self.path("bin/ffmpeg"), 0o755)
        return {"PATH": self.path("bin") + ":" + os.environ["PATH"]}

    @base.in_long_form
    def test_without_ffmpeg_one_line_names_the_package(self):
        self.make("a.mp4")
        for kind in BY_FFMPEG:
            self.refused(1, rf"a\.{kind}: ffmpeg, which writes \.{kind}, is missing; install the "
                         "package ffmpeg$", "-n", "3", "-o", "a." + kind,
                         environment={"PATH": self.path("empty")})
        # A format that does not need ffmpeg works without it.
        self.draw("a.gif", 3, environment={"PATH": self.path("empty")})
        self.draw("-", 3, "--format", "y4m", environment={"PATH": self.path("empty")})
        text = self.good("--doctor", environment={"PATH": self.path("empty")}).decode()
        self.assertRegex(text, r"ffmpeg +missing, gives .*: install the package ffmpeg\n")

    @base.in_long_form
    def test_an_ffmpeg_that_fails_is_said_in_one_line(self):
        for script, said in (
                ("head -c 20000 >/dev/null; echo before >&2; echo the last line >&2; exit 1",
                 "cannot write: ffmpeg: the last line$"),
                ("cat >/dev/null; echo too late >&2; exit 1", "ffmpeg: too late$"),
                ("cat >/dev/null; echo the reason >&2; echo 'in stream 0:0 -- ' >&2; exit 1",
                 "ffmpeg: the reason$"),
                ("cat >/dev/null; echo not even 1 >&2", "ffmpeg: not even 1$"),
                ("exit 3", "ffmpeg ended with status 3, and gave no reason$"),
                ("head -c 20000 >/dev/null", "ffmpeg ended before the last picture$"),
                ("cat >/dev/null", "ffmpeg wrote nothing$"),
                ("kill -TERM $$", "ffmpeg was ended by a signal: Terminated$"),
                ("head -c 20000 >/dev/null; printf 'a\\n\\001\\r\\n\\n' >&2; exit 1", "ffmpeg: a$"),
                ("head -c 20000 >/dev/null; seq 100000 >&2; exit 1", "ffmpeg: 100000$"),
                ("echo data >/proc/self/fd/3; echo x: No space left on device >&2; exit 1",
                 "cannot write: No space left on device; make room and run again$"),
                # It ignores no signal, except two of the C library.
                ("grep SigIgn /proc/self/status >&2; exit 1", "SigIgn: 0{7}[01][08]0{7}$")):
            environment = self.fake(script + "\n")
            self.make("a.webm")
            with self.subTest(script=script):
                self.refused(1, "^LightedCube: a.webm: .*" + said, "-n", "20", "-o", "a.webm",
                             "-s", "100x100", environment=environment)

    @base.in_long_form
    def test_a_real_refusal_is_said_in_one_line(self):
        environment = self.fake(f"exec {shutil.which('ffmpeg')} -i no-such-file a.webm\n")
        self.refused(1, r"^LightedCube: a\.webp: cannot write: ffmpeg: .*: No such file",
                     "-n", "2", "-o", "a.webp", environment=environment)

    def children(self, process):
        found = []
        for entry in os.listdir("/proc"):
            try:
                with open(f"/proc/{entry}/stat", encoding="latin-1") as file:
                    if int(file.read().rsplit(")", 1)[1].split()[1]) == process.pid:
                        found.append(int(entry))
            except (OSError, ValueError):
                pass
        return found

    @base.in_long_form
    def test_ffmpeg_does_not_outlive_the_program(self):
        for number in (signal.SIGTERM, signal.SIGKILL):
            with self.start("-n", "1000000", "-o", "a.mp4") as process:
                children = []
                while not children and process.poll() is None:
                    children = self.children(process)
                process.send_signal(number)
                self.assertEqual(process.wait(base.PATIENCE), -number)
            self.assertEqual(len(children), 1)
            # The encoder reaches the end of its input, finishes its nameless file, and exits.
            while os.path.exists(f"/proc/{children[0]}"):
                with open(f"/proc/{children[0]}/stat", encoding="latin-1") as file:
                    if file.read().rsplit(")", 1)[1].split()[0] == "Z":
                        break  # nobody's but init's to wait for
                time.sleep(0.01)
            self.assertEqual(self.everything(), {})


class Interrupted(Animations):
    def whole(self, name, count):
        if name.endswith(".png"):
            base.Png(self.read(name))
        else:
            self.assertEqual(len(decode(self.path(name), 3 * 48 * 48)), count, name)

    def test_ctrl_c_leaves_whole_files_alone(self):
        chance = random.Random(SEED)
        for name, count in (("a.gif", 12), ("a.mp4", 12), ("a%02d.png", 30), ("a.png", 1)):
            arguments = ("-s", "48x48", "-n", str(count), "-o", name)
            started = time.monotonic()
            self.good(*arguments, program=PROGRAM)
            took = time.monotonic() - started
            ended = set()
            for attempt in range(20):
                # Old files stay, or are replaced by complete ones.
                for old in os.listdir(self.folder):
                    if attempt % 2:
                        os.remove(self.path(old))
                with self.start(*arguments, stdout=subprocess.PIPE,
                                start_new_session=True) as process:
                    time.sleep(chance.uniform(0, 1.1 * took))
                    try:
                        os.killpg(process.pid, signal.SIGINT)  # as a terminal does it
                    except ProcessLookupError:
                        pass
                    said = process.communicate(timeout=base.PATIENCE)
                self.assertIn(process.returncode, (0, -signal.SIGINT))
                self.assertEqual(said, (b"", b""))
                ended.add(process.returncode)
                if -signal.SIGINT not in ended:
                    took /= 1.5  # less busy now than when it was measured
                for left in os.listdir(self.folder):
                    self.assertFalse(left.startswith("."), (name, left))
                    self.whole(left, count)
                if attempt + 1 >= 20 // base.step(12) and -signal.SIGINT in ended:
                    break
            self.assertIn(-signal.SIGINT, ended, name)
            for left in os.listdir(self.folder):
                os.remove(self.path(left))

    @base.in_long_form
    def test_ignored_signals_stay_ignored(self):
        """As under nohup and in a shell's background."""
        for number in (signal.SIGINT, signal.SIGHUP):
            with self.start("-s", "48x48", "-n", "60", "-o", "a.gif", stderr=None,
                            preexec_fn=lambda n=number: signal.signal(n, signal.SIG_IGN)) as process:
                time.sleep(0.05)
                process.send_signal(number)
                self.assertEqual(process.wait(base.PATIENCE), 0)
            self.whole("a.gif", 60)


class FullDisks(Animations):
    def limited(self, size, name, *arguments):
        self.says(1, rf"^{PROGRAM}: {name}: cannot write: File too large\n$", *arguments,
                  program=PROGRAM, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                                         (size, size)))

    def test_whole_pictures_stay_and_the_broken_one_is_gone(self):
        arguments = ("-s", "64x64", "-n", "12", "--fps", "2", "-o", "a%02d.png")
        self.good(*arguments, program=PROGRAM)
        before = self.everything()
        sizes = [len(before[path]) for path in sorted(before)]
        limit = max(sizes) - 1
        shutil.rmtree(self.folder)
        os.mkdir(self.folder)
        self.limited(limit, r"a\d\d\.png", *arguments)
        after = self.everything()
        self.assertGreater(len(after), 0)
        self.assertLess(len(after), 12)
        for path, content in after.items():
            self.assertEqual(content, before[path])

    @base.in_long_form
    def test_of_an_animation_nothing_stays(self):
        for i, kind in enumerate(FILES):
            for there in (False, True) if base.LONG else (i % 2 > 0,):
                if there:
                    self.make("a." + kind)
                before = self.everything()
                self.limited(2000, rf"a\.{kind}", "-s", "100x100", "-n", "20", "--compress", "0",
                             "-o", "a." + kind)
                self.assertEqual(self.everything(), before)

    @base.in_long_form
    def test_a_disk_that_is_full_before_the_end(self):
        """A file system with fewer pages than the animation has, and with just enough."""
        script = ('mount -t tmpfs -o size=$1k small small || exit 99; shift\n'
                  'echo old > small/old; "$@"; code=$?\n'
                  'ls -A small; cp small/a.* kept 2>/dev/null; exit $code')
        os.mkdir(self.path("small"))
        enter = ["unshare", "-m"] if os.getuid() == 0 else ["unshare", "-rm"]
        for kind in FILES[::base.step(6)]:
            self.draw("a." + kind, 20, "--fps", "2", size=(96, 96))
            enough = (len(self.read("a." + kind)) + 4095) // 4096
            self.assertGreater(enough, 1, kind)
            os.remove(self.path("a." + kind))
            for pages in {enough // 2, enough - 1, enough}:
                result = subprocess.run(
                    [*enter, "sh", "-c", script, "sh", str(4 * pages + 4),  # one for the other file
                     os.path.join(base.EXAMPLES, PROGRAM), "-s", "96x96", "-n", "20", "--fps", "2",
                     "-o", "small/a." + kind], cwd=self.folder, capture_output=True,
                    timeout=base.PATIENCE)
                code, error = result.returncode, result.stderr.decode()
                if code in (99, 1) and "mount" in error + " unshare" and "LightedCube" not in error:
                    self.skipTest("this machine does not permit mounting a file system")
                if pages < enough:
                    self.assertEqual((code, result.stdout), (1, b"old\n"))
                    self.assertRegex(error, rf"^{PROGRAM}: small/a\.{kind}: cannot write: "
                                     "No space left on device; make room and run again\n$")
                else:
                    self.assertEqual((code, error), (0, ""), kind)
            os.rename(self.path("kept"), self.path("a." + kind))
            frames = WebP(self.path("a.webp")).frames if kind == "webp" else decode(
                self.path("a." + kind), 3 * 96 * 96)
            self.assertEqual(len(frames), 20, kind)


def main():
    if not shutil.which("ffmpeg") or not shutil.which("ffprobe") or not WebP.LIBRARY:
        print("skipped: needs the packages ffmpeg and libwebpdemux2")
        return 77
    return base.main()


if __name__ == "__main__":
    sys.exit(main())
