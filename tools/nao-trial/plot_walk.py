#!/usr/bin/env python3
"""Draws how the robot walks, as nao-trial measures it: docs/images/walk-odometry.svg and walk-push.svg.

Usage: tools/nao-trial/plot_walk.py [--bin DIR] [--out DIR] [--seeds A-B]
"""

import argparse
import csv
import math
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from output_file import replace_file  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIZE = 460  # pixels
MARGIN = 46
INK, GRID, TRUTH, ODOMETRY, FALLEN = "#333333", "#dddddd", "#1f6fb4", "#d9822b", "#c0392b"


class Plot:
    """Square SVG plot with equal axes. Coordinates are those of the data, y up."""

    def __init__(self, low, high, title, unit):
        self.low, self.high = low, high
        self.scale = (SIZE - 2 * MARGIN) / max(high[0] - low[0], high[1] - low[1])
        self.parts = []
        self.text(SIZE / 2, 20, title, anchor="middle", size=14)
        step = nice_step((SIZE - 2 * MARGIN) / self.scale / 6)
        for axis in (0, 1):
            value = math.ceil(low[axis] / step) * step
            while value <= low[axis] + (SIZE - 2 * MARGIN) / self.scale + 1e-9:
                self.grid_line(axis, value, unit)
                value += step

    def at(self, x, y):
        return (MARGIN + (x - self.low[0]) * self.scale, SIZE - MARGIN - (y - self.low[1]) * self.scale)

    def text(self, x, y, text, anchor="start", size=11, color=INK):
        self.parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" fill="{color}">'
            f"{text}</text>")

    def grid_line(self, axis, value, unit):
        end = SIZE - MARGIN
        label = f"{value:g}"
        if axis == 0:
            x = self.at(value, self.low[1])[0]
            self.line([(x, MARGIN), (x, end)], GRID, 1)
            self.text(x, end + 16, label + f" {unit}", "middle")
        else:
            y = self.at(self.low[0], value)[1]
            self.line([(MARGIN, y), (end, y)], GRID, 1)
            self.text(MARGIN - 6, y + 4, label, "end")

    def line(self, pixels, color, width=2):
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in pixels)
        self.parts.append(f'<polyline points="{points}" fill="none" stroke="{color}" '
                          f'stroke-width="{width}"/>')

    def curve(self, data, color):
        self.line([self.at(x, y) for x, y in data], color)

    def dot(self, x, y, color):
        px, py = self.at(x, y)
        self.parts.append(f'<circle cx="{px:.1f}" cy="{py:.1f}" r="4" fill="{color}"/>')

    def circle(self, radius, color):
        px, py = self.at(0, 0)
        self.parts.append(f'<circle cx="{px:.1f}" cy="{py:.1f}" r="{radius * self.scale:.1f}" '
                          f'fill="none" stroke="{color}" stroke-dasharray="5 4"/>')

    def legend(self, entries):
        for i, (text, color) in enumerate(entries):
            self.text(MARGIN + 6, MARGIN + 14 + 16 * i, text, color=color, size=12)

    def write(self, file):
        replace_file(file, f'<svg xmlns="http://www.w3.org/2000/svg" width="{SIZE}" height="{SIZE}" '
                     f'viewBox="0 0 {SIZE} {SIZE}" font-family="sans-serif">'
                     f'<rect width="100%" height="100%" fill="white"/>\n'
                     + "\n".join(self.parts) + "\n</svg>\n")
        print(file)


def nice_step(rough):
    """The number 1, 2 or 5 times a power of ten that is next above."""
    power = 10 ** math.floor(math.log10(rough))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough)


def run(program, *arguments):
    result = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"{program} {' '.join(arguments)}: {result.stderr.strip()}")
    return result.stdout


def plot_odometry(trial, out):
    with tempfile.TemporaryDirectory() as folder:
        trace = pathlib.Path(folder) / "trace.csv"
        run(trial, "walk", "--vx", "0.2", "--wz", "0.25", "--duration", "40", "--seeds", "1",
            "--trace", str(trace))
        with trace.open(encoding="utf-8") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    truth = [(row["true_x"], row["true_y"]) for row in rows]
    odometry = [(row["odometry_x"], row["odometry_y"]) for row in rows]
    both = truth + odometry
    low = [min(p[i] for p in both) - 0.1 for i in (0, 1)]
    high = [max(p[i] for p in both) + 0.1 for i in (0, 1)]
    plot = Plot(low, high, "0.2 m/s in a circle for 40 s, from above", "m")
    plot.curve(truth, TRUTH)
    plot.curve(odometry, ODOMETRY)
    plot.legend([("truth", TRUTH), ("odometry", ODOMETRY)])
    plot.write(out / "walk-odometry.svg")


def plot_pushes(trial, out, seeds):
    text = run(trial, "walk-push", "--seeds", seeds, "--verbose")
    points = re.findall(r"impulse_Ns (\S+)\s+direction_deg (\S+)", text)
    if not points:
        sys.exit("walk-push reported no push")
    plot = Plot((-3.2, -3.2), (3.2, 3.2), "Greatest push survived at 0.15 m/s (ahead is up)", "N s")
    plot.circle(0.6, FALLEN)
    for impulse, direction in points:
        size, angle = float(impulse), math.radians(float(direction))
        # Ahead is up, left is left.
        plot.dot(-size * math.sin(angle), size * math.cos(angle), TRUTH)
    plot.legend([(f"{len(points)} robots, directions, moments", TRUTH), ("asked: 0.6 N s", FALLEN)])
    plot.write(out / "walk-push.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/dev/bin")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/images")
    parser.add_argument("--seeds", default="1-100", help="of the pushes (default: %(default)s)")
    options = parser.parse_args()
    trial = options.bin / "nao-trial"
    if not trial.exists():
        sys.exit(f"{trial} is missing: build it first (cmake --build --preset dev)")
    plot_odometry(str(trial), options.out)
    plot_pushes(str(trial), options.out, options.seeds)


if __name__ == "__main__":
    main()
