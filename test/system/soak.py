#!/usr/bin/python3
"""Usage: test/system/soak.py [--minutes M]

Lets a whole stack run with a phone watching, the robot standing, and prints what changed meanwhile:
falls, drift of the feet, error of real time, memory, lost messages. Not part of the test run, for it takes
as long as it says (default: 10 minutes); exit status 1 if a figure is beyond its bound.
"""

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from stack import BIN_DIR, Stack  # noqa: E402

PROGRAMS = ["nao-sim", "nao-motion", "nao-head-camera", "nao-phone-gateway"]
MAX_FOOT_DRIFT = 0.005  # m
MAX_REAL_TIME_ERROR = 0.01
MAX_TILT = math.radians(20)
# Bound of the growth of allocators after the first minute; a leak of one message in a hundred exceeds it.
MAX_MEMORY_GROWTH_MB = 8


def rotate(q, v):
    """Vector v rotated by the unit quaternion q = (w, x, y, z)."""
    w, u = q[0], q[1:]
    t = [2 * c for c in cross(u, v)]
    return [v[i] + w * t[i] + cross(u, t)[i] for i in range(3)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def multiply(p, q):
    """Product of two quaternions (w, x, y, z)."""
    vector = [p[0] * q[i + 1] + q[0] * p[i + 1] + cross(p[1:], q[1:])[i] for i in range(3)]
    return [p[0] * q[0] - sum(p[i + 1] * q[i + 1] for i in range(3)), *vector]


class Legs:
    """Positions of the soles by forward kinematics of the robot's URDF (no joint has a rotation at angle 0)."""

    def __init__(self, urdf):
        self.joint_to = {}
        for joint in ElementTree.parse(urdf).getroot().iter("joint"):
            if joint.find("parent") is not None:
                self.joint_to[joint.find("child").get("link")] = joint

    def sole(self, link, robot):
        """Position of a link's origin in the world, m, from a robot_truth_t as a dictionary."""
        angles = dict(zip(robot["joint_names"], robot["joint_position"]))
        chain = []
        while link in self.joint_to:
            chain.insert(0, self.joint_to[link])
            link = chain[0].find("parent").get("link")
        position = list(robot["position_torso_in_world"])
        orientation = list(robot["orientation_torso_in_world"])
        for joint in chain:
            origin = joint.find("origin")
            offset = [float(x) for x in origin.get("xyz", "0 0 0").split()]
            position = [a + b for a, b in zip(position, rotate(orientation, offset))]
            if joint.get("type") == "fixed":
                continue
            mimic = joint.find("mimic")
            angle = angles[mimic.get("joint") if mimic is not None else joint.get("name")]
            axis = [float(x) for x in joint.find("axis").get("xyz").split()]
            half = [math.cos(angle / 2), *[math.sin(angle / 2) * x for x in axis]]
            orientation = multiply(orientation, half)
        return position


def tilt(robot):
    return math.acos(max(-1.0, min(1.0, rotate(robot["orientation_torso_in_world"], [0, 0, 1])[2])))


def memory_mb(pids):
    """Program name to resident memory, MB."""
    page = os.sysconf("SC_PAGE_SIZE")
    return {name: int(Path(f"/proc/{pids[name]}/statm").read_text().split()[1]) * page / 1e6
            for name in PROGRAMS}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10)
    minutes = parser.parse_args().minutes
    legs = Legs(BIN_DIR.parent / "share/nao-remote/robots/nao/nao.urdf")
    with Stack() as stack:
        stack.start_or_fail()
        phone = subprocess.Popen(
            [str(BIN_DIR / "nao-phone"), "--port", str(stack.tcp_port), "watch", "--rate", "30",
             "--images", "15", "--duration", str(60 * minutes + 60)],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT)
        try:
            time.sleep(30)  # StandInit reached, first allocations made
            first, first_memory, start = stack.truth(), memory_mb(stack.pids()), time.monotonic()
            drift = worst_tilt = 0.0
            delay = []
            while time.monotonic() - start < 60 * minutes:
                time.sleep(5)
                truth = stack.truth()
                delay += [row["metrics"]["tick_delay_p99_ms"]
                             for row in json.loads(stack.nao("status", "--json").stdout) if row["program"] == "nao-sim"]
                robot = truth["robots"][0]
                worst_tilt = max(worst_tilt, tilt(robot))
                for sole in ("LSole", "RSole"):
                    drift = max(drift, math.dist(legs.sole(sole, robot), legs.sole(sole, first["robots"][0])))
            wall = time.monotonic() - start
            last, last_memory = stack.truth(), memory_mb(stack.pids())
            phone_left = phone.poll() is not None
        finally:
            phone.terminate()
            phone.wait()

        dropped = {row["program"]: row["num_messages_dropped"]
                   for row in json.loads(stack.nao("status", "--json").stdout)}
    simulated = (last["utime"] - first["utime"]) * 1e-6
    growth = {name: last_memory[name] - first_memory[name] for name in PROGRAMS}
    ticks = last["tick"] - first["tick"]
    late = last["num_late_ticks"] - first["num_late_ticks"]
    rows = [
        ("drift of the feet", f"{drift * 1e3:.3f} mm", drift <= MAX_FOOT_DRIFT),
        ("greatest tilt of the torso", f"{math.degrees(worst_tilt):.2f} deg", worst_tilt <= MAX_TILT),
        ("error of real time", f"{(simulated / wall - 1) * 100:+.3f} %", abs(simulated / wall - 1) <= MAX_REAL_TIME_ERROR),
        ("ticks more than 2 ms late", f"{late} of {ticks}, {100 * late / ticks:.2f} %", True),
        ("99th percentile of the tick delay, per second", f"{statistics.median(delay):.2f} ms, maximum {max(delay):.2f} ms", True),
        *[(f"memory of {name}", f"{first_memory[name]:.1f} {growth[name]:+.1f} MB", growth[name] <= MAX_MEMORY_GROWTH_MB)
          for name in PROGRAMS],
        ("messages dropped", ", ".join(f"{name} {count}" for name, count in dropped.items()), not any(dropped.values())),
        ("phone still connected", "no" if phone_left else "yes", not phone_left),
    ]
    print(f"{wall / 60:.1f} minutes, {simulated:.1f} s simulated")
    for name, value, is_good in rows:
        print(f"  {name:32} {value:40} {'' if is_good else 'BEYOND ITS BOUND'}")
    return 0 if all(is_good for _, _, is_good in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
