#!/usr/bin/python3
"""Usage: test/phone-gateway/exhibition_soak.py [--minutes M]

An exhibition in real time: a stack of scripts/start with visitors that drive against the fence, leave, do nothing, scan twice,
fall silent or never come back, while gateway and simulator are killed by turns every two minutes. Exit status 1 if a visitor that
stayed was not served exactly once, two drove at the same time, the robot walked out of the fence by more than 10 cm, or the
gateway's memory grows. Not part of the test run, because of its duration (default: 60 minutes).
"""

import argparse
import os
import random
import secrets
import signal
import statistics
import sys
import threading
import time
from collections import Counter

import programs  # noqa: F401  (where the packages are)
from phone import ConnectionLost, Phone, Refused
from stack import Stack
from nao_remote import remote_pb2 as pb

FENCE = 0.6  # m, half of its side
OVERSHOOT = 0.1  # m
TURN = 20  # s
SETTINGS = f"""
turn: {TURN}
warning: 5
idle: 6
changeover: 2
reconnect: 40
fence: {{frame: start, corners: [[-{FENCE}, -{FENCE}], [{FENCE}, -{FENCE}], [{FENCE}, {FENCE}], [-{FENCE}, {FENCE}]]}}
attract: {{period: 10, actions: [wave]}}
"""
HABITS = ("drives",) * 6 + ("leaves the queue", "leaves the turn", "does nothing", "scans twice", "is silent", "never returns")
KILLED = ("nao-phone-gateway", "nao-sim")
KILL_PERIOD = 120  # s
ARRIVAL = (3, 36)  # s between two visitors: most wait, and at times nobody is there
WARM_UP = 30  # s in which a new gateway's memory settles
MAX_SLOPE = 1.0  # MiB an hour

Phase = pb.Exhibition


class Visitor(threading.Thread):
    """A person with a phone, which connects again like the app."""

    def __init__(self, port, habit, rng):
        super().__init__(daemon=True)
        self.port, self.habit, self.rng = port, habit, rng
        self.key = secrets.token_hex(16)
        self.served = False
        self.was_silent = False
        self.turns = []  # [first, last] obeyed walk of each turn, s
        self.is_driving = False

    def run(self):
        while not self.served:
            try:
                self.visit()
            except (ConnectionLost, Refused):
                time.sleep(1)

    def connect(self):
        phone = Phone(port=self.port, token="test-token", name="visitor")
        phone.ask(attend=pb.Attend(visitor_key=self.key))
        return phone

    def visit(self):
        with self.connect() as phone:
            other = self.connect() if self.habit == "scans twice" else None
            try:
                self.wait_and_drive(other or phone, phone)
            finally:
                if other:
                    other.__exit__()

    def wait_and_drive(self, phone, first):
        until_tired = time.monotonic() + self.rng.uniform(3, 30)
        while not self.served:
            phone.wait_until(lambda: False, 0.1)
            if first is not phone:
                first.wait_until(lambda: False, 0.01)
            told = next((notice.exhibition for notice in reversed(phone.notices) if notice.kind == pb.Notice.EXHIBITION_CHANGED), None)
            del phone.notices[:-20]
            is_tired = time.monotonic() > until_tired
            if told is None:
                continue
            if told.phase == Phase.SERVED or (told.phase == Phase.NONE and self.habit.startswith("leaves") and is_tired):
                self.served = True
            elif told.phase == Phase.DRIVING and not told.is_robot_away:
                self.drive(phone)
            else:
                self.is_driving = False
                self.wait(phone, is_tired)

    def wait(self, phone, is_tired):
        if not is_tired:
            return
        if self.habit == "leaves the queue":
            phone.ask(attend=pb.Attend(visitor_key=self.key, leaves=True))
            self.served = True
        elif self.habit == "is silent":
            self.habit, self.was_silent = "drives", True
            time.sleep(15)
        elif self.habit == "never returns":
            self.served = True

    def drive(self, phone):
        if not self.is_driving:
            self.is_driving = True
            self.turns.append([])
            self.velocity = pb.WalkTurn()
            self.next_velocity = 0
        if self.habit == "does nothing":
            return
        now = time.monotonic()
        if now > self.next_velocity:
            self.next_velocity = now + self.rng.uniform(1, 5)
            self.velocity = pb.WalkTurn(vx=self.rng.uniform(-0.1, 0.25), vy=self.rng.uniform(-0.1, 0.1), wz=self.rng.uniform(-0.4, 0.4))
            # Lets go of the stick first, as a hand does.
            self.command(phone, pb.WalkTurn())
        self.command(phone, self.velocity)
        if self.habit == "leaves the turn" and self.turns[-1] and now - self.turns[-1][0] > 5:
            phone.ask(attend=pb.Attend(visitor_key=self.key, leaves=True))
            self.served = True

    def command(self, phone, velocity):
        try:
            phone.ask(walk_turn=velocity)
            now = time.monotonic()
            self.turns[-1][:] = [self.turns[-1][0] if self.turns[-1] else now, now]
        except Refused:
            pass  # the turn has ended, or the robot gets up


