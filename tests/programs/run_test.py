#!/usr/bin/env python3
"""examples/run and common/setup.sh: what they say, where they build, what they install.

usage: run_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

Builds nothing: in copies of the scripts, programs of a few lines stand for meson, ninja and apt-get.
"""
import itertools
import json
import os
import re
import shutil
import subprocess
import sys
import time
import unittest

import command_line_test as base

RUN = os.path.join(base.SOURCE, "examples/run")

# What meson and ninja do, as far as setup.sh sees it. A program that was built says where it is.
TOOLS = {
    "dpkg-query": 'shift 3; for package; do echo "$package installed"; done',
    "meson": 'if [ "$1" = test ]; then case $* in *--list*) printf "a / %s\\n" effects matrix; esac; '
             'exit; fi; [ "$2" != --reconfigure ] || shift; '
             '[ "$2" != --cross-file ] || shift 2; mkdir -p "$2" && '
             'echo "$3" >"$2/source_root" && '
             ': >"$2/build.ninja"',
    "ninja": r'''
cd "$2" || exit 1
shift 2
source=$(cat source_root)
dry=; [ "$1" = -n ] && dry=1 && shift
for target; do
    case $target in *-plugin | all) continue ;; esac
    [ -x "$target" ] && [ -z "$(find "$source/examples" -newer "$target")" ] && continue
    [ "$dry" ] && echo "[1/1] would build $target" && exit
    mkdir -p "${target%/*}" && printf '#!/bin/sh\necho "ran $0"\n' >"$target" && chmod +x "$target"
    built=1
done
[ "${built-}" ] || echo "ninja: no work to do."
''',
}


class Case(base.Case):
    def setUp(self):
        super().setUp()
        for name, text in TOOLS.items():
            self.tool(name, text)

    def tool(self, name, text):
        self.make("bin/" + name, "#!/bin/sh\n" + text + "\n")
        os.chmod(self.path("bin", name), 0o755)

    def environment(self, **more):
        clean = {key: value for key, value in os.environ.items()
                 if key not in ("LIGHTING_BUILD", "XDG_CACHE_HOME", "NO_COLOR", "LIGHTING_BACKEND")}
        clean.update({"HOME": self.path("home"), "TERM": "xterm",
                      "PATH": self.path("bin") + ":" + clean["PATH"]}, **more)
        return {key: value for key, value in clean.items() if value is not None}

    def start(self, *arguments, run=RUN, environment=None, **more):
        """The status, standard output and standard error."""
        result = subprocess.run([run, *arguments], cwd=self.folder, text=True, capture_output=True,
                                timeout=base.PATIENCE, env=self.environment(**(environment or {})),
                                **more)
        return result.returncode, result.stdout, result.stderr


