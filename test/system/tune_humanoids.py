#!/usr/bin/python3
"""Usage: test/system/tune_humanoids.py [--robots N,N,...] [--generations G] [--seeds A-B] [--json FILE] ...

From the URDF of an unknown robot to a walk without a line of code: humanoids of random dimensions (make_humanoids) are
imported, checked, tuned by nao-walk-tuner, and walk on seeds that the tuner does not use, before and after. A walk of
10 s succeeds if the robot stops at its end on its feet and walked at v / sqrt(g * leg length) of at least 0.15. Exit
status 1 if fewer than 90 % of the walks of a tuned robot succeed.
"""

import argparse
import json
import math
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from stack import BIN_DIR  # noqa: E402

GRAVITY = 9.81  # m/s^2
LEAST_SPEED = 0.15  # v / sqrt(g * leg length)
LEAST_RATE = 0.9
SEED_LINE = re.compile(r"^seed \d+ *: (ok|.*?) .*?speed_mps ([\d.]+)|^seed \d+", re.MULTILINE)


class Watch:
    """Wall time and processor time of the programs that have run since the start, s."""

    def __init__(self):
        self.wall, self.processor = time.monotonic(), self.children()

    @staticmethod
    def children():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    def times(self):
        return {"wall_s": round(time.monotonic() - self.wall, 1),
                "processor_s": round(self.children() - self.processor, 1)}


class Workshop:
    """A data folder with robots of its own; everything else is the build's."""

    def __init__(self, folder, options):
        self.options = options
        self.folder = Path(folder)
        self.robots = self.folder / "data" / "robots"
        self.robots.mkdir(parents=True)
        for entry in (BIN_DIR.parent / "share" / "nao-remote").iterdir():
            if entry.name != "robots":
                (self.folder / "data" / entry.name).symlink_to(entry)
        self.environment = {**os.environ, "NAO_REMOTE_DATA": str(self.folder / "data")}

    def run(self, *command):
        """Output of a program of the build. @raise SystemExit if it fails."""
        done = subprocess.run([str(BIN_DIR / command[0]), *map(str, command[1:])], env=self.environment,
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}:\n{done.stdout}{done.stderr}")
        return done.stdout

    def make_humanoids(self):
        """{number: leg length, mass, ...}; the URDFs lie in the folder."""
        lines = self.run("make_humanoids", self.folder).splitlines()
        return {int(number): {"leg_m": float(leg), "mass_kg": float(mass), "hip": hip, "waist": waist == "1",
                              "numeric_leg": offset == "1"}
                for number, leg, mass, hip, waist, offset in map(str.split, lines)}

    def measure(self, name, speed):
        """Walks ahead at the robot's limit. @param speed Least speed, m/s."""
        limits = re.search(r"walk_limits: \{forward: ([\d.]+)", (self.robots / name / "robot.yaml").read_text())
        out = self.run("nao-trial", "walk", "--model", name, "--vx", limits[1], "--verbose", "--seeds",
                       self.options.seeds, "--disturbances", self.options.disturbances)
        walks = list(SEED_LINE.finditer(out))
        speeds = [float(walk[2]) for walk in walks if walk[1] == "ok"]
        return {"walks": len(walks), "upright": len(speeds), "succeeded": sum(v >= speed for v in speeds),
                "mean_mps": round(sum(speeds) / max(1, len(speeds)), 3), "slowest_mps": min(speeds, default=0)}

    def make_walk(self, number, dimensions):
        """Import, check, tune. @return What was measured."""
        name = f"humanoid{number}"
        speed = LEAST_SPEED * math.sqrt(GRAVITY * dimensions["leg_m"])
        result = {"robot": number, **dimensions, "least_mps": round(speed, 3)}
        watch = Watch()
        self.run("nao", "robot", "import", self.folder / f"{name}.urdf", "--name", name, "--folder", self.robots,
                 "--no-simulation")
        self.run("nao", "robot", "check", name)
        result["import"] = watch.times()
        result["untuned"] = self.measure(name, speed)
        if self.options.generations > 0:
            watch = Watch()
            self.run("nao-walk-tuner", "--model", name, "--disturbances", self.options.disturbances, "--generations",
                     self.options.generations, "--screen", self.options.screen, "--jobs", self.options.jobs, "--output",
                     self.robots / name / "gait.yaml")
            result["tuning"] = watch.times()
            result["tuned"] = self.measure(name, speed)
        return result


def print_row(result):
    def walks(figures):
        return "{succeeded} of {walks} ({upright} upright), {mean_mps:.3f} m/s".format(**figures) if figures else "-"

    seconds = result.get("tuning", result["import"])
    print("| {robot} | {leg_m:.2f} m, {mass_kg:.1f} kg | {least_mps:.3f} m/s | {untuned} | {tuned} | {wall:.0f} s | "
          "{processor:.0f} s |".format(**{**result, "untuned": walks(result["untuned"]),
                                          "tuned": walks(result.get("tuned"))},
                                       wall=seconds["wall_s"], processor=seconds["processor_s"]), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", default="3,4,1", help="numbers of the humanoids, 0 to 9 (default: %(default)s)")
    parser.add_argument("--generations", type=int, default=10, help="of the search; 0: measure untuned robots")
    parser.add_argument("--screen", type=int, default=5, help="as nao-walk-tuner's")
    parser.add_argument("--jobs", type=int, default=2, help="threads of the tuner")
    parser.add_argument("--seeds", default="101-120", help="of the measured walks (default: %(default)s)")
    parser.add_argument("--disturbances", default="moderate")
    parser.add_argument("--json", help="write the results to this file, too")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="nao-") as folder:
        workshop = Workshop(folder, options)
        humanoids = workshop.make_humanoids()
        print("| Robot | Leg, mass | Least speed | Imported | Tuned | Tuning: wall time | Processor time |\n"
              "| --- | --- | --- | --- | --- | --- | --- |", flush=True)
        results = []
        for number in map(int, options.robots.split(",")):
            results.append(workshop.make_walk(number, humanoids[number]))
            print_row(results[-1])
            if options.json:
                Path(options.json).write_text(json.dumps(results, indent=1) + "\n")
    last = [result.get("tuned", result["untuned"]) for result in results]
    return 0 if all(figures["succeeded"] >= LEAST_RATE * figures["walks"] for figures in last) else 1


if __name__ == "__main__":
    sys.exit(main())
