#!/usr/bin/python3
"""Command lines in the documents agree with the help texts of the programs."""

import functools
import os
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

from stack import BIN_DIR, ROOT, run

# Shell words that separate two command lines.
SEPARATORS = {";", "&&", "||", "|", "&", "(", ")", ">", "<"}


def tracked(*patterns):
    listed = run(["git", "-C", ROOT, "ls-files", "--cached", "--others", "--exclude-standard", *patterns]).stdout
    return [ROOT / name for name in listed.splitlines() if (ROOT / name).exists()]


@functools.cache
def commands():
    """All commands for users: name as in the documents -> file."""
    # nao-bare-sender is the baseline that nao-bench-gateway starts; users do not call it.
    found = {file.name: file for file in BIN_DIR.glob("nao*") if "_" not in file.name and file.name != "nao-bare-sender"}
    for file in tracked("scripts/*", ".ci/*", "test/*.py", "test/playback/record", "tools/*.py"):
        if os.access(file, os.X_OK):
            found[str(file.relative_to(ROOT))] = file
    return found


@functools.cache
def help_text(*words):
    result = run([*words, "--help"])
    assert result.returncode == 0, f"{words}: {result.returncode} {result.stderr}"
    return result.stdout


def subcommands(text):
    section = re.search(r"^Subcommands:\n((?:[ \t]+.*\n?)*)", text, re.MULTILINE)
    return set(re.findall(r"^  (\S+)", section[1], re.MULTILINE)) if section else set()


def options(text):
    return set(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", text))


def words_of(line):
    lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    try:
        return list(lexer)
    except ValueError:  # a quotation mark in a sentence
        return line.split()


def command_lines(text):
    """Lines of code of a document: indented and fenced blocks, and `inline code`."""
    fenced = re.findall(r"^```\w*\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    outside = re.sub(r"^```\w*\n.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    lines = [line for block in fenced for line in block.splitlines() if not re.search("[│─]", line)]  # no diagrams
    lines += re.findall(r"^    (\S.*)$", outside, re.MULTILINE)
    return lines + re.findall(r"`([^`]+)`", outside)


def calls(line):
    """The command lines within a line. @return [(name, [word after it])]."""
    found, current = [], None
    for word in words_of(line.split(" # ")[0]):
        name = re.sub(r"^(?:\./)?(?:build/[a-z]+/bin/)?", "", word)
        if current is None and name in commands():
            current = (name, [])
            found.append(current)
        elif word in SEPARATORS or word == "--":  # after it, another program's options
            current = None
        elif current is not None:
            current[1].append(re.sub(r"^\[|\]$", "", word))
    return found


def complaint(name, words):
    """Contradiction between a call and the help texts of its command; None if there is none."""
    path = [commands()[name]]
    text = help_text(*path)
    for word in words:
        if word.startswith("--"):
            if word.split("=")[0].rstrip(",:") not in options(text) | {"--help", "--version"}:
                return f"{' '.join([name, *map(str, path[1:])])} has no option {word}"
            continue
        # Alternatives: list|take. Capitals are placeholders.
        known = subcommands(help_text(*path))
        if known and word.isupper():
            text += "".join(help_text(*path, name) for name in known)
        for alternative in word.split("|") if known else []:
            if re.fullmatch(r"[a-z][a-z-]*", alternative) and alternative not in known:
                return f"{name} has no subcommand {alternative}"
        if known and word.split("|")[0] in known:
            path.append(word.split("|")[0])
            text += help_text(*path)
    return None


class HelpTexts(unittest.TestCase):
    def test_what_documents_call_is_what_help_texts_know(self):
        num_calls = 0
        for document in tracked("*.md"):
            for line in command_lines(document.read_text()):
                for name, words in calls(line):
                    num_calls += 1
                    with self.subTest(document=str(document.relative_to(ROOT)), line=line):
                        self.assertIsNone(complaint(name, words))
        self.assertGreater(num_calls, 100)

    def test_nao_without_its_tools_says_how_to_build_them(self):
        with tempfile.TemporaryDirectory() as folder:
            alone = shutil.copy(BIN_DIR / "nao", folder)
            result = subprocess.run([alone, "log", "info", "run.lcmlog"], check=False, capture_output=True, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertIn(f"nao log is in the program nao-tools, which is not in {folder}; build it:", result.stderr)

    def test_help_needs_no_data(self):
        for name, file in commands().items():
            if file.parent == BIN_DIR:
                for words in [[], *[[word] for word in subcommands(help_text(file))]]:
                    with self.subTest(program=name, words=words):
                        result = run([file, *words, "--help"], env={**os.environ, "NAO_REMOTE_DATA": "/no/such"})
                        self.assertEqual(result.returncode, 0, result.stderr)

    def test_every_option_that_is_named_alone_belongs_to_some_command(self):
        known = options("".join(help_text(file) for file in commands().values()))
        for document in tracked("*.md"):
            for option in re.findall(r"`(--[a-z][a-z0-9-]*)", document.read_text()):
                with self.subTest(document=str(document.relative_to(ROOT)), option=option):
                    self.assertIn(option, known)

    def test_scripts_explain_every_option_that_they_take(self):
        for name, file in commands().items():
            source = file.read_bytes()
            if not source.startswith(b"#!/usr/bin/env bash"):
                continue
            for taken in re.findall(r"^\s+(?:[\w-]+ \| )*(--[a-z-]+)(?: \| [\w-]+)*\)", source.decode(), re.MULTILINE):
                with self.subTest(script=name, option=taken):
                    self.assertIn(taken, options(help_text(file)) | {"--help"})

    def test_the_readme_of_nao_names_every_subcommand(self):
        page = (ROOT / "tools/nao/README.md").read_text()
        for name in subcommands(help_text(BIN_DIR / "nao")):
            with self.subTest(subcommand=name):
                self.assertRegex(page, rf"(?m)^    nao {name}\b")


if __name__ == "__main__":
    unittest.main()
