#!/usr/bin/python3
"""Logs the robot's states into a table, prints a summary, and writes it as CSV. Needs pandas (Debian: python3-pandas).

log_to_pandas.py [ADDRESS] [SECONDS]
Exit status: 77 if pandas is missing.
"""

import sys

import nao_remote

try:
    import pandas
except ImportError:
    sys.stderr.write("pandas is missing (Debian: python3-pandas)\n")
    sys.exit(77)

with nao_remote.connect(*sys.argv[1:2]) as robot, robot.states(rate=30) as states:
    rows = []
    begin = next(states).utime
    for state in states:
        x, y, height = state.torso_position
        rows.append({"time": (state.utime - begin) / 1e6, "mode": state.mode.name, "x": x, "y": y, "height": height,
                     **state.joint_position})
        if rows[-1]["time"] > (float(sys.argv[2]) if len(sys.argv) > 2 else 5):
            break

table = pandas.DataFrame(rows).set_index("time")
table.to_csv("states.csv")
print(table[["x", "y", "height"]].describe())
print(f"{len(table)} states in states.csv")
