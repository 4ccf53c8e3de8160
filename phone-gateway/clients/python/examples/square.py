#!/usr/bin/python3
"""The robot walks along a square and prints where it believes to be at each corner.

square.py [ADDRESS]
"""

import math
import sys

import nao_remote

SIDE = 0.3  # m

with nao_remote.connect(*sys.argv[1:2]) as robot:
    robot.posture(robot.description.ready_posture)
    for corner in range(1, 5):
        robot.move_to(SIDE, 0, 0)
        robot.move_to(0, 0, math.pi / 2)
        x, y, _ = robot.state().torso_position
        print(f"corner {corner}: x {x:.2f} m, y {y:.2f} m")
