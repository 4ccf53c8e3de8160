#!/usr/bin/python3
"""Usage: test/system/robot_drive.py [--seeds A-B] [--duration S] [--disturbances NAMES] [--real-time]

Joystick sessions of a network client with the whole stack behind LoLA: client, gateway, nao-motion, nao-robot, socket, simulator; in
lock-step, at up to three times real time. Before each session the robot goes to a posture, gets up from its back and kicks. Prints how each
session ended. Exit status 1 if a robot fell in more than one session of ten, or did not do the rest. A session of 600 s takes minutes;
not part of the test run.
"""

import argparse
import math
import random
import sys
import time
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "phone-gateway/clients/python"))
import built_package  # noqa: E402, F401
import nao_remote  # noqa: E402
from nao_remote import Mode  # noqa: E402
from stack import Stack  # noqa: E402

FALLEN = (Mode.FALLING, Mode.FALLEN, Mode.GETTING_UP)
# Simulated seconds per wall second in lock-step, at most: the gateway repeats a walk command every 0.1 s of the wall clock, and
# nao-motion ends the walk 0.5 s of robot time after the last one. Without it, a fall and the get-up end between two states that the
# client reads.
PACE = 3
# Joystick values are held for as long, s of robot time; part of the time the sticks are released, or pressed to the stop.
HOLD_RANGE = (0.2, 4)
PART_AHEAD = 0.15
PART_RELEASED = 0.15
# States a second of wall clock that decide when the joysticks move.
STATE_RATE = 50


def prepare(stack, robot):
    """Postures, get-up and kick. @return what failed, or an empty text. @raise CommandFailed"""
    ready = robot.description.ready_posture
    robot.posture(robot.description.rest_posture)
    robot.posture(ready)
    stack.nao("world", "place-robot", "0", "0", "--posture", "LyingBack")
    if not robot.wait_until(lambda state: state.mode in FALLEN, timeout=60):
        return "the fall was not noticed"
    robot.wait_until(lambda state: state.mode == Mode.HOLDING, timeout=120)
    robot.posture(ready)
    if stack.torso_height() < 0.3:
        return "it did not get up"
    kick = next(name for name in sorted(robot.description.actions) if "kick" in name)
    try:
        robot.action(kick)
    except nao_remote.CommandFailed as failure:
        # There is no ball.
        if failure.reason_code != "kick-missed":
            raise
    return "" if stack.torso_height() > 0.3 else f"it fell in {kick}"


def drive(robot, seed, duration):
    """Random positions of the joysticks. @return robot time until the fall, s, at least the duration if there was none; and the part
    of the states in which the robot walked."""
    draw = random.Random(seed)
    limits = robot.description
    start = None
    change = 0
    num_states = num_walking = 0
    for state in robot.states(rate=STATE_RATE):
        now = state.utime * 1e-6
        start = now if start is None else start
        num_states += 1
        num_walking += state.mode == Mode.WALKING
        if state.mode in FALLEN or now - start >= duration:
            return now - start, num_walking / num_states
        if now < change:
            continue
        change = now + draw.uniform(*HOLD_RANGE)
        kind = draw.random()
        x, y, turn = (draw.uniform(-1, 1) for _ in range(3))
        velocity = (x * (limits.max_vx if x > 0 else -limits.min_vx), y * limits.max_vy, turn * limits.max_wz)
        if kind < PART_AHEAD:
            velocity = (limits.max_vx, 0, 0)
        elif kind > 1 - PART_RELEASED:
            velocity = (0, 0, 0)
        robot.walk(*velocity)
    raise ConnectionError("no states come")


@dataclass
class Session:
    # The failure before the drive; empty if there was none.
    fault: str
    # Robot time of the drive without a fall, s.
    driven: float
    # Part of that time during which it walked.
    walking: float
    # Wall time of the drive, s.
    wall: float


def run_session(seed, duration, disturbances, is_real_time=False):
    words = [] if is_real_time else ["--lock-step"]
    with Stack() as stack:
        stack.start_or_fail("--backend", "lola", "--scene", "empty", "--only", "sim,robot,motion,phone-gateway",
                            "--disturbances", disturbances, "--seed", str(seed), *words)
        with nao_remote.connect(f"tcp://127.0.0.1:{stack.tcp_port}") as robot:
            if not is_real_time:
                stack.nao("world", "set-pace", PACE)
            robot.wait_until(lambda state: state.mode == Mode.HOLDING, timeout=60)
            try:
                fault = prepare(stack, robot)
            except (nao_remote.CommandFailed, nao_remote.Timeout) as failure:
                fault = str(failure)
                stack.nao("world", "place-robot", "0", "0", "--posture", robot.description.ready_posture)
                robot.wait_until(lambda state: state.mode == Mode.HOLDING, timeout=120)
            started = time.monotonic()
            driven, walking = drive(robot, seed, duration)
            return Session(fault, driven, walking, time.monotonic() - started)


def parse():
    parser = argparse.ArgumentParser(usage=__doc__.splitlines()[0][7:])
    parser.add_argument("--seeds", default="1-10")
    parser.add_argument("--duration", type=float, default=600)
    parser.add_argument("--disturbances", default="real")
    parser.add_argument("--real-time", action="store_true")
    options = parser.parse_args()
    first, _, last = options.seeds.partition("-")
    options.seeds = range(int(first), int(last or first) + 1)
    return options


def main():
    options = parse()
    num_upright = 0
    num_faults = 0
    for seed in options.seeds:
        session = run_session(seed, options.duration, options.disturbances, options.real_time)
        is_upright = session.driven >= options.duration
        num_upright += is_upright
        num_faults += session.fault != ""
        print(f"seed {seed}: {session.fault or 'posture, get-up and kick done'}; {'no fall in' if is_upright else 'fell after'} "
              f"{session.driven:.0f} s of driving, {100 * session.walking:.0f} % of it walking, {session.driven / session.wall:.1f} times real time", flush=True)
    num = len(options.seeds)
    print(f"{num_upright} of {num} sessions of {options.duration:.0f} s without a fall; {num - num_faults} of {num} prepared")
    return 0 if num - num_upright <= math.floor(num / 10) and num_faults == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
