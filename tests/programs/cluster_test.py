#!/usr/bin/env python3
"""What the pages show of GNU parallel, make and Slurm: run as it stands there, but with small pictures.

usage: cluster_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

What the parts make together is what one process makes. Slurm has three nodes that take two tasks at
once each: its daemons are started with a configuration of their own, in a temporary folder, on free ports
of the loopback interface, and end with the test. That needs root.
"""
import csv
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

import command_line_test as base

TASKS = 2
NODES = ("one", "two", "three")
TREE = os.path.join(base.SOURCE, "shaders/labs/solutions/lab05_per_fragment")
STARTER = os.path.join(base.SOURCE, "examples/labs/lab05_per_fragment")
# Of the pages' words, what is smaller here.
SMALLER = (("-n 900", "-n 24 -s 40x30"), ("-s 800x800", "-s 40x40"),
           ("accuracy -o study", "accuracy --scene cube --quick -s 48x48 -o study"),
           ("--class DIR", "--class class"))
DAEMONS = ("munged", "slurmctld", "slurmd")


def needs(*programs):
    missing = [name for name in programs if not shutil.which(name)]
    return unittest.skipIf(missing, f"without {', '.join(missing)}; common/setup.sh names the "
                                    "packages (packages_to_cluster)")


def blocks(page, heading):
    """The blocks of code below a heading of a page."""
    with open(os.path.join(base.SOURCE, page)) as file:
        section = file.read().partition(f"# {heading}\n")[2].partition("\n## ")[0]
    found = re.findall(r"```\w+\n(.*?)```", section, re.DOTALL)
    for shown, small in SMALLER:
        found = [block.replace(shown, small) for block in found]
    return found


def block(page, heading, word):
    return next(found for found in blocks(page, heading) if word in found)


def films(word):
    return block("examples/guide/processes.md", "Several processes", word)


def classes(word):
    return block("examples/labs/TEACHING.md", "On a cluster", word)


class Cluster(base.Case):
    def setUp(self):
        super().setUp()
        self.environment = {**os.environ, "XDG_CACHE_HOME": self.path("cache"),
                            "PATH": base.EXAMPLES + ":" + os.environ["PATH"]}

    def sh(self, *command, **more):
        """Runs a command that must succeed, at most `PATIENCE` long."""
        result = subprocess.run(command, cwd=self.folder, env=self.environment, text=True,
                                capture_output=True, timeout=base.PATIENCE, **more)
        self.assertEqual(result.returncode, 0, (command, result.stdout, result.stderr))
        return result.stdout

    def shell(self, text):
        return self.sh("sh", "-ec", text)

    def cluster(self, *arguments):
        process = subprocess.Popen([os.path.join(base.SOURCE, "examples/cluster"), *arguments], text=True,
                                   cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        return process

    def end_of(self, process, status=0):
        """Waits for a command. Returns what it said."""
        error = process.communicate(timeout=base.PATIENCE)[1]
        self.assertEqual(process.returncode, status, error)
        return error

    def slow_film(self, engine):
        """A film whose parts take their time."""
        self.make("bin/FourLights", "#!/bin/sh\ncase $* in *--part*) sleep 2 ;; esac\n"
                  f'exec {base.EXAMPLES}/FourLights "$@"\n')
        os.chmod(self.path("bin/FourLights"), 0o755)
        return self.cluster(engine, "6", "--", self.path("bin/FourLights"), "-n", "24", "-s", "40x30",
                            "-o", "lights.mp4")

    def wait_for(self, happened):
        end = time.monotonic() + base.PATIENCE
        while not happened():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.1)

    def assert_film(self):
        self.sh("FourLights", "-n", "24", "-s", "40x30", "-o", "one.mp4")
        self.assertTrue(self.read("lights.mp4") == self.read("one.mp4"))

    def assert_gallery(self):
        self.sh("gallery", "-s", "40x40", "-o", "one")
        for name in os.listdir(self.path("one")):
            self.assertTrue(self.read("one/" + name) == self.read("gallery/" + name), name)

    def rows(self, folder, file, measured):
        with open(self.path(folder, file), newline="") as lines:
            return sorted(tuple(value for key, value in row.items() if not re.search(measured, key))
                          for row in csv.DictReader(lines))

    def make_class(self):
        for i in range(10):
            source, folder = TREE if i % 3 else STARTER, self.path(f"class/student{i}")
            os.makedirs(folder)
            for name in os.listdir(source):
                if name.endswith((".vert", ".frag")):
                    shutil.copy(os.path.join(source, name), folder)
        self.sh("check", "--class", "class", "--lab", "5", "-o", "whole")

    def assert_class(self):
        self.shell(classes("check --merge"))
        whole = self.rows("whole", "class.csv", "seconds")
        self.assertEqual(len(whole), 10)
        self.assertEqual(self.rows("results", "class.csv", "seconds"), whole)


