#!/usr/bin/env python3
"""The programs in a window: an X server of the test's own, real keys and a real pointer (xdotool);
the screen is read from the server's frame buffer.

usage: window_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

Waits have a deadline that only a defect reaches; no test depends on speed. Exit code: 77 without an
X server or a driver.
"""
import ctypes
import ctypes.util
import math
import os
import random
import re
import resource
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import command_line_test as base

DEADLINE = 240
SCREEN = 1024, 768
MOVING = "LightedCube_animation"
SCENE = "ShadingModels"
# Beside every window of the tests, because the server draws the pointer into its picture.
AWAY = SCREEN[0] - 5, SCREEN[1] - 5
PANEL = 356  # by which a window with a panel is wider
ERRORS = 136  # by which a window with errors is higher


def wait_for(condition, what, deadline=DEADLINE):
    """The first true value of `condition`; `what` names it in the message of a timeout."""
    end, pause = time.monotonic() + deadline, 0.03
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(pause)
        pause = min(1.3 * pause, 0.2)  # most conditions start a process
    raise AssertionError(f"timeout: waiting for {what}")


class Server:
    """An X server without a window manager."""

    def __init__(self, *options):
        self.folder = tempfile.mkdtemp(prefix="window_test-")
        reading, writing = os.pipe()
        size = f"{SCREEN[0]}x{SCREEN[1]}x24"
        self.process = subprocess.Popen(
            # -r: on a busy machine the release comes late, and the key would repeat.
            ["Xvfb", "-displayfd", str(writing), "-r", "-screen", "0", size, "-fbdir", self.folder,
             "-nolisten", "tcp", "-noreset", "-ac", *options],
            pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as file:
            number = file.readline().strip()
        if not number:
            raise unittest.SkipTest("no X server starts here")
        self.display = ":" + number
        self.environment = {**{key: value for key, value in os.environ.items()
                               if key not in ("WAYLAND_DISPLAY", "LIGHTING_SHADERS")},
                            "DISPLAY": self.display}

    def stop(self, how=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(how)
            self.process.wait(DEADLINE)
        shutil.rmtree(self.folder, ignore_errors=True)

    def xdotool(self, *arguments, check=True):
        words = ["xdotool", *(str(argument) for argument in arguments)]
        return subprocess.run(words, env=self.environment, check=check, timeout=DEADLINE, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout

    def pixels(self, x, y, width, height):
        """RGB of a part of the screen, from the file that the server draws into: an XWD header of
        32-bit numbers, the first of which is its size, and after 12 bytes for each colour of a
        table the pixels, B G R and one unused."""
        with open(os.path.join(self.folder, "Xvfb_screen0"), "rb") as file:
            data = file.read()
        header = struct.unpack(">25I", data[:100])
        start, stride = header[0] + 12 * header[19], header[12]
        assert header[4:6] == SCREEN and header[11] == 32, header
        rgb = bytearray()
        for row in range(y, y + height):
            at = start + row * stride + 4 * x
            line = bytearray(3 * width)
            for channel in range(3):
                line[channel::3] = data[at + 2 - channel:at + 4 * width:4]
            rgb += line
        return bytes(rgb)


class Manager:
    """What only a window manager does, through Xlib: says that a window is an icon, closes it. And titles,
    which are asked for hundreds of times, without a process for each."""

    class Message(ctypes.Structure):
        _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int),
                    ("display", ctypes.c_void_p), ("window", ctypes.c_ulong),
                    ("message", ctypes.c_ulong), ("format", ctypes.c_int),
                    ("data", ctypes.c_long * 5), ("pad", ctypes.c_long * 12)]

    def __init__(self, server):
        self.xlib = ctypes.CDLL("libX11.so.6")
        self.xlib.XOpenDisplay.restype = ctypes.c_void_p
        self.xlib.XInternAtom.restype = ctypes.c_ulong
        self.display = ctypes.c_void_p(self.xlib.XOpenDisplay(server.display.encode()))
        self.ignore = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(lambda *_: 0)
        self.xlib.XSetErrorHandler(self.ignore)  # of a window that is gone

    def atom(self, name):
        return ctypes.c_ulong(self.xlib.XInternAtom(self.display, name.encode(), 0))

    def finish(self):
        self.xlib.XCloseDisplay(self.display)

    def title(self, window):
        name = ctypes.c_char_p()
        self.xlib.XFetchName(self.display, ctypes.c_ulong(window), ctypes.byref(name))
        said = (name.value or b"").decode("latin-1")
        if name:
            self.xlib.XFree(name)
        return said

    def close(self, window):
        protocols, delete = self.atom("WM_PROTOCOLS"), self.atom("WM_DELETE_WINDOW")
        event = self.Message(type=33, window=window, message=protocols.value, format=32)
        event.data[0] = delete.value
        self.xlib.XSendEvent(self.display, ctypes.c_ulong(window), 0, ctypes.c_long(0),
                             ctypes.byref(event))
        self.xlib.XFlush(self.display)

    def set_icon(self, window, icon):
        state = self.atom("WM_STATE")
        values = (ctypes.c_ulong * 2)(3 if icon else 1, 0)  # IconicState, NormalState
        self.xlib.XChangeProperty(self.display, ctypes.c_ulong(window), state, state, 32, 0, values,
                                  2)
        change = self.xlib.XUnmapWindow if icon else self.xlib.XMapWindow
        change(self.display, ctypes.c_ulong(window))
        self.xlib.XFlush(self.display)


class Shown:
    """A program in its window."""

    def __init__(self, case, *arguments, program=MOVING, environment=None, prefix=(), **more):
        self.case, self.server, self.program = case, case.server, program
        self.errors = case.path(f"errors of {id(self)}")
        with open(self.errors, "wb") as errors:
            self.process = subprocess.Popen(
                [*prefix, os.path.join(base.EXAMPLES, program), *arguments], cwd=case.folder,
                env={**self.server.environment, **(environment or {})}, stdout=subprocess.DEVNULL,
                stderr=errors, **more)
        self.ended = False
        case.addCleanup(self.kill)
        # Its title says that it draws; before that it may be there without a picture.
        self.window = wait_for(self.find, "a window")
        wait_for(lambda: "frames per second" in self.title(), "frames")
        self.server.xdotool("windowfocus", "--sync", self.window, "mousemove", *AWAY)
        case.addCleanup(lambda: self.ended or self.leave())

    def find(self):
        if self.process.poll() is not None:
            raise AssertionError(f"{self.program} has ended: {self.said()}")
        found = self.server.xdotool("search", "--all", "--onlyvisible", "--pid", self.process.pid,
                                    "--class", "^lighting$", check=False)
        return int(found.split()[0]) if found else None

    def kill(self):
        self.process.kill()
        self.process.wait()

    def said(self):
        with open(self.errors, encoding="utf-8") as file:
            return file.read()

    def title(self):
        if hasattr(self.case, "manager"):
            return self.case.manager.title(self.window)
        return self.server.xdotool("getwindowname", self.window, check=False).strip()

    def place(self):
        text = self.server.xdotool("getwindowgeometry", "--shell", self.window)
        values = dict(line.split("=") for line in text.split())
        return tuple(int(values[name]) for name in ("X", "Y", "WIDTH", "HEIGHT"))

    def key(self, *keys):
        self.server.xdotool("key", *keys)

    def pause(self):
        self.key("space")
        wait_for(lambda: self.title().endswith("paused"), "a pause")

    def save(self, *keys):
        """Its picture, which the key s has it save, alone or among others."""
        before = self.said()
        self.key(*(keys or "s"))
        said = wait_for(lambda: self.said()[len(before):].endswith("\n") and self.said(),
                        "a saved picture")[len(before):]
        found = re.fullmatch(rf"{self.program}: saved (.*); the same without a window: (.*)\n", said)
        self.case.assertTrue(found, said)
        picture = self.case.png(found[1])
        picture.command = shlex.split(found[2])
        return picture

    def resize(self, width, height):
        self.server.xdotool("windowsize", self.window, width, height)

    def drag(self, *places):
        """The left button goes down at the first and up at the last."""
        steps = ["mousemove", *places[0], "mousedown", 1]
        for place in places[1:]:
            steps += ["mousemove", *place]
        self.server.xdotool(*steps, "mouseup", 1, "mousemove", *AWAY)

    def click(self, x, y):
        """A frame, with a saved picture, lies between it and the pointer's leaving."""
        self.server.xdotool("mousemove", x, y, "click", 1)
        self.save()
        self.server.xdotool("mousemove", *AWAY)

    def open_panel(self, width, height):
        """Beside a picture of this size; pictures are saved when it is in its place."""
        self.key("p")
        wait_for(lambda: self.place()[2:] == (width + PANEL, height), "a wider window")
        for _ in range(3):
            self.save()

    def ends(self, code, said=""):
        self.ended = True
        self.case.assertEqual(self.process.wait(DEADLINE), code, self.said())
        if said is None:
            return
        if isinstance(said, str):
            self.case.assertEqual(self.said(), said)
        else:
            self.case.assertRegex(self.said(), said)

    def leave(self):
        """Escape ends it without a further message; also at the end of a test."""
        before = self.said()
        self.key("Escape")
        self.ends(0, before)


CAMERA = 2, 1, 3  # the eye of ShadingModels, which looks at the origin


def pixel_of(point, width, height):
    """Where the camera of ShadingModels sees a point: 50 degrees high, or wide if that is less."""
    length = math.hypot(*CAMERA)
    back = [part / length for part in CAMERA]
    right = [part / math.hypot(back[2], back[0]) for part in (back[2], 0, -back[0])]
    up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
          back[0] * right[1] - back[1] * right[0]]
    x, y, z = (sum(a * b for a, b in zip(point, axis)) for axis in (right, up, back))
    scale = min(width, height) / 2 / math.tan(math.radians(25)) / (length - z)
    return round(width / 2 + x * scale), round(height / 2 - y * scale)


