#!/usr/bin/python3
"""Simulator and camera, motion, and gateway on three hosts, with a network that delays and drops datagrams."""

import contextlib
import json
import math
import re
import os
import subprocess
import time
import unittest

from hosts import GROUP, Hosts
from stack import BIN_DIR, DEADLINE, ROOT, Stack, run

WORLD, MOTION, GATEWAY = "world", "motion", "gate"
ONLY = {WORLD: "sim,head-camera", MOTION: "motion", GATEWAY: "phone-gateway"}
DELAY = 0.02  # s, one way
LOSS = float(os.environ.get("NAO_TEST_LOSS", "0.01"))
# From the last received walk command to a robot at rest: a command is valid for 0.5 s; the steps
# that end the walk take more at this delay (nao-trial walk --latency 6 --late 0.02: up to 1 s).
STOP_TIME = 2.0


class HostStack(Stack):
    """The part of a stack that runs on one host."""

    def __init__(self, hosts, host):
        super().__init__()
        self.lcm_url = f"udpm://{GROUP}:{hosts.port}?ttl=1"
        self.hosts = hosts
        self.host = host

    def start_part(self):
        return run([*self.hosts.on(self.host), ROOT / "scripts/start", "--bin", BIN_DIR, "--run-dir", self.run_dir,
                    "--lcm-url", self.lcm_url, "--bind", "127.0.0.1", "--token", self.token, "--only", ONLY[self.host],
                    "--http-port", "8080", "--tcp-port", "7668"])

    def nao(self, *arguments):
        return run([*self.hosts.on(self.host), BIN_DIR / "nao", "--lcm-url", self.lcm_url, *arguments])

    def phone_command(self, *arguments):
        return [*self.hosts.on(self.host), str(BIN_DIR / "nao-phone"), "--port", "7668", *arguments]

    def phone(self, *arguments):
        return run(self.phone_command(*arguments))


@unittest.skipIf(Hosts.missing(), Hosts.missing())
class SeveralHosts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hosts = Hosts(list(ONLY), 20000 + os.getpid() % 10000, DELAY, LOSS)
        cls.hosts.__enter__()
        cls.addClassCleanup(cls.hosts.__exit__)
        cls.part = {}
        for host in ONLY:
            cls.part[host] = HostStack(cls.hosts, host)
            cls.addClassCleanup(cls.part[host].__exit__)
            started = cls.part[host].start_part()
            if started.returncode != 0:
                raise AssertionError(f"{host}: {started.stdout}{started.stderr}{cls.part[host].logs()}")
        ready = cls.part[GATEWAY].nao("status", "--wait", "nao-sim,nao-motion,nao-head-camera,nao-phone-gateway",
                                      "--timeout", "60")
        if ready.returncode != 0:
            raise AssertionError(ready.stderr + "".join(part.logs() for part in cls.part.values()))

    def truth(self):
        return json.loads(self.part[WORLD].nao("world", "show", "--json").stdout)["robots"][0]

    def assert_obeys(self, posture, height):
        deadline = time.monotonic() + DEADLINE
        result = self.part[GATEWAY].phone("posture", posture)
        # On a busy machine sensor data may be late for longer than nao-motion waits; and after a cut the gateway hears the
        # robot up to 0.1 s later than its status.
        while (re.search("no sensor data|does not answer", result.stdout + result.stderr)
               and time.monotonic() < deadline):
            result = self.part[GATEWAY].phone("posture", posture)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertAlmostEqual(self.truth()["position_torso_in_world"][2], height, delta=0.02)

    def test_a_phone_moves_the_robot_and_sees_it(self):
        # data/robots/nao/postures.yaml: heights of the torso.
        self.assert_obeys("Crouch", 0.229)
        self.assert_obeys("StandInit", 0.322)
        image = self.part[GATEWAY].run_dir / "image.jpg"
        result = self.part[GATEWAY].phone("image", image)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertTrue(image.read_bytes().startswith(b"\xff\xd8"))

    def place(self):
        """(true position of the torso, m; simulated time, s)."""
        world = json.loads(self.part[WORLD].nao("world", "show", "--json").stdout)
        return world["robots"][0]["position_torso_in_world"], world["utime"] * 1e-6

    def assert_upright(self, position):
        self.assertGreater(position[2], 0.28, "it has fallen")

    def test_a_phone_walks_the_robot(self):
        start = self.place()[0]
        with self.walking():
            self.await_distance(start, 0.5)
            self.assert_upright(self.place()[0])
        self.assert_obeys("StandInit", 0.322)

    @contextlib.contextmanager
    def walking(self):
        """A phone that walks the robot backward."""
        walk = subprocess.Popen(self.part[GATEWAY].phone_command("walk", "-0.1", "--duration", "60"),
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            yield
        finally:
            walk.kill()
            walk.wait()

    def await_time(self, simulated):
        deadline = time.monotonic() + DEADLINE
        while self.place()[1] < simulated:
            self.assertLess(time.monotonic(), deadline)

    def await_distance(self, start, distance):
        deadline = time.monotonic() + DEADLINE
        while math.dist(self.place()[0][:2], start[:2]) < distance:
            self.assertLess(time.monotonic(), deadline, "it does not walk")

    def test_a_gateway_that_is_cut_off_while_a_phone_walks_leaves_a_robot_that_stands(self):
        start = self.place()[0]
        try:
            with self.walking():
                self.await_distance(start, 0.15)
                self.hosts.cut(GATEWAY)
                self.await_time(self.place()[1] + STOP_TIME)
                stopped, stopped_at = self.place()
                self.await_time(stopped_at + 2)
                self.assertLess(math.dist(self.place()[0], stopped), 0.015, "it walks on")
                self.assert_upright(stopped)
        finally:
            self.hosts.mend(GATEWAY)
            self.part[GATEWAY].nao("status", "--wait", "nao-sim,nao-motion", "--timeout", "60")
        self.assert_obeys("StandInit", 0.322)

    def test_a_motion_host_that_is_cut_off_comes_back(self):
        before = self.truth()["position_torso_in_world"]
        self.hosts.cut(MOTION)
        try:
            refused = self.part[GATEWAY].nao("posture", "Crouch")
            self.assertEqual(refused.returncode, 1)
            self.assertIn("does not answer", refused.stderr)
            after = self.truth()["position_torso_in_world"]
            self.assertLess(max(abs(a - b) for a, b in zip(after, before)), 0.03, "stands as it stood")
        finally:
            self.hosts.mend(MOTION)
        deadline = time.monotonic() + DEADLINE
        while self.part[GATEWAY].nao("status", "--wait", "nao-motion", "--timeout", "5").returncode != 0:
            self.assertLess(time.monotonic(), deadline)
        self.assert_obeys("Crouch", 0.229)
        self.assert_obeys("StandInit", 0.322)

    def test_the_bus_check_names_the_programs_of_all_hosts(self):
        said = self.part[GATEWAY].nao("status").stdout
        for program in ("nao-sim", "nao-motion", "nao-head-camera", "nao-phone-gateway"):
            self.assertIn(program, said)


if __name__ == "__main__":
    unittest.main()
