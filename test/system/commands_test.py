#!/usr/bin/python3
"""The robot executes commands of the command-line client and rejects invalid ones with a reason."""

import signal
import subprocess
import time
import unittest

from stack import BIN_DIR, DEADLINE, Stack


class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = Stack()
        cls.addClassCleanup(cls.stack.__exit__)
        cls.stack.start_or_fail("--only", "sim,motion,speaker")

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
        # data/robots/nao/postures.yaml: a crouching NAO's torso is 0.229 m above the floor.
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

    def test_waits_for_programs_of_this_host_only(self):
        rename = ["unshare", "--uts", "sh", "-c", "hostname elsewhere && exec \"$@\"", "sh"]
        if subprocess.run([*rename, "true"], capture_output=True, check=False).returncode != 0:
            self.skipTest("this system permits no host names of its own")
        with subprocess.Popen([*rename, BIN_DIR / "nao-motion-files", "--lcm-url", self.stack.lcm_url,
                               "--folder", self.stack.run_dir], stderr=subprocess.DEVNULL) as elsewhere:
            self.addCleanup(elsewhere.kill)
            self.obeyed("status", "--wait", "nao-motion-files", "--timeout", DEADLINE - 10)
            alone = self.stack.nao("status", "--wait", "nao-motion-files", "--this-host", "--timeout", "2.5")
            self.assertEqual(alone.returncode, 1, alone.stdout)
            self.assertIn("nao-motion-files is not ready", alone.stderr)
            self.obeyed("status", "--wait", "nao-sim,nao-motion", "--this-host", "--timeout", DEADLINE - 10)
            elsewhere.terminate()

    def test_clips_a_joint_to_its_limit(self):
        self.obeyed("joint", "HeadYaw", "=30")
        self.assertLess(self.joint("HeadYaw"), 2.1)
        self.assertGreater(self.joint("HeadYaw"), 1.8)
        self.obeyed("joint", "HeadYaw", "=0")

    def test_a_walk_whose_program_was_held_up_has_not_been_done(self):
        walk = subprocess.Popen([BIN_DIR / "nao", "--lcm-url", self.stack.lcm_url, "walk", "0.1", "0", "0", "--for", "100"],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            self.wait_for_mode("walking")
            walk.send_signal(signal.SIGSTOP)
            self.wait_for_mode("holding")
            walk.send_signal(signal.SIGCONT)
            _, said = walk.communicate(timeout=DEADLINE)
        finally:
            walk.kill()
        self.assertEqual(walk.returncode, 1)
        self.assertIn("ended before its time", said)

    def wait_for_mode(self, mode):
        deadline = time.monotonic() + DEADLINE
        while self.stack.state()["motion_state"]["mode"] != mode:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)

    def test_refuses_nonsense_in_words_and_does_not_move(self):
        before = self.stack.torso_height()
        self.assertIn("Handstand", self.refused("posture", "Handstand"))
        self.assertIn("Tail", self.refused("joint", "Tail", "+0.1"))
        self.assertIn("juggle", self.refused("action", "juggle"))
        self.refused("posture", "Crouch", "--speed", "7")
        self.assertAlmostEqual(self.stack.torso_height(), before, delta=0.005)

    def lights(self):
        robot = self.stack.truth()["robots"][0]
        return dict(zip(robot["light_names"], robot["light_rgb"]))

    def test_says_a_text_and_returns_when_it_is_spoken(self):
        begin = time.monotonic()
        said = self.obeyed("say", "one, two, three")
        self.assertIn("done", said)
        # Never faster than the sound lasts.
        self.assertGreater(time.monotonic() - begin, 0.8)
        for language in ("de", "es-MX", "fr", "it", "zh"):
            self.obeyed("say", "--language", language, "--rate", "2", "1")

    def test_refuses_to_say_nonsense_in_words(self):
        self.assertIn("control character U+0007", self.refused("say", "bell\a"))
        self.assertIn("at most 1000", self.refused("say", "a" * 1001))
        self.assertIn("xx", self.refused("say", "--language", "xx", "a"))
        self.assertIn("2", self.refused("say", "--volume", "2", "a"))

    def test_a_text_interrupts_or_follows_the_one_before(self):
        self.obeyed("say", "--no-wait", "one two three four five six seven eight nine ten " * 10)
        self.obeyed("say", "--rate", "2", "stop")
        self.obeyed("say", "--no-wait", "one two three")
        begin = time.monotonic()
        self.obeyed("say", "--after", "four")
        self.assertGreater(time.monotonic() - begin, 1)
        self.obeyed("say", "--no-wait", "one two three " * 30)
        self.obeyed("say", "--stop")

    def test_the_eyes_are_lit_while_it_speaks(self):
        self.assertNotIn("left-eye", self.lights())
        self.obeyed("say", "--no-wait", "one two three four five six seven eight nine ten " * 3)
        self.addCleanup(self.stack.nao, "say", "--stop")
        deadline = time.monotonic() + DEADLINE
        while "left-eye" not in self.lights():
            self.assertLess(time.monotonic(), deadline)
        self.obeyed("say", "--stop")
        while "left-eye" in self.lights():
            self.assertLess(time.monotonic(), deadline)

    def test_sets_lights_by_name_and_color(self):
        self.obeyed("light", "chest", "left-foot", "#ff0080")
        self.assertEqual(self.lights()["chest"], [1, 0, 128 / 255])
        self.assertEqual(self.lights()["left-foot"], self.lights()["chest"])
        self.obeyed("light", "chest", "left-foot", "off")
        self.assertNotIn("chest", self.lights())
        self.assertIn("skull", self.refused("light", "tail", "red"))

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

    def test_places_the_robot(self):
        self.obeyed("world", "place-robot", "0.4", "-0.3", "--posture", "Stand")
        robot = self.stack.truth()["robots"][0]
        self.assertAlmostEqual(robot["position_torso_in_world"][0], 0.4, delta=0.05)
        self.assertAlmostEqual(robot["position_torso_in_world"][1], -0.3, delta=0.05)
        self.obeyed("world", "reset")

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
