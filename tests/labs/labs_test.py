#!/usr/bin/env python3
"""The labs as students and teachers use them: starters, solutions, mistakes, faults, `check`.

usage: labs_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]
       labs_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER --many [SEEDS [PAIRS]]

The second prints how often `check` names the mistakes of mistakes.py, each alone in SEEDS seeds
(20), and PAIRS pairs of two for each lab (100). The first takes some of them.

The wrong programs are edits of the solutions' texts and share nothing with check's own catalogue.
Exit code: 77 where nothing can be drawn.
"""
import concurrent.futures
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path[:0] = [os.path.dirname(HERE), HERE]
import command_line_test as base
import faults
import mistakes

LABS = mistakes.NAMES
EXAMPLES = os.path.join(base.SOURCE, "examples", "labs")
CHECK = next(
    (
        path
        for path in (
            os.path.join(base.EXAMPLES, "labs", "check"),
            os.path.join(base.EXAMPLES, "check"),
        )
        if os.path.exists(path)
    ),
    None,
)
WORKERS = os.cpu_count() or 1


def run_check(lab, folder, seed=1, *more):
    """The exit code and what `check` writes as JSON."""
    name = LABS[lab]
    done = subprocess.run(
        [CHECK, name, folder, "--seed", str(seed), "--json", "-", "--limit", "60", *more],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=120,
    )
    if not done.stdout.startswith(b"{"):
        raise AssertionError(
            f"{name} {folder}: {done.returncode}: {done.stderr.decode()} {done.stdout[:200]}"
        )
    return done.returncode, json.loads(done.stdout)


def check_texts(lab, texts, seed=1):
    with tempfile.TemporaryDirectory(prefix="labs_test-") as folder:
        for name, text in texts.items():
            with open(os.path.join(folder, name), "w") as file:
                file.write(text)
        return run_check(lab, folder, seed)[1]


def in_parallel(function, jobs):
    with concurrent.futures.ThreadPoolExecutor(WORKERS) as pool:
        return list(pool.map(lambda job: function(*job), jobs))


def named(result):
    return [mistake["name"] for mistake in result["mistakes"]]


def pictures(result):
    """What tells drawn scenes apart: equal errors everywhere are equal pictures."""
    return [(probe["maximum"], probe["rms"]) for probe in result["probes"]]


def outcome(result, kinds):
    """named, one (of two), unnamed, unseen or MISNAMED: for a text with these mistakes."""
    names = set(named(result))
    if not names:
        return "unseen" if result["verdict"] == "right" else "unnamed"
    accepted = [mistakes.CALLED.get(kind, {kind}) for kind in kinds]
    # Of several that look alike, one has to be true; else all.
    if result["one_of"]:
        return "MISNAMED" if not names & set.union(*accepted) else ("named", "one")[len(kinds) - 1]
    if not names <= set.union(*accepted):
        return "MISNAMED"
    return "named" if all(of & names for of in accepted) else "one"


def judge_single(lab, name, seed):
    result = check_texts(lab, mistakes.single(lab, name, seed % 2), seed)
    return lab, name, seed, outcome(result, [name]), result


def judge_pair(lab, first, second, seed):
    """Where one of two hides the other, the other one's name is right alone; so is that of a third
    which is the same as both."""
    result = check_texts(lab, mistakes.pair(lab, first, second, seed % 2), seed)
    said = outcome(result, [first, second])
    if named(result) == [mistakes.THIRD.get((first, second))]:
        said = "hidden"
    if said in ("one", "unnamed"):
        for one in (first, second):
            if pictures(check_texts(lab, mistakes.single(lab, one, seed % 2), seed)) == pictures(
                result
            ):
                said = "hidden"
    return lab, f"{first} + {second}", seed, said, result


def pairs_of(lab, count, chance):
    names = mistakes.of_lab(lab)
    every = [
        (a, b) for i, a in enumerate(names) for b in names[i + 1 :] if mistakes.pair(lab, a, b)
    ]
    return chance.sample(every, min(count, len(every)))


