#!/usr/bin/env python3
"""Draws how the robot walks, as nao-trial measures it: docs/images/walk-odometry.svg.

Usage: tools/nao-trial/plot_walk.py [--bin DIR] [--out DIR]
"""

import argparse
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from output_file import replace_file  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIZE = 460  # pixels
MARGIN = 46
INK, GRID, TRUTH, ODOMETRY = "#333333", "#dddddd", "#1f6fb4", "#d9822b"


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


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/dev/bin")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/images")
    options = parser.parse_args()
    trial = options.bin / "nao-trial"
    if not trial.exists():
        sys.exit(f"{trial} is missing: build it first (cmake --build --preset dev)")
    plot_odometry(str(trial), options.out)


if __name__ == "__main__":
    main()