class Names(Case):
    def test_what_was_meant_is_said(self):
        for word, said in (("Shadingmodels", "did you mean ShadingModels?"),
                           ("lab05", "did you mean lab05_per_fragment?"),
                           ("lab5", "did you mean lab05_per_fragment?"),
                           ("LightedCub", "did you mean LightedCube?"),
                           ("LihgtedCube", "did you mean LightedCube?"),
                           ("pointlightedsphere_perfragment",
                            "did you mean PointLightedSphere_perFragment?"),
                           ("galery", "did you mean gallery?"),
                           ("lab", f"{RUN} --list names them"),
                           ("xylophone", f"{RUN} --list names them")):
            self.assertEqual(self.start(word),
                             (2, "", f"examples/run: {word}: no such program; {said}\n"))
        for word, said in (("--jsno", "did you mean --json?"), ("-z", "--help lists them")):
            self.assertEqual(self.start(word),
                             (2, "", f"examples/run: {word}: no such option; {said}\n"))

    def test_a_test_that_was_meant_is_said(self):
        run = os.path.join(base.SOURCE, "tests/run")
        self.assertEqual(self.start("--logn", run=run), (
            2, "", "tests/run: --logn: no such option; did you mean --long?\n"))
        for word, said in (("matrx", "tests/run: matrx: no such test; did you mean matrix?\n"),
                           ("xylophone", "tests/run: no test was run; `meson test -C")):
            code, _, error = self.start(word, run=run,
                                        environment={"LIGHTING_BUILD": self.path("build")})
            self.assertEqual((code, said in error), (2, True), error)

    def test_cluster_wants_a_number_and_a_command(self):
        self.assertRegex(self.start("cluster", "--help")[1], "^cluster: many processes or machines share")
        for arguments, said in (((), "which command"), (("8",), "which command"),
                                (("8", "--"), "which command"), (("--pbs", "8"), "--pbs: no such option")):
            code, text, error = self.start("cluster", *arguments)
            self.assertEqual((code, text), (2, ""))
            self.assertRegex(error, f"^examples/run cluster: {said}")
        self.assertEqual(self.start("cluster", "8", "--", "gallry")[0], 2)

    def test_pages_replace_only_pages(self):
        for arguments, code, said in (((), 2, "web: -o DIR names the folder for the pages, --pdf FILE the book's file"),
                                      (("-o",), 2, "-o: name a folder, as in -o pages"),
                                      (("--pdf",), 2, "--pdf: name a file, as in --pdf book.pdf"),
                                      (("--size", "9x9"), 2, "web: --size: no such option; -o DIR names the folder, --lab LAB a lab of your own, "
                                       "--pdf FILE the book's file"),
                                      (("--lab", "x", "--pdf", "book.pdf"), 2, "web: --lab needs -o DIR, the folder for the pages"),
                                      (("-o", "new", "--lab", "none"), 1, "web: --lab none: no such folder"),
                                      (("-o", self.folder), 1,
                                       f"web: {self.folder}: is there, and holds no such pages; name another folder")):
            before = sorted(os.listdir(self.folder))
            self.assertEqual(self.start("web", *arguments), (code, "", f"examples/run: {said}\n"))
            self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_a_folder_of_systems_is_ones_own(self):
        self.make("systems/trixie/notes", "mine")
        self.tool("id", "echo 0")
        self.tool("debootstrap", "exit 1")
        self.assertEqual(self.start("trixie", run=os.path.join(base.SOURCE, "tests/systems/run"),
                                    environment={"LIGHTING_SYSTEMS": self.path("systems")}), (
            1, "", f"tests/systems/run: LIGHTING_SYSTEMS: {self.path('systems')}: is not empty, and of no earlier call; "
                   "name another folder\n"))
        self.assertTrue(os.path.exists(self.path("systems/trixie/notes")))

    @base.in_long_form
    def test_what_is_about_a_word(self):
        """Programs, options and the book's places; in any case of letters."""
        code, text, said = self.start("--list", "Specular")
        self.assertEqual((code, said), (0, ""))
        lines = {line[:32].strip(): line[32:].strip() for line in text.splitlines()}
        self.assertIn("diffuse and specular colour", lines["Materials"])
        self.assertIn("ShininessRow", lines["--specular R,G,B"])
        self.assertEqual(lines["Specular Reflection"], "chapter 13 of the book, in examples/chapter")
        self.assertTrue(all("specular" in line.lower() for line in text.splitlines()))
        self.assertEqual(self.start("--list", "a.b*c"), (
            1, "", "examples/run: nothing is about a.b*c; examples/run --list names all programs\n"))

    @base.in_long_form
    def test_the_list_for_tools_has_every_program(self):
        code, text, said = self.start("--json")
        self.assertEqual((code, said), (0, ""))
        programs = json.loads(text)
        self.assertEqual({one["name"] for one in programs},
                         set(base.EVERY) | {"Vectors"} | {"check", "Scene"})
        # The same by groups, each under a title.
        parts = [part.split("\n", 1) for part in self.start("--list")[1].rstrip("\n").split("\n\n")]
        groups = [list(group) for _, group in itertools.groupby(programs, lambda one: one["group"])]
        self.assertEqual([rows for _, rows in parts],
                         ["\n".join(f"  {one['name']:32} {one['summary']}" for one in group) for group in groups])
        for title, _ in parts:
            self.assertRegex(title, "^[A-Z].*:$")
        for one in programs:
            folder = os.path.join(base.SOURCE, "examples", one["group"])
            self.assertTrue(one["group"] == "all" or os.path.isdir(folder), one)
            if one["group"] in ("lecture", "lighting", "diagrams", "study"):
                self.assertTrue(os.path.exists(os.path.join(folder, one["name"] + ".c")), one)

    def test_the_version_is_said(self):
        code, text, said = self.start("--version")
        self.assertEqual((code, said), (0, ""))
        self.assertRegex(text, r"^run \(lighting\) \d[\d.]*(-\d+-g\w+)?\n$")

    def test_errors_are_red_on_a_terminal(self):
        for more, red in (({}, True), ({"NO_COLOR": "1"}, False), ({"TERM": "dumb"}, False)):
            code, said = base.on_terminal([RUN, "xylophone"], env=self.environment(**more))
            self.assertEqual(code, 2)
            self.assertEqual(said.startswith("\x1b[31mexamples/run:\x1b[0m xylophone: "), red, said)
            self.assertEqual("\x1b" in said, red, said)