def tally(rows):
    counts = {}
    for row in rows:
        counts[row[3]] = counts.get(row[3], 0) + 1
    return counts


def share(counts, total):
    return counts.get("named", 0) / total if total else 1.0


class Labs(base.Case):
    def folder_of(self, lab, kind="solutions"):
        return (
            os.path.join(HERE, kind, LABS[lab])
            if kind != "starter"
            else os.path.join(EXAMPLES, LABS[lab])
        )

    def assert_right(self, jobs):
        for (lab, folder, seed), (code, result) in zip(jobs, in_parallel(run_check, jobs)):
            worst = max((probe["maximum"] for probe in result["probes"]), default=None)
            said = (folder, seed, result["message"], result.get("details"), named(result), worst)
            self.assertEqual((result["verdict"], code), ("right", 0), said)
            # In lab 10 the rest of the points is for what it costs; who computes in 16 bits is
            # right, but for scenes that are too large for them.
            least = 5 if lab == 10 else 9 if named(result) == ["mediump overflow"] else 10
            self.assertGreaterEqual(result["points"], least, said)


class Right(Labs):
    def test_the_solutions_are_right_in_every_seed(self):
        self.assert_right([(lab, self.folder_of(lab), seed) for lab in LABS for seed in (1, 2, 77)])

    def test_a_right_solution_written_differently_is_right(self):
        jobs = []
        for lab in LABS:
            folder = self.folder_of(lab, "alternatives")
            names = sorted(os.listdir(folder))
            self.assertGreaterEqual(len(names), 5, folder)
            jobs += [(lab, os.path.join(folder, name), 3) for name in names]
        self.assert_right(jobs)

    def test_the_starters_are_wrong_and_say_so(self):
        jobs = [(lab, self.folder_of(lab, "starter"), 1) for lab in LABS]
        for (lab, _, _), (code, result) in zip(jobs, in_parallel(run_check, jobs)):
            self.assertEqual((result["verdict"], code), ("wrong", 1), LABS[lab])
            self.assertLess(result["points"], result["most"] / 2, LABS[lab])

    def test_each_task_is_complete(self):
        for lab, name in LABS.items():
            with open(os.path.join(EXAMPLES, name, "TASK.md")) as file:
                text = file.read()
            for part in (
                "expected.png",
                "## What there is",
                "## What to do",
                "## What to read",
                "## Run and check",
                "## Points",
                f"check lab{lab:02} mine",
            ):
                self.assertIn(part, text, name)
            for path in re.findall(r"`((?:examples|shaders|common)/[\w./]+\.\w+)`", text):
                self.assertTrue(os.path.exists(os.path.join(base.SOURCE, path)), f"{name}: {path}")
            self.assertFalse(os.listdir(os.path.join(EXAMPLES, name)) == [])

    def test_the_expected_pictures_are_the_exact_ones(self):
        for lab, name in LABS.items():
            picture = self.path("expected.png")
            subprocess.run([CHECK, name, "--expected", picture], check=True, timeout=120)
            with open(os.path.join(EXAMPLES, name, "expected.png"), "rb") as file:
                kept = base.Png(file.read())
            self.assertEqual(kept.pixels, self.png("expected.png").pixels, name)


