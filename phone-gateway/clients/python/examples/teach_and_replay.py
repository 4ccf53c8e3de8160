#!/usr/bin/python3
"""Records the robot's joints while another client or a hand moves them, saves them, and replays them.

teach_and_replay.py [ADDRESS] [FILE] [SECONDS]    FILE: written if it does not exist, else replayed only
"""

import json
import sys
from pathlib import Path

import nao_remote

KEYFRAME_PERIOD = 0.5  # s
# A joint that has moved by less since the last keyframe is left alone, rad.
LEAST_CHANGE = 0.05


def record(robot, seconds):
    """@return keyframes: joint positions by name, one every KEYFRAME_PERIOD."""
    keyframes = []
    with robot.states(rate=20) as states:
        begin = next(states).utime
        for state in states:
            time = (state.utime - begin) / 1e6
            if time >= len(keyframes) * KEYFRAME_PERIOD:
                keyframes.append(dict(state.joint_position))
            if time > seconds:
                return keyframes


def replay(robot, keyframes):
    """Goes through the keyframes; the first one is where the recording began."""
    for number, keyframe in enumerate(keyframes):
        present = robot.state().joint_position
        for name, angle in keyframe.items():
            if abs(angle - present[name]) >= LEAST_CHANGE:
                print(f"keyframe {number}: {name} to {angle:.2f} rad", flush=True)
                robot.joints[name].move_to(angle, 0.5)


with nao_remote.connect(*sys.argv[1:2]) as robot:
    file = Path(sys.argv[2] if len(sys.argv) > 2 else "taught.json")
    if not file.exists():
        print("recording", flush=True)
        file.write_text(json.dumps(record(robot, float(sys.argv[3]) if len(sys.argv) > 3 else 10)))
        print(f"{file} is written; run it again to replay")
    else:
        replay(robot, json.loads(file.read_text()))
