#!/usr/bin/python3
"""The robot executes commands of the command-line client and rejects invalid ones with a reason."""

import time
import unittest

from stack import DEADLINE, Stack


class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = Stack()
        cls.addClassCleanup(cls.stack.__exit__)
        cls.stack.start_or_fail("--only", "sim,motion")

    def obeyed(self, *arguments):
        result = self.stack.nao(*arguments)
        self.assertEqual(result.returncode, 0, f"{arguments}: {result.stdout}{result.stderr}")
        return result.stdout

    def refused(self, *arguments):
        result = self.stack.nao(*arguments)
        self.assertEqual(result.returncode, 1, f"{arguments}: {result.stdout}{result.stderr}")
        self.assertIn("refused", result.stderr)
        return result.stderr

    def joint(self, name):
        state = self.stack.state()["robot_state"]
        return state["joint_position"][state["joint_names"].index(name)]

    def test_goes_to_postures(self):
        self.obeyed("posture", "Crouch")
        # robots/nao/postures.yaml: a crouching NAO's torso is 0.229 m above the floor.
        self.assertAlmostEqual(self.stack.torso_height(), 0.229, delta=0.01)
        self.assertEqual(self.stack.state()["motion_state"]["posture"], "Crouch")
        self.obeyed("posture", "Stand")
        self.assertGreater(self.stack.torso_height(), 0.30)

    def test_turns_a_joint_by_and_to_an_angle(self):
        self.obeyed("joint", "HeadYaw", "=0.3", "HeadPitch", "=0.1")
        self.assertAlmostEqual(self.joint("HeadYaw"), 0.3, delta=0.03)
        self.assertAlmostEqual(self.joint("HeadPitch"), 0.1, delta=0.03)
        self.obeyed("joint", "HeadYaw", "-0.2")
        self.assertAlmostEqual(self.joint("HeadYaw"), 0.1, delta=0.03)
        self.obeyed("joint", "HeadYaw", "=0", "HeadPitch", "=0")

    def test_clips_a_joint_to_its_limit(self):
        self.obeyed("joint", "HeadYaw", "=30")
        self.assertLess(self.joint("HeadYaw"), 2.1)
        self.assertGreater(self.joint("HeadYaw"), 1.8)
        self.obeyed("joint", "HeadYaw", "=0")

    def test_refuses_nonsense_in_words_and_does_not_move(self):
        before = self.stack.torso_height()
        self.assertIn("Handstand", self.refused("posture", "Handstand"))
        self.assertIn("Tail", self.refused("joint", "Tail", "+0.1"))
        self.assertIn("juggle", self.refused("action", "juggle"))
        self.refused("posture", "Crouch", "--speed", "7")
        self.assertAlmostEqual(self.stack.torso_height(), before, delta=0.005)

    def test_stop_ends_a_motion_and_tells_its_sender(self):
        self.obeyed("posture", "Stand")
        self.obeyed("posture", "Crouch", "--speed", "0.05", "--no-wait")
        self.obeyed("stop")
        self.assertNotEqual(self.stack.state()["motion_state"]["posture"], "Crouch")

    def test_pauses_the_world_and_steps_it(self):
        self.obeyed("world", "pause")
        self.addCleanup(self.stack.nao, "world", "resume")
        before = self.stack.truth()
        self.assertTrue(before["is_paused"])
        self.obeyed("world", "step", "5")
        deadline = time.monotonic() + DEADLINE
        while self.stack.truth()["tick"] < before["tick"] + 5:
            self.assertLess(time.monotonic(), deadline)
        self.assertEqual(self.stack.truth()["tick"], before["tick"] + 5)
        self.obeyed("world", "resume")
        self.assertFalse(self.stack.truth()["is_paused"])

    def test_places_the_ball_and_refuses_to_push_what_is_not_there(self):
        self.obeyed("world", "place-ball", "0.5", "0.25")
        ball = self.stack.truth()["position_ball_in_world"]
        self.assertAlmostEqual(ball[0], 0.5, delta=0.02)
        self.assertAlmostEqual(ball[1], 0.25, delta=0.02)
        self.assertIn("tail", self.refused("world", "push", "1", "0", "0", "--link", "tail"))

    def test_every_channel_decodes(self):
        said = self.obeyed("spy", "--for", "2")
        self.assertIn(" 0 undecodable", said)
        for channel in ("NAO_SENSOR_STATE", "NAO_JOINT_COMMAND", "NAO_ROBOT_STATE", "NAO_MOTION_STATE", "WORLD_TRUTH",
                        "DAEMON_STATUS"):
            self.assertIn(channel, said)


class WithoutARobot(unittest.TestCase):
    def test_a_command_without_an_answer_fails_in_words(self):
        with Stack() as stack:
            result = stack.nao("posture", "Stand")
            self.assertEqual(result.returncode, 1)
            self.assertIn("does not answer", result.stderr)

    def test_a_wrong_command_line_is_status_2(self):
        with Stack() as stack:
            for words in (["walk", "fast"], ["walk", "nan", "0", "0"], ["joint", "HeadYaw", "0.3"], ["dance"], []):
                with self.subTest(words=words):
                    self.assertEqual(stack.nao(*words).returncode, 2)


if __name__ == "__main__":
    unittest.main()
