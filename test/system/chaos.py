#!/usr/bin/python3
"""Usage: test/system/chaos.py [--minutes M] [--seed N] [--patience FACTOR]

Kills, hangs and starves the programs of a whole stack at random moments while a phone drives and a recorder
records, and prints what became of it: how long until everything was whole again, whether the robot moved
without control, and what the recording lacks. Exit status 1 if a figure is beyond its bound. A minute of it is
part of the test run.
"""

import argparse
import json
import os
import random
import resource
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from message_fields import read_mode, read_tick, read_walk  # noqa: E402
from lcm_log import read_events  # noqa: E402
from stack import BIN_DIR, DEADLINE, ROOT, Stack  # noqa: E402

PROGRAMS = ["nao-sim", "nao-motion", "nao-head-camera", "nao-phone-gateway"]
# Promised for a machine that does nothing else; a busy one may take longer.
MAX_RECOVERY = 10  # s
# From the loss of control (the gateway's, the phone's) to the end of the walk.
MAX_RUNNING_ON = 1.5  # s
# The recording may lack what was on its way while something was killed, s around it.
KILLED_INSTANT = 1.0


class Driver(threading.Thread):
    """A phone whose owner holds the joystick, and takes it up again whenever the connection was lost."""

    def __init__(self, stack):
        super().__init__(daemon=True)
        self.stack = stack
        self.is_ending = False
        self.num_drives = 0

    def run(self):
        while not self.is_ending:
            turn = random.choice(["0", "0.6", "-0.6"])
            phone = subprocess.run(
                [str(BIN_DIR / "nao-phone"), "--port", str(self.stack.tcp_port), "walk", "0.12", "0", turn,
                 "--duration", "4"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL, check=False)
            self.num_drives += phone.returncode == 0
            time.sleep(0.5)


def starve(pid):
    """Lets every further request for memory fail, as on a machine that has no more."""
    used = int(Path(f"/proc/{pid}/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    _, hard = resource.prlimit(pid, resource.RLIMIT_AS)
    resource.prlimit(pid, resource.RLIMIT_AS, (used // 2, hard))


HURTS = {
    "killed": lambda pid: os.kill(pid, signal.SIGKILL),
    "hung": lambda pid: os.kill(pid, signal.SIGSTOP),
    "starved": starve,
}


class Chaos:
    def __init__(self, stack, minutes):
        self.stack = stack
        self.end = time.time() + 60 * minutes
        # (wall time, program, what was done to it, s until all was whole or None)
        self.hurts = []
        # Programs that got on without the memory that they were refused.
        self.num_unmoved = 0

    def run(self):
        while time.time() < self.end:
            time.sleep(random.uniform(1, 6))
            program = random.choice(PROGRAMS)
            kind = random.choice(list(HURTS))
            moment = time.time()
            old = self.stack.pids()[program]
            HURTS[kind](old)
            seconds = self.wait_whole(program, old, kind, moment)
            self.hurts.append((moment, program, kind, seconds))
            print(f"{len(self.hurts):4} {program:20} {kind:8} "
                  + (f"whole after {seconds:.1f} s" if seconds is not None else "NOT WHOLE AGAIN"), flush=True)
            if seconds is None:
                return

    def wait_whole(self, program, old, kind, moment):
        """@return s until every program says that it is ready, the hurt one by a new process; None: never."""
        while time.time() < moment + DEADLINE:
            rows = {row["program"]: row for row in json.loads(self.stack.nao("status", "--json").stdout or "[]")}
            whole = all(name in rows and rows[name]["state"] == "ready" for name in PROGRAMS)
            # Who asks for no memory does not notice that there is none.
            is_hurt = rows.get(program, {}).get("process_id") == old and (
                kind != "starved" or time.time() < moment + 3)
            if whole and not is_hurt:
                self.unstarve(old, program, rows)
                return time.time() - moment
            time.sleep(0.1)
        return None

    def unstarve(self, old, program, rows):
        if rows[program]["process_id"] == old:
            self.num_unmoved += 1
            _, hard = resource.prlimit(old, resource.RLIMIT_AS)
            resource.prlimit(old, resource.RLIMIT_AS, (hard, hard))


class Recording:
    """What the log says about the run."""

    def __init__(self, path):
        self.ticks = {"NAO_SENSOR_STATE": []}
        # Wall times of walk commands that ask for motion; (wall time, mode).
        self.walks = []
        self.modes = []
        for event in read_events(path):
            now = event.time * 1e-6
            if event.channel in self.ticks:
                self.ticks[event.channel].append((now, read_tick(event.data)))
            if event.channel == "NAO_WALK_COMMAND" and any(read_walk(event.data)):
                self.walks.append(now)
            elif event.channel == "NAO_MOTION_STATE":
                self.modes.append((now, read_mode(event.data)))

    def missing(self, channel, hurts):
        """Messages that a channel lacks while nothing was hurt, of how many."""
        missing = 0
        ticks = self.ticks[channel]
        for (before, a), (after, b) in zip(ticks, ticks[1:]):
            if b <= a + 1:
                continue  # the next one, or a simulator that began anew
            near = any(before - KILLED_INSTANT <= moment <= after + KILLED_INSTANT or
                       moment <= before <= moment + (seconds or 0) + KILLED_INSTANT
                       for moment, _, _, seconds in hurts)
            if not near:
                missing += b - a - 1
        return missing, len(ticks)

    def walked_on(self):
        """Longest time that the robot walked after the last walk command before a pause in them, s."""
        worst = 0.0
        for last, following in zip(self.walks, [*self.walks[1:], float("inf")]):
            if following - last < MAX_RUNNING_ON:
                continue
            walking = [now for now, mode in self.modes if last < now < following and mode == "walking"]
            if walking:
                worst = max(worst, walking[-1] - last)
        return worst


def report(chaos, recording, driver, patience):
    times = sorted(seconds for _, _, _, seconds in chaos.hurts if seconds is not None)
    failures = sum(seconds is None for _, _, _, seconds in chaos.hurts)
    sensors_missing, sensors = recording.missing("NAO_SENSOR_STATE", chaos.hurts)
    walked_on = recording.walked_on()
    rows = [
        ("programs hurt", f"{len(chaos.hurts)}", bool(chaos.hurts)),
        ("got on without more memory", f"{chaos.num_unmoved}", True),
        ("not whole again", f"{failures}", failures == 0),
        ("whole again, median", f"{times[len(times) // 2]:.1f} s" if times else "-", bool(times)),
        ("whole again, worst", f"{times[-1]:.1f} s" if times else "-", bool(times) and times[-1] <= patience * MAX_RECOVERY),
        ("drives of 4 s from beginning to end", f"{driver.num_drives}", driver.num_drives > 0),
        ("walked on after the last walk command", f"{walked_on:.2f} s", walked_on <= patience * MAX_RUNNING_ON),
        ("sensor states missing between the hurts", f"{sensors_missing} of {sensors}", sensors_missing == 0),
    ]
    for name, value, is_good in rows:
        print(f"  {name:42} {value:20} {'' if is_good else 'BEYOND ITS BOUND'}")
    return all(is_good for _, _, is_good in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--patience", type=float, default=1, help="of the bounds in time, on a machine that has other work")
    arguments = parser.parse_args()
    random.seed(arguments.seed)
    with Stack() as stack:
        stack.start_or_fail()
        log = stack.run_dir / "chaos.lcmlog"
        recorder = subprocess.Popen(
            [str(ROOT / "scripts/record"), "--run-dir", str(stack.run_dir), "--channels",
             "NAO_(SENSOR_STATE|MOTION_STATE|WALK_COMMAND)", str(log)], stdout=subprocess.DEVNULL)
        driver = Driver(stack)
        chaos = Chaos(stack, arguments.minutes)
        try:
            driver.start()
            chaos.run()
        finally:
            driver.is_ending = True
            driver.join(DEADLINE)
            recorder.terminate()
            recorder.wait(DEADLINE)
        is_good = report(chaos, Recording(log), driver, arguments.patience)
        if not is_good:
            print(stack.logs())
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main())
