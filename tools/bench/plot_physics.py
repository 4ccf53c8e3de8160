#!/usr/bin/python3
"""Usage: tools/bench/plot_physics.py FIGURES.json OUTPUT.svg

Draws what a physics step costs over the number of contacts and of robots, from the figures that
`scripts/bench --only physics --json FIGURES.json` has written. Package: scripts/setup --with plot.
"""

import io
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from output_file import replace_file  # noqa: E402


def points_of(figures, kind):
    """(number, us) of the figures named physics.KIND_NUMBER.step_us."""
    pattern = re.compile(rf"physics\.{kind}_(\d+)\.step_us")
    found = [(int(match[1]), one["value"]) for one in figures if (match := pattern.fullmatch(one["name"]))]
    if not found:
        sys.exit(f"plot_physics: no figure physics.{kind}_N.step_us in the file")
    return sorted(found)


def main():
    if len(sys.argv) != 3 or "--help" in sys.argv:
        print(__doc__.strip())
        sys.exit(0 if "--help" in sys.argv else 2)
    with open(sys.argv[1], encoding="utf-8") as file:
        figures = json.load(file)
    import matplotlib.pyplot as plt  # --help does without

    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "nao"})  # text as text, and the same file each time
    drawing, both = plt.subplots(1, 2, figsize=(7.2, 2.6), layout="constrained")
    for axes, kind, title, label in ((both[0], "contacts", "One robot standing", "contacts with the floor"),
                                     (both[1], "robots", "Robots in one world", "robots standing")):
        points = points_of(figures, kind)
        axes.plot(*zip(*points), "o-", color="#0066cc")
        for x, y in points:
            axes.annotate(f"{y:.0f}", (x, y), (0, 6), textcoords="offset points", ha="center")
        axes.set(title=title, xlabel=label, ylabel="µs", ylim=(0, 1.2 * max(y for _, y in points)))
    image = io.BytesIO()
    drawing.savefig(image, format="svg", metadata={"Date": None})
    replace_file(sys.argv[2], image.getvalue())


if __name__ == "__main__":
    main()