def crop(pixels, stride, place):
    x, y, width, height = place
    return b"".join(pixels[3 * (stride * row + x):][:3 * width] for row in range(y, y + height))


def seconds_of(picture):
    return float(picture.texts["Time"].removesuffix(" s"))


def orbit_of(picture):
    """Azimuth, elevation and distance in its command; None where the camera is as it was."""
    if "--orbit" not in picture.command:
        return None
    numbers = picture.command[picture.command.index("--orbit") + 1].split(",")
    return tuple(float(number) for number in (*numbers, "1")[:3])


class Case(base.Case):
    @classmethod
    def setUpClass(cls):
        cls.server = Server()
        cls.addClassCleanup(cls.server.stop)

    def setUp(self):
        super().setUp()
        self.manager = Manager(self.server)
        self.addCleanup(self.manager.finish)

    def show(self, *arguments, paused=False, **more):
        shown = Shown(self, "--window", *arguments, **more)
        if paused:
            shown.pause()
        return shown

    def assert_headless(self, picture, program, *arguments):
        """The picture is, to the last bit, the one that the command said with it draws headless."""
        name, *command = picture.command
        self.assertEqual(name, os.path.join(base.EXAMPLES, program))
        self.good(*command, *arguments, "-o", "headless.png", program=program)
        headless = self.png("headless.png")
        self.assertTrue(picture.pixels == headless.pixels, f"{program} {command}")
        # The window's driver may be another one, and the command has more options here.
        self.assertEqual({**picture.texts, "Driver": "", "Command": ""},
                         {**headless.texts, "Driver": "", "Command": ""})
        os.remove(self.path("headless.png"))

    def visible(self, shown):
        """Of its window, as the screen shows it."""
        x, y, width, height = shown.place()
        return self.server.pixels(x, y, min(width, SCREEN[0] - x), min(height, SCREEN[1] - y))

    def assert_shown(self, shown):
        """The screen, the saved and the headless picture are the same to the last bit. The screen
        comes first, because it later shows that a picture was saved."""
        shown.key("x")  # does nothing, but that an older notice has been read
        x, y, width, height = shown.place()
        screen = wait_for(lambda: self.still(shown), "a picture that stands still")
        picture = shown.save()
        if (picture.width, picture.height) != (width, height):
            picture = shown.save()  # the key overtook the size
        self.assertEqual((picture.width, picture.height), (width, height))
        visible = b"".join(picture.pixels[3 * width * row:][:3 * min(width, SCREEN[0] - x)]
                           for row in range(min(height, SCREEN[1] - y)))
        if screen != visible:
            wait_for(lambda: self.visible(shown) == visible,
                     f"the screen to show the {width}x{height} picture")
        self.assert_headless(picture, shown.program)
        return picture

    def still(self, shown):
        before = self.visible(shown)
        time.sleep(0.05)
        return before if before == self.visible(shown) else None

    def assert_nothing_half_written(self):
        """Whole pictures, and no other file."""
        for name in os.listdir(self.folder):
            if name.endswith(".png"):
                self.png(name)
            else:
                self.assertTrue(name.startswith("errors of"), name)


