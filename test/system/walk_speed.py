#!/usr/bin/python3
"""Usage: test/system/walk_speed.py [--seconds S] [--seeds A-B] [--tolerance SHARE]

Walks over the bus in real time, driven by `nao walk` and by a phone (`nao-phone walk`), against the same walks of
`nao-trial`, in lock-step without a bus: the true speed, on the world's own clock. Exit status 1 if one differs by more
than the tolerance. A busy machine makes nao-motion miss ticks; how many is printed, and none are expected on a quiet one.
"""

import argparse
import json
import math
import subprocess
import sys
import threading
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from stack import BIN_DIR, Stack, run  # noqa: E402

WALKS = {"ahead": (0.25, 0, 0), "aside": (0, 0.15, 0), "turning": (0, 0, 1.0)}  # m/s, m/s, rad/s
SPEED_UP = 3  # s, until the gait has its speed


def heading(orientation):
    w, x, y, z = orientation
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


class Course:
    """World truths of one walk, as dictionaries in the order of time."""

    def __init__(self, truths):
        self.truths = truths

    @staticmethod
    def record(stack, drive, seconds):
        """World truths during one walk command."""
        log = stack.run_dir / "walk.lcmlog"
        log.unlink(missing_ok=True)
        recorder = subprocess.Popen(
            [str(BIN_DIR / "nao"), "record", str(log), "--lcm-url", stack.lcm_url, "--channels", "WORLD_TRUTH"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        driver = threading.Thread(target=drive)
        driver.start()
        driver.join(timeout=seconds + 60)
        recorder.send_signal(2)
        recorder.wait(timeout=30)
        lines = stack.nao("log", "json", log).stdout.splitlines()
        return Course([json.loads(line).get("message", json.loads(line)) for line in lines])

    def speed(self, seconds):
        """Mean velocity, m/s and rad/s, from the time when the gait has reached its speed to the end of the command."""
        robots = [(truth["utime"] * 1e-6, truth["robots"][0]) for truth in self.truths]
        start = next(time for time, robot in robots if math.hypot(*robot["velocity_torso_in_world"][:2]) > 0.05)
        window = [(time, robot) for time, robot in robots if start + SPEED_UP <= time <= start + seconds - 0.5]
        way = turn = 0.0
        # Displacements of whole seconds: the sway within a step cancels, and turning in place gives no speed.
        marks = window[::100]
        for (_, before), (_, after) in zip(marks, marks[1:]):
            way += math.dist(before["position_torso_in_world"][:2], after["position_torso_in_world"][:2])
            turn += math.remainder(heading(after["orientation_torso_in_world"]) -
                                   heading(before["orientation_torso_in_world"]), 2 * math.pi)
        time = marks[-1][0] - marks[0][0]
        return way / time, turn / time

    def late_ticks(self):
        return self.truths[-1]["num_late_commands"] - self.truths[0]["num_late_commands"]


def expected(velocity, seeds, seconds):
    """m/s and rad/s of nao-trial, median of the seeds."""
    vx, vy, wz = velocity
    file = Path(f"/tmp/walk-speed-{id(velocity)}.json")
    run([BIN_DIR / "nao-trial", "walk", "--vx", vx, "--vy", vy, "--wz", wz, "--seeds", seeds,
         "--duration", seconds, "--json", file])
    metrics = json.loads(file.read_text())["metrics"]
    file.unlink()
    return metrics["speed_mps"]["median"], metrics["turning_radps"]["median"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=12)
    parser.add_argument("--seeds", default="1-8")
    parser.add_argument("--tolerance", type=float, default=0.05)
    arguments = parser.parse_args()
    seconds = arguments.seconds
    failures = 0
    print("walk     driver    trial     bus       differs   late ticks")
    with Stack() as stack:
        stack.start_or_fail("--only", "sim,motion,phone-gateway")
        for name, velocity in WALKS.items():
            expected_velocity = expected(velocity, arguments.seeds, seconds)
            phone = [BIN_DIR / "nao-phone", "--host", "127.0.0.1", "--port", stack.tcp_port, "--token", stack.token, "walk"]
            drivers = {
                "nao": lambda velocity=velocity: stack.nao("walk", *velocity, "--for", seconds),
                "phone": lambda velocity=velocity, phone=phone: run([*phone, *velocity, "--duration", seconds]),
            }
            for driver, drive in drivers.items():
                stack.nao("world", "reset")
                stack.nao("posture", "StandInit")
                course = Course.record(stack, drive, seconds)
                kind = 1 if velocity[2] else 0
                true, unit = course.speed(seconds)[kind], ("m/s", "rad/s")[kind]
                differs = true / expected_velocity[kind] - 1
                failures += abs(differs) > arguments.tolerance
                print(f"{name:8} {driver:6} {expected_velocity[kind]:7.3f} {true:9.3f} {unit:5} {100 * differs:+8.1f} % "
                      f"{course.late_ticks():6}", flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