class Watch:
    """What must hold all the time."""

    def __init__(self, stack):
        self.stack = stack
        self.faults = Counter()
        self.farthest = 0
        self.memory = {}  # samples (s, MiB) of each gateway process
        self.kills = Counter()
        self.max_waiting = 0

    def look(self):
        try:
            truth = self.stack.truth()["robots"][0]["position_torso_in_world"]
            pid = self.stack.pids()["nao-phone-gateway"]
            with open(f"/proc/{pid}/statm", encoding="ascii") as file:
                pages = int(file.read().split()[1])
        except (ValueError, KeyError, IndexError, OSError):
            return  # killed a moment ago
        self.memory.setdefault(pid, []).append((time.monotonic(), pages * os.sysconf("SC_PAGESIZE") / 2 ** 20))
        # A fallen robot lies where it fell.
        if truth[2] > 0.25:
            self.farthest = max(self.farthest, abs(truth[0]), abs(truth[1]))

    def kill(self, name):
        pid = self.stack.pids().get(name)
        if pid:
            os.kill(pid, signal.SIGKILL)
            self.kills[name] += 1

    def slope(self):
        """@return MiB an hour, of the gateway that ran longest."""
        longest = max(self.memory.values(), key=len)
        settled = [sample for sample in longest if sample[0] > longest[0][0] + WARM_UP]
        return 3600 * statistics.linear_regression(*zip(*settled)).slope if len(settled) > 30 else 0.0


def soak(stack, minutes, rng):
    watch, visitors = Watch(stack), []
    start = now = time.monotonic()
    # The last third is without kills, so that memory can be judged.
    next_visit, next_kill, end = now, now + KILL_PERIOD, now + 60 * minutes
    killed = 0
    while now < end or any(visitor.is_alive() for visitor in visitors):
        if now > end + 600:
            break
        if now >= next_visit and now < end - 60:
            visitors.append(Visitor(stack.tcp_port, rng.choice(HABITS), rng))
            visitors[-1].start()
            next_visit = now + rng.uniform(*ARRIVAL)
        if now >= next_kill and now < start + 40 * minutes:
            watch.kill(KILLED[killed % len(KILLED)])
            killed += 1
            next_kill = now + KILL_PERIOD
        watch.look()
        watch.max_waiting = max(watch.max_waiting, sum(visitor.is_alive() for visitor in visitors))
        time.sleep(0.3)
        now = time.monotonic()
    return watch, visitors


def judge(watch, visitors):
    """@return what was wrong, in words."""
    faults = []
    stayed = [visitor for visitor in visitors if visitor.habit in ("drives", "scans twice", "is silent")]
    for visitor in stayed:
        driven = [turn for turn in visitor.turns if turn]
        # Whose turn begins in a silence loses it, as one that does nothing.
        if visitor.is_alive() or not visitor.served or not (driven or visitor.was_silent):
            faults.append(f"a visitor that {visitor.habit} was not served")
        # A turn that the robot's absence or a restart interrupts goes on.
        if driven and driven[-1][1] - driven[0][0] > TURN + KILL_PERIOD:
            faults.append("a visitor was served twice")
    intervals = sorted(turn for visitor in visitors for turn in visitor.turns if turn)
    faults += ["two drove at the same time" for one, other in zip(intervals, intervals[1:]) if other[0] < one[1]]
    if watch.farthest > FENCE + OVERSHOOT:
        faults.append(f"the robot was {watch.farthest:.2f} m away")
    if watch.slope() > MAX_SLOPE:
        faults.append("the gateway's memory grows")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=60)
    options = parser.parse_args()
    with Stack() as stack:
        settings = stack.run_dir / "fair.yaml"
        settings.write_text(SETTINGS, encoding="utf-8")
        stack.start_or_fail("--scene", "empty", "--no-camera", "--exhibition", settings)
        watch, visitors = soak(stack, options.minutes, random.Random(1))
        faults = judge(watch, visitors)
        print(next((stack.run_dir / "logs").glob("exhibition-*.txt")).read_text(encoding="utf-8"))
        if faults:
            print(stack.logs())
    print(f"{len(visitors)} visitors ({dict(Counter(visitor.habit for visitor in visitors))}), at most {watch.max_waiting} at once; "
          f"killed: {dict(watch.kills)}; farthest {watch.farthest:.2f} m of {FENCE} m; memory {watch.slope():+.2f} MiB an hour")
    print("\n".join(faults) or "no fault")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
