#!/usr/bin/env python3
"""`meson install`: what it installs, and that it can be taken away again.

usage: installation_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

Installs what is built into a temporary folder.
"""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import command_line_test as base

BUILD = os.path.dirname(base.EXAMPLES)
LOG = os.path.join(BUILD, "meson-logs/install-log.txt")  # what `uninstall` removes


def files(folder):
    return [os.path.join(parent, name) for parent, _, names in os.walk(folder) for name in names]


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="installation_test-")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.root = os.path.join(cls.folder, "root")
        theirs = None
        if os.path.exists(LOG):
            with open(LOG, "rb") as file:
                theirs = file.read()
        try:
            subprocess.run(["meson", "install", "-C", BUILD, "--no-rebuild", "--destdir", cls.root], check=True,
                           capture_output=True)
            shutil.copy(LOG, cls.folder)
        finally:
            if theirs is not None:
                with open(LOG, "wb") as file:
                    file.write(theirs)
            elif os.path.exists(LOG):
                os.remove(LOG)

    @unittest.skipIf(base.SANITIZED, "a sanitizer reports by the paths of the sources")
    def test_no_file_says_where_it_was_built(self):
        """As the bytes of a file else depend on it."""
        for path in files(self.root):
            with open(path, "rb") as file:
                content = file.read()
            for folder in BUILD, base.SOURCE:
                if folder.count("/") > 1: # "/lighting" may be in any path
                    self.assertNotIn(os.fsencode(folder) + b"/", content, path)

    def test_what_is_uninstalled_leaves_nothing(self):
        root = os.path.join(self.folder, "again")
        shutil.copytree(self.root, root, symlinks=True)
        self.assertGreater(len(files(root)), 100)
        os.mkdir(os.path.join(self.folder, "meson-logs"))
        with open(os.path.join(self.folder, "install-log.txt")) as file:
            log = file.read().replace(self.root, root)
        with open(os.path.join(self.folder, "meson-logs/install-log.txt"), "w") as file:
            file.write(log)
        # What `ninja uninstall` is.
        subprocess.run(["meson", "--internal", "uninstall"], cwd=self.folder, check=True, capture_output=True)
        self.assertEqual([path for path in files(root) if os.path.lexists(path)], [])
        self.assertFalse(os.path.exists(root), "empty folders")

    @unittest.skipIf(base.SANITIZED, "a sanitized library needs a sanitized program")
    def test_another_project_uses_the_library(self):
        """As examples/guide/library.md shows it, and with our warnings; the picture is the program's."""
        with open(os.path.join(base.SOURCE, "examples/guide/library.md")) as file:
            code, commands = re.findall(r"```(?:c|sh)\n(.*?)```", file.read(), re.DOTALL)
        with open(os.path.join(self.folder, "cube.c"), "w") as file:
            file.write(code)
        found, = glob.glob(self.root + "/**/lighting.pc", recursive=True)
        shaders, = glob.glob(self.root + "/**/lighting/shaders", recursive=True)
        environment = {**os.environ, "PKG_CONFIG_PATH": os.path.dirname(found), "LIGHTING_SHADERS": shaders}
        with open(found) as file:
            prefix = self.root + re.search("^prefix=(.*)", file.read())[1]
        commands = commands.replace("pkg-config", f"pkg-config --define-variable=prefix={prefix}").replace("cc ", "cc -std=c11 -Wall -Wextra -Wconversion -Wshadow -Werror ")
        result = subprocess.run(["sh", "-ec", commands], cwd=self.folder, env=environment, text=True, capture_output=True)
        self.assertEqual((result.returncode, result.stdout + result.stderr), (0, ""))
        picture = base.Png(subprocess.run(
            [os.path.join(base.EXAMPLES, "LightedCube"), "-s", "400x300", "--samples", "4", "--orbit", "30,10", "-o", "-"],
            check=True, capture_output=True).stdout)
        with open(os.path.join(self.folder, "cube.ppm"), "rb") as file:
            self.assertTrue(file.read() == b"P6 400 300 255\n" + picture.pixels)


if __name__ == "__main__":
    sys.exit(base.run_tests())