class Wrong(Labs):
    """A sample; --many has them all."""

    def test_a_mistake_alone_is_named(self):
        jobs = [
            (lab, name, 5 + i % 3)
            for lab in LABS
            for i, name in enumerate(mistakes.of_lab(lab))
            if i % 3 == lab % 3
        ]
        rows = in_parallel(judge_single, jobs)
        said = [row[:4] + (named(row[4]),) for row in rows if row[3] != "named"]
        self.assertFalse([row for row in rows if row[3] == "MISNAMED"], said)
        self.assertGreaterEqual(share(tally(rows), len(rows)), 0.95, said)

    def test_two_at_once_are_named(self):
        chance = random.Random(7)
        jobs = [
            (lab, first, second, 9) for lab in LABS for first, second in pairs_of(lab, 4, chance)
        ]
        rows = in_parallel(judge_pair, jobs)
        seen = [row for row in rows if row[3] != "hidden"]
        said = [row[:4] + (named(row[4]),) for row in rows if row[3] not in ("named", "hidden")]
        self.assertFalse([row for row in seen if row[3] == "MISNAMED"], said)
        self.assertGreaterEqual(share(tally(seen), len(seen)), 0.7, said)

    def test_what_is_no_known_mistake_gets_no_name(self):
        jobs = [(*mistakes.art(name), 4) for name in mistakes.ART]
        for name, result in zip(mistakes.ART, in_parallel(check_texts, jobs)):
            self.assertEqual(
                result["verdict"], "wrong", (name, result["message"], result.get("details"))
            )
            self.assertEqual(named(result), [], name)
            self.assertTrue(result["symptoms"], name)


