#!/usr/bin/python3
"""A walk ends in time when the driver's connection or the gateway fails: measured by the robot's true position, in simulated
time."""

import math
import signal
import subprocess
import sys
import unittest

from programs import BIN_DIR, DEADLINE, ROOT, wait_until
from walking import STILL_DISTANCE, WalkingTest

sys.path.insert(0, str(ROOT / "test/support"))

import phone
from faulty_link import FaultyLink
from nao_remote import remote_pb2 as pb


class LinkLoss(WalkingTest):
    def test_the_phone_stops_sending(self):
        client = self.driver()
        self.walk(client, 2)
        self.assert_stands_soon()

    def test_the_phone_closes_its_connection(self):
        client = self.driver()
        self.walk(client, 2)
        client.__exit__()
        self.assert_stands_soon()

    def test_the_phone_program_is_killed(self):
        command = [str(BIN_DIR / "nao-phone"), "--port", str(self.robot.gateway.tcp_port), "walk", "0.18",
                   "--duration", "60"]
        _, start = self.world()
        with subprocess.Popen(command) as process:
            wait_until(lambda: math.dist(start[:2], self.world()[1][:2]) > 2 * STILL_DISTANCE, "the robot walks")
            process.kill()
        self.assert_stands_soon()

    def test_a_phone_program_that_was_suspended_walks_no_more(self):
        command = [str(BIN_DIR / "nao-phone"), "--port", str(self.robot.gateway.tcp_port), "walk", "0.18",
                   "--duration", "60"]
        _, start = self.world()
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
            try:
                wait_until(lambda: math.dist(start[:2], self.world()[1][:2]) > 2 * STILL_DISTANCE, "the robot walks")
                process.send_signal(signal.SIGSTOP)
                self.assert_stands_soon()
                process.send_signal(signal.SIGCONT)
                _, said = process.communicate(timeout=DEADLINE)
            finally:
                process.kill()
        self.assertEqual(process.returncode, 1)
        self.assertIn("held up", said)

    def test_the_phone_is_out_of_reach(self):
        with FaultyLink(self.robot.gateway.tcp_port) as link:
            client = self.driver(link.port)
            self.walk(client, 2)
            link.stalled = True
            self.assert_stands_soon()
            # The half-open connection times out, and its control is released.
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

    def test_the_gateway_is_killed_and_restarted(self):
        client = self.driver()
        self.walk(client, 2)
        self.robot.gateway.kill()
        self.assert_stands_soon()
        self.robot.start_gateway()
        self.robot.stand()


if __name__ == "__main__":
    unittest.main()
