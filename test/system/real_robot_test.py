#!/usr/bin/python3
"""The stack with nao-robot in nao-sim's place, over LoLA: postures, walks, joystick sessions, and what happens when programs die."""

import json
import math
import os
import signal
import time
import unittest

import robot_drive
from stack import DEADLINE, Stack


class RealRobot(unittest.TestCase):
    def setUp(self):
        self.stack = Stack()
        self.addCleanup(self.stack.__exit__)

    def start(self, *options):
        self.stack.start_or_fail("--backend", "lola", "--scene", "empty", "--only", "sim,robot,motion", *options)
        self.stand()

    def stand(self):
        """The first command after the programs are ready is carried out."""
        ready = self.stack.wait_ready("nao-robot", "nao-motion")
        self.assertEqual(ready.returncode, 0, ready.stderr)
        result = self.stack.nao("posture", "StandInit")
        self.assertEqual(result.returncode, 0, result.stderr + self.stack.logs())
        self.assertGreater(self.stack.torso_height(), 0.3)

    def wait_until(self, condition):
        deadline = time.monotonic() + DEADLINE
        while not condition():
            self.assertLess(time.monotonic(), deadline, self.stack.logs())
            time.sleep(0.1)

    def robot(self):
        """Status of nao-robot; an empty dictionary if it does not run."""
        programs = json.loads(self.stack.nao("status", "--json").stdout)
        return next((program for program in programs if program["program"] == "nao-robot"), {})

    def is_seated(self):
        robot = self.stack.truth()["robots"][0]
        # Cosine of the tilt: z of the torso's z axis.
        _, x, y, _ = robot["orientation_torso_in_world"]
        return robot["position_torso_in_world"][2] < 0.26 and 1 - 2 * (x * x + y * y) > math.cos(0.4)

    def check_posture_and_walk(self):
        result = self.stack.nao("posture", "Crouch")
        self.assertEqual(result.returncode, 0, result.stderr + self.stack.logs())
        self.assertTrue(self.is_seated())
        result = self.stack.nao("posture", "StandInit")
        self.assertEqual(result.returncode, 0, result.stderr + self.stack.logs())
        start = self.stack.truth()["robots"][0]["position_torso_in_world"]
        result = self.stack.nao("move-to", "0.3", "0", "0")
        self.assertEqual(result.returncode, 0, result.stderr + self.stack.logs())
        end = self.stack.truth()["robots"][0]["position_torso_in_world"]
        self.assertAlmostEqual(math.dist(start[:2], end[:2]), 0.3, delta=0.1)

    def test_joystick_session_in_lock_step(self):
        session = robot_drive.run_session(seed=2, duration=60, disturbances="real")
        self.assertEqual(session.fault, "")
        self.assertGreaterEqual(session.driven, 60)
        self.assertGreater(session.walking, 0.6)

    def test_joystick_session_in_real_time(self):
        # A machine with other load delays joint commands, from which the robot may fall: one session of three is enough.
        sessions = []
        for seed in range(2, 5):
            sessions.append(robot_drive.run_session(seed, duration=10, disturbances="real", is_real_time=True))
            if sessions[-1].fault == "" and sessions[-1].driven >= 10 and sessions[-1].walking > 0.4:
                return
        self.fail(sessions)

    def test_lock_step(self):
        self.start("--lock-step")
        self.check_posture_and_walk()

    def test_real_time_and_dying_programs(self):
        self.start()
        self.check_posture_and_walk()
        self.assertEqual(self.robot()["state"], "ready")
        result = self.stack.script("status")
        self.assertEqual(result.returncode, 0, result.stdout)

        # The controller dies: the robot sits down, and continues when the controller is back.
        os.kill(self.stack.pids()["nao-motion"], signal.SIGSTOP)
        self.wait_until(self.is_seated)
        os.kill(self.stack.pids()["nao-motion"], signal.SIGCONT)
        self.stand()

        # nao-robot dies or hangs: the watchdog makes the robot sit down, then both are restarted.
        for number in (signal.SIGKILL, signal.SIGSTOP):
            with self.subTest(signal=number):
                first = self.stack.pids()["nao-robot"]
                os.kill(first, number)
                self.wait_until(self.is_seated)
                self.wait_until(lambda: self.stack.pids().get("nao-robot", first) != first)
                self.stand()

        # It is ended in an orderly way: it sits down first.
        os.kill(self.stack.pids()["nao-robot-watchdog"], signal.SIGTERM)
        self.wait_until(self.is_seated)
        self.wait_until(lambda: "nao-robot" not in self.stack.pids())


if __name__ == "__main__":
    unittest.main()
