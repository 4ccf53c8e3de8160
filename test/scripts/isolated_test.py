#!/usr/bin/python3
"""test/support/isolated ends all processes that a test leaves, also those of a test that is killed."""

import subprocess
import unittest
from pathlib import Path

ISOLATED = Path(__file__).resolve().parents[1] / "support/isolated"


class Isolated(unittest.TestCase):
    def setUp(self):
        if subprocess.run(["unshare", "--net", "--pid", "--fork", "--mount-proc", "true"], stderr=subprocess.DEVNULL, check=False).returncode != 0:
            self.skipTest("takes the right to make namespaces")

    def start(self, script, parent=()):
        """Starts a test that leaves a process behind, which holds the output open."""
        test = subprocess.Popen([*parent, ISOLATED, "sh", "-c", f"setsid sleep 1000 & {script}"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(test.stdout.close)
        self.assertEqual(test.stdout.readline(), "ready\n")
        return test

    def test_a_test_leaves_no_process_and_its_status_is_kept(self):
        test = self.start("echo ready; exit 3")
        self.assertEqual(test.communicate(timeout=60)[0], "")
        self.assertEqual(test.returncode, 3)

    def test_a_killed_test_leaves_no_process(self):
        test = self.start("echo ready; wait")
        test.kill()
        self.assertEqual(test.communicate(timeout=60)[0], "")

    def test_a_test_whose_parent_is_killed_leaves_no_process(self):
        parent = self.start("echo ready; wait", ["sh", "-c", '"$@"; exit', "sh"])
        parent.kill()
        self.assertEqual(parent.communicate(timeout=60)[0], "")


if __name__ == "__main__":
    unittest.main()
