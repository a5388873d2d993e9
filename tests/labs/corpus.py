#!/usr/bin/env python3
"""Submissions that were written from the tasks alone, by authors who had not read `check`.

corpus/labNN.txt has those of a lab: a line "=== NAME/FILE" before each file; a file that is not
plain text is in base64, "=== NAME/FILE base64". The file `label` begins "right", "wrong: MISTAKE",
"two: MISTAKES", "compile: WHY NOT" or "cheat: HOW". Those whose names begin with n are new: they were written by others,
and only measured. The old ones served to improve `check`. In lab 11 those whose names begin with h, drawn by a hash of
their names, were held out until both halves had been measured; then all served. corpus/rulings.txt has, for each new
submission whose verdict or given names are not those of its label, what was decided, and why.

usage: corpus.py CHECK --half old|new [--lab N] [--every N] [--json FILE]   judges, and lists
       corpus.py CHECK --half new --table [--from FILE]   the table of examples/labs/TEACHING.md
       corpus.py --add FOLDER PREFIX   adds FOLDER/labNN/NAME to corpus/labNN.txt as PREFIXNAME
"""
import base64
import collections
import concurrent.futures
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "corpus")


def half_of(name):
    """Of "labNN/NAME"."""
    return "new" if name.split("/")[1].startswith("n") else "old"


def add(folder, prefix):
    for lab in sorted(os.listdir(folder)):
        if not lab.startswith("lab") or not os.path.isdir(os.path.join(folder, lab)):
            continue
        with open(os.path.join(HERE, f"{lab[:5]}.txt"), "a", newline="") as out:
            for name in sorted(os.listdir(os.path.join(folder, lab))):
                one = os.path.join(folder, lab, name)
                if not os.path.isfile(os.path.join(one, "label")):
                    continue
                for file in sorted(os.listdir(one)):
                    with open(os.path.join(one, file), "rb") as opened:
                        content = opened.read()
                    try:
                        text = content.decode()
                    except UnicodeDecodeError:
                        text = "\0"
                    plain = text.endswith("\n") and not set(text) & set("\0\r") and "=== " not in text
                    out.write(f"=== {prefix}{name}/{file}{'' if plain else ' base64'}\n")
                    out.write(text if plain else base64.encodebytes(content).decode())


def read(lab):
    """The submissions of a lab: the files of each by its name."""
    found = collections.defaultdict(dict)
    path = os.path.join(HERE, f"lab{lab:02}.txt")
    if not os.path.exists(path):
        return found
    with open(path, newline="") as file:
        for part in file.read().split("=== ")[1:]:
            head, text = part.split("\n", 1)
            where, *coded = head.split(" ")
            name, file_name = where.split("/")
            content = base64.b64decode(text) if coded else text.encode()
            found[name][file_name] = content
    return found


def judge(check, lab, name, files, seed=3):
    label = files["label"].decode().split("\n")[0].strip()
    with tempfile.TemporaryDirectory(prefix="corpus-") as folder:
        for file_name, content in files.items():
            if file_name != "label":
                with open(os.path.join(folder, file_name), "wb") as file:
                    file.write(content)
        done = subprocess.run(
            [check, str(lab), folder, "--seed", str(seed), "--json", "-"],
            stdin=subprocess.DEVNULL,
            capture_output=True,
        )
    row = {"lab": lab, "name": f"lab{lab:02}/{name}", "label": label}
    try:
        result = json.loads(done.stdout)
    except ValueError:
        return {**row, "verdict": "no verdict", "message": str(done.stderr), "said": []}
    return {
        **row,
        "verdict": result["verdict"],
        "message": result["message"],
        "said": [[mistake["name"], mistake["sure"], mistake["look"]] for mistake in result["mistakes"]],
    }


def jobs(half=None, lab=None, every=1):
    for number in [lab] if lab else range(1, 12):
        for i, (name, files) in enumerate(sorted(read(number).items())):
            if half in (None, half_of(f"lab{number:02}/{name}")) and i % every == 0:
                yield number, name, files


