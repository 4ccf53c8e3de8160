#!/usr/bin/python3
"""Usage: test/system/robot_faults.py [--moments N] [--seed N] [--programs LIST] [--situations LIST]

Kills (SIGKILL) and stops (SIGSTOP) nao-robot, nao-motion and the gateway at random moments, with the whole stack behind LoLA in
real time, while the robot stands, walks or lies. Prints a table of how it ended. Exit status 1 if a robot that stood did not
end seated, or one that lay was not limp. With 20 moments, of each program and signal, about two hours; not part of the test run.
"""

import argparse
import collections
import json
import math
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from stack import BIN_DIR, DEADLINE, Stack  # noqa: E402

SIGNALS = {"KILL": signal.SIGKILL, "STOP": signal.SIGSTOP}
PROGRAMS = ("nao-robot", "nao-motion", "nao-phone-gateway")
SITUATIONS = ("standing", "walking", "lying")
# Time within which the robot must come to rest, s: the watchdog waits 0.3 s, sitting down takes 3 s.
REST_TIME = 12
# Range of the time of the fault after the beginning of the situation, s: a few steps.
MOMENT_RANGE = 2.0
# Longest wait for one step of the preparation, s.
STEP_TIME = 40


class Failure(Exception):
    """The preparation of a moment did not work."""


def wait(condition, what, limit=STEP_TIME):
    deadline = time.monotonic() + limit
    while not condition():
        if time.monotonic() > deadline:
            raise Failure(what)
        time.sleep(0.1)


class Robot:
    """The robot of a stack: what it does, and commands to it."""

    def __init__(self, stack):
        self.stack = stack
        self.walker = None

    def phase(self):
        programs = json.loads(self.stack.nao("status", "--json").stdout or "[]")
        robot = next((program for program in programs if program["program"] == "nao-robot"), {})
        return robot.get("detail", "")

    def pose(self):
        """"standing", "seated", "lying" or "between"."""
        robot = self.stack.truth()["robots"][0]
        _, x, y, _ = robot["orientation_torso_in_world"]
        tilt = math.acos(max(-1.0, min(1.0, 1 - 2 * (x * x + y * y))))
        height = robot["position_torso_in_world"][2]
        if tilt > 0.9:
            return "lying"
        if tilt < 0.4:
            return "seated" if height < 0.26 else "standing" if height > 0.28 else "between"
        return "between"

    def stand(self):
        """On its feet and driven, wherever it was before."""
        if self.pose() != "standing" or not self.phase().startswith("driven"):
            self.stack.nao("world", "place-robot", "0", "0", "--posture", "Crouch")
            wait(lambda: self.phase().startswith("driven"), "the robot is not driven")
        wait(lambda: self.stack.nao("posture", "StandInit").returncode == 0, "it does not stand up")

    def walk(self):
        self.walker = subprocess.Popen(
            [str(BIN_DIR / "nao-phone"), "--port", str(self.stack.tcp_port), "walk", "0.1", "0", "0", "--duration", "60"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait(lambda: self.stack.state()["motion_state"]["mode"] == "walking", "it does not walk")

    def stop_walking(self):
        if self.walker is not None:
            self.walker.kill()
            self.walker.wait()
            self.walker = None

    def prepare(self, situation):
        self.stand()
        if situation == "walking":
            self.walk()
        elif situation == "lying":
            self.stack.nao("world", "place-robot", "0", "0", "--posture", "LyingBack")


def try_once(stack, robot, program, number, situation):
    """@return how the robot ended."""
    robot.prepare(situation)
    time.sleep(random.uniform(0, MOMENT_RANGE if situation != "lying" else 0.8))
    before = stack.pids().get(program)
    if before is None:
        raise Failure(f"{program} does not run")
    os.kill(before, number)
    ended = "between"
    deadline = time.monotonic() + REST_TIME
    wanted = ("standing",) if program == "nao-phone-gateway" else ("seated", "lying")
    while time.monotonic() < deadline:
        time.sleep(0.5)
        ended = robot.pose()
        # It has begun to get up by itself again, if it could: --autostart.
        if ended in wanted and (ended == "seated" or time.monotonic() > deadline - REST_TIME + 4):
            break
    if program == "nao-motion" and number == signal.SIGSTOP and stack.pids().get(program) == before:
        os.kill(before, signal.SIGCONT)
    robot.stop_walking()
    wait(lambda: stack.pids().get(program, before) != before or number == signal.SIGSTOP,
         f"{program} is not started anew")
    if number == signal.SIGSTOP:
        # The process watchdog replaces it, or it continues.
        try:
            os.kill(before, signal.SIGCONT)
        except ProcessLookupError:
            pass
    return ended


def parse():
    parser = argparse.ArgumentParser(usage=__doc__.splitlines()[0][7:])
    parser.add_argument("--moments", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--programs", type=lambda text: text.split(","), default=PROGRAMS)
    parser.add_argument("--situations", type=lambda text: text.split(","), default=SITUATIONS)
    return parser.parse_args()


def main():
    options = parse()
    random.seed(options.seed)
    is_good = True
    with Stack() as stack:
        stack.start_or_fail("--backend", "lola", "--scene", "empty", "--no-camera")
        robot = Robot(stack)
        for situation in options.situations:
            for program in options.programs:
                for name, number in SIGNALS.items():
                    counts = collections.Counter()
                    for _ in range(options.moments):
                        try:
                            counts[try_once(stack, robot, program, number, situation)] += 1
                        except Failure as failure:
                            counts[f"not tried: {failure}"] += 1
                            robot.stop_walking()
                            stack.wait_ready("nao-motion", "nao-robot", "nao-phone-gateway")
                    if situation == "standing" and program != "nao-phone-gateway":
                        is_good = is_good and counts["seated"] == options.moments
                    text = ", ".join(f"{count} {what}" for what, count in sorted(counts.items()))
                    print(f"{situation:9} {program:18} SIG{name}: {text}", flush=True)
    return 0 if is_good else 1


if __name__ == "__main__":
    assert DEADLINE > STEP_TIME
    sys.exit(main())