@needs("parallel", "make")
class OneMachine(Cluster):
    @needs("ffmpeg")
    def test_gnu_parallel_makes_a_film_a_gallery_and_a_survey(self):
        for line in films("parallel ").splitlines():
            self.shell(line.replace("parallel ", "parallel --will-cite "))
        self.assert_film()
        self.assert_gallery()
        self.sh("accuracy", "--scene", "cube", "--quick", "-s", "48x48", "-o", "one_study")
        whole = self.rows("one_study", "results.csv", "time|run_|noise")
        self.assertEqual(len(whole), 15)
        self.assertEqual(self.rows("study", "results.csv", "time|run_|noise"), whole)

    @needs("ffmpeg")
    def test_make_makes_a_film(self):
        shader = shutil.copy(os.path.join(base.SOURCE, "shaders/lighting/cone.glsl"),
                             os.makedirs(self.path("mine")) or self.path("mine"))
        self.make("Makefile", films("$(parts)"))
        self.sh("make", "-j4")
        self.assert_film()
        self.assertIn("up to date", self.sh("make", "-j4"))
        # After an interruption only the parts that have not ended run again.
        os.remove(self.path("lights.part3"))
        self.assertEqual(len(re.findall("--part", self.sh("make", "-j4"))), 1)
        self.assert_film()
        # A shader that has changed is in every picture.
        with open(shader, "a") as file:
            file.write("// edited\n")
        os.utime(shader, (time.time() + 1,) * 2)
        self.assertEqual(len(re.findall("--part", self.sh("make", "-j4"))), 8)
        self.assert_film()

    @needs("ffmpeg")
    def test_parallel_continues_after_an_interruption(self):
        process = self.slow_film("--parallel")
        self.wait_for(lambda: os.path.exists(self.path("lights.mp4.parts/000000.png")))
        process.send_signal(signal.SIGINT)
        self.assertIn("interrupted; the same command continues", self.end_of(process, 130))
        self.assertNotIn("lights.mp4", os.listdir(self.folder))
        self.end_of(self.slow_film("--parallel"))
        self.assert_film()
        self.assertNotIn("lights.mp4.cluster", os.listdir(self.folder))

    def test_one_command_makes_a_gallery_a_survey_and_a_class(self):
        said = self.end_of(self.cluster("2", "--parallel", "--", "gallery", "-s", "40x40", "-o", "gallery"))
        self.assertRegex(said, "^examples/run cluster: [01] of 2 parts\n(.*\n)*.*: 2 of 2 parts\n$")
        self.assert_gallery()
        survey = ("accuracy", "--scene", "cube", "--quick", "-s", "48x48", "-o")
        self.end_of(self.cluster("--parallel", "2", "--", *survey, "study"))
        self.sh(*survey, "one_study")
        self.assertEqual(*(self.rows(folder, "results.csv", "time|run_|noise")
                           for folder in ("study", "one_study")))
        self.make_class()
        said = self.end_of(self.cluster("--parallel", "3", "--", "check", "--class", "class", "--lab",
                                        "5", "-o", "results"))
        self.assertRegex(said, "3 of 3 parts, 10 students\n$")
        self.assertEqual(*(self.rows(folder, "class.csv", "seconds") for folder in ("whole", "results")))

    def test_a_part_that_dies_is_tried_again_and_one_that_fails_is_named(self):
        self.make("bin/LightedCube", "#!/bin/sh\ncase $* in *2/3*) test -e died || { : >died; kill -9 "
                  f"$$; }} ;; esac\nexec {base.EXAMPLES}/LightedCube \"$@\"\n")
        os.chmod(self.path("bin/LightedCube"), 0o755)
        draw = ("3", "--parallel", "--", "bin/LightedCube", "-s", "20x20", "-n", "6")
        self.assertRegex(self.end_of(self.cluster(*draw, "-o", "a%d.png")),
                         "\n.*: part 2 of 3 failed: .*; trying again: 2\n.*: 3 of 3 parts, 6 of 6 pictures\n$")
        self.assertEqual(sum(name.startswith("a") for name in os.listdir(self.folder)), 6)
        self.assertRegex(self.end_of(self.cluster(*draw, "-o", "a%d.png", "--shaders", "none"), 1),
                         "missing after 3 tries: 1 2 3; part 1 of 3 failed: .*: none: no such shader")
        self.assertRegex(self.end_of(self.cluster(*draw, "-o", "a%d.png", "--samples", "x"), 2),
                         "part 1 of 3 failed: LightedCube: --samples x")

    def test_gnu_parallel_judges_a_class(self):
        self.make_class()
        self.shell(classes("parallel ").replace("parallel ", "parallel --will-cite "))
        self.assert_class()


