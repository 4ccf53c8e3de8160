#!/usr/bin/python3
"""The robot dances: arms, head and knees move to a beat, each move as fast as the beat allows.

dance.py [ADDRESS]
"""

import sys
import time

import nao_remote

BEAT = 0.8  # s
# Group of joints, its changes, rad, and whether the other side makes them mirrored. Their sum is nothing.
MOVES = [
    ("left shoulder", {"pitch": -1.0}, True),
    ("head", {"yaw": 0.5}, False),
    ("left elbow", {"roll": -0.6}, True),
    ("head", {"yaw": -1.0}, False),
    ("left elbow", {"roll": 0.6}, True),
    ("head", {"yaw": 0.5, "pitch": 0.2}, False),
    ("left shoulder", {"pitch": 1.0}, True),
    ("head", {"pitch": -0.2}, False),
]

with nao_remote.connect(*sys.argv[1:2]) as robot:
    robot.posture(robot.description.stand_posture)
    begin = time.monotonic()
    for beat, (group, changes, both_sides) in enumerate(MOVES, start=1):
        move = robot.change_joints(group, **changes, both_sides=both_sides, speed=0.5, wait=False)
        move.wait()
        print(f"beat {beat}: {group}")
        time.sleep(max(0.0, begin + beat * BEAT - time.monotonic()))
    robot.posture("Crouch")
    robot.posture(robot.description.stand_posture)