class Pictures(Case):
    @base.in_long_form
    def test_every_lecture_program_shows_and_saves_what_it_draws_headless(self):
        for program in base.PROGRAMS[::base.step(6)]:
            with self.subTest(program=program):
                shown = self.show("-s", "120x90", program=program, paused=True)
                self.assert_shown(shown)
                shown.leave()

    @base.in_long_form
    def test_scenes_show_and_save_what_they_draw_headless(self):
        for program in SCENE, "ShininessRow", "PhongBlinn":
            with self.subTest(program=program):
                shown = self.show("-s", "240x180", program=program, paused=True)
                self.assert_shown(shown)
                shown.leave()

    @base.in_long_form
    @unittest.skipUnless(base.DIAGRAMS, "no cairo")
    def test_a_diagram_shows_and_saves_what_it_draws_headless(self):
        for arguments in (), ("--figure", "rays"), ("--light", "100", "--rays", "radiating"):
            with self.subTest(arguments=arguments):
                shown = self.show("-s", "240x180", *arguments, program="Vectors", paused=True)
                self.assert_shown(shown)
                shown.resize(300, 120)
                self.assert_shown(shown)
                shown.leave()

    @base.in_long_form
    def test_pages_are_turned(self):
        shown = self.show("-s", "320x240", program="lessons", paused=True)

        def lesson(picture):
            command = picture.command
            return command[command.index("--lesson") + 1] if "--lesson" in command else "first"

        for keys, name in (((), "first"), (("Next",), "LightedCube_animation"),
                           (("Prior", "Prior"), "first"), (("Next", "Next"), "LightedCube_ambient"),
                           (("Next",) * 12, "PointLightedSphere_perFragment"),
                           (("Prior",), "PointLightedSphere")):
            shown.key(*keys) if keys else None
            picture = wait_for(lambda: (p := shown.save()) and lesson(p) == name and p, name)
            self.assert_headless(picture, "lessons")
        self.assert_shown(shown)
        shown.key("r")
        wait_for(lambda: lesson(shown.save()) == "first", "the first again")

    @unittest.skipUnless(base.DIAGRAMS, "no cairo")
    @base.in_long_form
    def test_a_diagram_is_saved_as_svg(self):
        shown = self.show("-s", "240x180", "--light", "-30", "-o", "a.svg", program="Vectors")
        for _ in range(2):
            shown.key("s")
            wait_for(lambda: os.path.exists(self.path("a.svg")), "a.svg")
            self.good("-s", "240x180", "--light", "-30", "-o", "b.svg", program="Vectors")
            self.assertEqual(self.read("a.svg"), self.read("b.svg"))
            os.remove(self.path("a.svg"))
        shown.leave()

    @base.in_long_form
    def test_options_hold_in_a_window(self):
        for arguments in (("--samples", "4"), ("--precision", "highp"), ("-t", "-3"),
                          ("--orbit", "30,20,0.7")):
            with self.subTest(arguments=arguments):
                shown = self.show("-s", "150x150", *arguments, paused=True)
                self.assert_shown(shown)
                shown.leave()

    @base.in_long_form
    def test_a_saved_picture_has_the_name_that_was_asked_for(self):
        shown = self.show("-s", "50x50")
        for _ in range(2):
            shown.save()
        shown.leave()
        self.assertEqual(re.findall(r"saved (.*?);", shown.said()),
                         [f"{MOVING}0001.png", f"{MOVING}0002.png"])
        shown = self.show("-s", "50x50", "-o", "turn%03d.png")
        self.make("turn001.png")
        shown.save()
        shown.leave()
        self.assertIn("saved turn002.png;", shown.said())
        self.assertEqual(self.read("turn001.png"), b"old")
        shown = self.show("-s", "50x50", "-o", "one.png")
        first, second = shown.save(), shown.save()
        shown.leave()
        self.assertGreater(seconds_of(second), seconds_of(first))
        self.assertEqual(self.png("one.png").texts, second.texts)

    @base.in_long_form
    def test_a_window_draws_what_other_backends_draw(self):
        for name, environment, arguments in (
                ("egl", {}, ()), ("given", {}, ("--backend", "window")),
                ("default", {"LIGHTING_BACKEND": "window"}, ())):
            self.good("-s", "40x40", "-o", name, *arguments, program="gallery",
                      environment={**self.server.environment, **environment})
        for name in os.listdir(self.path("egl")):
            if name.endswith(".png"):
                pictures = [self.png(f"{folder}/{name}").pixels
                            for folder in ("egl", "given", "default")]
                self.assertTrue(pictures[0] == pictures[1] == pictures[2], name)

    @base.in_long_form
    def test_the_environment_opens_a_window_too(self):
        shown = Shown(self, "-s", "60x40", environment={"LIGHTING_BACKEND": "window"})
        shown.pause()
        self.assert_headless(shown.save(), MOVING)


class Keys(Case):
    @base.in_long_form
    def test_the_title_has_the_name_and_the_frames_per_second(self):
        shown = self.show()
        # At first the pointer may still be over it, and the title tells of a pixel.
        wait_for(lambda: re.fullmatch(rf"{MOVING}, \d+ frames per second", shown.title()), "the name and the rate")
        shown.pause()
        self.assertEqual(shown.title(), f"{MOVING}, paused")
        shown.key("space")
        wait_for(lambda: "paused" not in shown.title(), "time to run")

    def test_time_runs_as_the_clock_does(self):
        """Each moment saved lies between those before its key was pressed and after its file was
        there, on a clock that began with the first of them."""
        shown = self.show("-t", "100", "-s", "60x60")
        moments = []
        for _ in range(4):
            before = time.monotonic()
            drawn = seconds_of(shown.save())
            moments.append((before, drawn, time.monotonic()))
            time.sleep(0.2)
        shown.leave()
        self.assertGreater(moments[0][1], 100)
        for first in moments:
            for second in moments:
                if second[0] > first[0]:
                    elapsed = second[1] - first[1]
                    # The time drawn is in whole milliseconds.
                    self.assertGreaterEqual(elapsed, second[0] - first[2] - 0.001)
                    self.assertLessEqual(elapsed, second[2] - first[0] + 0.001)

    @base.in_long_form
    def test_arrows_step_the_time(self):
        shown = self.show("-t", "3", "--fps", "4", "-s", "60x60", paused=True)
        begin = seconds_of(shown.save())
        for key, there in (("Right", 0.25), ("Right", 0.5), ("Left", 0.25), ("Up", 1.25),
                           ("Down", 0.25), ("Down", -0.75)):
            shown.key(key)
            shown.save()  # of the moment before, where both keys come between two frames
            self.assertAlmostEqual(seconds_of(shown.save()), begin + there, delta=0.0015)
        self.assert_shown(shown)

    @base.in_long_form
    def test_a_step_pauses(self):
        shown = self.show("-s", "60x60")
        shown.key("Right")
        wait_for(lambda: shown.title().endswith("paused"), "a pause")
        self.assertEqual(seconds_of(shown.save()), seconds_of(shown.save()))

    @base.in_long_form
    def test_dragging_and_scrolling_are_an_orbit(self):
        for program in MOVING, SCENE:
            shown = self.show("-s", "300x300", program=program, paused=True)
            self.assertIsNone(orbit_of(shown.save()))
            # To the left the camera goes right, by 0.4 degrees a pixel.
            shown.drag((200, 100), (170, 110), (120, 150), (100, 150))
            picture = self.assert_shown(shown)
            for got, wanted in zip(orbit_of(picture), (40, 20, 1)):
                self.assertAlmostEqual(got, wanted, places=9)
            self.server.xdotool("mousemove", 150, 150, "click", 4, "click", 4, "click", 5,
                                "click", 4, "mousemove", *AWAY)
            picture = self.assert_shown(shown)
            for got, wanted in zip(orbit_of(picture), (40, 20, 0.9**2)):
                self.assertAlmostEqual(got, wanted, places=9)
            shown.key("bracketleft", "bracketleft", "bracketright")
            command = self.assert_shown(shown).command
            self.assertEqual(command[command.index("--orbit") + 1], "40,20,0.81,5")
            shown.leave()

    @base.in_long_form
    def test_the_pointer_alone_and_other_buttons_move_nothing(self):
        shown = self.show("-s", "300x300")
        self.server.xdotool("mousemove", 50, 50, "mousemove", 200, 200,
                            "mousedown", 3, "mousemove", 100, 120, "mouseup", 3)
        self.assertIsNone(orbit_of(shown.save()))

    @base.in_long_form
    def test_an_orbit_has_its_limits(self):
        shown = self.show("-s", "300x300")
        shown.drag((150, 10), (150, 290))
        self.server.xdotool("mousemove", 150, 150, "click", "--repeat", 60, "--delay", 5,
                            4, "mousemove", *AWAY)
        shown.pause()
        picture = shown.save()
        self.assertEqual(orbit_of(picture), (0, 90, 0.1))
        self.assert_headless(picture, MOVING)

    @base.in_long_form
    def test_keys_of_one_frame(self):
        """As a slow one has them: each counts in its turn."""
        shown = self.show("-t", "50", "-s", "300x300", paused=True)
        begin = seconds_of(shown.save())
        shown.process.send_signal(signal.SIGSTOP)
        threading.Timer(0.5, shown.process.send_signal, (signal.SIGCONT,)).start()
        self.assertAlmostEqual(seconds_of(shown.save("Up", "Up", "s", "Up")), begin + 2, delta=0.0015)
        self.assertAlmostEqual(seconds_of(shown.save()), begin + 3, delta=0.0015)

    @base.in_long_form
    def test_r_resets(self):
        shown = self.show("-t", "50", "-s", "300x300", "--orbit", "5,6")
        shown.drag((150, 100), (100, 150))
        shown.key("Up", "Up")
        self.assertGreater(seconds_of(shown.save()), 52)
        before = time.monotonic()
        shown.key("r")
        picture = shown.save()
        self.assertEqual(orbit_of(picture), (5, 6, 1))
        self.assertLessEqual(50, seconds_of(picture))
        self.assertLessEqual(seconds_of(picture), 50 + time.monotonic() - before)
        self.assertLess(seconds_of(picture), seconds_of(shown.save()))

    @base.in_long_form
    def test_letters_in_capitals_are_the_same_keys(self):
        shown = self.show("-s", "50x50")
        shown.key("S")
        wait_for(lambda: "saved" in shown.said(), "a saved picture")


