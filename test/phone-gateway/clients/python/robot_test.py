#!/usr/bin/python3
"""The package nao_remote with the real gateway, motion and simulator, on a bus and ports of their own."""

import math
import os
import re
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

from built_package import BIN_DIR, ROOT

import nao_remote
from programs import DEADLINE, Gateway, Robot, wait_until

EXAMPLES = ROOT / "phone-gateway/clients/python/examples"


class WithRobot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = Robot(scene="soccer")
        cls.enterClassContext(cls.stack)
        cls.stack.start_speaker()
        cls.stack.stand()

    @property
    def address(self):
        return f"http://127.0.0.1:{self.stack.gateway.http_port}/#token=test-token"

    def connect(self, **options):
        return self.enterContext(nao_remote.connect(self.address, **{"timeout": DEADLINE, **options}))

    def example(self, name, *arguments, folder=None):
        """Runs an example in a folder of its own. @return its output and the folder. Skips the test if it lacks an optional
        package."""
        folder = folder or self.enterContext(tempfile.TemporaryDirectory())
        result = subprocess.run([sys.executable, EXAMPLES / f"{name}.py", self.address, *map(str, arguments)], cwd=folder,
                                stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=5 * DEADLINE, check=False)
        if result.returncode == 77:
            self.skipTest(result.stderr)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout, Path(folder)


class Driving(WithRobot):
    def test_postures_and_joints_move_the_true_robot(self):
        robot = self.connect()
        robot.posture("Crouch", timeout=DEADLINE)
        crouched = self.stack.torso_height()
        robot.posture("Stand", timeout=DEADLINE)
        self.assertGreater(self.stack.torso_height(), crouched + 0.02)
        robot.joints["HeadYaw"].move_to(0.4, timeout=DEADLINE)
        self.assertAlmostEqual(robot.joints["HeadYaw"].position(), 0.4, delta=0.05)
        robot.joints["HeadYaw"].move_by(-0.4, timeout=DEADLINE)
        truth = self.stack.truth()
        yaw = truth["joint_position"][truth["joint_names"].index("HeadYaw")]
        self.assertAlmostEqual(yaw, 0, delta=0.05)

    def test_a_walk_moves_the_robot_forward_and_ends(self):
        robot = self.connect()
        robot.posture("StandInit", timeout=DEADLINE)
        before = self.stack.truth()
        robot.walk(0.15, duration=4)
        after = self.stack.truth()
        moved = sum((after["position_torso_in_world"][i] - before["position_torso_in_world"][i]) ** 2 for i in (0, 1)) ** 0.5
        self.assertGreater(moved, 0.1)
        self.assertIs(robot.wait_until(lambda state: state.mode != nao_remote.Mode.WALKING, DEADLINE).mode,
                      nao_remote.Mode.HOLDING)

    def test_states_and_images_arrive(self):
        robot = self.connect()
        with robot.states(30, timeout=DEADLINE) as states:
            times = [next(states).utime for _ in range(10)]
        self.assertEqual(times, sorted(set(times)))
        with robot.images(10, width=160, timeout=DEADLINE) as images:
            seen = [next(images) for _ in range(3)]
        self.assertEqual({(image.camera, image.width, image.height) for image in seen}, {("top", 160, 120)})
        self.assertTrue(all(image.jpeg.startswith(b"\xff\xd8") for image in seen))
        self.assertEqual(robot.image("bottom", 320, timeout=DEADLINE).camera, "bottom")

    def test_refusals_are_the_robots_sentences(self):
        robot = self.connect()
        for call, code in ((lambda: robot.posture("Handstand"), "posture-unknown"), (lambda: robot.action("juggle"), "action-unknown"),
                           (lambda: robot.move_to(99), "goal-out-of-range"), (lambda: robot.image(width=17), "width-unsupported"),
                           (lambda: robot.change_joints("tail", yaw=1), "joint-group-unknown")):
            with self.assertRaises(nao_remote.InvalidArgument) as refused:
                call()
            self.assertEqual(refused.exception.reason_code, code)
        with self.assertRaises(nao_remote.InvalidArgument) as refused, robot.states(99, timeout=DEADLINE) as states:
            next(states)
        self.assertEqual(refused.exception.reason_code, "state-rate-out-of-range")

    def test_one_client_drives_and_the_other_is_told_who(self):
        ana, ben = self.connect(name="Ana"), self.connect(name="Ben")
        with ana.driving(), self.assertRaises(nao_remote.ControlTaken) as refused:
            ben.posture("Stand")
        self.assertEqual(refused.exception.driver_name, "Ana")
        ben.posture("Stand", timeout=DEADLINE)
        self.assertEqual({client.name for client in ana.operator.clients()} & {"Ana", "Ben"}, {"Ana", "Ben"})

    def test_a_walk_that_another_client_stopped_ends(self):
        ana, ben = self.connect(name="Ana"), self.connect(name="Ben")
        walk = ana.walk(0.1)
        ana.wait_until(lambda state: state.mode == nao_remote.Mode.WALKING, DEADLINE)
        ben.stop()
        with self.assertRaises(nao_remote.NaoError):
            walk.wait(DEADLINE)
        ana.wait_until(lambda state: state.mode == nao_remote.Mode.HOLDING, DEADLINE)

    def test_a_killed_gateway_raises_everywhere_and_is_found_again(self):
        robot = self.connect()
        with robot.states(20, timeout=DEADLINE) as states, robot.events(timeout=DEADLINE) as events:
            next(states)
            walk = robot.walk(0.1)
            self.stack.gateway.kill()
            with self.assertRaises(nao_remote.ConnectionLost):
                walk.wait(DEADLINE)
            next(event for event in events if isinstance(event, nao_remote.Disconnected))
            for call in (robot.state, robot.stop, robot.image, lambda: robot.walk(0.1), lambda: robot.posture("Stand")):
                with self.assertRaises(nao_remote.ConnectionLost):
                    call()
            self.stack.start_gateway()
            robot.wait_until_connected(DEADLINE)
            # States continue, and the robot obeys.
            next(states)
            wait_until(lambda: self.obeys(robot), "the robot obeys again")

    def obeys(self, robot):
        try:
            robot.posture("Stand", timeout=DEADLINE)
            return True
        except nao_remote.NaoError:
            return False


