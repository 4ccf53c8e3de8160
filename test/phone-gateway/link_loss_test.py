#!/usr/bin/python3
"""Whatever breaks while a phone walks the robot, the walk ends in time: judged by where the simulator says
that the robot is, in simulated time."""

import json
import math
import subprocess
import sys
import time
import unittest

from programs import BIN_DIR, DEADLINE, ROOT, Robot, wait_until

sys.path.insert(0, str(ROOT / "test/support"))

import phone  # of phone-gateway/examples/python
from faulty_link import FaultyLink
from remote_protocol import remote_pb2 as pb

WALK_PERIOD = 0.1
# From the last command to the walk's end: 0.5 s until it is stale in the gateway (or in motion, if the gateway is
# gone), and the steps that bring the robot to a stand.
TIME_TO_STAND = 3.0
# A robot that walks gets this far in STILL_TIME several times over; one that stands sways less.
STILL_TIME = 2.0
STILL_DISTANCE = 0.02


class LinkLoss(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = cls.enterClassContext(Robot(scene="empty"))

    def setUp(self):
        self.robot.stand()

    def world(self):
        """@return simulated time, s, and the torso's place on the floor, m."""
        truth = json.loads(self.robot.nao("world", "show", "--json"))
        return truth["utime"] * 1e-6, truth["robots"][0]["position_torso_in_world"]

    def walk(self, client, duration, speed=0.6):
        """Walks as an app does, and makes sure that the robot really goes."""
        _, start = self.world()
        end = time.monotonic() + duration
        while time.monotonic() < end:
            client.ask(walk_turn=pb.WalkTurn(x=speed))
            client.wait_until(lambda: False, WALK_PERIOD)
        wait_until(lambda: self.is_away_from(start, client, speed), "the robot walks")

    def is_away_from(self, start, client, speed):
        client.ask(walk_turn=pb.WalkTurn(x=speed))
        _, here = self.world()
        return math.dist(start[:2], here[:2]) > 2 * STILL_DISTANCE

    def assert_stands_soon(self):
        """The robot stands still TIME_TO_STAND after now, upright."""
        start, _ = self.world()
        wait_until(lambda: self.world()[0] > start + TIME_TO_STAND, "simulated time passes")
        _, before = self.world()
        wait_until(lambda: self.world()[0] > start + TIME_TO_STAND + STILL_TIME, "simulated time passes")
        _, after = self.world()
        self.assertLess(math.dist(before[:2], after[:2]), STILL_DISTANCE, "it walks on")
        self.assertGreater(after[2], 0.25, "it has fallen")

    def driver(self, port=None):
        client = phone.Phone(port=port or self.robot.gateway.tcp_port, timeout=DEADLINE, name="driver")
        self.addCleanup(client.__exit__)
        client.ask(take_control=pb.TakeControl())
        return client

    def test_the_phone_falls_silent(self):
        client = self.driver()
        self.walk(client, 2)
        self.assert_stands_soon()

    def test_the_phone_closes_its_connection(self):
        client = self.driver()
        self.walk(client, 2)
        client.__exit__()
        self.assert_stands_soon()

    def test_the_phone_program_is_killed(self):
        command = [str(BIN_DIR / "nao-phone"), "--port", str(self.robot.gateway.tcp_port), "walk", "0.6",
                   "--duration", "60"]
        _, start = self.world()
        with subprocess.Popen(command) as process:
            wait_until(lambda: math.dist(start[:2], self.world()[1][:2]) > 2 * STILL_DISTANCE, "the robot walks")
            process.kill()
        self.assert_stands_soon()

    def test_the_phone_is_out_of_reach(self):
        with FaultyLink(self.robot.gateway.tcp_port) as link:
            client = self.driver(link.port)
            self.walk(client, 2)
            link.stalled = True
            self.assert_stands_soon()
            # The half-open connection is found by its silence, and its control is free.
            with phone.Phone(port=self.robot.gateway.tcp_port, timeout=DEADLINE) as other:
                other.wait_until(lambda: any(not notice.control.driver_id for notice in other.notices
                                             if notice.kind == pb.Notice.CONTROL_CHANGED), 10)
                self.assertTrue(other.ask(take_control=pb.TakeControl()).control.is_mine)

    def test_the_connection_is_reset(self):
        with FaultyLink(self.robot.gateway.tcp_port) as link:
            client = self.driver(link.port)
            self.walk(client, 2)
            link.reset()
            self.assert_stands_soon()

    def test_a_slow_link_walks_and_stops(self):
        with FaultyLink(self.robot.gateway.tcp_port) as link:
            link.delay = 0.2
            client = self.driver(link.port)
            self.walk(client, 3)
            client.ask(walk_turn=pb.WalkTurn())
            self.assert_stands_soon()

    def test_the_gateway_is_killed_and_comes_back(self):
        client = self.driver()
        self.walk(client, 2)
        self.robot.gateway.kill()
        self.assert_stands_soon()
        self.robot.start_gateway()
        self.robot.stand()


if __name__ == "__main__":
    unittest.main()