def judge_all(check, todo):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(lambda job: judge(check, *job), todo))


def rulings():
    """Submissions that `check` names wrongly."""
    path = os.path.join(HERE, "rulings.txt")
    if not os.path.exists(path):
        return set()
    with open(path) as file:
        return {line.split(" ")[0] for line in file if " wrongly named: " in line}


def outcome(row, wrongly):
    """right, passes, accused, error, refused, named, unknown or MISNAMED."""
    if row["label"].startswith("right") and row["verdict"] != "right":
        return "accused"
    if row["verdict"] == "right" and not row["said"]:
        return "right" if row["label"].startswith("right") else "passes"
    if row["verdict"] in ("error", "refused", "timeout", "no verdict"):
        return "error" if row["verdict"] == "error" else "refused"
    if row["name"] in wrongly:
        return "MISNAMED"
    if not row["said"]:
        starter = row["message"].startswith("unchanged")
        return "named" if starter else "unknown"
    return "named"


def interval(count, total):
    """Wilson's interval for 95%."""
    if not total:
        return "-"
    z, share = 1.96, count / total
    middle = (share + z * z / (2 * total)) / (1 + z * z / total)
    half = z / (1 + z * z / total) * (share * (1 - share) / total + z * z / (4 * total**2)) ** 0.5
    return f"{count} of {total}, {share:.1%} ({max(middle - half, 0):.1%} to {min(middle + half, 1):.1%})"


def table(rows):
    wrongly = rulings()
    kinds = collections.defaultdict(collections.Counter)
    for row in rows:
        kind = row["label"].split(":")[0]
        if kind == "compile" or "not compile" in row["label"] or "not link" in row["label"] or "no valid C" in row["label"]:
            kind = "broken"
        kinds[kind][outcome(row, wrongly)] += 1
    print("| submissions | outcome | count, share, 95% interval |")
    print("|---|---|---|")
    names = {
        "right": "right",
        "broken": "do not compile or link",
        "wrong": "one mistake",
        "two": "two mistakes",
        "cheat": "cheats and near misses",
    }
    words = {
        "right": "judged right",
        "passes": "judged right",
        "accused": "judged wrong",
        "error": "reported with the compiler's message",
        "refused": "refused or stopped, with the reason",
        "named": "named rightly",
        "unknown": "wrong, without a name",
        "MISNAMED": "wrongly named",
    }
    for kind, name in names.items():
        total = sum(kinds[kind].values())
        for said in words:
            if kinds[kind][said] or (said == "MISNAMED" and kind == "wrong"):
                print(f"| {name} | {words[said]} | {interval(kinds[kind][said], total)} |")
    sure = collections.Counter()
    for row in rows:
        for _, share, _ in row["said"]:
            sure[round(share, 2), row["name"] not in wrongly] += 1
    for value in sorted({key[0] for key in sure}):
        good, bad = sure[value, True], sure[value, False]
        print(f"| names called {value:.0%} sure | true | {interval(good, good + bad)} |")


def option(name, otherwise=None):
    return sys.argv[sys.argv.index(name) + 1] if name in sys.argv else otherwise


def main():
    if "--add" in sys.argv:
        add(*sys.argv[sys.argv.index("--add") + 1 :][:2])
        return
    lab = option("--lab")
    todo = list(jobs(option("--half"), lab and int(lab), int(option("--every", 1))))
    if "--from" in sys.argv:
        with open(option("--from")) as file:
            rows = json.load(file)
    else:
        rows = judge_all(sys.argv[1], todo)
    if "--table" in sys.argv:
        table(rows)
        return
    if "--json" in sys.argv:
        with open(option("--json"), "w") as file:
            json.dump(rows, file, indent=1)
    for row in rows:
        said = "; ".join(f"{name} {sure:.0%}, {look[:80]}" for name, sure, look in row["said"])
        print(f"{row['name']} | {row['label'][:100]} | {row['verdict']} | {said or row['message'][:100]}")


if __name__ == "__main__":
    main()
