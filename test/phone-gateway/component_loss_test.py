#!/usr/bin/python3
"""nao-motion, simulator, camera and gateway hang or are killed during a walk: clients are notified, the walk ends, and
the programs are restarted. Times are simulated time, which slows down with the programs on a busy machine."""

import json
import math
import os
import signal
import sys
import unittest

from programs import DEADLINE, ROOT, wait_until
from walking import STILL_DISTANCE, STILL_TIME, WalkingTest

sys.path.insert(0, str(ROOT / "test/support"))

import phone
from nao_remote import remote_pb2 as pb
from stack import BIN_DIR, Stack, run

TIME_TO_NOTIFY = 2.0
TIME_TO_RECOVER = 10.0
# m. A robot whose servos hold in the middle of a step may fall and get up again, but does not move farther than its length.
BODY_LENGTH = 0.6
UPRIGHT_HEIGHT = 0.28


class SupervisedRobot:
    """A stack as scripts/start makes it, with the interface of programs.Robot."""

    def __init__(self):
        self.stack = Stack()

    def __enter__(self):
        self.stack.__enter__()
        self.stack.start_or_fail("--scene", "empty")
        return self

    def __exit__(self, *_):
        self.stack.__exit__()

    @property
    def gateway(self):
        return self.stack

    def nao(self, *arguments):
        result = self.stack.nao(*arguments)
        if result.returncode != 0:
            raise AssertionError(f"nao {arguments}: {result.stdout}{result.stderr}")
        return result.stdout

    def stand(self):
        command = [BIN_DIR / "nao-phone", "--port", self.stack.tcp_port, "posture", "StandInit"]
        wait_until(lambda: run(command).returncode == 0, "the robot stands")

    def kill(self, program):
        os.kill(self.stack.pids()[program], signal.SIGKILL)


class ComponentLossTest(WalkingTest):
    def setUp(self):
        self.client = None
        super().setUp()
        # An earlier test may have killed the gateway.
        self.client = wait_until(self.connected_driver, "the gateway accepts connections")
        self.client.ask(subscribe=pb.Subscribe(state_rate=30, image_rate=15))
        self.client.wait_until(lambda: self.client.image, DEADLINE)
        self.client.notices.clear()

    def connected_driver(self):
        try:
            return self.driver()
        except (phone.ConnectionLost, phone.Refused):
            return None

    def world(self):
        """Also handles the client's messages, so that its connection stays open."""
        if self.client:
            self.client.wait_until(lambda: False, 0.01)
        return super().world()

    def wait_for(self, condition, what):
        self.assertTrue(self.client.wait_until(condition, DEADLINE), f"{what}: {self.client.notices}")

    def wait_for_component(self, component, is_available):
        self.wait_for(lambda: any(notice.kind == pb.Notice.COMPONENT_CHANGED and notice.component == component
                                  and notice.is_available == is_available and notice.message
                                  for notice in self.client.notices), f"{component} {is_available}")

    def assert_refuses_to_move(self):
        for request in ({"walk_turn": pb.WalkTurn(vx=0.1)}, {"go_to_posture": pb.GoToPosture(posture="Crouch")}):
            with self.assertRaises(phone.Refused) as refused:
                self.client.ask(**request)
            self.assertEqual(refused.exception.code, pb.ROBOT_UNAVAILABLE)
            self.assertTrue(refused.exception.response.message)

    def assert_obeys_again(self):
        """@return simulated time when it did, s."""
        def accepts():
            try:
                return self.client.ask(change_joints=pb.ChangeJoints(group="head", yaw=0.1))
            except phone.Refused:
                return self.client.wait_until(lambda: False, 0.1)
        wait_until(accepts, "commands are accepted")
        return self.world()[0]

    def stands_still(self):
        """@return True if the robot is upright and does not move for STILL_TIME."""
        start, before = self.world()
        wait_until(lambda: self.world()[0] > start + STILL_TIME, "simulated time passes")
        _, after = self.world()
        return after[2] > UPRIGHT_HEIGHT and math.dist(before, after) < STILL_DISTANCE

    def assert_ends_standing(self, place):
        """The robot ends standing where it was. Without balance control it may have fallen and got up."""
        wait_until(self.stands_still, "the robot stands")
        self.assertLess(math.dist(place[:2], self.world()[1][:2]), BODY_LENGTH)


