#!/usr/bin/python3
"""Draws how the robot walks, as nao-trial measures it: docs/images/walk-odometry.svg. Package: scripts/setup --with plot.

Usage: tools/nao-trial/plot_walk.py [--bin DIR] [--out DIR]
"""

import argparse
import csv
import io
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from output_file import replace_file  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]


def read_trace(trial):
    """@return the rows of a walk in a circle, as numbers by column."""
    with tempfile.TemporaryDirectory() as folder:
        trace = pathlib.Path(folder) / "trace.csv"
        result = subprocess.run([trial, "walk", "--vx", "0.2", "--wz", "0.25", "--duration", "40", "--seeds", "1",
                                 "--trace", str(trace)], capture_output=True, text=True, check=False)
        if result.returncode != 0:
            sys.exit(f"{trial}: {result.stderr.strip()}")
        with trace.open(encoding="utf-8") as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/dev/bin")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/images")
    options = parser.parse_args()
    trial = options.bin / "nao-trial"
    if not trial.exists():
        sys.exit(f"{trial} is missing: build it first (cmake --build --preset dev)")
    rows = read_trace(str(trial))
    import matplotlib.pyplot as plt  # --help does without

    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "nao"})  # text as text, and the same file each time
    figure, axes = plt.subplots(figsize=(4.6, 4.6), layout="constrained")
    for name, first, color in (("truth", "true", "#1f6fb4"), ("odometry", "odometry", "#d9822b")):
        axes.plot([row[f"{first}_x"] for row in rows], [row[f"{first}_y"] for row in rows], color=color, label=name)
    axes.set(title="0.2 m/s in a circle for 40 s, from above", xlabel="m", aspect="equal")
    axes.grid(color="#dddddd")
    axes.legend(loc="upper left")
    image = io.BytesIO()
    figure.savefig(image, format="svg", metadata={"Date": None})
    replace_file(options.out / "walk-odometry.svg", image.getvalue())


if __name__ == "__main__":
    main()