class Pages(Case):
    """examples/run web, with a ninja that makes the pages that PAGES names."""

    def setUp(self):
        super().setUp()
        for name in ("examples/run", "common/setup.sh"):
            os.makedirs(os.path.dirname(self.path("tree", name)), exist_ok=True)
            shutil.copy(os.path.join(base.SOURCE, name), self.path("tree", name))
        for name in ("meson.build", "meson_options.txt", "shaders/some/a.glsl", "shaders/some/b.glsl"):
            self.make("tree/" + name, "")
        self.tool("ninja", 'cd "$2" && rm -rf "$3" && mkdir -p "$3/single" && cd "$3" || exit 1\n'
                           'for page in $PAGES; do echo "$page" | tee -a .lighting >"$page"; done')

    def web(self, folder, pages):
        code, text, said = self.start("web", "-o", folder, run=self.path("tree/examples/run"), environment={"PAGES": pages})
        self.assertEqual((code, text), (0, ""), said)
        return said

    def files(self, folder):
        return sorted(os.path.relpath(os.path.join(parent, file), self.path(folder))
                      for parent, _, files in os.walk(self.path(folder)) for file in files)

    def change(self, path):
        os.utime(self.path("tree", path), (time.time() + 60,) * 2)

    @base.in_long_form
    def test_only_pages_are_replaced(self):
        first = [".lighting", "index.html", "old.html", "single/a.html"]
        self.web("pages/", "index.html old.html single/a.html")
        self.assertEqual(self.files("pages"), first)
        self.make("pages/notes.html", "mine")
        self.make("pages/.git/HEAD", "mine")
        os.symlink("pages", self.path("link"))
        self.change("examples/run")
        self.web("link", "index.html new.html single/b.html")
        self.assertTrue(os.path.islink(self.path("link")))
        self.assertEqual(self.files("pages"), [".git/HEAD", ".lighting", "index.html", "new.html", "notes.html",
                                               "single/b.html"])

    def test_a_list_names_nothing_elsewhere(self):
        self.make("mine.html", "mine")
        self.make("pages/.lighting", f"../mine.html\nsingle/../../mine.html\n{self.path('mine.html')}\n")
        self.web("pages", "index.html")
        self.assertEqual(self.files("pages"), [".lighting", "index.html"])
        self.assertTrue(os.path.exists(self.path("mine.html")))

    @base.in_long_form
    def test_nothing_is_linked_anew_while_it_draws_pages(self):
        tool = self.read("bin/ninja").decode()
        self.tool("ninja", f"case $2 in *-web) flock -n '{self.path('tree/build/.lock')}' true && exit 1 ;; esac\n{tool}")
        self.web("pages", "index.html")
        subprocess.run(["flock", "-n", self.path("tree/build/.lock"), "true"], check=True)

    @base.in_long_form
    def test_pages_that_cannot_be_written_leave_the_old_ones(self):
        self.web("pages", "index.html old.html")
        self.change("examples/run")
        self.tool("cp", "exit 1")
        self.assertEqual(self.start("web", "-o", "pages", run=self.path("tree/examples/run"),
                                    environment={"PAGES": "index.html"}),
                         (1, "", "examples/run: web: pages: cannot be written\n"))
        self.assertEqual(self.files("pages"), [".lighting", "index.html", "old.html"])

    @base.in_long_form
    def test_shaders_that_come_or_go_are_listed_again(self):
        self.assertIn("configuring", self.web("pages", "index.html"))
        self.change("shaders/some/a.glsl")
        self.assertNotIn("configuring", self.web("pages", "index.html new.html"))
        self.assertIn("new.html", self.files("pages"))
        self.change("shaders/some")
        self.assertIn("configuring", self.web("pages", "index.html"))


