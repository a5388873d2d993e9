#!/usr/bin/env python3
"""What the pages show of GNU parallel, make and Slurm: run as it stands there, but with small pictures.

usage: cluster_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]

What the parts make together is what one process makes. Slurm is one node that takes four tasks at
once: its daemons are started with a configuration of their own, in a temporary folder, on free ports
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

TASKS = 4
TREE = os.path.join(base.SOURCE, "tests/labs/solutions/lab05_per_fragment")
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

    def test_gnu_parallel_judges_a_class(self):
        self.make_class()
        self.shell(classes("parallel ").replace("parallel ", "parallel --will-cite "))
        self.assert_class()


@needs(*DAEMONS, "sbatch", "sinfo")
@unittest.skipIf(os.getuid(), "Slurm's daemons need root")
class Slurm(Cluster):
    def start(self, *command):
        log = open(self.path("slurm", os.path.basename(command[0]) + ".log"), "wb")
        with log:
            process = subprocess.Popen(command, cwd=self.folder, env=self.environment, stdout=log,
                                       stderr=subprocess.STDOUT, start_new_session=True)
        self.addCleanup(self.end, process)

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
        ports = [socket.socket() for _ in range(2)]
        for port in ports:
            port.bind(("127.0.0.1", 0))
        control, node = (port.getsockname()[1] for port in ports)
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
            SlurmdSpoolDir={place}/spool
            SlurmctldPidFile={place}/slurmctld.pid
            SlurmdPidFile={place}/slurmd.pid
            SlurmctldPort={control}
            SlurmdPort={node}
            SelectType=select/cons_tres
            SelectTypeParameters=CR_CPU
            SlurmdParameters=config_overrides
            NodeName={host} NodeAddr=127.0.0.1 CPUs={TASKS}
            PartitionName=all Nodes={host} Default=YES State=UP
        """.replace("\n            ", "\n"))
        os.mkdir(os.path.join(place, "state"))
        os.mkdir(os.path.join(place, "spool"))
        self.environment["SLURM_CONF"] = os.path.join(place, "slurm.conf")
        self.start("slurmctld", "-D", "-c")
        self.start("slurmd", "-D", "-c")
        end = time.monotonic() + base.PATIENCE
        while "idle" not in subprocess.run(["sinfo", "-h", "-o", "%t"], env=self.environment,
                                           capture_output=True, text=True).stdout:
            if time.monotonic() > end:
                logs = b"".join(self.read("slurm/" + name + ".log")[-500:] for name in DAEMONS)
                self.fail(f"the node does not come up: {logs.decode()}")
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


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # ends the daemons, too
    sys.exit(base.main())
