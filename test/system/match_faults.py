#!/usr/bin/python3
"""Faults in a match: two robots play against two by what they see, while this kills one program after the other.

Usage: match_faults.py [--minutes M] [--seed N] [--json FILE]

A robot's own programs killed: only that robot pauses; the other robots' nao-motion and nao-play must go on saying that they
act. Simulator, gateway or referee killed: all pause. Afterwards score and clock must be right, every program ready and the world running within 10 s; a robot that stood and was not hit may not
have fallen within 3 s for that reason alone (falls are counted, and compared with those of times without faults).
"""

import argparse
import json
import os
import random
import re
import signal
import sys
import time

from robot_pauses import Recording, find_pauses
from stack import Stack

SHARED = ("nao-sim", "nao-phone-gateway", "nao-referee")
PER_ROBOT = ("nao-motion", "nao-motion-files", "nao-head-camera", "nao-vision", "nao-play", "nao-speaker")
LIMIT = 10  # s until everything is whole again
ROBOTS = ("NAO1", "NAO2", "NAO3", "NAO4")
PAUSE = 8   # s of undisturbed play between two faults
FALLEN = 0.2  # m, height of the torso


class Run:
    def __init__(self, stack, seed):
        self.stack = stack
        self.random = random.Random(seed)
        self.rows = []
        # Wall times at which undisturbed times began.
        self.quiet = []

    def match(self):
        shown = self.stack.nao("match", "show")
        found = re.match(r"(\w+(?:-\w+)*), half (\d), (\d+):(\d\d) left, (\d+):(\d+)", shown.stdout)
        if not found:
            return None
        phase, half, minutes, seconds, a, b = found.groups()
        return {"phase": phase, "half": int(half), "left": 60 * int(minutes) + int(seconds), "score": [int(a), int(b)]}

    def truth(self):
        shown = self.stack.nao("world", "show", "--json")
        return json.loads(shown.stdout) if shown.returncode == 0 else None

    def programs(self):
        # The status is 1 even if only a program is not ready.
        shown = self.stack.script("status", "--json")
        return json.loads(shown.stdout) if shown.stdout else []

    def standing(self, truth):
        return [robot["position_torso_in_world"][2] > FALLEN for robot in truth["robots"]] if truth else []

    def is_whole(self, count):
        """Every program is ready again, and the world runs."""
        rows = self.programs()
        first = self.truth()
        time.sleep(0.3)
        second = self.truth()
        return (len(rows) >= count and all(row["state"] == "ready" for row in rows) and first and second
                and second["utime"] > first["utime"] and self.match() is not None)

    def fault(self, count):
        rows = self.programs()
        names = [row["program"] for row in rows]
        kinds = [name for name in names if name in SHARED] * 2 + [name for name in names if name.startswith(PER_ROBOT)]
        name = self.random.choice(sorted(kinds))
        asked = time.monotonic()
        before, stood = self.match(), self.standing(self.truth())
        pid = next(row["pid"] for row in rows if row["program"] == name)
        begin, wall = time.monotonic(), time.time()
        os.kill(pid, signal.SIGKILL)
        time.sleep(0.5)
        while not self.is_whole(count):
            if time.monotonic() - begin > 60:
                break
            time.sleep(0.2)
        took = time.monotonic() - begin
        after, stands = self.match(), self.standing(self.truth())
        # Between the two looks at the clock; a second for its rounding.
        longest = time.monotonic() - asked + 1
        # In the meantime a goal may be scored, and a half may end; a score never decreases, and the clock is never
        # ahead.
        is_right = bool(before and after and all(b >= a for a, b in zip(before["score"], after["score"]))
                        and sum(after["score"]) <= sum(before["score"]) + 1
                        and (after["half"] > before["half"] or before["left"] - longest <= after["left"] <= before["left"]))
        fell = [i for i, (a, b) in enumerate(zip(stood, stands)) if a and not b]
        self.rows.append({"killed": name, "wall": wall, "whole_s": round(took, 1), "is_right": is_right, "fell": fell,
                          "before": before, "after": after})
        print(json.dumps(self.rows[-1]), flush=True)

    def undisturbed(self):
        """Falls in a time without faults, for comparison."""
        stood = self.standing(self.truth())
        self.quiet.append(time.time())
        time.sleep(PAUSE)
        return sum(a and not b for a, b in zip(stood, self.standing(self.truth())))


