#!/usr/bin/python3
"""Checks the referee of matches: runs nao-trial's matches, finds goals and balls that went out in the
recorded path of the ball, and compares them with the referee's events.

The path has 100 places a second. Where it crosses a line is found by interpolation; the referee looks at
single places, 20 times a second."""

import argparse
import csv
import json
import os
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from output_file import replace_file  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent.parent
# A ball that moves farther than this between two places was put somewhere, m: 50 m/s.
PUT = 0.5
# Largest time from a crossing to its event, s: the referee's period, and a place of the path.
LATEST = 0.1
# Figures of nao-trial that are printed for each match.
FIGURES = ("kicks", "falls", "penalties", "upright_ratio", "longest_stuck_s")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="Further options are nao-trial's: --duration 60")
    parser.add_argument("scenario", nargs="?", default="match-error-model",
                        help="match or match-error-model (%(default)s)")
    parser.add_argument("--seeds", default="1-4", help="first and last seed (%(default)s)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="matches at the same time (%(default)s)")
    parser.add_argument("--program", default=str(ROOT / "build/dev/bin/nao-trial"), help="nao-trial (%(default)s)")
    parser.add_argument("--json", help="file for the figures")
    parser.add_argument("--traces", help="folder that keeps the traces of the matches (default: none)")
    return parser.parse_known_args()


def crossings(path, scene):
    """@param path: rows of (time, phase, x, y, z). @return list of (time, kind, team)."""
    field, goals, ball = scene["field"], scene["goals"], scene["ball"]
    # The whole ball is beyond the outer edge of the line.
    beyond = field["line_width"] / 2 + ball["radius"]
    limits = [field["length"] / 2 + beyond, field["width"] / 2 + beyond]
    post = (goals["post_distance"] - goals["post_diameter"]) / 2
    bar = goals["crossbar_height"] - goals["post_diameter"] / 2
    found = []
    is_outside = False
    for before, after in zip(path, path[1:]):
        if max(abs(a - b) for a, b in zip(before[2:4], after[2:4])) > PUT:
            is_outside = False
            continue
        if after[1] != "playing":
            continue
        fractions = []
        for axis in (0, 1):
            a, b = abs(before[2 + axis]), abs(after[2 + axis])
            if b > limits[axis]:
                fractions.append(((limits[axis] - a) / (b - a) if b > a else 0, axis))
        if not fractions:
            is_outside = False
            continue
        if is_outside:
            continue
        is_outside = True
        fraction, axis = min(fractions)
        x, y, z = (p + min(max(fraction, 0), 1) * (q - p) for p, q in zip(before[2:], after[2:]))
        is_goal = axis == 0 and abs(y) < post and z < bar
        found.append((after[0], "goal" if is_goal else "ball-out", (0 if x > 0 else 1) if is_goal else None))
    return found


def read(file):
    """@return path of the ball, the referee's goals and outs as (time, kind, team), and whether it ended the match."""
    path, events, has_ended = [], [], False
    with open(file, encoding="utf-8") as stream:
        for kind, time, *values in csv.reader(stream):
            if kind == "ball":
                path.append((float(time), values[0], *map(float, values[1:])))
            elif kind == "event" and values[0] in ("goal", "ball-out"):
                events.append((float(time), values[0], int(values[1]) if values[0] == "goal" else None))
            has_ended |= kind == "event" and values[0] == "match-end"
    return path, events, has_ended


def compare(found, events):
    """@return texts of what only one of them has."""
    left = list(events)
    differences = []
    for time, kind, team in found:
        match = next((e for e in left if e[1:] == (kind, team) and -0.001 <= e[0] - time <= LATEST), None)
        if match:
            left.remove(match)
        else:
            differences.append(f"{kind} at {time:.2f} s (team {team}) only in the ball's path")
    return differences + [f"{kind} at {time:.2f} s (team {team}) only of the referee" for time, kind, team in left]


def check(arguments, seed, options, folder, scene):
    file = Path(folder) / f"{seed}.csv"
    summary = Path(folder) / f"{seed}.json"
    command = [arguments.program, arguments.scenario, "--seeds", str(seed), "--trace", str(file),
               "--json", str(summary), *options]
    subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
    if not file.exists():
        sys.exit(f"nao-trial wrote no trace; run it by hand: {' '.join(command)}")
    path, events, has_ended = read(file)
    differences = compare(crossings(path, scene), events)
    goals = sum(kind == "goal" for _, kind, _ in events)
    figures = {name: values["mean"] for name, values in json.loads(summary.read_text())["metrics"].items()}
    print(f"seed {seed}: {goals} goals, {len(events) - goals} outs of the referee, {len(differences)} differences; "
          + ", ".join(f"{name} {figures[name]:.3g}" for name in FIGURES), flush=True)
    for text in differences:
        print(f"  {text}")
    if not arguments.traces:
        file.unlink()
    return {"seed": seed, "goals": goals, "outs": len(events) - goals, "differences": differences,
            "has_ended": has_ended, "figures": figures}


def summarize(matches):
    num_events = sum(match["goals"] + match["outs"] for match in matches)
    num_differences = sum(len(match["differences"]) for match in matches)
    print(f"{len(matches)} matches, {sum(match['has_ended'] for match in matches)} ended, "
          f"{sum(match['goals'] > 0 for match in matches)} with a goal; "
          f"{num_events} goals and outs, {num_differences} differences")
    for name in ("goals", *FIGURES):
        values = [match["figures"][name] for match in matches]
        print(f"  {name}: mean {statistics.mean(values):.3g}, {min(values):.3g} to {max(values):.3g}")
    return num_events > 0 and num_differences == 0


def main():
    arguments, options = parse_arguments()
    scene = yaml.safe_load((ROOT / "data/scenes/soccer.yaml").read_text())
    first, _, last = arguments.seeds.partition("-")
    with tempfile.TemporaryDirectory() as temporary, ThreadPoolExecutor(arguments.jobs) as pool:
        folder = arguments.traces or temporary
        Path(folder).mkdir(parents=True, exist_ok=True)
        matches = list(pool.map(lambda seed: check(arguments, seed, options, folder, scene),
                                range(int(first), int(last or first) + 1)))
    is_good = summarize(matches)
    if arguments.json:
        replace_file(arguments.json, json.dumps(matches, indent=1) + "\n")
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main())
