#!/usr/bin/python3
"""Usage: test/system/chaos.py [--minutes M] [--seed N] [--time-scale FACTOR]

Fault injection: crashes, hangs or exhausts the memory of programs of a whole stack at random times while a phone
drives and a recorder records. Prints the recovery times, whether the robot moved without control, and the
messages missing in the recording. Exit status 1 if a figure exceeds its bound. A minute of it is part of the
test run.
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
# Bound for a machine without other load; --time-scale scales it.
MAX_RECOVERY = 10  # s
# From the loss of control (gateway or phone) to the end of the walk.
MAX_RUNNING_ON = 1.5  # s
# Messages in transit during a fault may be missing from the recording: tolerance around it, s.
FAULT_MARGIN = 1.0


class Driver(threading.Thread):
    """A phone that drives with the joystick and reconnects after each loss of the connection."""

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


def exhaust_memory(pid):
    """Makes every further memory allocation fail."""
    used = int(Path(f"/proc/{pid}/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    _, hard = resource.prlimit(pid, resource.RLIMIT_AS)
    resource.prlimit(pid, resource.RLIMIT_AS, (used // 2, hard))


FAULTS = {
    "killed": lambda pid: os.kill(pid, signal.SIGKILL),
    "hung": lambda pid: os.kill(pid, signal.SIGSTOP),
    "no memory": exhaust_memory,
}


class Chaos:
    def __init__(self, stack, minutes):
        self.stack = stack
        self.end = time.time() + 60 * minutes
        # (wall time, program, fault, s until all programs were ready again or None)
        self.faults = []
        # Programs that continued without further memory.
        self.num_unaffected = 0

    def run(self):
        while time.time() < self.end:
            time.sleep(random.uniform(1, 6))
            program = random.choice(PROGRAMS)
            kind = random.choice(list(FAULTS))
            moment = time.time()
            old = self.stack.pids()[program]
            FAULTS[kind](old)
            seconds = self.wait_for_recovery(program, old, kind, moment)
            self.faults.append((moment, program, kind, seconds))
            print(f"{len(self.faults):4} {program:20} {kind:9} "
                  + (f"recovered after {seconds:.1f} s" if seconds is not None else "NOT RECOVERED"), flush=True)
            if seconds is None:
                return

    def wait_for_recovery(self, program, old, kind, moment):
        """@return Time until every program is ready, the faulty one as a new process, s; None: never."""
        while time.time() < moment + DEADLINE:
            rows = {row["program"]: row for row in json.loads(self.stack.nao("status", "--json").stdout or "[]")}
            all_ready = all(name in rows and rows[name]["state"] == "ready" for name in PROGRAMS)
            # A program that allocates no memory does not fail; it is given 3 s.
            is_faulty = rows.get(program, {}).get("process_id") == old and (
                kind != "no memory" or time.time() < moment + 3)
            if all_ready and not is_faulty:
                self.restore_memory(old, program, rows)
                return time.time() - moment
            time.sleep(0.1)
        return None

    def restore_memory(self, old, program, rows):
        if rows[program]["process_id"] == old:
            self.num_unaffected += 1
            _, hard = resource.prlimit(old, resource.RLIMIT_AS)
            resource.prlimit(old, resource.RLIMIT_AS, (hard, hard))


class Recording:
    """Evaluates the log of the run."""

    def __init__(self, path):
        self.ticks = {"NAO_SENSOR_STATE": []}
        # Wall times of walk commands with a non-zero velocity; (wall time, mode).
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

    def missing(self, channel, faults):
        """(number of messages that a channel lacks outside the faults, number of all its messages)."""
        missing = 0
        ticks = self.ticks[channel]
        for (before, a), (after, b) in zip(ticks, ticks[1:]):
            if b <= a + 1:
                continue  # no gap, or a restarted simulator
            near = any(before - FAULT_MARGIN <= moment <= after + FAULT_MARGIN or
                       moment <= before <= moment + (seconds or 0) + FAULT_MARGIN
                       for moment, _, _, seconds in faults)
            if not near:
                missing += b - a - 1
        return missing, len(ticks)

    def walked_on(self):
        """Maximum time that the robot walked on after the last walk command before a pause, s."""
        worst = 0.0
        for last, following in zip(self.walks, [*self.walks[1:], float("inf")]):
            if following - last < MAX_RUNNING_ON:
                continue
            walking = [now for now, mode in self.modes if last < now < following and mode == "walking"]
            if walking:
                worst = max(worst, walking[-1] - last)
        return worst


def report(chaos, recording, driver, time_scale):
    times = sorted(seconds for _, _, _, seconds in chaos.faults if seconds is not None)
    failures = sum(seconds is None for _, _, _, seconds in chaos.faults)
    sensors_missing, sensors = recording.missing("NAO_SENSOR_STATE", chaos.faults)
    walked_on = recording.walked_on()
    rows = [
        ("injected faults", f"{len(chaos.faults)}", bool(chaos.faults)),
        ("unaffected by exhausted memory", f"{chaos.num_unaffected}", True),
        ("not recovered", f"{failures}", failures == 0),
        ("recovery time, median", f"{times[len(times) // 2]:.1f} s" if times else "-", bool(times)),
        ("recovery time, worst", f"{times[-1]:.1f} s" if times else "-", bool(times) and times[-1] <= time_scale * MAX_RECOVERY),
        ("complete drives of 4 s", f"{driver.num_drives}", driver.num_drives > 0),
        ("walked on after the last walk command", f"{walked_on:.2f} s", walked_on <= time_scale * MAX_RUNNING_ON),
        ("sensor states missing between faults", f"{sensors_missing} of {sensors}", sensors_missing == 0),
    ]
    for name, value, is_good in rows:
        print(f"  {name:42} {value:20} {'' if is_good else 'EXCEEDS ITS BOUND'}")
    return all(is_good for _, _, is_good in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--time-scale", type=float, default=1, help="factor of the bounds in time, on a machine with other load")
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
        is_good = report(chaos, Recording(log), driver, arguments.time_scale)
        if not is_good:
            print(stack.logs())
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main())
