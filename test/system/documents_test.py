#!/usr/bin/python3
"""Commands in the documents work, and their links have targets."""

import os
import re
import subprocess
import unittest

from stack import BIN_DIR, DEADLINE, ROOT, Stack, run


def documents():
    """Every Markdown file of the project."""
    listed = run(["git", "-C", ROOT, "ls-files", "--cached", "--others", "--exclude-standard", "*.md"]).stdout
    return [ROOT / name for name in listed.splitlines() if (ROOT / name).exists()]


def commands(path):
    """The lines of the ```sh blocks of a file, without comments."""
    blocks = re.findall(r"^```sh\n(.*?)^```", path.read_text(), re.MULTILINE | re.DOTALL)
    lines = [line.split("#")[0].strip() for block in blocks for line in block.splitlines()]
    return [line for line in lines if line]


class Documents(unittest.TestCase):
    def test_every_command_of_the_readme_works_in_its_order(self):
        found = commands(ROOT / "README.md")
        self.assertIn("scripts/start", found)
        found.remove("scripts/test")  # what runs this
        with Stack() as stack:
            environment = {**os.environ, "NAO_REMOTE_BIN": str(BIN_DIR), "NAO_REMOTE_RUN_DIR": str(stack.run_dir),
                           "LCM_DEFAULT_URL": stack.lcm_url}
            for command in found:
                with self.subTest(command=command):
                    here = command.replace("build/dev/bin", str(BIN_DIR))
                    result = subprocess.run(here, shell=True, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL,
                                            capture_output=True, text=True, timeout=DEADLINE, check=False)
                    self.assertEqual(result.returncode, 0, result.stdout + result.stderr + stack.logs())
            self.assertEqual(stack.pids(), {})

    def test_every_link_leads_to_a_file(self):
        for document in documents():
            for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", document.read_text()):
                if "://" not in target:
                    with self.subTest(document=document.name, target=target):
                        self.assertTrue((document.parent / target).exists())

    def test_every_script_that_is_named_is_there(self):
        for document in documents():
            for name in re.findall(r"scripts/([a-z]+)\b", document.read_text()):
                with self.subTest(document=document.name, name=name):
                    self.assertTrue((ROOT / "scripts" / name).exists())

    def test_every_path_that_is_named_is_there(self):
        folders = {name.split("/")[0] for name in run(["git", "-C", ROOT, "ls-files"]).stdout.splitlines() if "/" in name}
        for document in documents():
            for word in " ".join(re.findall(r"`([^`\n]+)`", document.read_text())).split():
                path = word.strip(".,:;").replace("NAME", "*")
                if path.split("/")[0] in folders and re.fullmatch(r"[\w./*-]+", path):
                    with self.subTest(document=document.name, path=word):
                        self.assertTrue([*ROOT.glob(path), *document.parent.glob(path), *ROOT.glob(f"{path}.*")])

    def test_every_channel_of_the_code_is_in_the_table(self):
        table = (ROOT / "lcmtypes/README.md").read_text()
        code = (ROOT / "libs/common/channels.h").read_text()
        names = ["NAO" + suffix for suffix in re.findall(r'robot \+ "(_[A-Z_]+)"', code)]
        names += re.findall(r'= "([A-Z_]+)";', code)
        self.assertGreater(len(names), 10)
        for name in names:
            with self.subTest(channel=name):
                self.assertIn(f"| `{name}` |", table)


if __name__ == "__main__":
    unittest.main()
