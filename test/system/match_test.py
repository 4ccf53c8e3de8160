#!/usr/bin/python3
"""A match of two teams, started by one command: referee, robots that play by themselves, a person who drives."""

import json
import os
import re
import signal
import time
import unittest

from stack import DEADLINE, Stack


class Match(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = Stack()
        cls.addClassCleanup(cls.stack.__exit__)
        # Behaviors stand without images: nothing touches the ball but this test.
        cls.stack.start_or_fail("--match", "1v1", "--autonomous", "NAO2", "--no-camera")
        cls.events = cls.stack.run_dir / "logs/match.jsonl"

    def match(self):
        """What nao match show prints: phase, score and players."""
        shown = self.stack.nao("match", "show")
        self.assertEqual(shown.returncode, 0, shown.stderr)
        phase, left, score = re.match(r"(\w+), half \d, (\d+:\d\d) left, (\d+:\d+)", shown.stdout).groups()
        return {"phase": phase, "left": left, "score": score, "text": shown.stdout}

    def wait_until(self, condition, what, seconds=DEADLINE):
        deadline = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), deadline, f"{what}\n{self.match()}\n{self.stack.logs()}")
            time.sleep(0.2)

    def succeed(self, *words):
        done = self.stack.nao(*words)
        self.assertEqual(done.returncode, 0, done.stderr)

    def rows(self):
        return {row["program"]: row for row in json.loads(self.stack.script("status", "--json").stdout)}

    def test_a_match(self):
        self.assertEqual(self.match()["phase"], "initial")
        refused = self.stack.nao("match", "goal", "0")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("not possible in the phase initial", refused.stderr)
        # A robot in a forbidden place is put at its own place after 45 s; this place is allowed.
        self.succeed("match", "start")
        self.assertEqual(self.match()["phase"], "ready")
        self.wait_until(lambda: self.match()["phase"] == "playing", "no kick-off", 90)
        self.assertRegex(self.match()["text"], r"NAO2 +team 1, number 1, plays by itself")

        self.succeed("world", "place-ball", "4.8", "0.3")
        self.wait_until(lambda: self.match()["score"] == "1:0", "the goal does not count", 5)
        self.assertEqual(self.match()["phase"], "ready")
        # The ball still lies in the goal: it counts once.
        time.sleep(1)
        self.assertEqual(self.match()["score"], "1:0")

        before = self.match()
        row = self.rows()["nao-referee"]
        os.kill(row["pid"], signal.SIGKILL)
        self.wait_until(lambda: self.rows()["nao-referee"]["restarts"] == 1, "nao-referee is not started again", 10)
        self.wait_until(lambda: self.rows()["nao-referee"]["state"] == "ready", "nao-referee is not ready again", 10)
        self.assertEqual(self.match()["score"], before["score"])
        # The clock runs during a kick-off, too.
        self.assertLessEqual(self.match()["left"], before["left"])
        self.assertGreater(self.match()["left"], "4:00")

        self.succeed("match", "penalize", "NAO2")
        self.wait_until(lambda: self.stack.truth()["robots"][1]["position_torso_in_world"][1] > 3, "NAO2 is not put beside the field", 10)
        self.succeed("match", "finish")
        self.assertEqual(self.match()["phase"], "finished")
        events = [json.loads(line) for line in self.events.read_text().splitlines()]
        self.assertEqual([event["event"] for event in events], ["kick-off", "goal", "penalty", "match-end"])
        self.assertEqual([event["event_id"] for event in events], [1, 2, 3, 4])

    def test_wrong_words_are_explained(self):
        for options, said in ((["--game-controller"], "--game-controller needs --match"),
                              (["--autonomous", "all"], "--autonomous needs --match"),
                              (["--match", "1v1", "--autonomous", "NAO7"], "no robot 'NAO7'; there are: NAO1 NAO2"),
                              (["--match", "1v1", "--scene", "empty"], "--match needs a field")):
            with self.subTest(options=options):
                refused = self.stack.script("start", *options)
                self.assertEqual(refused.returncode, 2)
                self.assertIn(said, refused.stderr)


if __name__ == "__main__":
    unittest.main()