class HungComponents(ComponentLossTest):
    """Programs that stop without exiting: they are not restarted, and clients must be notified."""

    def stop(self, program):
        process = self.robot.programs[program].process
        process.send_signal(signal.SIGSTOP)
        self.addCleanup(process.send_signal, signal.SIGCONT)
        return process

    def test_motion_hangs_while_the_robot_walks(self):
        self.walk(self.client, 2)
        start, place = self.world()
        motion = self.stop("nao-motion")
        self.wait_for_component(pb.Notice.MOTION, False)
        self.assertLess(self.world()[0] - start, TIME_TO_NOTIFY)
        self.assert_refuses_to_move()
        motion.send_signal(signal.SIGCONT)
        self.wait_for_component(pb.Notice.MOTION, True)
        # Neither the old walk nor the refused posture is executed now.
        self.assert_ends_standing(place)
        self.assertNotEqual(json.loads(self.robot.nao("state", "--json"))["motion_state"]["posture"], "Crouch")

    def test_the_simulator_hangs_while_the_robot_walks(self):
        self.walk(self.client, 2)
        _, place = self.world()
        sim = self.stop("nao-sim")
        # Simulated time does not advance; scripts/bench measures the time until clients are notified.
        self.wait_for_component(pb.Notice.ROBOT, False)
        self.assert_refuses_to_move()
        sim.send_signal(signal.SIGCONT)
        self.wait_for_component(pb.Notice.ROBOT, True)
        self.assert_ends_standing(place)

    def test_the_camera_hangs_while_the_robot_walks(self):
        self.walk(self.client, 2)
        start, _ = self.world()
        camera = self.stop("nao-head-camera")
        self.wait_for_component(pb.Notice.CAMERA, False)
        self.assertLess(self.world()[0] - start, TIME_TO_NOTIFY)
        self.assert_stands_soon()
        camera.send_signal(signal.SIGCONT)
        self.wait_for_component(pb.Notice.CAMERA, True)

    def test_the_camera_hangs_while_no_images_are_requested(self):
        self.client.ask(subscribe=pb.Subscribe(state_rate=30))
        start, _ = self.world()
        camera = self.stop("nao-head-camera")
        self.wait_for_component(pb.Notice.CAMERA, False)
        self.assertLess(self.world()[0] - start, TIME_TO_NOTIFY)
        camera.send_signal(signal.SIGCONT)
        self.wait_for_component(pb.Notice.CAMERA, True)


class KilledComponents(ComponentLossTest):
    """Programs that exit are restarted by supervisor."""

    @classmethod
    def make_robot(cls):
        return SupervisedRobot()

    def test_motion_is_killed_while_the_robot_walks(self):
        self.walk(self.client, 2)
        start, place = self.world()
        self.robot.kill("nao-motion")
        self.wait_for(lambda: self.client.notices, "the client is notified")
        self.assertLess(self.world()[0] - start, TIME_TO_NOTIFY)
        self.assertLess(self.assert_obeys_again() - start, TIME_TO_RECOVER)
        self.assert_ends_standing(place)

    def test_the_simulator_is_killed_while_the_robot_walks(self):
        self.walk(self.client, 2)
        self.robot.kill("nao-sim")
        self.wait_for(lambda: self.client.notices, "the client is notified")
        # The new simulator starts again at time 0.
        self.assertLess(self.assert_obeys_again(), TIME_TO_RECOVER)
        self.assert_stands_soon()
        self.assertLess(math.hypot(*self.world()[1][:2]), BODY_LENGTH)

    def test_the_camera_is_killed_while_the_robot_walks(self):
        self.walk(self.client, 2)
        start, _ = self.world()
        last = self.client.image.utime
        self.robot.kill("nao-head-camera")
        self.wait_for(lambda: self.client.image.utime > last + 1000000 * TIME_TO_NOTIFY, "images arrive again")
        self.assertLess(self.world()[0] - start, TIME_TO_RECOVER)
        self.assert_stands_soon()

    def test_the_gateway_is_killed_while_the_robot_walks(self):
        self.walk(self.client, 2)
        start, _ = self.world()
        self.robot.kill("nao-phone-gateway")
        with self.assertRaises(phone.ConnectionLost):
            self.client.wait_until(lambda: False, DEADLINE)
        self.client = None
        self.client = wait_until(self.connected_driver, "the gateway accepts connections again")
        self.assertLess(self.world()[0] - start, TIME_TO_RECOVER)
        self.assert_stands_soon()


if __name__ == "__main__":
    unittest.main()