class Idle(Case):
    def test_nothing_is_drawn_while_nothing_changes(self):
        """An event is followed by three frames, and the pause has two, a key that goes down and up;
        a notice ends."""
        for panel in False, True:
            shown = self.show("-v", "-s", "200x150", program=SCENE)
            if panel:
                shown.key("p")
                time.sleep(0.5)
            shown.pause()
            time.sleep(2)
            shown.key("Escape")
            shown.ends(0, None)
            drawn, still = map(int, re.search(
                r"^window: (\d+) frames drawn, (\d+) of them while time stood still$",
                shown.said(), re.MULTILINE).groups())
            self.assertGreater(drawn, still)
            self.assertLessEqual(still, 30)  # of 120, if each was drawn

    @base.in_long_form
    def test_what_changes_is_drawn_although_time_stands_still(self):
        os.mkdir(self.path("mine"))
        with open(os.path.join(base.SOURCE, "shaders/lecture/LightedCube.frag"),
                  encoding="utf-8") as file:
            text = file.read()
        shown = self.show("-s", "160x160", "--shaders", "mine", program="LightedCube", paused=True)
        before = self.visible(shown)
        self.make("mine/LightedCube.frag", text.replace("v_Color;\n}", "v_Color * 0.5;\n}"))
        wait_for(lambda: self.visible(shown) != before, "the saved shader")
        before = self.visible(shown)
        shown.drag((80, 80), (60, 80))
        wait_for(lambda: self.visible(shown) != before, "the dragged camera")


class Commands(Case):
    def assert_runs(self, shown, starts):
        shown.pause()
        shown.drag((100, 100), (61, 90))
        picture = shown.save()
        command = re.findall("the same without a window: (.*)", shown.said())[-1]
        self.assertTrue(command.startswith(starts), command)
        # Milliseconds, and tenths of a degree.
        self.assertRegex(command, r"--time \d+(\.\d{1,3})? --orbit[ =][-.\d]{1,6},[-.\d]{1,6}$")
        shown.leave()
        os.remove(self.path("a b.png"))
        subprocess.run(["sh", "-c", command], cwd=self.folder, check=True, timeout=DEADLINE)
        self.assertTrue(self.png("a b.png").pixels == picture.pixels)

    @base.in_long_form
    def test_what_is_said_runs_in_a_shell(self):
        shown = self.show("-s", "150x150", "-o", "a b.png")
        self.assert_runs(shown, os.path.join(base.EXAMPLES, MOVING) + " --output 'a b.png' ")
        # With the script that started it.
        os.mkdir(self.path("the scripts"))
        self.make("the scripts/run", f'#!/bin/sh\nexec "{base.EXAMPLES}/$@"\n')
        os.chmod(self.path("the scripts/run"), 0o755)
        shown = self.show("-s", "150x150", "-o", "a b.png",
                          environment={"LIGHTING_RUN": "the scripts/run"})
        self.assert_runs(shown, f"'the scripts/run' {MOVING} --output 'a b.png' ")


class Sizes(Case):
    @base.in_long_form
    def test_the_picture_has_the_window_s_size_and_aspect(self):
        shown = self.show(paused=True)
        for width, height in ((320, 200), (101, 333), (1, 1), (3, 500), (1500, 1000), (400, 400)):
            with self.subTest(size=(width, height)):
                shown.resize(width, height)
                wait_for(lambda: shown.place()[2:] == (width, height), "the size")
                self.assert_shown(shown)

    @base.in_long_form
    def test_sizes_to_begin_with(self):
        for size in ((1, 1), (700, 2), (1700, 900)):
            shown = self.show("-s", "%dx%d" % size, paused=True)
            picture = self.assert_shown(shown)
            self.assertEqual((picture.width, picture.height), size)
            shown.leave()

    @base.in_long_form
    def test_f_is_the_whole_screen_and_back(self):
        shown = self.show("-s", "200x150", paused=True)
        before = shown.place()
        for _ in range(2):
            shown.key("f")
            wait_for(lambda: shown.place() == (0, 0, *SCREEN), "the whole screen")
            self.assert_shown(shown)
            shown.key("f")
            wait_for(lambda: shown.place() == before, "the window as it was")
            self.assert_shown(shown)

    @base.in_long_form
    def test_an_icon_goes_on_afterwards(self):
        shown = self.show("-s", "200x150")
        for _ in range(3):
            self.manager.set_icon(shown.window, True)
            wait_for(lambda: not shown.find(), "an icon")
            self.manager.set_icon(shown.window, False)
            wait_for(shown.find, "a window again")
        self.server.xdotool("windowfocus", "--sync", shown.window)
        shown.pause()
        self.assert_shown(shown)