class Folders(Case):
    """A copy of the scripts that a user runs who may not write to it."""

    def setUp(self):
        super().setUp()
        for name in ("examples/run", "examples/meson.build", "common/setup.sh", "common/packages",
                     "meson.build", "meson_options.txt"):
            os.makedirs(os.path.dirname(self.path("tree", name)), exist_ok=True)
            shutil.copy(os.path.join(base.SOURCE, name), self.path("tree", name))
        self.make("tree/examples/lecture/LightedCube.c", '    .summary = "a cube",\n')
        os.mkdir(self.path("home"))
        os.chmod(self.path("home"), 0o777)
        self.run_path = self.path("tree/examples/run")

    def protect(self):
        for folder, _, _ in os.walk(self.path("tree")):
            os.chmod(folder, 0o555)
            self.addCleanup(os.chmod, folder, 0o755)

    def start(self, *arguments, **more):
        return super().start("LightedCube", *arguments, run=self.run_path, **base.SOMEBODY, **more)

    @base.in_long_form
    def test_what_is_not_built_is_built_in_the_users_cache(self):
        self.protect()
        code, text, said = self.start()
        self.assertEqual(code, 0, said)
        folder = re.fullmatch(rf"ran ({re.escape(self.path('home/.cache/lighting/'))}build-\d+)"
                              "/examples/LightedCube\n", text)[1]
        self.assertEqual(said.splitlines()[0], f"examples/run: {self.path('tree/build')} cannot be "
                                               f"written; building in {folder}")
        self.assertEqual(self.start(), (0, text, ""))
        self.assertFalse(os.path.exists(self.path("tree/build")))

    @base.in_long_form
    def test_a_program_is_told_how_it_was_started(self):
        """For the command that its window shows."""
        self.tool("ninja", TOOLS["ninja"].replace("ran $0", "$LIGHTING_RUN"))
        self.protect()
        code, text, said = self.start()
        self.assertEqual((code, text), (0, self.run_path + "\n"), said)

    @base.in_long_form
    def test_the_cache_may_be_elsewhere(self):
        self.protect()
        for cache, there in ((self.path("home/other"), "home/other/lighting"),
                             ("relative", "home/.cache/lighting")):
            code, text, said = self.start(environment={"XDG_CACHE_HOME": cache})
            self.assertEqual((code, text.startswith("ran " + self.path(there))), (0, True), said)

    @base.in_long_form
    def test_a_build_that_may_not_be_written_runs(self):
        result = super().start("LightedCube", run=self.run_path)
        self.assertEqual(result[:2], (0, f"ran {self.path('tree/build/examples/LightedCube')}\n"))
        self.protect()
        self.assertEqual(self.start(), (0, result[1], ""))
        # Built without the scripts: ninja says that it is up to date.
        os.chmod(self.path("tree/build"), 0o755)
        os.remove(self.path("tree/build/.done-LightedCube"))
        os.chmod(self.path("tree/build"), 0o555)
        self.assertEqual(self.start(), (0, result[1], ""))
        # Out of date.
        os.utime(self.path("tree/examples/lecture/LightedCube.c"), (time.time() + 60,) * 2)
        code, text, said = self.start()
        self.assertEqual((code, self.path("home/.cache") in text), (0, True), said)
        self.assertIn("cannot be written; building in", said)

    def test_a_copied_tree_is_configured_anew(self):
        """Its build folder would else belong to the first."""
        first = super().start("LightedCube", run=self.run_path)
        shutil.copytree(self.path("tree"), self.path("copy"), symlinks=True)
        there = self.path("copy/build/examples/LightedCube")
        os.remove(there)
        code, text, said = super().start("LightedCube", run=self.path("copy/examples/run"))
        self.assertEqual((code, text), (0, f"ran {there}\n"), said)
        self.assertIn("configuring", said)
        self.assertEqual(super().start("LightedCube", run=self.run_path), (0, first[1], ""))
        # A folder elsewhere is not taken from the tree that it was made for.
        for run, status in ((self.run_path, 0), (self.path("copy/examples/run"), 1)):
            result = super().start("LightedCube", run=run,
                                   environment={"LIGHTING_BUILD": self.path("other")})
            self.assertEqual(result[0], status, result)
        self.assertIn(f"belongs to {self.path('tree')}; LIGHTING_BUILD names another", result[2])

    def test_a_file_of_the_future_is_named(self):
        """meson stops there."""
        skew = 'echo "ERROR: Clock skew detected. File /a b/meson.build has a time stamp 9.0s in the future."; exit 1'
        for tool in "ninja", "meson":  # ninja starts meson again if meson.build has changed
            self.tool(tool, skew)
            code, _, said = super().start("LightedCube", run=self.run_path)
            self.assertEqual(code, 1)
            self.assertRegex(said, "\nexamples/run: /a b/meson.build is of the future: set the clock, or ")
            self.assertNotIn("ERROR", said)
            shutil.rmtree(self.path("tree/build"))

    @base.in_long_form
    def test_a_long_build_says_how_far_it_is(self):
        """Without a terminal, too."""
        self.tool("ninja", 'for i in $(seq 80); do echo "[$i/80] Compiling"; done; exit 1')
        _, _, said = super().start("LightedCube", run=self.run_path)
        self.assertEqual(re.findall(r"built (\d+) of 80 files", said), ["20", "40", "60"])
        self.assertIn("[80/80] Compiling", said)  # what it said, because it failed

    @base.in_long_form
    def test_a_slow_build_says_how_far_it_is(self):
        """Every 10 s, and not only the first time."""
        self.assertIn("building LightedCube\n", super().start("LightedCube", run=self.run_path)[2])
        os.utime(self.path("tree/examples/lecture/LightedCube.c"), (time.time() + 60,) * 2)
        self.tool("ninja", 'echo "[1/3] Compiling"; sleep 15; echo "[2/3] Compiling"; echo "[3/3] Linking"')
        # The first line if the machine is so busy that it comes late.
        self.assertRegex(super().start("LightedCube", run=self.run_path)[2],
                         "^(examples/run: built 1 of 3 files\n)?examples/run: built 2 of 3 files\n$")

    @base.in_long_form
    def test_two_first_commands_wait_for_each_other(self):
        """The second installs nothing."""
        self.tool("sudo", 'exec "$@"')
        self.tool("dpkg-query", '[ ! -e "$HOME/installed" ] || { shift 3; for package; do '
                                'echo "$package installed"; done; }')
        self.tool("apt-get", 'case " $* " in *" --print-uris "*) echo "Need to get 1 B of archives."; exit;; esac\n'
                             'echo >>"$HOME/calls"; while [ ! -e "$HOME/go" ]; do sleep 0.1; done\n'
                             ': >"$HOME/installed"')
        def begin():
            return subprocess.Popen([self.run_path, "LightedCube"], env=self.environment(), stdout=subprocess.PIPE,
                                    stderr=subprocess.PIPE, text=True)
        with begin() as first:
            while first.poll() is None and not os.path.exists(self.path("home/calls")):
                time.sleep(0.01)
            with begin() as second:
                line = second.stderr.readline()
                self.make("home/go", b"")
                text, said = second.communicate()
            self.assertEqual((first.communicate()[0], first.returncode, second.returncode), (text, 0, 0), said)
        self.assertTrue(line.endswith(f"another command uses {self.path('tree/build')}; waiting for it\n"), line)
        self.assertEqual(self.read("home/calls"), b"\n")

    @base.in_long_form
    def test_two_tools_find_that_nothing_has_changed(self):
        """And so the program starts at once."""
        first = super().start("LightedCube", run=self.run_path)
        self.assertEqual(first[0], 0, first)
        os.mkdir(self.path("few"))
        for tool in "sh", "readlink", "find":
            os.symlink(shutil.which(tool), self.path("few", tool))
        self.assertEqual(super().start("LightedCube", run=self.run_path,
                                       environment={"PATH": self.path("few")}),
                         (0, first[1], ""))

    def test_nowhere_to_build_is_one_line(self):
        self.protect()
        build = self.path("tree/build")
        for said, environment in (
                (f"cannot write to the build folder {build}; LIGHTING_BUILD names another",
                 {"HOME": None}),
                (rf"cannot write to the build folder {build}, nor to /proc/.cache/lighting/build-\d+; "
                 "LIGHTING_BUILD names another", {"HOME": "/proc"}),
                ("cannot write to the build folder /proc/build; LIGHTING_BUILD names another",
                 {"LIGHTING_BUILD": "/proc/build"})):
            code, text, error = self.start(environment=environment)
            self.assertEqual((code, text), (1, ""))
            self.assertRegex(error, f"^examples/run: {said}\n$")

    @base.in_long_form
    def test_only_the_plugins_that_are_needed_are_built(self):
        self.tool("ninja", 'shift 2; [ "$1" = -n ] || echo "$*" >>"$HOME/targets"; exit 1')
        for arguments, plugins in (((), []), (("-s40",), ["app"]), (("-o", "a.exr"), ["app", "image_oiio"]),
                                   (("-o", "a.gif"), ["app", "image_oiio"]), (("-n", "3", "-o", "a.gif"), ["app"]), (("--help",), ["app"]),
                                   (("--show", "error"), ["app", "probe"]), (("--show-clipped",), ["app"]),
                                   (("--model", "a.obj", "-w"), ["app", "model_assimp", "panel_imgui"])):
            self.assertEqual(self.start(*arguments)[0], 1)
            self.assertEqual(self.read("home/targets").decode(), " ".join(
                ["examples/LightedCube", *(name + "-plugin" for name in plugins)]) + "\n")
            os.remove(self.path("home/targets"))


