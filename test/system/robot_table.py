#!/usr/bin/python3
"""Usage: test/system/robot_table.py FOLDER [--robots NAME,...] [--seeds A-B] [--tune MINUTES] [--output FILE]

Imports each FOLDER/NAME/robot.urdf with `nao robot import`, lets the robot stand 60 s and walk 10 s on seeds that the
import does not use, and prints a table in Markdown, one line after each robot. Exit status 1 if an import fails.
"""

import argparse
import json
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from stack import BIN_DIR  # noqa: E402

GRAVITY = 9.81  # m/s^2
HEAD = ["Robot", "Height, m", "Mass, kg", "Joints", "Stands", "Walks", "Speed, m/s", "Froude number", "Cause"]


def trial(robots, bin_dir, kind, name, seeds, *arguments):
    """Successes, runs, mean speed of the successful ones, m/s, and the most frequent cause of a failure."""
    report = robots.parent / f"{name}.{kind}.json"
    environment = {**os.environ, "NAO_REMOTE_DATA": str(robots.parent)}
    run = subprocess.run([bin_dir / "nao-trial", kind, "--model", name, "--seeds", seeds, "--verbose", *arguments],
                         env=environment, capture_output=True, text=True, check=False)
    lines = re.findall(r"^seed \d+ *: (.*)$", run.stdout, re.MULTILINE)
    report.write_text(run.stdout + run.stderr)
    good = [line for line in lines if line.startswith("ok")]
    speeds = [float(found.group(1)) for line in good if (found := re.search(r"speed_mps (\S+)", line))]
    causes = [re.split(r"  ", line)[0] for line in lines if not line.startswith("ok")]
    cause = max(causes, key=causes.count) if causes else "" if lines else (run.stderr.strip().splitlines() or [""])[-1]
    return len(good), len(lines), sum(speeds) / max(1, len(speeds)), cause


def leg_length(robot):
    """From the gait, m: it scales max_forward by the length of the legs."""
    gait = robot / "gait.yaml"
    found = re.search(r"max_forward: \{value: [^,]+, range: \[([^,]+),", gait.read_text()) if gait.exists() else None
    return float(found.group(1)) / 0.15 if found else math.nan


def try_robot(robots, bin_dir, urdf, options):
    """The row of one robot."""
    name = urdf.parent.name
    command = [bin_dir / "nao-tools", "robot", "import", urdf, "--name", name, "--folder", robots]
    run = subprocess.run([*command, "--tune", str(options.tune)], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return [name, "", "", "", "", "", "", "", (run.stdout + run.stderr).strip().splitlines()[-1]]
    card = json.loads((robots / name / "card.json").read_text())
    stands = trial(robots, bin_dir, "stand", name, options.seeds, "--duration", "60")
    row = [name, f"{card['height_m']:.2f}", f"{card['mass_kg']:.1f}", str(card["motors"]), f"{stands[0]}/{stands[1]}"]
    if not (robots / name / "gait.yaml").exists():
        return [*row, "", "", "", stands[3] or card["failure"]]
    walks = trial(robots, bin_dir, "walk", name, options.seeds, "--vx", str(card["commanded_speed_mps"]))
    froude = walks[2] ** 2 / (GRAVITY * leg_length(robots / name))
    return [*row, f"{walks[0]}/{walks[1]}", f"{walks[2]:.2f} of {card['commanded_speed_mps']:.2f}", f"{froude:.3f}",
            stands[3] or walks[3]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--robots", help="only these")
    parser.add_argument("--seeds", default="7001-7005")
    parser.add_argument("--tune", type=float, default=0, help="minutes")
    parser.add_argument("--output", type=Path, help="folder of the imported robots, which stays")
    parser.add_argument("--bin", type=Path, default=BIN_DIR)
    options = parser.parse_args()
    found = sorted(urdf.parent.name for urdf in options.folder.glob("*/robot.urdf"))
    names = options.robots.split(",") if options.robots else found
    with tempfile.TemporaryDirectory() as temporary:
        data = options.output or Path(temporary)
        robots = data / "robots"
        robots.mkdir(parents=True)
        for entry in (BIN_DIR.parent / "share" / "nao-remote").iterdir():
            if entry.name != "robots":
                (data / entry.name).symlink_to(entry)
        print("| " + " | ".join(HEAD) + " |\n|" + " --- |" * len(HEAD), flush=True)
        rows = []
        for name in names:
            rows.append(try_robot(robots, options.bin, options.folder / name / "robot.urdf", options))
            print("| " + " | ".join(rows[-1]) + " |", flush=True)
    return 1 if any(not row[4] for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