class Panel(Case):
    @base.in_long_form
    def test_h_shows_help_and_hides_it(self):
        shown = self.show("-s", "400x400", paused=True)
        plain = wait_for(lambda: self.still(shown), "a picture that stands still")
        shown.key("h")
        wait_for(lambda: self.visible(shown) != plain, "help")
        shown.key("h")
        wait_for(lambda: self.visible(shown) == plain, "no help")

    @base.in_long_form
    def test_the_panel_lies_over_the_picture_and_not_in_it(self):
        shown = self.show("-s", "500x400", program=SCENE, paused=True)
        plain = wait_for(lambda: self.still(shown), "a picture that stands still")
        shown.open_panel(500, 400)
        # Below the rings at the lights.
        left = lambda: crop(self.visible(shown), 500 + PANEL, (0, 130, 500, 270))
        wait_for(lambda: left() == crop(plain, 500, (0, 130, 500, 270)), "the whole picture")
        picture = shown.save()
        self.assertTrue(picture.pixels == plain)
        self.assert_headless(picture, SCENE)
        # What is dragged is the panel, not the camera. A frame lies between any two saved pictures.
        for step in (("mousemove", 600, 60), ("mousedown", 1), ("mousemove", 660, 90),
                     ("mouseup", 1), ("mousemove", *AWAY)):
            self.server.xdotool(*step)
            self.assertIsNone(orbit_of(shown.save()))
        shown.drag((480, 380), (470, 380))
        self.assertIsNotNone(orbit_of(shown.save()))
        # In a window that is too narrow the picture is smaller, and whole.
        shown.resize(400, 300)
        wait_for(lambda: shown.place()[2:] == (400, 300), "the size")
        picture = wait_for(lambda: self.saved_with(shown, (134, 300)), "a narrow picture")
        screen = lambda: crop(self.visible(shown), 400, (0, 110, 134, 190))
        wait_for(lambda: screen() == crop(picture.pixels, 134, (0, 110, 134, 190)),
                 "the narrow picture")
        self.assert_headless(picture, SCENE)

    def saved_with(self, shown, size):
        picture = shown.save()
        return picture if (picture.width, picture.height) == size else None

    @base.in_long_form
    def test_a_window_without_its_panel_is_as_it_was(self):
        shown = self.show("-s", "900x300", program=SCENE, paused=True)
        shown.key("p")
        wait_for(lambda: shown.place()[2:] == (SCREEN[0], 300), "the whole width")
        shown.key("p")
        wait_for(lambda: shown.place()[2:] == (900, 300), "the window as it was")
        self.assert_shown(shown)

    def test_a_switch_in_the_panel_is_the_option(self):
        """Where the switch lies is up to the panel: it is looked for from where it is outwards, in a
        scene that stands still."""
        program, option = "PhongBlinn", ("--fit", "off")
        size = ("-s", "600x560")
        self.good(*size, "-o", "plain.png", program=program)
        self.good(*size, *option, "-o", "wanted.png", program=program)
        plain, wanted = self.png("plain.png").pixels, self.png("wanted.png").pixels
        self.assertNotEqual(plain, wanted)
        shown = self.show(*size, "-o", "a.png", program=program)
        shown.open_panel(600, 560)
        found = None
        places = ((600 + x, y) for y in range(68, 150, 7) for x in (94, 106, 118, 130))
        for x, y in sorted(places, key=lambda place: math.dist(place, (718, 96))):
            shown.click(x, y)
            if shown.save().pixels == wanted:
                found = x, y
                break
            shown.key("r")
        self.assertIsNotNone(found)
        shown.key("r")
        self.assertTrue(shown.save().pixels == plain)


    @base.in_long_form
    def test_a_light_is_dragged_by_its_point(self):
        """In the plane parallel to the picture, where the pointer takes it."""
        shown = self.show("-s", "400x600", program=SCENE, paused=True)
        shown.open_panel(400, 600)
        plain = shown.save().pixels
        there = pixel_of((0, 1.5, 1.5), 400, 600)
        shown.drag(there, (there[0] + 30, there[1]), (there[0] + 60, there[1] + 40))
        picture = shown.save()
        self.assertIsNone(orbit_of(picture))
        number, *at = picture.command[picture.command.index("--light-at") + 1].split(",")
        self.assertEqual(number, "0")
        self.assertTrue(all(len(part) <= 6 for part in at), at)
        at = [float(part) for part in at]
        self.assertAlmostEqual(sum(a * b for a, b in zip(at, CAMERA)), 1.5 + 1.5 * 3, delta=0.02)
        for got, wanted in zip(pixel_of(at, 400, 600), (there[0] + 60, there[1] + 40)):
            self.assertAlmostEqual(got, wanted, delta=1.5)
        self.assert_headless(picture, SCENE)
        shown.key("r")
        wait_for(lambda: "paused" not in shown.title(), "time to run")
        shown.pause()
        self.assertNotIn("--light-at", shown.save().command)
        # Without the panel the camera is what is dragged.
        shown.key("p")
        wait_for(lambda: shown.place()[2:] == (400, 600), "the window without the panel")
        shown.drag(there, (there[0] - 30, there[1]))
        picture = shown.save()
        self.assertIsNotNone(orbit_of(picture))
        self.assertNotIn("--light-at", picture.command)

    @base.in_long_form
    def test_a_light_gets_another_color(self):
        """By a click into a slider; where it lies is up to the panel."""
        shown = self.show("-s", "500x400", program=SCENE, paused=True)
        shown.open_panel(500, 400)
        plain = shown.save().pixels
        for y in 52, 102:  # folds the parameters, and unfolds the lights
            shown.click(650, y)
        for step in (0, -6, 6, -12, 12):
            shown.click(620, 127 + step)
            picture = shown.save()
            if "--light-color" in picture.command:
                break
        number, *colors = picture.command[picture.command.index("--light-color") + 1].split(",")
        self.assertEqual((number, len(colors)), ("0", 6))
        self.assertNotEqual(colors[0], colors[1])
        self.assertNotEqual(picture.pixels, plain)
        self.assert_headless(picture, SCENE)
        shown.key("r")
        wait_for(lambda: "paused" not in shown.title(), "time to run")
        shown.pause()
        self.assertNotIn("--light-color", shown.save().command)

    @base.in_long_form
    def test_common_options_are_in_the_panel(self):
        """Where they lie is up to the panel: they are looked for about where they are."""
        shown = self.show("-s", "500x400", program=SCENE, paused=True)
        shown.open_panel(500, 400)
        for y in 52, 77:  # folds the parameters, and unfolds the options
            shown.click(650, y)
        for option, x, y in (("--samples", 798, 101), ("--precision", 611, 151),
                             ("--linear-light", 611, 201)):
            for step in (0, -6, 6, -12, 12):
                shown.click(x, y + step)
                picture = shown.save()
                if option in picture.command:
                    break
            self.assertIn(option, picture.command)
            self.assert_headless(picture, SCENE)
        shown.key("r")
        wait_for(lambda: "paused" not in shown.title(), "time to run")
        shown.pause()
        picture = shown.save()
        self.assertEqual(len(picture.command), 7, picture.command)  # output, size and time
        self.assert_headless(picture, SCENE)

    @base.in_long_form
    def test_a_map_shows_where_the_error_is(self):
        """In the picture's place; what is saved stays the picture. Its switch is looked for about
        where it is."""
        shown = self.show("-s", "500x400", "--interpolation", "gouraud", program=SCENE, paused=True)
        shown.open_panel(500, 400)
        shown.click(650, 52)
        # The lower left corner is background; in the middle is the sphere.
        corner = lambda: crop(self.visible(shown), 500 + PANEL, (10, 380, 4, 4))
        sphere = lambda: crop(self.visible(shown), 500 + PANEL, (240, 190, 9, 9))
        plain = shown.save().pixels
        before = sphere()
        self.assertNotEqual(corner(), bytes(3 * 16))
        for y in (272, 266, 278, 260, 284):
            shown.click(526, y)
            try:
                wait_for(lambda: sphere() != before, "a map", 20)
                break
            except AssertionError:
                pass
        wait_for(lambda: corner() == bytes(3 * 16), "a background without an error")
        self.assertNotEqual(sphere(), before)
        self.assertTrue(shown.save().pixels == plain)
        shown.click(526, y)
        wait_for(lambda: sphere() == before, "the picture again")

    @base.in_long_form
    def test_before_and_after(self):
        """Left of the middle, or of the pointer, as it was when b was pressed; until b is pressed again."""
        shown = self.show("-s", "400x300", paused=True)
        before = shown.save().pixels
        shown.key("b", "Up")
        after = shown.save().pixels
        shown.key("x")  # does nothing, but that the notice has been read
        part = lambda pixels, x, width: crop(pixels, 400, (x, 0, width, 120))
        self.assertNotEqual(*(part(pixels, 120, 80) for pixels in (before, after)))
        self.assertNotEqual(*(part(pixels, 201, 80) for pixels in (before, after)))

        def divided(at):
            seen = self.visible(shown)
            return part(seen, 0, at) == part(before, 0, at) and part(seen, at + 1, 399 - at) == part(after, at + 1, 399 - at)

        wait_for(lambda: divided(200), "two halves")
        x, y, _, _ = shown.place()
        self.server.xdotool("mousemove", x + 150, y + 250)  # which the server draws below what is looked at
        wait_for(lambda: divided(150), "a line at the pointer")
        self.server.xdotool("mousemove", *AWAY)
        shown.key("b")
        wait_for(lambda: self.visible(shown) == after, "the picture alone")

    @base.in_long_form
    def test_before_and_after_of_floats(self):
        self.good("-s", "400x300", "-o", "bytes.png", program="LightedCube")
        shown = self.show("-s", "400x300", "-o", "a.exr", program="LightedCube")
        part = lambda pixels, x, width: crop(pixels, 400, (x, 0, width, 120))
        expected = part(self.png("bytes.png").pixels, 0, 200)
        shown.key("b", "x")  # the second: the notice has been read

        def divided():
            seen = self.visible(shown)
            return part(seen, 0, 200) == expected and set(part(seen, 200, 1)) == {255}

        wait_for(divided, "the picture, and a white line")

    @base.in_long_form
    def test_letters_grow_and_the_panel_with_them(self):
        shown = self.show("-s", "300x200", program=SCENE, paused=True)
        shown.key("p")
        wait_for(lambda: shown.place()[2] == 300 + PANEL, "a wider window")
        shown.key("plus")
        wait_for(lambda: shown.place()[2] == 300 + round(1.15 * PANEL), "larger letters")
        self.assertEqual(shown.save().width, 300)
        shown.key("minus", "minus")
        wait_for(lambda: shown.place()[2] == 300 + round(PANEL / 1.15), "smaller letters")
        shown.key("p")
        wait_for(lambda: shown.place()[2] == 300, "the window as it was")

    @base.in_long_form
    @unittest.skipUnless(base.DIAGRAMS, "no cairo")
    def test_the_panel_moves_a_diagram(self):
        """A click on "blinn-phong"; where it lies is up to the panel."""
        shown = self.show("-s", "600x560", "-o", "a.png", program="Vectors")
        plain, found = shown.save().pixels, False
        shown.open_panel(600, 560)
        for x, y in ((600 + x, y) for y in range(168, 190, 6) for x in (84, 92)):
            shown.click(x, y)
            picture = shown.save()
            if picture.pixels != plain:
                self.assertIn("blinn-phong", picture.command)
                self.assert_headless(picture, "Vectors")
                found = True
                break
        self.assertTrue(found)