class Build(unittest.TestCase):
    def test_a_program_of_the_lecture_needs_few_files(self):
        """Nothing of scenes, windows and the shaders' language is compiled for a first picture."""
        build = os.path.dirname(base.EXAMPLES)
        if not shutil.which("ninja") or not os.path.exists(os.path.join(build, "build.ninja")):
            self.skipTest("not ninja's build folder")
        commands = subprocess.run(["ninja", "-C", build, "-t", "commands", "examples/LightedCube"],
                                  capture_output=True, text=True, check=True).stdout
        self.assertRegex(commands, r" -c \S*/common/core/matrix\.c")
        for folder in ("glsl", "shapes", "shadows", "lighting", "reference", "probe", "choose", "kinds"):
            self.assertNotIn(f"/common/{folder}/", commands)
        # keep_loaded.c is compiled for the sanitizers alone.
        files = re.findall(r" -c (\S+)", commands)
        self.assertLessEqual(sum("keep_loaded" not in file for file in files), 30)


class Packages(Case):
    APT = r'''
case " $* " in
*" --print-uris "*)
    [ -e "$HOME/lists" ] || exit 100
    echo "Need to get 12.3 MB/45 MB of archives."
    echo "After this operation, 160 MB of additional disk space will be used." ;;
*" update "*) : >"$HOME/lists" ;;
*" install "*)
    [ ! -e "$HOME/locked" ] || { echo "E: Could not get lock /var/lib/dpkg/lock-frontend." >&2; exit 100; }
    echo "Get:1 noise"
    case " $* " in *" APT::Status-Fd=3 "*)
        echo "dlstatus:1:20.5:Retrieving file 1 of 2" >&3
        echo "pmstatus:gcc:66.7:Unpacking gcc" >&3 ;;
    esac
    echo "E: no space" >&2
    exit "${APT_STATUS-0}" ;;
esac
'''

    def setUp(self):
        super().setUp()
        os.mkdir(self.path("home"))
        self.tool("apt-get", self.APT)
        self.tool("sudo", 'exec "$@"')
        self.tool("dpkg-query", "exit 1")
        self.tool("ninja", ": >$HOME/built; exit 1")

    def install(self, terminal, **environment):
        command = [RUN, "LightedCube"]
        more = {"LIGHTING_BUILD": self.path("build"), **environment}
        if terminal:
            return base.on_terminal(command, env=self.environment(**more))
        result = subprocess.run(command, env=self.environment(**more), text=True,
                                capture_output=True)
        return result.returncode, result.stderr

    def test_the_megabytes_to_come_are_said(self):
        _, said = self.install(False)
        self.assertIn("examples/run: fetching the package lists\nexamples/run: installing with "
                      "apt-get (12.3 MB/45 MB to fetch, 160 MB on disk): gcc ", said)
        self.assertNotIn("Unpacking", said)
        self.assertNotIn("noise", said)
        self.assertTrue(os.path.exists(self.path("home/built")))

    def test_progress_is_seen_on_a_terminal(self):
        self.make("home/lists")
        _, said = self.install(True)
        self.assertNotIn("fetching", said)
        self.assertIn("\r\x1b[K 20% Retrieving file 1 of 2\r\x1b[K 66% Unpacking gcc\r\x1b[K", said)
        self.assertNotIn("noise", said)
        self.assertTrue(os.path.exists(self.path("home/built")))

    def test_a_failure_is_said_with_its_reason(self):
        for terminal in False, True:
            code, said = self.install(terminal, APT_STATUS="100", NO_COLOR="1")
            self.assertEqual(code, 1)
            self.assertIn("E: no space", said)
            self.assertRegex(said.splitlines()[-1],
                             "^examples/run: apt-get could not install: gcc ")
            self.assertFalse(os.path.exists(self.path("home/built")))

    def test_another_programs_lock_is_waited_for(self):
        self.make("home/lists")
        self.tool("sleep", 'echo >>"$HOME/slept"; [ "$(wc -l <"$HOME/slept")" -lt 3 ] || rm -f "$HOME/locked"')
        self.make("home/locked")
        _, said = self.install(False)
        self.assertEqual(said.count("waiting for it, at most 5 minutes\n"), 1, said)
        self.assertNotIn("could not install", said)
        self.assertEqual(self.read("home/slept"), b"\n" * 3)
        self.assertTrue(os.path.exists(self.path("home/built")))
        if not base.LONG:
            return
        self.make("home/locked")
        self.make("home/slept", "")
        self.tool("sleep", 'echo >>"$HOME/slept"')
        code, said = self.install(False)
        self.assertEqual(code, 1)
        self.assertIn("E: Could not get lock", said)
        self.assertEqual(self.read("home/slept"), b"\n" * 60)

    def test_other_systems_get_their_packages_names(self):
        """Where there is no dpkg. The path has what is in every system, and a package manager."""
        tools = ("sh", "sed", "awk", "cat", "readlink", "id", "uname", "grep", "mkdir", "mktemp",
                 "find")
        for manager, said in (("dnf", "dnf install gcc glibc-devel .*OpenImageIO-devel"),
                              ("pacman", "pacman -S gcc glibc .*openimageio"),
                              ("apk", "apk add gcc musl-dev .*openimageio-dev"),
                              ("brew", "brew install .*glfw .*openimageio"),
                              (None, "what these packages of Debian contain: gcc .*openimageio-dev")):
            folder = self.path(f"bin {manager}")
            os.mkdir(folder)
            for tool in tools:
                os.symlink(shutil.which(tool), os.path.join(folder, tool))
            if manager:
                os.symlink("/bin/true", os.path.join(folder, manager))
            result = subprocess.run(
                [RUN, "Materials", "-o", "a.exr"],
                env={"PATH": folder, "LIGHTING_BUILD": self.path("build")}, capture_output=True)
            error = result.stderr.decode()
            self.assertEqual((result.returncode, error.count("\n")), (1, 1), error)
            self.assertRegex(error, "^examples/run: this is not a Debian system; it needs " + said)
            self.assertEqual("untested" in error, bool(manager), error)

    def wanted(self, *words):
        """The packages that examples/run asks for."""
        self.tool("dpkg-query", 'shift 3; echo "$*" >>"$HOME/wanted"; exit 1')
        self.start(*words, environment={"LIGHTING_BUILD": self.path("build")})
        return self.read("home/wanted").decode().split("\n")[0].split()

    @unittest.skipUnless(base.LONG and shutil.which("strace") and shutil.which("apt-get"),
                         "the long form, with strace and apt-get")
    def test_a_program_opens_only_what_its_packages_bring(self):
        """Those that examples/run installs for it, and what they depend on, on an empty system."""
        plain = {**os.environ, "LC_ALL": "C"}
        ask = lambda *command: subprocess.run(command, env=plain, text=True, capture_output=True).stdout
        essential = set(re.findall(r"^(\S+) required$", ask("dpkg-query", "-W", "-f", "${Package} ${Priority}\n"), re.M))
        all_brought, owner = {}, {}
        for program in sorted(set(base.EVERY) - {"gallery", "accuracy", "hard_cases", "precision", "lessons"}) + ["lessons"]:
            packages = self.wanted(program)
            os.remove(self.path("home/wanted"))
            if tuple(packages) not in all_brought:
                listed = ask("apt-get", "-s", "-o", "Dir::State::status=/dev/null", "--no-install-recommends", "install",
                             *packages)
                all_brought[tuple(packages)] = set(re.findall(r"^Inst (\S+)", listed, re.M)) | essential
            brought = all_brought[tuple(packages)]
            if not set(packages) <= brought:
                self.skipTest("apt-get has no package lists")
            draw = [program, "1", os.path.join(base.SOURCE, "shaders/labs/solutions/lab01_diffuse")] if program == "check" \
                else [program, "-s", "40x40", "-o", self.path("a.png")]
            subprocess.run(["strace", "-f", "-z", "-qq", "-e", "trace=openat,execve", "-o", self.path("trace"),
                            os.path.join(base.EXAMPLES, draw[0]), *draw[1:]], cwd=self.folder, capture_output=True,
                           check=True, env={**plain, "LP_NUM_THREADS": "0"})
            with open(self.path("trace")) as file:
                paths = set(re.findall(r'"(/(?:usr|lib)[^"]*)"', file.read()))
            names = {name for path in map(os.path.realpath, paths) if os.path.isfile(path)
                     for name in (path, path.removeprefix("/usr"))}
            owner.update(dict.fromkeys(names - set(owner)))
            for line in ask("dpkg", "-S", "/none", *(name for name in names if owner[name] is None)).splitlines():
                package, _, name = line.partition(": ")
                owner[name] = package.split(":")[0]
            owners = {owner[name] for name in names} - {None}
            self.assertGreater(len(owners), 3)
            self.assertEqual(owners - brought, set(), program)

    def test_every_package_has_its_names_elsewhere(self):
        with open(os.path.join(base.SOURCE, "common/setup.sh")) as file:
            text = file.read().replace("\\\n", " ")
        wanted = set(" ".join(re.findall(r'^packages_to_\w+="(.*?)"', text, re.MULTILINE)).split())
        with open(os.path.join(base.SOURCE, "common/packages")) as file:
            rows = [line.split() for line in file if not line.startswith("#")]
        self.assertEqual(wanted, {row[0] for row in rows})
        self.assertTrue(all(len(row) == 5 for row in rows))


if __name__ == "__main__":
    sys.exit(base.run_tests())