def is_played(match):
    return match is not None and match["phase"] in ("ready", "set", "playing")


def note_pauses(run, states, scale):
    """Adds to each fault of one robot's program which robots paused, and why.
    @return number of undisturbed times of a robot, and in how many of them it paused."""
    for row in run.rows:
        if row["killed"] in SHARED or not is_played(row["before"]) or not is_played(row["after"]):
            continue
        hit = row["killed"].rpartition("-")[2]
        pauses = {robot: find_pauses(states, robot, row["wall"], row["wall"] + row["whole_s"], scale) for robot in ROBOTS}
        row["pauses_of_hit"] = pauses.pop(hit)
        row["pauses_of_others"] = sum(pauses.values(), [])
        if row["pauses_of_others"]:
            print(f"{row['killed']} killed, and others paused: {row['pauses_of_others']}")
    quiet = [find_pauses(states, robot, begin, begin + PAUSE, scale) for begin in run.quiet for robot in ROBOTS]
    for pauses in filter(None, quiet):
        print(f"paused without a fault: {pauses}")
    return len(quiet), sum(map(bool, quiet))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--minutes", type=float, default=15)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--time-scale", type=float, default=1, help="factor on the limits, for a busy machine")
    parser.add_argument("--json")
    arguments = parser.parse_args()
    with Stack() as stack:
        stack.start_or_fail("--match", "2v2", "--autonomous", "all", "--seed", str(arguments.seed))
        run = Run(stack, arguments.seed)
        recording = Recording(stack)
        count = len(run.programs())
        begin = time.monotonic()
        while (run.match() or {}).get("phase") != "playing":
            time.sleep(1)
        undisturbed_falls = 0
        while time.monotonic() - begin < 60 * arguments.minutes:
            if run.match() and run.match()["phase"] == "finished":
                stack.nao("match", "new-match")
                stack.nao("match", "start")
            undisturbed_falls += run.undisturbed()
            run.fault(count)
        num_quiet, num_quiet_pauses = note_pauses(run, recording.end(), arguments.time_scale)
        rows = run.rows
        late = [row for row in rows if row["whole_s"] > LIMIT * arguments.time_scale]
        wrong = [row for row in rows if not row["is_right"]]
        shared = [row for row in rows if row["killed"] in SHARED]
        own = [row for row in rows if "pauses_of_others" in row]
        spread = [row for row in own if row["pauses_of_others"]]
        times = sorted(row["whole_s"] for row in rows)
        print(f"{len(rows)} faults, {len(shared)} of them of simulator, gateway or referee; whole again after {times[len(times) // 2]} s "
              f"(median), {times[-1]} s (worst), {len(late)} later than {LIMIT * arguments.time_scale:g} s; score or clock wrong {len(wrong)} times; falls "
              f"{sum(len(row['fell']) for row in rows)} in {sum(times):.0f} s with faults, "
              f"{undisturbed_falls} in {PAUSE * len(rows)} s without; {len(own)} faults of one robot's programs: it paused in "
              f"{sum(bool(row['pauses_of_hit']) for row in own)}, another one in {len(spread)}; without faults a robot paused in "
              f"{num_quiet_pauses} of {num_quiet} times of {PAUSE} s")
        if arguments.json:
            with open(arguments.json, "w", encoding="utf-8") as file:
                json.dump(rows, file, indent=1)
    return 1 if late or wrong or spread else 0


if __name__ == "__main__":
    sys.exit(main())