class Shaders(Case):
    FRAGMENT = "mine/LightedCube.frag"

    def setUp(self):
        super().setUp()
        os.mkdir(self.path("mine"))
        lecture = os.path.join(base.SOURCE, "shaders/lecture")
        with open(os.path.join(lecture, "LightedCube.frag"), encoding="utf-8") as file:
            self.original = file.read()
        self.assertIn("gl_FragColor = v_Color;", self.original)
        self.broken = self.original.replace("gl_FragColor = v_Color;", "gl_FragColor = v_Colour;")
        self.dark = self.original.replace("v_Color;\n}", "v_Color * 0.5;\n}")
        self.assertNotEqual(self.dark, self.original)

    def edit(self, text, replace):
        """As editors do: into the file, or into another that takes its name."""
        if replace:
            self.make("mine/new", text)
            os.rename(self.path("mine/new"), self.path(self.FRAGMENT))
        else:
            self.make(self.FRAGMENT, text)

    def assert_drawn(self, shown, text):
        """What is on the screen is drawn with that shader."""
        picture = shown.save()
        self.make("other/LightedCube.frag", text)
        self.assert_headless(picture, "LightedCube", "--shaders", "other")
        return picture

    def test_a_shader_is_live_broken_and_mended(self):
        self.edit(self.original, False)
        shown = self.show("-s", "160x160", "--shaders", "mine", program="LightedCube")
        self.assert_drawn(shown, self.original)
        for replace in False, True:
            said = shown.said()
            self.edit(self.broken, replace)
            wait_for(lambda: "broken" in shown.title(), "a title that says broken")
            self.assertRegex(shown.said()[len(said):], rf"^{self.FRAGMENT}:\d+: .*v_Colour")
            # The last one that could be drawn still is, whole; the error is below.
            wait_for(lambda: shown.place()[2:] == (160, 160 + ERRORS), "a higher window")
            picture = wait_for(lambda: (p := shown.save()).height == 160 and p, "its size")
            screen = lambda: crop(self.visible(shown), 160, (0, 60, 160, 100))
            wait_for(lambda: screen() == crop(picture.pixels, 160, (0, 60, 160, 100)), "it whole")
            self.assert_drawn(shown, self.original)
            self.edit(self.dark, replace)
            wait_for(lambda: "broken" not in shown.title(), "a title that no longer says so")
            wait_for(lambda: shown.place()[2:] == (160, 160), "a lower window")
            wait_for(lambda: shown.save().height == 160, "its size")
            picture = self.assert_drawn(shown, self.dark)
            self.edit(self.original, replace)
            wait_for(lambda: shown.save().pixels != picture.pixels, "the first shader again")
            self.assert_drawn(shown, self.original)

    @base.in_long_form
    def test_a_variable_that_becomes_unused_is_a_warning(self):
        self.edit(self.original, False)
        shown = self.show("-s", "160x160", "--shaders", "mine", program="LightedCube")
        self.edit(self.original.replace("= v_Color", "= vec4(0.2, 0.4, 0.6, 1.0)"), True)
        # Mesa 26 says so of uniforms, but no more of attributes.
        wait_for(lambda: re.search(r"LightedCube\.vert:4: warning: a_Color is not used, a_Normal |"
                                   r"LightedCube\.vert:8: warning: u_LightColor is not used, ",
                                   shown.said()), "a warning")
        self.assertEqual(shown.save().at(80, 80), (51, 102, 153))
        shown.key("r")  # loads the shaders again
        self.assertEqual(shown.save().at(80, 80), (51, 102, 153))
        for word in ("broken", "no picture"):
            self.assertNotIn(word, shown.title())

    @base.in_long_form
    def test_one_that_is_broken_from_the_start_can_be_mended(self):
        self.edit(self.broken, False)
        shown = self.show("-s", "160x160", "--shaders", "mine", program="LightedCube")
        wait_for(lambda: "broken" in shown.title(), "a title that says broken")
        self.assertRegex(shown.said(), rf"^{self.FRAGMENT}:\d+: .*v_Colour")
        shown.key("s")
        wait_for(lambda: "there is no picture to save" in shown.said(), "a refusal")
        self.edit(self.original, True)
        wait_for(lambda: "broken" not in shown.title(), "a title that no longer says so")
        self.assert_drawn(shown, self.original)
        os.remove(self.path(self.FRAGMENT))  # then the original is drawn
        wait_for(lambda: shown.said().endswith(f"{self.FRAGMENT} is gone\n"), "a warning")

    @base.in_long_form
    def test_a_missing_folder_does_not_end_it(self):
        self.edit(self.original, False)
        shown = self.show("-s", "160x160", "--shaders", "mine", program="LightedCube")
        shutil.rmtree(self.path("mine"))
        wait_for(lambda: shown.said().endswith("mine: no such shader folder\n"),
                 "a complaint")
        plain = self.assert_drawn(shown, self.original).pixels
        os.mkdir(self.path("mine"))
        self.edit(self.dark, True)
        wait_for(lambda: shown.save().pixels != plain, "the new shader")
        self.assert_drawn(shown, self.dark)


