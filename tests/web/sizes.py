"""What the pages weigh, packed by gzip as a server sends them.

usage: sizes.py FOLDER_OF_THE_PAGES   prints the table of examples/web/README.md
"""
import functools
import gzip
import pathlib
import re
import sys


@functools.lru_cache(None)
def packed(path):
    return len(gzip.compress(path.read_bytes(), 9, mtime=0))


def loaded(site, name):
    """The files that a page loads: scripts, styles, pictures other than a chapter's, which come when they are in sight."""
    text = (site / f"{name}.html").read_text(encoding="utf-8")
    return [site / file for file in re.findall(r'<(?:script|img) src="(.*?)"|<link rel="stylesheet" href="(.*?)"', text)
            for file in file if file and not re.match(r"chapter\d\d_", file)] + [
                site / "lighting.js"] * bool(re.search(r'<figure class="(?:live|formula)"', text))  # if one is in sight


def sizes(site):
    """(name, all that the page loads, the page without what others load, the single file or 0) in bytes, in order of name."""
    site = pathlib.Path(site)
    for path in sorted(site.glob("*.html")):
        single = site / "single" / path.name
        own = packed(path)
        yield path.stem, own + sum(map(packed, loaded(site, path.stem))), own, packed(single) if single.exists() else 0


def table(site):
    print("| page | kB, with all that it loads | kB of its own | kB as one file |\n|---|---|---|---|")
    for name, whole, own, single in sizes(site):
        alone = f"{single / 1000:.1f}" if single else ""
        print(f"| `{name}` | {whole / 1000:.1f} | {own / 1000:.1f} | {alone} |")


def read(page):
    """The table's rows as sizes() gives them."""
    rows = re.findall(r"^\| `(\w+)` \| ([\d.]+) \| ([\d.]+) \| ([\d.]*) \|$", page, re.MULTILINE)
    return [(name, *(1000 * float(size or 0) for size in more)) for name, *more in rows]


if __name__ == "__main__":
    table(sys.argv[1])
