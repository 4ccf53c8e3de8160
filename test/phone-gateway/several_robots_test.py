#!/usr/bin/python3
"""One gateway offers robots of different models; none of them runs."""

import subprocess
import unittest

from programs import BIN_DIR, DEADLINE, Gateway

import phone
from nao_remote import remote_pb2 as pb


class SeveralRobots(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.gateway = Gateway("--robot", "NAO1:nao:0:1", "--robot", "NAO2:t1:1:4")
        cls.addClassCleanup(cls.gateway.kill)

    def phone(self, name, **options):
        client = phone.Phone(port=self.gateway.tcp_port, name=name, timeout=DEADLINE, **options)
        self.addCleanup(client.__exit__)
        return client

    def nao_phone(self, *arguments):
        return subprocess.run([str(BIN_DIR / "nao-phone"), "--port", str(self.gateway.tcp_port), *arguments],
                              capture_output=True, text=True, timeout=DEADLINE, check=False)

    def test_each_has_its_own_description(self):
        self.assertEqual(self.phone("Ana").robot.model, "nao")
        ben = self.phone("Ben", robot="NAO2")
        self.assertEqual(ben.robot.model, "t1")
        self.assertEqual([(robot.name, robot.team, robot.number) for robot in ben.connected.robots.robots],
                         [("NAO1", 0, 1), ("NAO2", 1, 4)])

    def test_a_change_of_robot_brings_the_other_description(self):
        ana = self.phone("Ana", robot="NAO1")
        ana.ask(watch_robot=pb.WatchRobot(robot="NAO2"))
        self.assertTrue(ana.wait_until(
            lambda: any(notice.kind == pb.Notice.ROBOT_CHANGED and notice.robot.model == "t1" for notice in ana.notices), DEADLINE))

    def test_the_command_line_client_lists_them_and_chooses_one(self):
        ana = self.phone("Ana", robot="NAO2")
        ana.ask(take_control=pb.TakeControl())
        listed = self.nao_phone("robots")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertRegex(listed.stdout, r"NAO1 +nao +team 0 number 1 +does not answer\n")
        self.assertRegex(listed.stdout, r"NAO2 +t1 +team 1 number 4 +Ana drives\n")
        unknown = self.nao_phone("--robot", "NAO9", "state")
        self.assertEqual(unknown.returncode, 1)
        self.assertIn("NAO1, NAO2", unknown.stderr)

    def test_a_wrong_command_line_is_explained(self):
        for robots in (["NAO1", "NAO1:t1"], ["nao"], ["NAO1:nao:3:1"], ["NAO1:no-such-model"]):
            said = subprocess.run([str(BIN_DIR / "nao-phone-gateway"), "--lcm-url", "memq://", "--bind", "127.0.0.1",
                                   *[word for robot in robots for word in ("--robot", robot)]],
                                  capture_output=True, text=True, timeout=DEADLINE, check=False)
            self.assertIn(said.returncode, (1, 2), robots)
            self.assertIn(robots[-1].split(":")[-1] if "model" in robots[-1] else "NAO1" if len(robots) > 1 else robots[0],
                          said.stderr)


if __name__ == "__main__":
    unittest.main()