class Pixels(Case):
    def explained(self, shown, picture, place):
        """Whether the window says of a pixel of the picture what --probe says."""
        said = self.good(*picture.command[1:], "--probe", "%d,%d" % place, program=shown.program)
        lines = said.decode().splitlines()
        verdict, = (line for line in lines if line.startswith("verdict: "))
        lines.remove(verdict)
        return "\n".join([verdict.removeprefix("verdict: "), *lines]) in shown.said()

    @base.in_long_form
    def test_a_click_explains_a_pixel_and_a_drag_none(self):
        for program, place in (SCENE, (180, 220)), ("LightedCube_ambient", (210, 190)):
            shown = self.show("-v", "-s", "400x400", "--precision", "mediump", program=program)
            shown.drag(place, (place[0] + 30, place[1]), place)  # and back
            self.server.xdotool("mousemove", *place, "mousedown", 1, "mousemove", place[0] + 1,
                                place[1], "mouseup", 1)  # at the place where the button went down
            wait_for(lambda: "explaining the pixel took" in shown.said(), "an explanation")
            wait_for(lambda: shown.place()[2:] == (400 + PANEL, 400), "the panel")
            self.server.xdotool("mousemove", *AWAY)
            wait_for(lambda: shown.title() == f"{program}, paused", "a pause")
            shown.key("s")
            command = wait_for(lambda: re.search("saved (.*); the same.*: (.*)", shown.said()),
                               "a saved picture")
            picture = self.png(command[1])
            picture.command = shlex.split(command[2])
            self.assertIsNone(orbit_of(picture))
            wait_for(lambda: self.explained(shown, picture, place), "what --probe says")
            # The second entry of the list, which opens upwards, is error.
            self.says(0, "^error: ", *picture.command[1:], "--show", "error", "-o", "error.png",
                      program=program)
            wanted = crop(self.png("error.png").pixels, 400, (0, 60, 400, 280))
            self.assertNotEqual(wanted, crop(picture.pixels, 400, (0, 60, 400, 280)))
            self.server.xdotool("mousemove", 680, 310, "click", 1)
            time.sleep(0.5)
            self.server.xdotool("mousemove", 520, 171, "click", 1)
            wait_for(lambda: crop(self.visible(shown), 400 + PANEL, (0, 60, 400, 280)) == wanted,
                     "what --show draws")
            shown.key("Escape")
            shown.ends(0, None)

    @base.in_long_form
    def test_the_title_tells_of_the_pixel_under_the_pointer(self):
        for program, background in (SCENE, "; the background, exactly .*"), ("PointLightedCube", ""):
            shown = self.show("-s", "400x400", program=program, paused=True)
            picture = shown.save()
            for x, y in (180, 220), (185, 225), (3, 5):
                self.server.xdotool("mousemove", x, y)
                drawn = "%d, %d, %d" % picture.at(x, y)
                told = r"; object \d, exactly ([\d.]+), .*: (\d+\.\d) steps off" if x > 3 else background
                line = rf"{program}, {x},{y}: {drawn}{told}, paused"
                said = wait_for(lambda: re.fullmatch(line, shown.title()), drawn)
                if program != SCENE and x > 3:  # --probe's, by the equation at the pixel
                    probed = self.good("-s", "400x400", "--probe", f"{x},{y}", program=program).decode()
                    exact, = re.findall(r"at the pixel itself: ([\d.]+)", probed)
                    self.assertAlmostEqual(float(said[1]), float(exact), delta=0.06)
            self.server.xdotool("mousemove", *AWAY)
            wait_for(lambda: shown.title() == f"{program}, paused", "no pixel")
            shown.key("Escape")
            shown.ends(0, None)


class Ends(Case):
    def test_closing_the_window_ends_the_program(self):
        shown = self.show("-s", "60x60")
        self.manager.close(shown.window)
        shown.ends(0)

    @base.in_long_form
    def test_closing_it_during_a_save_leaves_whole_files(self):
        for _ in range(3):
            shown = self.show("-s", "900x700", "--compress", "9")
            shown.key("s", "s")
            self.manager.close(shown.window)
            shown.ends(0, re.compile(rf"^({MOVING}: saved .*\n)*$"))
            self.assert_nothing_half_written()

    def test_signals_end_it_at_once(self):
        for number in signal.SIGINT, signal.SIGTERM:
            for keys in (), ("s",):
                shown = self.show("-s", "900x700", "--compress", "9")
                if keys:
                    shown.key(*keys)
                shown.process.send_signal(number)
                shown.ends(-number, re.compile(rf"^({MOVING}: saved .*\n)*$"))
                self.assert_nothing_half_written()

    @base.in_long_form
    def test_a_picture_that_cannot_be_saved_does_not_end_it(self):
        os.mkdir(self.path("there"))
        shown = self.show("-s", "60x60", "-o", "there/a.png")
        os.rmdir(self.path("there"))
        shown.key("s")
        wait_for(lambda: shown.said().endswith("\n"), "what is said")
        self.assertRegex(shown.said(), rf"^{MOVING}: there/a\.png: .*\n$")
        os.mkdir(self.path("there"))
        shown.save()
        self.assertEqual(os.listdir(self.path("there")), ["a.png"])

    @base.in_long_form
    def test_a_missing_model_does_not_end_it(self):
        model = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
        self.make("model.obj", model)
        shown = self.show("-s", "60x60", "--model", "model.obj", program=SCENE)
        os.remove(self.path("model.obj"))
        shown.key("r")  # opens everything again, as a change in the panel does
        wait_for(lambda: shown.title().endswith("no picture"), "a title that says so")
        shown.key("r", "s")
        wait_for(lambda: "no picture to save" in shown.said(), "a refusal")
        said = f"{SCENE}: model.obj: No such file or directory\n"  # once
        self.assertRegex(shown.said(), rf"^{said}{SCENE}: s: there is no picture to save[^\n]*\n$")
        self.make("model.obj", model)
        shown.key("r")
        wait_for(lambda: "no picture" not in shown.title(), "a picture again")
        shown.pause()
        self.assert_headless(shown.save(), SCENE)

    @base.in_long_form
    def test_a_full_disk_is_said_and_no_end(self):
        self.make("a.png")
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        shown = self.show("-s", "300x300", "--compress", "0", "-o", "a.png", preexec_fn=limit)
        shown.key("s")
        wait_for(lambda: shown.said().endswith("\n"), "what is said")
        self.assertRegex(shown.said(), rf"^{MOVING}: a\.png: cannot write: .*\n$")
        self.assertEqual(self.read("a.png"), b"old")

    @base.in_long_form
    def test_random_input_does_no_harm(self):
        hands = random.Random(7)
        shown = self.show("-s", "200x200")
        for _ in range(60):
            match hands.randrange(4):
                case 0:
                    shown.key(*hands.choices(("space", "r", "f", "Left", "Right", "Up", "Down", "h",
                                              "F1", "a", "ctrl+s", "Tab", "eacute", "BackSpace"),
                                             k=5))
                case 1:
                    shown.drag(*((hands.randrange(SCREEN[0]), hands.randrange(SCREEN[1]))
                                 for _ in range(3)))
                case 2:
                    shown.resize(hands.randrange(1, 700), hands.randrange(1, 700))
                case 3:
                    self.server.xdotool("mousemove", hands.randrange(300), hands.randrange(300),
                                        "click", "--repeat", 3, "--delay", 5,
                                        hands.choice((1, 2, 3, 4, 5, 6, 7)))
            self.assertIsNone(shown.process.poll(), shown.said())
        self.manager.close(shown.window)
        shown.ends(0)