@needs(*DAEMONS, "sbatch", "sinfo")
@unittest.skipIf(os.getuid(), "Slurm's daemons need root")
class Slurm(Cluster):
    def start(self, *command):
        log = open(self.path("slurm", os.path.basename(command[0]) + ".log"), "ab")
        with log:
            process = subprocess.Popen(command, cwd=self.folder, env=self.environment, stdout=log,
                                       stderr=subprocess.STDOUT, start_new_session=True)
        self.addCleanup(self.end, process)
        return process

    def end(self, process):
        process.terminate()
        try:
            process.wait(30)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def setUp(self):
        super().setUp()
        host = socket.gethostname().partition(".")[0]
        place = self.path("slurm")
        os.makedirs(os.path.join(place, "munge"), 0o700)
        with open(os.open(os.path.join(place, "munge/key"), os.O_WRONLY | os.O_CREAT, 0o400),
                  "wb") as file:
            file.write(os.urandom(1024))
        self.start("munged", "--foreground", "--force",  # --force: in a folder that all may enter
                   *(f"--{what}-file={place}/munge/{what}" for what in ("key", "pid", "log", "seed")),
                   f"--socket={place}/munge/socket")
        ports = [socket.socket() for _ in range(1 + len(NODES))]
        for port in ports:
            port.bind(("127.0.0.1", 0))
        control, *own = (port.getsockname()[1] for port in ports)
        for port in ports:
            port.close()
        self.make("slurm/slurm.conf", f"""
            ClusterName=one
            SlurmctldHost={host}(127.0.0.1)
            SlurmUser=root
            SlurmdUser=root
            AuthType=auth/munge
            AuthInfo=socket={place}/munge/socket
            CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
            ProctrackType=proctrack/linuxproc
            TaskPlugin=task/none
            MpiDefault=none
            ReturnToService=2
            StateSaveLocation={place}/state
            SlurmdSpoolDir={place}/spool-%n
            SlurmdPidFile={place}/slurmd-%n.pid
            SlurmdTimeout=20
            SlurmctldPidFile={place}/slurmctld.pid
            SlurmctldPort={control}
            SelectType=select/cons_tres
            SelectTypeParameters=CR_CPU
            SlurmdParameters=config_overrides
            PartitionName=all Nodes={",".join(NODES)} Default=YES State=UP
        """.replace("\n            ", "\n") + "".join(
            f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs={TASKS}\n"
            for name, port in zip(NODES, own)))
        os.mkdir(os.path.join(place, "state"))
        self.environment["SLURM_CONF"] = os.path.join(place, "slurm.conf")
        self.start("slurmctld", "-D", "-c")
        self.nodes = {name: self.start("slurmd", "-D", "-c", "-N", name) for name in NODES}
        end = time.monotonic() + base.PATIENCE
        while subprocess.run(["sinfo", "-h", "-N", "-o", "%t"], env=self.environment, text=True,
                             capture_output=True).stdout.split() != ["idle"] * len(NODES):
            if time.monotonic() > end:
                logs = b"".join(self.read("slurm/" + name + ".log")[-500:] for name in DAEMONS)
                self.fail(f"a node does not come up: {logs.decode()}")
            time.sleep(0.2)

    def batch(self, job):
        """Submits an array and waits for it. Returns how many tasks it had."""
        self.make("job.sh", job)
        self.sh("sbatch", "--wait", "job.sh")
        return int(re.search(r"--array=1-(\d+)", job)[1])

    @needs("ffmpeg")
    def test_an_array_makes_a_film(self):
        tasks = self.batch(films("#SBATCH"))
        logs = [name for name in os.listdir(self.folder) if re.match(r"slurm-\d+_\d+\.out", name)]
        self.assertEqual((len(logs), [self.read(name) for name in logs]), (tasks, [b""] * tasks))
        self.sh("FourLights", "-n", "24", "-s", "40x30", "-o", "lights.mp4", "--merge")
        self.assert_film()

    def test_an_array_judges_a_class(self):
        self.make_class()
        os.mkdir(self.path("parts"))
        self.batch(classes("#SBATCH"))
        self.assert_class()

    def kill_node(self, name):
        """As if its machine had lost power: the daemon, the steps and what they run."""
        jobs = self.sh("squeue", "-h", "-w", name, "-t", "R", "-o", "%A").split()
        self.assertTrue(jobs)
        self.nodes[name].kill()
        self.nodes[name].wait()
        for process in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{process}/environ", "rb") as file:
                    environment = file.read().split(b"\0")
                with open(f"/proc/{process}/cmdline", "rb") as file:
                    line = file.read().decode(errors="replace")
            except OSError:
                continue
            step = re.match(r"slurmstepd: \[(\d+)\.", line)
            if f"SLURM_CONF={self.path('slurm/slurm.conf')}".encode() in environment and (
                    step and step[1] in jobs or f"SLURMD_NODENAME={name}".encode() in environment):
                os.kill(int(process), signal.SIGKILL)

    def test_a_node_that_dies_costs_no_picture(self):
        process = self.slow_film("--slurm")
        self.wait_for(lambda: self.sh("squeue", "-h", "-w", "two", "-t", "R"))
        self.kill_node("two")
        said = self.end_of(process)
        self.assertRegex(said, "6 of 6 parts, 24 of 24 pictures\n$")
        self.assert_film()

    def test_a_command_that_was_ended_waits_for_the_parts_again(self):
        process = self.slow_film("--slurm")
        self.wait_for(lambda: self.sh("squeue", "-h", "-t", "R"))
        process.send_signal(signal.SIGINT)
        self.assertRegex(self.end_of(process, 130), "the parts go on in Slurm; the same command waits")
        self.end_of(self.slow_film("--slurm"))
        self.assert_film()
        self.assertEqual(len(set(self.sh("squeue", "-h", "-t", "all", "-o", "%F").split())), 1)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # ends the daemons, too
    sys.exit(base.main())
