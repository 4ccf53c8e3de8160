#!/usr/bin/python3
"""Usage: tools/bench/plot_physics.py FIGURES.json OUTPUT.svg

Draws what a physics step costs over the number of contacts and of robots, from the figures that
`scripts/bench --only physics --json FIGURES.json` has written.
"""

import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from output_file import replace_file  # noqa: E402

WIDTH, HEIGHT, MARGIN = 360, 260, 48


def points_of(figures, kind):
    """(number, us) of the figures named physics.KIND_NUMBER.step_us."""
    pattern = re.compile(rf"physics\.{kind}_(\d+)\.step_us")
    found = [(int(match[1]), one["value"]) for one in figures if (match := pattern.fullmatch(one["name"]))]
    if not found:
        sys.exit(f"plot_physics: no figure physics.{kind}_N.step_us in the file")
    return sorted(found)


def panel(left, title, axis, points):
    most_x, most_y = points[-1][0], max(y for _, y in points) * 1.1

    def place(x, y):
        return (left + MARGIN + x / most_x * (WIDTH - 2 * MARGIN), HEIGHT - MARGIN - y / most_y * (HEIGHT - 2 * MARGIN))

    (x0, y0), (x1, y1) = place(0, 0), place(most_x, most_y)
    lines = [f'<text x="{(x0 + x1) / 2}" y="24" text-anchor="middle" font-weight="bold">{title}</text>',
             f'<path d="M{x0} {y1}V{y0}H{x1}" fill="none" stroke="#888"/>',
             f'<text x="{(x0 + x1) / 2}" y="{HEIGHT - 10}" text-anchor="middle">{axis}</text>',
             f'<text x="{x0}" y="{y1 - 6}" text-anchor="middle">µs</text>',
             '<polyline fill="none" stroke="#06c" points="'
             + " ".join("{:.1f},{:.1f}".format(*place(*point)) for point in points) + '"/>']
    for x, y in points:
        px, py = place(x, y)
        lines += [f'<circle cx="{px:.1f}" cy="{py:.1f}" r="3" fill="#06c"/>',
                  f'<text x="{px:.1f}" y="{py - 8:.1f}" text-anchor="middle">{y:.0f}</text>',
                  f'<text x="{px:.1f}" y="{y0 + 16}" text-anchor="middle">{x}</text>']
    return lines


def main():
    if len(sys.argv) != 3 or "--help" in sys.argv:
        print(__doc__.strip())
        sys.exit(0 if "--help" in sys.argv else 2)
    with open(sys.argv[1], encoding="utf-8") as file:
        figures = json.load(file)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {2 * WIDTH} {HEIGHT}" '
             'font-family="sans-serif" font-size="11">', '<rect width="100%" height="100%" fill="#fff"/>']
    lines += panel(0, "One robot standing", "contacts with the floor", points_of(figures, "contacts"))
    lines += panel(WIDTH, "Robots in one world", "robots standing", points_of(figures, "robots"))
    replace_file(sys.argv[2], "\n".join(lines + ["</svg>"]) + "\n")


if __name__ == "__main__":
    main()
