#!/usr/bin/python3
"""Several robots in one world, started by one command."""

import json
import math
import os
import signal
import subprocess
import time
import unittest

from stack import BIN_DIR, DEADLINE, Stack


class ThreeRobots(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = Stack()
        cls.addClassCleanup(cls.stack.__exit__)
        cls.stack.start_or_fail("--robots", "3", "--only", "sim,motion")

    def robots(self):
        """True states by name."""
        return {robot["robot"]: robot for robot in self.stack.truth()["robots"]}

    def place(self, name):
        return self.robots()[name]["position_torso_in_world"]

    def assert_all_stand(self):
        for name, robot in self.robots().items():
            self.assertGreater(robot["position_torso_in_world"][2], 0.3, f"{name}\n{self.stack.logs()}")

    def rows(self):
        """scripts/status, by program."""
        return {row["program"]: row for row in json.loads(self.stack.script("status", "--json").stdout)}

    def wait_until(self, condition, what):
        deadline = time.monotonic() + DEADLINE
        while not condition():
            self.assertLess(time.monotonic(), deadline, f"{what}\n{self.stack.logs()}")
            time.sleep(0.2)

    def test_status_and_logs_name_the_robot_of_each_program(self):
        rows = self.rows()
        self.assertEqual(set(rows), {"nao-sim", "nao-motion-NAO1", "nao-motion-NAO2", "nao-motion-NAO3", "nao-watchdog"})
        for name, row in rows.items():
            self.assertEqual(row["state"], "ready", row)
            self.assertTrue(row["log"].endswith(f"/{name}.log"), row)
            self.assertIsNotNone(row["cpu_percent"], row)

    def test_only_the_robot_that_is_told_walks(self):
        self.assert_all_stand()
        before = {name: self.place(name) for name in ("NAO1", "NAO2", "NAO3")}
        walked = self.stack.nao("--robot", "NAO2", "move-to", "0.4", "0", "0")
        self.assertEqual(walked.returncode, 0, walked.stderr)
        self.assert_all_stand()
        self.assertAlmostEqual(math.dist(self.place("NAO2"), before["NAO2"]), 0.4, delta=0.15)
        for name in ("NAO1", "NAO3"):
            self.assertLess(math.dist(self.place(name), before[name]), 0.02, name)

    def test_a_killed_motion_pauses_only_its_robot_and_comes_back(self):
        before = self.place("NAO3")
        row = self.rows()["nao-motion-NAO3"]
        walk = subprocess.Popen([BIN_DIR / "nao", "--lcm-url", self.stack.lcm_url, "--robot", "NAO2", "walk", "0", "0", "0.4",
                                 "--for", "6"], stderr=subprocess.PIPE, text=True)
        start_heading = self.heading("NAO2")
        self.wait_until(lambda: abs(self.heading("NAO2") - start_heading) > 0.2, "NAO2 does not turn")
        os.kill(row["pid"], signal.SIGKILL)
        _, said = walk.communicate(timeout=DEADLINE)
        self.assertEqual(walk.returncode, 0, f"NAO2's walk went on: {said}")
        self.wait_until(lambda: self.rows()["nao-motion-NAO3"]["state"] == "ready", "nao-motion-NAO3 is not back")
        again = self.rows()
        self.assertNotEqual(again["nao-motion-NAO3"]["pid"], row["pid"])
        self.assertEqual(again["nao-motion-NAO3"]["restarts"], 1)
        for name in ("nao-sim", "nao-motion-NAO1", "nao-motion-NAO2"):
            self.assertEqual(again[name]["restarts"], 0, name)
        self.assert_all_stand()
        self.assertLess(math.dist(self.place("NAO3"), before), 0.02)
        turned = self.stack.nao("--robot", "NAO3", "joint", "HeadYaw", "=0.4")
        self.assertEqual(turned.returncode, 0, turned.stderr)

    def heading(self, name):
        w, x, y, z = self.robots()[name]["orientation_torso_in_world"]
        return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


class Match(unittest.TestCase):
    def test_two_teams_face_each_other_and_stop_ends_all(self):
        with Stack() as stack:
            started = stack.start_or_fail("--match", "2v1", "--only", "sim,motion,motion-files", "--robot", "R")
            self.assertIn("R1:nao:0:1, R2:nao:0:2, R3:nao:1:1", started.stdout)
            robots = stack.truth()["robots"]
            self.assertEqual([(robot["robot"], robot["team"], robot["number"]) for robot in robots],
                             [("R1", 0, 1), ("R2", 0, 2), ("R3", 1, 1)])
            for robot in robots:
                self.assertLess((1 if robot["team"] == 0 else -1) * robot["position_torso_in_world"][0], -0.8)
            self.assertEqual(stack.stop().returncode, 0)
            self.assertEqual(stack.pids(), {})

    def test_different_models(self):
        with Stack() as stack:
            stack.start_or_fail("--robot", "A", "--robot", "BIG:t1", "--only", "sim,motion")
            self.assertEqual([robot["model"] for robot in stack.truth()["robots"]], ["nao", "t1"])
            self.assertEqual(stack.nao("--robot", "A", "joint", "HeadYaw", "=0.3").returncode, 0)

    def test_wrong_numbers_of_robots_are_refused(self):
        for words in (["--robots", "0"], ["--robots", "11"], ["--robots", "two"], ["--match", "6v6"], ["--match", "2"],
                      ["--match", "1v1", "--robots", "2"], ["--robots", "2", "--backend", "lola"],
                      ["--robots", "2", "--robot", "A", "--robot", "B"],
                      ["--robots", "2", "--vision", "--start-pose", "1,0,0"]):
            with self.subTest(words=words), Stack() as stack:
                refused = stack.start(*words)
                self.assertEqual(refused.returncode, 2, refused.stdout + refused.stderr)
                self.assertIn("--help", refused.stderr)


if __name__ == "__main__":
    unittest.main()
