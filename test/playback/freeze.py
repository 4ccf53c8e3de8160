#!/usr/bin/python3
"""Usage: test/playback/freeze.py commands|sensors|truth|gateway LOG FROZEN

Makes a small frozen log for the playback tests of a recording with scripts/record.

  commands  commands of a phone with robot time instead of wall time
  sensors   every second NAO_SENSOR_STATE of the two seconds around the moment when the robot falls
  truth     the last WORLD_TRUTH
  gateway   a second of states, ten of each kind, and two images
"""

import re
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from lcm_log import HEADER, SYNC, read_log  # noqa: E402

# After the fingerprint the message begins with utime, and sensor_state_t with tick.
UTIME = struct.Struct(">8xq")
SENSOR = "NAO_SENSOR_STATE"


def write_log(path, events):
    """@param events  (time in microseconds, channel, data)"""
    with open(path, "wb") as file:
        for number, (time, channel, data) in enumerate(events):
            name = channel.encode()
            file.write(HEADER.pack(SYNC, number, time, len(name), len(data)) + name + data)


def utime(event):
    return UTIME.unpack_from(event.data)[0]


def commands(events):
    """Commands with the robot time of the latest preceding sensor state."""
    now, frozen = None, []
    for event in events:
        if event.channel == SENSOR:
            now = utime(event)
        elif now is not None and re.fullmatch(r"NAO_(WALK|MOVE_TO|POSTURE|JOINT_CHANGE|ACTION|STOP)_COMMAND"
                                              r"|WORLD_COMMAND", event.channel):
            frozen.append((now, event.channel, event.data))
    return frozen


def sensors(events):
    """From 2 s before the end of the steady phase to the end of the fall."""
    sensed = [event for event in events if event.channel == SENSOR]
    fall = next((event for event in events
                 if event.channel == "NAO_MOTION_STATE" and b"falling\0" in event.data), None)
    if fall is None:
        raise SystemExit("freeze: the robot does not fall in this log")
    moment = utime(fall)
    return [(utime(event), event.channel, event.data) for event in sensed
            if -1_200_000 <= utime(event) - moment <= 800_000 and utime(event) % 20_000 == 0]


def truth(events):
    last = [event for event in events if event.channel == "WORLD_TRUTH"][-1]
    return [(utime(last), last.channel, last.data)]


def gateway(events):
    frozen, taken = [], {}
    limits = {"NAO_ROBOT_STATE": 10, "NAO_MOTION_STATE": 10, "NAO_HEAD_CAMERA_IMAGE": 2}
    last = {}
    for event in events:
        due = event.time - last.get(event.channel, 0) >= 95_000
        if due and taken.get(event.channel, 0) < limits.get(event.channel, 0):
            last[event.channel] = event.time
            taken[event.channel] = taken.get(event.channel, 0) + 1
            frozen.append((event.time, event.channel, event.data))
    return frozen


def main():
    kinds = {function.__name__: function for function in (commands, sensors, truth, gateway)}
    if len(sys.argv) != 4 or sys.argv[1] not in kinds:
        print(__doc__.strip())
        raise SystemExit(0 if "--help" in sys.argv else 2)
    frozen = kinds[sys.argv[1]](read_log(Path(sys.argv[2])))
    if not frozen:
        raise SystemExit(f"freeze: {sys.argv[2]} holds nothing of the kind {sys.argv[1]}")
    write_log(sys.argv[3], frozen)
    print(f"{sys.argv[3]}: {len(frozen)} messages")


if __name__ == "__main__":
    main()
