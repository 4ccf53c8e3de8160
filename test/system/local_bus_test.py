#!/usr/bin/python3
"""Programs of one host (ttl=0) hear one another, whatever the host's network is."""

import json
import os
import signal
import subprocess
import sys
import time
import unittest

from stack import BIN_DIR, DEADLINE, Stack


def ip(*words):
    return subprocess.run(["ip", *words], check=False, capture_output=True, text=True)


def has_namespace_of_its_own():
    return len(json.loads(ip("-json", "link").stdout)) == 1 and ip("link", "add", "wifi0", "type", "veth", "peer", "name", "router0").returncode == 0


class LocalBus(unittest.TestCase):
    def test_it_lives_on_when_the_network_goes(self):
        # A host in a Wi-Fi: multicast has the default route.
        ip("route", "delete", "224.0.0.0/4")
        ip("address", "add", "192.168.7.2/24", "dev", "wifi0")
        ip("link", "set", "wifi0", "up")
        ip("link", "set", "router0", "up")
        ip("route", "add", "default", "via", "192.168.7.1")
        with Stack() as stack:
            stack.start_or_fail("--only", "sim,motion")
            log = stack.run_dir / "lcm.log"
            # LCM's own tools listen on the interface of the route.
            logger = subprocess.Popen(["lcm-logger", "--quiet", f"--lcm-url={stack.lcm_url}", log], stdout=subprocess.DEVNULL)
            self.addCleanup(logger.kill)
            self.wait_until(lambda: log.exists() and log.stat().st_size > 100_000)
            logger.terminate()
            logger.wait(DEADLINE)

            ip("link", "delete", "wifi0")
            said = stack.nao("bus")
            self.assertIn("by interface lo", said.stdout)
            self.assertEqual(said.returncode, 0, said.stdout)
            self.obeys(stack)
            motion = stack.pids()["nao-motion"]
            os.kill(motion, signal.SIGKILL)
            self.wait_until(lambda: stack.pids().get("nao-motion", motion) != motion)
            ready = stack.wait_ready("nao-motion")
            self.assertEqual(ready.returncode, 0, ready.stderr)
            self.obeys(stack)
        with Stack() as stack:
            stack.start_or_fail("--only", "sim,motion")
            self.obeys(stack)

    def test_the_check_names_a_multicast_route_on_another_interface_than_the_hosts(self):
        for name, address in (("wifi1", "192.168.8.2/24"), ("cable1", "10.9.8.2/24")):
            ip("link", "add", name, "type", "veth", "peer", "name", f"{name}-end")
            self.addCleanup(ip, "link", "delete", name)
            ip("address", "add", address, "dev", name)
            for end in (name, f"{name}-end"):
                ip("link", "set", end, "up")
        ip("route", "replace", "default", "via", "192.168.8.1")
        bus = [BIN_DIR / "nao", "--lcm-url", "udpm://239.255.76.67:17667?ttl=1", "bus"]
        for route, status, words in (("cable1", 1, "FAIL  no program of another host is heard; messages to other hosts leave by cable1 only, and the "
                                                   "default route goes by wifi1"),
                                     ("wifi1", 0, "note  no program of another host is heard; messages to other hosts leave by wifi1 only. If")):
            with self.subTest(route=route):
                ip("route", "replace", "239.255.76.0/24", "dev", route)
                said = subprocess.run(bus, check=False, capture_output=True, text=True, timeout=DEADLINE)
                self.assertIn(words, said.stdout)
                self.assertEqual(said.returncode, status, said.stdout)

    def obeys(self, stack):
        for posture in ("Crouch", "StandInit"):
            result = stack.nao("posture", posture)
            self.assertEqual(result.returncode, 0, result.stderr)

    def wait_until(self, condition):
        deadline = time.monotonic() + DEADLINE
        while not condition():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)


if __name__ == "__main__":
    if not has_namespace_of_its_own():
        print("skipped: it needs a network namespace of its own", file=sys.stderr)
        sys.exit(77)
    unittest.main()
