#!/usr/bin/python3
"""nao-trial refuses wrong arguments: which option, what is wrong with it, exit status 1 or 2, no trial begun.
Seeds that run at the same time give the results of seeds one after the other."""

import unittest

from stack import BIN_DIR, run


class Usage(unittest.TestCase):
    def assert_refused(self, arguments, *words):
        result = run([BIN_DIR / "nao-trial", *arguments])
        self.assertIn(result.returncode, (1, 2), arguments)
        self.assertEqual(result.stdout, "", arguments)
        for word in words:
            self.assertIn(word, result.stderr, arguments)

    def test_sizes_of_teams(self):
        for teams in ("", "2", "2v", "v2", "0v2", "2v6", "2x2", "2v2v2", "10v10", "-1v2", "2v2 "):
            self.assert_refused(["match", "--teams", teams, "--seeds", "1"], "--teams")

    def test_seeds(self):
        for seeds in ("x", "3-1", "1-", "-1-2"):
            self.assert_refused(["sprint", "--seeds", seeds], "seeds")

    def test_jobs(self):
        for jobs in ("0", "65", "x"):
            self.assert_refused(["sprint", "--jobs", jobs, "--seeds", "1"], "--jobs")
        self.assert_refused(["walk", "--jobs", "2", "--trace", "walk.csv", "--seeds", "1-2"], "--trace")
        trial = [BIN_DIR / "nao-trial", "walk", "--vx", "0.2", "--duration", "2", "--seeds", "1-5"]
        alone = run([*trial, "--jobs", "1"])
        self.assertEqual(alone.returncode, 0, alone.stderr)
        self.assertIn("5 of 5", alone.stdout)
        self.assertEqual(alone.stdout, run([*trial, "--jobs", "3"]).stdout)

    def test_names(self):
        self.assert_refused(["sprint", "--engine", "bullet", "--seeds", "1"], "bullet")
        self.assert_refused(["sprint", "--disturbances", "storm", "--seeds", "1"], "storm")
        self.assert_refused(["sprint", "--model", "r2d2", "--seeds", "1"], "r2d2")
        self.assert_refused(["gallop"], "gallop")


if __name__ == "__main__":
    unittest.main()
