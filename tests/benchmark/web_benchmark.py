#!/usr/bin/env python3
"""The time of a frame, drawn and read back, in a browser and natively: in turn, by the same C on the same driver.

usage: web_benchmark.py EXAMPLES_FOLDER_OF_THE_BUILD WEB_FRAMES SOURCE_FOLDER [--markdown] [--short]

Prints a table in Markdown, either way; --short measures one round, to see that it works. Exit code: 77 without Emscripten,
Chromium or a driver that draws.
"""
import os
import re
import statistics
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../web"))
import browser
import pages

PROGRAMS = ["LightedCube_animation", "PointLightedSphere", "PointLightedSphere_perFragment", "ShadingModels", "FourLights",
            "FourLights --shadows=volumes"]
FRAMES, ROUNDS = 20, 21
SCRIPT = """(async () => {
    window.own = await Engine.open(Page.page.compiled, document.createElement("canvas"));
    window.frameTime = (lines, start, count) => {
        if (own.run(lines) || !own.draw(start, [0, 0, 1]))
            throw own.message;
        const begin = performance.now();
        for (let i = 0; i < count; i++)
            if (!own.draw(start + 0.1 * i, [0, 0, 1]))
                throw own.message;
        return (performance.now() - begin) / count;
    };
})()"""


def natively(process, program, start):
    process.stdin.write(f"{start} {FRAMES} {program}\n")
    process.stdin.flush()
    answer = process.stdout.readline()
    if not answer:
        sys.exit(f"web_benchmark: {program}: web_frames ended")
    return float(answer)


def in_browser(page, program, start):
    return page.run(f"frameTime({program.split()}, {start}, {FRAMES})")


def cell(values, digits):
    lower, middle, upper = statistics.quantiles(values, n=4) if len(values) > 1 else 3 * values
    return f"{middle:.{digits}f} [{lower:.{digits}f}, {upper:.{digits}f}]"


def measure(process, page, rounds):
    emcc = subprocess.run(["emcc", "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    print(f"In the browser: {re.search(r'Chrome/[0-9]+', page.run('navigator.userAgent'))[0]}; "
          f"{page.run(pages.RENDERER)}; emcc {re.search(r'[0-9]+[.][0-9.]+', emcc)[0]} -Oz\n")
    print("| frames of 400x400 | natively, ms | in Chromium, ms | Chromium over native | native again (the noise) |")
    print("|---|---|---|---|---|")
    for program in PROGRAMS:
        rows = []
        for turn in range(rounds + 1):
            start = 0.1 * turn
            rows.append((natively(process, program, start), in_browser(page, program, start), natively(process, program, start)))
        first, drawn, again = zip(*rows[1:])  # the first round warms up
        print(f"| `{program.replace('=', ' ')}` | {cell(first, 2)} | {cell(drawn, 2)} "
              f"| {cell([a / b for a, b in zip(drawn, first)], 2)} "
              f"| {cell([a / b for a, b in zip(again, first)], 2)} |", flush=True)


def main():
    code = pages.make()
    if code:
        return code
    options = sys.argv[4:]
    process = subprocess.Popen([pages.PAGE_NATIVE, *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    for line in process.stdout:
        print(line, end="", flush=True)
        if line == "\n":
            break
    else:
        return process.wait()
    with browser.Browser(*browser.MESA) as page:
        page.open(pages.address("LightedCube"))
        renderer = page.run(pages.RENDERER)
        if "Mesa" not in renderer and "llvmpipe" not in renderer:
            print(f"web_benchmark: Chromium draws with {renderer}, not with Mesa", file=sys.stderr)
            return 77
        page.run(SCRIPT)
        measure(process, page, 1 if "--short" in options else ROUNDS)
    process.stdin.close()
    return process.wait()


if __name__ == "__main__":
    sys.exit(main())