class Displays(base.Case):
    """No display, or one that goes away."""

    NONE = {"DISPLAY": "", "WAYLAND_DISPLAY": ""}
    HOW = r"leave out --window to draw to a file, which needs none\n$"

    def test_without_a_display_one_line_names_the_headless_way(self):
        for environment in (self.NONE, {**self.NONE, "DISPLAY": ":987654"},
                            {**self.NONE, "DISPLAY": "nonsense"}):
            for program, arguments in ((MOVING, ("--window",)), (SCENE, ("-b", "window")),
                                       ("gallery", ("-b", "window"))):
                self.refused(1, rf"^{program}: window: no display .*; {self.HOW}",
                             *arguments, program=program, environment=environment)
            self.refused(1, self.HOW, program=MOVING,
                         environment={**environment, "LIGHTING_BACKEND": "window"})
            self.good("-o", "a.png", environment=environment)

    def test_without_glfw_one_line_names_the_package(self):
        self.make("empty/libglfw.so.3", b"")
        self.refused(1, rf"^{MOVING}: window: libglfw\.so\.3 .*install the package libglfw3; "
                     + self.HOW, "--window", program=MOVING,
                     environment={"LD_LIBRARY_PATH": self.path("empty")})

    @base.in_long_form
    def test_no_library_misses_the_folder_of_a_session(self):
        """libwayland says so itself, on standard error, where it has to look for a display."""
        for folder in "", "relative", "/nonexistent":
            nowhere = {"XDG_RUNTIME_DIR": folder, "WAYLAND_DISPLAY": "", "DISPLAY": ""}
            self.good(*base.SMALL, "-o", "-", environment=nowhere)
            self.good("--doctor", environment=nowhere)
            self.refused(1, rf"^{MOVING}: window: no display .*; leave out --window", "--window",
                         program=MOVING, environment=nowhere)

    def test_options_of_files_are_refused_in_a_window(self):
        for environment, window in ({}, ("--window",)), ({"LIGHTING_BACKEND": "window"}, ()):
            for option in (("--frames", "3"), ("-n", "1"), ("-o", "-"), ("-n", "2", "-o", "a%d.png")):
                self.refused(2, rf"^{MOVING}: --(frames|output -): (in )?a window", *window, *option,
                             program=MOVING, environment=environment)
        self.refused(2, "^gallery: --window: ", "--window", program="gallery")
        self.refused(2, r"--size 0x4: ", "--window", "-s", "0x4")

    @base.in_long_form
    def test_a_display_that_dies_ends_the_program_with_one_line(self):
        self.server = Server()
        self.addCleanup(self.server.stop)
        for how in signal.SIGTERM, signal.SIGKILL:
            self.server = Server()
            shown = Shown(self, "--window", "-s", "300x300")
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            self.server.stop(how)
            shown.ends(1, f"{MOVING}: window: the connection to the display was lost; leave out "
                          "--window to draw without one\n")
            # Mesa writes to a lost display again and again, if it is allowed to: 15 seconds here.
            used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            self.assertLess(used, 8)

    @base.in_long_form
    def test_a_display_that_dies_at_the_start(self):
        for delay in range(0, 100, 20):
            server = Server()
            process = subprocess.Popen([os.path.join(base.EXAMPLES, MOVING), "--window"],
                                       env=server.environment, cwd=self.folder,
                                       stderr=subprocess.PIPE)
            time.sleep(delay / 1000)
            server.stop(signal.SIGKILL)
            error = process.communicate(timeout=DEADLINE)[1].decode()
            error = re.sub(r"^libEGL warning: .*\n", "", error)  # Mesa 25.0's own word about it
            # Mesa 22.3 itself writes to address 0x20 where a display dies while it is asked for a
            # window's surface; what a sanitizer says of that names its library.
            if process.returncode == -signal.SIGSEGV or "libEGL_mesa.so" in error:
                continue
            self.assertEqual(process.returncode, 1, error)
            self.assertRegex(error, rf"^{MOVING}: window: [^\n]*\n$")
        self.assertEqual(self.everything(), {})

    @base.in_long_form
    def test_headless_no_window_library_is_loaded_but_what_the_driver_needs(self):
        """Those of X11 and Wayland that Mesa's own EGL is linked to are no matter of ours."""
        window = re.compile(r"/lib(X|xcb|wayland|glfw|decor)[^/]*$")
        libraries = {}
        for backend in "egl", "osmesa":
            if backend == "osmesa":
                self.need_osmesa()
            self.good("-s", "4x4", "-o", "a.png", "-b", backend,
                      environment={**Displays.NONE, "LD_DEBUG": "files",
                                   "LD_DEBUG_OUTPUT": self.path(backend)})
            name, = (name for name in os.listdir(self.folder) if name.startswith(backend))
            loaded = set(re.findall(r"calling init: (\S+)", self.read(name).decode()))
            libraries[backend] = {path for path in loaded if window.search(path)}
            allowed = set()
            for path in loaded:
                if re.search(r"/lib(EGL|GL|GLX|OSMesa|gallium|glapi)[^/]*$|/dri/", path):
                    listed = subprocess.run(["ldd", path], capture_output=True, text=True).stdout
                    allowed |= set(re.findall(r"=> (\S+)", listed))
            real = {os.path.realpath(path) for path in allowed}
            self.assertEqual([path for path in libraries[backend]
                              if os.path.realpath(path) not in real], [])
            self.assertFalse([path for path in loaded if "glfw" in path])


def main():
    for tool in "Xvfb", "xdotool":
        if not shutil.which(tool):
            print(f"skipped: {tool} is not installed")
            return 77
    if not ctypes.util.find_library("glfw"):
        print("skipped: libglfw.so.3 is not installed")
        return 77
    return base.main()


if __name__ == "__main__":
    sys.exit(main())