class Examples(WithRobot):
    def test_hello(self):
        output, folder = self.example("hello")
        self.assertIn("NAO", output)
        self.assertTrue((folder / "view.jpg").read_bytes().startswith(b"\xff\xd8"))

    def test_square(self):
        output, _ = self.example("square")
        corners = re.findall(r"x (-?[\d.]+) m, y (-?[\d.]+) m", output)
        self.assertEqual(len(corners), 4)
        begin, across = (tuple(map(float, corners[i])) for i in (3, 1))
        self.assertGreater(math.dist(begin, across), 0.25, "opposite corners")

    def test_greet(self):
        self.example("greet")

    def test_dance(self):
        output, _ = self.example("dance")
        self.assertEqual(output.count("beat"), 8)

    def test_follow_ball(self):
        self.stack.nao("world", "reset")
        self.stack.stand()
        self.stack.nao("world", "place-ball", "1.0", "0.3")
        self.example("follow_ball", 120)
        truth = self.stack.truth()
        self.assertLess(math.dist(truth["position_torso_in_world"][:2], (1.0, 0.3)), 0.75)

    def test_teach_and_replay(self):
        robot = self.connect()
        robot.posture("Stand", timeout=DEADLINE)
        recording = subprocess.Popen(
            [sys.executable, "-u", EXAMPLES / "teach_and_replay.py", self.address, "wave.json", "6"],
            cwd=self.folder(), stdout=subprocess.PIPE, text=True)
        self.addCleanup(recording.wait)
        self.addCleanup(recording.stdout.close)
        self.assertEqual(recording.stdout.readline(), "recording\n")
        robot.joints["LShoulderRoll"].move_by(0.4, 0.5, timeout=DEADLINE)
        robot.joints["HeadYaw"].move_by(0.5, 0.5, timeout=DEADLINE)
        self.assertEqual(recording.wait(DEADLINE), 0)
        taught = robot.state().joint_position
        robot.joints["LShoulderRoll"].move_by(-0.4, timeout=DEADLINE)
        robot.joints["HeadYaw"].move_by(-0.5, timeout=DEADLINE)
        robot.release_control()
        output, _ = self.example("teach_and_replay", "wave.json", folder=self.folder())
        self.assertIn("HeadYaw", output)
        replayed = robot.state().joint_position
        for name in ("LShoulderRoll", "HeadYaw"):
            self.assertAlmostEqual(replayed[name], taught[name], delta=0.08, msg=name)

    def folder(self):
        if not hasattr(self, "_folder"):
            self._folder = self.enterContext(tempfile.TemporaryDirectory())
        return self._folder

    def test_log_to_pandas(self):
        output, folder = self.example("log_to_pandas", 2)
        self.assertIn("states in states.csv", output)
        self.assertTrue((folder / "states.csv").read_text().startswith("time,mode,x,y,height,"))

    def test_simulate_many(self):
        result = subprocess.run([sys.executable, EXAMPLES / "simulate_many.py"], capture_output=True, text=True,
                                timeout=5 * DEADLINE, check=False, env={**os.environ, "NAO_REMOTE_BIN": str(BIN_DIR)})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(re.findall(r"seed \d: 1\.", result.stdout)), 4, result.stdout)


class Security(unittest.TestCase):
    def test_tls_trusts_the_named_certificate_only(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        gateway = Gateway("--tls", "--tls-dir", folder)
        self.addCleanup(gateway.kill)
        address = f"https://127.0.0.1:{gateway.http_port}/#token=test-token"
        with nao_remote.connect(address, certificate=Path(folder) / "gateway-certificate.pem", timeout=DEADLINE) as robot:
            self.assertGreater(robot.ping().num_clients, 0)
        with self.assertRaisesRegex(nao_remote.ConnectionLost, "certificate"):
            nao_remote.connect(address, timeout=DEADLINE)

    def test_calls_of_several_threads_are_answered(self):
        gateway = Gateway()
        self.addCleanup(gateway.kill)
        robot = self.enterContext(nao_remote.connect(f"tcp://127.0.0.1:{gateway.tcp_port}", timeout=DEADLINE))
        pongs = []
        threads = [threading.Thread(target=lambda: pongs.extend(robot.ping() for _ in range(5))) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(pongs), 20)


if __name__ == "__main__":
    unittest.main()