class Faults(Labs):
    def test_a_fault_is_told_with_its_line_and_what_it_means(self):
        jobs = [(lab, texts) for (lab, texts), _, _ in faults.FAULTS.values()]
        for (name, (_, where, meaning)), result in zip(
            faults.FAULTS.items(), in_parallel(check_texts, jobs)
        ):
            said = result["message"] + "\n" + result.get("details", "")
            self.assertEqual(result["verdict"], "error", f"{name}: {said}")
            self.assertEqual(result["points"], 0, name)
            if where:
                self.assertRegex(result["message"], rf"^lab\d\d\.{where}:\d+: ", name)
            own = [
                line
                for line in said.split("\n")
                if not re.match(r"lab\d\d\.\w+:\d+: |  *\d+ \|", line)
            ]
            self.assertRegex("\n".join(own), meaning, f"{name}: {said}")

    def refused_with(self, lab, folder, *patterns):
        code, result = run_check(lab, folder)
        self.assertEqual(code, 1, result)
        self.assertIn(result["verdict"], ("error", "refused"), result)
        self.assertEqual(result["points"], 0, result)
        for pattern in patterns:
            self.assertRegex(result["message"], pattern)
        return result

    def copy(self, lab, name="mine"):
        shutil.copytree(self.folder_of(lab), self.path(name))
        return self.path(name)

    def edit(self, path, old, new):
        with open(path) as file:
            text = file.read()
        self.assertIn(old, text)
        with open(path, "w") as file:
            file.write(text.replace(old, new))

    def test_what_is_no_submission(self):
        empty = self.path("empty")
        os.mkdir(empty)
        self.refused_with(5, empty, r"lab05\.vert")
        self.refused_with(3, empty, r"matrices\.c")
        self.refused_with(5, self.path("nowhere"), r"nowhere")
        mine = self.copy(5)
        os.remove(os.path.join(mine, "lab05.frag"))
        self.refused_with(5, mine, r"lab05\.frag")
        os.mkdir(os.path.join(mine, "lab05.frag"))
        self.refused_with(5, mine, r"lab05\.frag")
        self.refused_with(5, os.path.join(mine, "lab05.vert"), r"lab05\.vert")

    def test_files_that_are_no_text(self):
        for name, content, said in (
            ("garbage", bytes(range(256)) * 40, r"lab05\.frag"),
            (
                "huge",
                b"// " + b"x" * 10_000_000 + b"\n",
                r"lab05\.frag.*larger|lab05\.frag.*large|lab05\.frag.*bytes",
            ),
            ("zeros", bytes(5000), r"lab05\.frag"),
            ("empty", b"", r"lab05\.frag"),
        ):
            mine = self.copy(5, name)
            with open(os.path.join(mine, "lab05.frag"), "wb") as file:
                file.write(content)
            self.refused_with(5, mine, said)

    def test_a_line_that_is_not_utf_8_is_quoted(self):
        mine = self.copy(5)
        with open(os.path.join(mine, "lab05.frag"), "ab") as file:
            file.write(b"#error \xb0\xa1\xff\n")
        self.refused_with(5, mine, r"lab05\.frag:\d+: .*\ufffd")

    def test_links_pipes_and_what_may_not_be_read(self):
        mine = self.copy(5)
        path = os.path.join(mine, "lab05.frag")
        os.remove(path)
        os.symlink("/etc/passwd", path)
        result = self.refused_with(5, mine, r"lab05\.frag")
        self.assertNotIn("root:", json.dumps(result))
        os.remove(path)
        os.mkfifo(path)
        self.refused_with(5, mine, r"lab05\.frag")
        os.remove(path)
        if os.getuid() != 0:
            self.make("mine/lab05.frag")
            os.chmod(path, 0)
            self.refused_with(5, mine, r"lab05\.frag")

    def test_an_include_stays_in_its_folder(self):
        for name in ("/etc/passwd", "../other/secret.glsl", "/dev/zero", "common.h"):
            self.make("other/secret.glsl", "secret\n")
            mine = self.copy(1, "mine" + str(abs(hash(name))))
            with open(os.path.join(mine, "lab01.frag"), "a") as file:
                file.write(f'#include "{name}"\n')
            result = self.refused_with(1, mine, r"lab01\.frag")
            self.assertNotIn("root:", json.dumps(result))
            self.assertNotIn("secret\n", json.dumps(result))

    def test_c_that_does_not_compile_or_end(self):
        head = '#include "lab_code.h"\nvoid lab_matrices(double s, Mat4 *w, Mat4 *n)\n{\n'
        for name, text, said in (
            ("semicolon", head + "    *w = mat4_identity()\n}\n", r"matrices\.c:4"),
            ("missing", '#include "lab_code.h"\nstatic int unused;\n', r"function|lab_matrices"),
            ("forbidden", "#include <stdio.h>\n" + head + '    puts("x");\n}\n', r"may be included"),
            ("crash", head + "    *(volatile int *)8 = 1;\n}\n", r"."),
        ):
            self.make(f"{name}/matrices.c", text)
            code, result = run_check(3, self.path(name))
            self.assertEqual(code, 1, name)
            self.assertIn(result["verdict"], ("error", "refused"), (name, result))
            self.assertRegex(result["message"] + result["details"], said, name)
        self.make(
            "endless/matrices.c", head + "    for (volatile int i = 0;; i = 0)\n        ;\n}\n"
        )
        code, result = run_check(3, self.path("endless"), 1, "--limit", "2")
        self.assertEqual((code, result["verdict"]), (1, "timeout"), result)

    def test_the_command_line(self):
        for arguments, code, said in (
            ((), 2, "lab05"),
            (("lab05",), 2, "lab05"),
            (("lab11", "x"), 2, "lab"),
            (("lab05_per_fragmant", "x"), 2, "lab05_per_fragment"),
            (("lab05", "x", "y"), 2, ""),
            (("lab05", "x", "--seed", "a"), 2, "--seed"),
        ):
            done = subprocess.run(
                [CHECK, *arguments],
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                timeout=60,
            )
            self.assertEqual((done.returncode, done.stdout), (code, ""), arguments)
            self.assertRegex(done.stderr, rf"^check: .*{said}.*\n$", arguments)
        for name in ("5", "05", "lab5", "lab05"):
            done = subprocess.run(
                [CHECK, name, self.folder_of(5), "--seed", "1"],
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                timeout=60,
            )
            self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
            self.assertRegex(done.stdout, r"^lab05_per_fragment: right, 10 of 10 points")

    def test_the_worst_scene_is_drawn(self):
        wrong = self.folder_of(5, "starter")
        os.mkdir(self.path("found"))
        _, result = run_check(5, wrong, 1, "--pictures", self.path("found"))
        self.assertEqual(len(result["pictures"]), 1)
        sheet = self.png(os.path.join("found", result["pictures"][0]))
        self.assertGreaterEqual(sheet.width, 3 * 64)

    def test_points_for_cost_hang_on_counts_and_not_on_time(self):
        folder = self.folder_of(10)
        first, second = (run_check(10, folder)[1] for _ in range(2))
        cost = first["cost"]
        for name in ("operations", "operations_ratio"):
            self.assertEqual(cost[name], second["cost"][name], name)
        self.assertEqual(first["points"], second["points"])
        if cost["operations"] is None:
            self.skipTest(first["details"])
        self.assertGreater(cost["time_ratio"], 0)
        # All five points at 0.63 of the plain program's operations, none at as many; in halves.
        share = min(max((1 - cost["operations_ratio"]) / 0.37, 0), 1)
        self.assertEqual(first["points"], 5 + int(10 * share) / 2)
        # One that draws the insides, too, costs more.
        mine = self.copy(10)
        self.edit(os.path.join(mine, "budget.c"), "cull = true", "cull = false")
        uncut = run_check(10, mine)[1]
        self.assertGreater(uncut["cost"]["operations"], cost["operations"])
        self.assertEqual(uncut["verdict"], "right")
        self.assertLess(uncut["points"], first["points"])

    def test_what_a_seed_gives_is_always_the_same(self):
        wrong = mistakes.single(6, "reflect's sign")
        first, second = check_texts(6, wrong, 12), check_texts(6, wrong, 12)
        for result in (first, second):
            result.pop("seconds"), result.pop("path")
        self.assertEqual(first, second)
        other = check_texts(6, wrong, 13)
        known, own = (
            lambda result, kind=kind: [probe for probe in result["probes"] if probe["set"] == kind]
            for kind in ("known", "seed")
        )
        self.assertEqual(known(first), known(other))
        self.assertNotEqual(own(first), own(other))


