#!/usr/bin/python3
"""Each program ends on SIGTERM and is restarted after a crash."""

import os
import signal
import socket
import tempfile
import time
import unittest

from stack import DEADLINE, Program, Stack, free_port

PROGRAMS = {
    "nao-sim": [],
    "nao-motion": [],
    "nao-motion-files": ["--folder", "/nowhere/motions"],
    "nao-head-camera": [],
    "nao-speaker": ["--output", "none"],
    "nao-phone-gateway": ["--bind", "127.0.0.1", "--token", "x"],
}
# And those that run only with an option of scripts/start.
ALL_PROGRAMS = {**PROGRAMS, "nao-robot": ["--lola", "/nowhere/lola"], "nao-foxglove": ["--port", "0"], "nao-play": [],
                "nao-referee": ["--robot", "NAO1:nao:0:1", "--robot", "NAO2:nao:1:1"]}


def options_of(name):
    if name == "nao-phone-gateway":
        return [*PROGRAMS[name], "--http-port", free_port(), "--tcp-port", free_port()]
    return ALL_PROGRAMS[name]


class Ending(unittest.TestCase):
    def test_each_program_ends_well_when_asked(self):
        for name in ALL_PROGRAMS:
            for asked in (signal.SIGTERM, signal.SIGINT):
                with self.subTest(program=name, signal=asked), Stack() as stack:
                    program = Program(name, stack.lcm_url, *options_of(name))
                    self.addCleanup(program.kill)
                    # Alone on the bus it may wait for other programs; it must publish its status.
                    deadline = time.monotonic() + DEADLINE
                    while name not in stack.nao("status").stdout and time.monotonic() < deadline:
                        self.assertIsNone(program.process.poll())
                    status, seconds, said = program.end(asked)
                    self.assertEqual(status, 0, said)
                    # Specified: 2 s. The rest allows for a loaded machine.
                    self.assertLess(seconds, 10)

    def test_each_program_has_a_version_and_explains_its_options(self):
        for name in [*ALL_PROGRAMS, "nao"]:
            with self.subTest(program=name):
                for option, expected in (("--version", name), ("--help", "--lcm-url")):
                    program = Program(name, "memq://", option)
                    program.process.communicate(timeout=DEADLINE)
                    self.assertEqual(program.process.returncode, 0)

    def test_a_wrong_option_is_status_2(self):
        for name in ALL_PROGRAMS:
            with self.subTest(program=name):
                program = Program(name, "memq://", "--no-such-option")
                _, said = program.process.communicate(timeout=DEADLINE)
                self.assertEqual(program.process.returncode, 2, said)


class Turns(unittest.TestCase):
    def test_control_goes_ahead_of_the_gateway_and_that_ahead_of_pictures(self):
        try:
            os.sched_setscheduler(os.getpid(), os.SCHED_RR, os.sched_param(2))
        except PermissionError:
            self.skipTest("takes root or RLIMIT_RTPRIO of 2")
        os.sched_setscheduler(os.getpid(), os.SCHED_OTHER, os.sched_param(0))
        with Stack() as stack:
            stack.start_or_fail()
            pids = stack.pids()
            priorities = {name: os.sched_getparam(pids[name]).sched_priority for name in PROGRAMS}
        self.assertEqual(priorities, {"nao-sim": 2, "nao-motion": 2, "nao-phone-gateway": 1, "nao-motion-files": 0,
                                      "nao-head-camera": 0, "nao-speaker": 0})


class ServiceManager(unittest.TestCase):
    def test_each_program_tells_systemd_that_it_is_ready_and_that_it_lives(self):
        for name in ALL_PROGRAMS:
            with self.subTest(program=name), Stack() as stack, \
                    tempfile.TemporaryDirectory() as folder, \
                    socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
                manager.bind(f"{folder}/notify")
                manager.settimeout(DEADLINE)
                program = Program(name, stack.lcm_url, *options_of(name),
                                  environment={"NOTIFY_SOCKET": f"{folder}/notify"})
                self.addCleanup(program.kill)
                said = []
                while sum("READY=1" in words for words in said) < 3:
                    said.append(manager.recv(4096).decode().split("\n"))
                    self.assertIn("WATCHDOG=1", said[-1])
                os.kill(program.process.pid, signal.SIGSTOP)
                # Earlier messages may still be in transit.
                manager.settimeout(3)
                with self.assertRaises(TimeoutError):
                    for _ in range(3):
                        manager.recv(4096)
                os.kill(program.process.pid, signal.SIGCONT)
                status, _, words = program.end()
                self.assertEqual(status, 0, words)


class Killing(unittest.TestCase):
    def test_a_killed_program_comes_back_and_the_robot_obeys_again(self):
        self.fault_each_program(signal.SIGKILL)

    def test_a_hung_program_is_replaced_and_the_robot_obeys_again(self):
        self.fault_each_program(signal.SIGSTOP)

    def fault_each_program(self, with_signal):
        with Stack() as stack:
            stack.start_or_fail()
            for name in PROGRAMS:
                with self.subTest(program=name):
                    old = stack.pids()[name]
                    os.kill(old, with_signal)
                    deadline = time.monotonic() + DEADLINE
                    while stack.pids().get(name, old) == old:
                        self.assertLess(time.monotonic(), deadline, stack.logs())
                        time.sleep(0.1)
                    ready = stack.wait_ready(*PROGRAMS)
                    self.assertEqual(ready.returncode, 0, ready.stderr + stack.logs())
                    for posture in ("Crouch", "Stand"):
                        result = stack.nao("posture", posture)
                        self.assertEqual(result.returncode, 0, f"{name}: {result.stderr}{stack.logs()}")


if __name__ == "__main__":
    unittest.main()
