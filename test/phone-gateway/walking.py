"""Shared by tests of walks that must end: a robot that walks, and its true position."""

import json
import math
import time
import unittest

from programs import DEADLINE, Robot, wait_until

import phone
from nao_remote import remote_pb2 as pb

WALK_PERIOD = 0.1
# s. From the last command to the end of the walk: 1 s of the gateway, which lets it step in place from 0.5 s on (0.5 s of nao-motion, if the gateway
# has failed), and the last steps, 0.6 to 0.9 s (measured).
TIME_TO_STAND = 2.5
# s and m. A walking robot moves several times as far in STILL_TIME; the sway of a standing one is smaller.
STILL_TIME = 2.0
STILL_DISTANCE = 0.02


class WalkingTest(unittest.TestCase):
    """Has a robot with all programs; measures its true position, in simulated time."""

    bind = "127.0.0.1"

    @classmethod
    def setUpClass(cls):
        cls.robot = cls.enterClassContext(cls.make_robot())

    @classmethod
    def make_robot(cls):
        return Robot(scene="empty", bind=cls.bind)

    def setUp(self):
        self.robot.stand()

    def world(self):
        """@return simulated time, s, and the true position of the torso, m."""
        truth = json.loads(self.robot.nao("world", "show", "--json"))
        return truth["utime"] * 1e-6, truth["robots"][0]["position_torso_in_world"]

    def walk(self, client, duration, speed=0.18):
        """Walks forward at `speed`, m/s, as the app does, until the robot has moved."""
        _, start = self.world()
        end = time.monotonic() + duration
        while time.monotonic() < end:
            client.ask(walk_turn=pb.WalkTurn(vx=speed))
            client.wait_until(lambda: False, WALK_PERIOD)
        wait_until(lambda: self.is_away_from(start, client, speed), "the robot walks")

    def is_away_from(self, start, client, speed):
        client.ask(walk_turn=pb.WalkTurn(vx=speed))
        _, here = self.world()
        return math.dist(start[:2], here[:2]) > 2 * STILL_DISTANCE

    def assert_stands_soon(self):
        """The robot stands still TIME_TO_STAND after now, upright."""
        start, _ = self.world()
        wait_until(lambda: self.world()[0] > start + TIME_TO_STAND, "simulated time passes")
        _, before = self.world()
        wait_until(lambda: self.world()[0] > start + TIME_TO_STAND + STILL_TIME, "simulated time passes")
        _, after = self.world()
        self.assertLess(math.dist(before[:2], after[:2]), STILL_DISTANCE, "it still walks")
        self.assertGreater(after[2], 0.25, "it has fallen")

    def driver(self, port=None):
        client = phone.Phone(port=port or self.robot.gateway.tcp_port, timeout=DEADLINE, name="driver")
        self.addCleanup(client.__exit__)
        client.ask(take_control=pb.TakeControl())
        return client