def many(seeds, pairs):
    single = ("named", "unnamed", "MISNAMED", "unseen")
    double = ("named", "one", "unnamed", "MISNAMED", "hidden")
    print(f"{'lab':20} {'alone':>6} {'share':>6}", *(f"{word:>8}" for word in single), end="   ")
    print(f"{'pairs':>6} {'share':>6}", *(f"{word:>8}" for word in double), flush=True)
    details = []
    for lab, name in LABS.items():
        kinds = mistakes.of_lab(lab)
        jobs = [(lab, kind, seed) for kind in kinds for seed in range(100, 100 + seeds)]
        alone = in_parallel(judge_single, jobs)
        chosen = pairs_of(lab, pairs, random.Random(lab))
        two = in_parallel(judge_pair, [(lab, *pair, 500 + i) for i, pair in enumerate(chosen)])
        for rows, words, end in ((alone, single, "   "), (two, double, "\n")):
            counts = tally(rows)
            seen = len(rows) - counts.get("hidden", 0)
            print(f"{name:20} " if rows is alone else "", end="")
            print(f"{len(rows):6} {share(counts, seen):6.1%}", end=" ")
            print(*(f"{counts.get(word, 0):8}" for word in words), end=end, flush=True)
        details += [row for row in alone + two if row[3] not in ("named", "hidden")]
    print("\nnot named (how often: lab, mistake: outcome, what was said):")
    groups = {}
    for lab, kind, _, said, result in details:
        key = (LABS[lab], kind, said, ", ".join(named(result)))
        groups[key] = groups.get(key, 0) + 1
    for key, count in sorted(groups.items()):
        print(f"{count:4}  {key[0]}, {key[1]}: {key[2]}  {key[3]}", flush=True)


if __name__ == "__main__":
    if CHECK is None:
        sys.exit(77)
    if "--many" in sys.argv:
        numbers = [int(word) for word in sys.argv[sys.argv.index("--many") + 1 :]]
        many(*(numbers + [20, 100][len(numbers) :]))
        sys.exit()
    sys.exit(base.main())
