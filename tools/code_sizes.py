#!/usr/bin/python3 -B
"""Counts what makes the sources hard to read: the largest classes, the longest files, repeated blocks of lines, and how
much of each .cpp file is comments. Counts by simple patterns; the numbers are places to look at, not verdicts."""

import argparse
import collections
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Sources that people write. Generated files are not tracked.
SOURCES = re.compile(r"\.(cpp|h|ts|py|mjs)$")
# Lines of a repeated block. Chosen: shorter ones are mostly the beginnings of files and loops.
BLOCK_LINES = 6


def git(*arguments):
    return subprocess.run(["git", "-C", ROOT, *arguments], check=True, stdout=subprocess.PIPE, text=True,
                          errors="replace").stdout


def read_sources(revision):
    """@return {path: text} of a revision, or of the working tree."""
    if revision:
        return {name: git("show", f"{revision}:{name}") for name in git("ls-tree", "-r", "--name-only", revision).split("\n")
                if SOURCES.search(name)}
    return {name: (ROOT / name).read_text(errors="replace") for name in git("ls-files").split("\n")
            if SOURCES.search(name) and (ROOT / name).exists()}


def classes(sources):
    """Data members and methods that classes and structs declare in headers, tests excepted: members end in "_", or, in
    a struct without any such, are declarations of variables; an inline method counts as well.
    @return [(data members, methods, name, path)], largest sum first."""
    found = []
    for path, text in sources.items():
        if not path.endswith(".h") or path.startswith("test/"):
            continue
        code = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)
        for start in re.finditer(r"\b(?:class|struct)\s+(\w+)[^;{()]*\{", code):
            depth, body = 1, []
            for letter in code[start.end():]:
                depth += (letter == "{") - (letter == "}")
                if depth == 0:
                    break
                if depth == 1:
                    body.append(letter)
            body = "".join(body)
            members = (re.findall(r"\b[a-z]\w*_\s*(?:;|=|\{|\})", body) or
                       re.findall(r"^\s+[\w:<>,&* ]+\s\w+\s*(?:=[^;]*)?;", body, re.M))
            methods = re.findall(r"\b[a-z_]\w*\s*\([^;{}]*\)\s*(?:const)?\s*(?:override)?\s*(?:;|\}|=|$)", body, re.M)
            found.append((len(members), len(methods), start[1], path))
    return sorted(found, key=lambda row: (-row[0] - row[1], row[2]))


def comment_lines(text):
    """@return (lines with a comment, lines that are not blank)"""
    comments = total = 0
    is_in_block = False
    for line in map(str.strip, text.splitlines()):
        if not line:
            continue
        total += 1
        if is_in_block or line.startswith("/*"):
            comments += 1
            is_in_block = "*/" not in line
        elif line.startswith("//") or re.search(r"[;{},)]\s+// (?!namespace)", line):
            comments += 1
    return comments, total


def repeated_blocks(sources):
    """Runs of at least BLOCK_LINES equal lines in two places, not counting blank lines, comments, lines without a
    letter, and lines that include or import. @return [(lines, path and line of both)], longest first."""
    places = collections.defaultdict(list)
    lines_of = {}
    for path, text in sources.items():
        kept = [(number, " ".join(line.split())) for number, line in enumerate(text.splitlines(), 1)]
        kept = [(number, line) for number, line in kept
                if re.search("[A-Za-z]", line) and not re.match(r"//|/?\*|#|import |from |using |namespace ", line)]
        lines_of[path] = kept
        for i in range(len(kept) - BLOCK_LINES + 1):
            places[tuple(line for _, line in kept[i:i + BLOCK_LINES])].append((path, i))
    blocks, seen = [], set()
    for found in places.values():
        for first, second in zip(found, found[1:]):
            if (first, second) in seen:
                continue
            length = 0
            while True:
                a, b = ((path, i + length) for path, i in (first, second))
                if max(a[1] - len(lines_of[a[0]]), b[1] - len(lines_of[b[0]])) >= 0:
                    break
                if lines_of[a[0]][a[1]][1] != lines_of[b[0]][b[1]][1]:
                    break
                seen.add((a, b))
                length += 1
            if length >= BLOCK_LINES:
                blocks.append((length, *(f"{path}:{lines_of[path][i][0]}" for path, i in (first, second))))
    return sorted(blocks, reverse=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--revision", help="count these sources of git instead of the working tree")
    parser.add_argument("--most", type=int, default=10, help="rows of each list (default: 10)")
    options = parser.parse_args()
    sources = read_sources(options.revision)

    found = classes(sources)
    print(f"Classes with more than 20 data members: {sum(row[0] > 20 for row in found)}, "
          f"with more than 25 methods: {sum(row[1] > 25 for row in found)}")
    for members, methods, name, path in found[:options.most]:
        print(f"  {members:3} / {methods:3}  {name:24} {path}")
    sizes = sorted(((len(text.splitlines()), path) for path, text in sources.items()), reverse=True)
    print(f"Sources with more than 400 lines: {sum(size > 400 for size, _ in sizes)}")
    for size, path in sizes[:options.most]:
        print(f"  {size:5}  {path}")
    blocks = repeated_blocks(sources)
    print(f"Repeated blocks of {BLOCK_LINES} lines or more: {len(blocks)}")
    for length, first, second in blocks[:options.most]:
        print(f"  {length:5}  {first} = {second}")
    rows = [(*comment_lines(text), path) for path, text in sources.items()
            if path.endswith(".cpp") and not path.startswith("test/")]
    comments, total = (sum(row[i] for row in rows) for i in (0, 1))
    print(f"Comments in .cpp files without tests: {100 * comments / total:.1f} % of {total} lines that are not blank")
    long_rows = sorted((100 * count / size, size, path) for count, size, path in rows if size > 80)
    print(f"Files above 80 such lines with less than 5 %: {sum(row[0] < 5 for row in long_rows)}")
    for percent, size, path in long_rows[:options.most]:
        print(f"  {percent:4.1f} % of {size:4}  {path}")


if __name__ == "__main__":
    main()
