"""When a robot of a stack did not act, from what its nao-motion and nao-play said on the bus."""

import json
import signal
import subprocess
import time

from stack import BIN_DIR

CHANNELS = "(.*)_(MOTION_STATE|PLAY_STATE)"
NO_ROBOT = 8       # motion_state_t.MODE_NO_ROBOT
AUTO = 6           # play_state_t.BEHAVIOR_AUTO
# Reasons with which nao-play stands although its match goes on; of images, which may be late on a busy machine.
WAITING = ("match-not-played", "no-robot")
WAITING_FOR_IMAGES = ("vision-unavailable", "image-unusable")
# Longest silence, s: motion_state_t's promise; play_state_t comes five times a second, and may be late by scheduling.
SILENCE = {"MOTION_STATE": 0.5, "PLAY_STATE": 1.0}


def read(lines):
    """@param lines: of nao log json. @return (robot, kind) to a list of (wall time in s, message), in the order of time."""
    found = {}
    for line in lines:
        row = json.loads(line)
        robot, _, kind = row["channel"].partition("_")
        found.setdefault((robot, kind), []).append((row["log_wall_utime"] * 1e-6, row["message"]))
    return found


def find_pauses(states, robot, begin, end, scale=1):
    """@param states: of read(). @param begin, end: wall time, s. @param scale: factor on the longest silence, for a busy
    machine; above 1, images may be late. @return texts that say why the robot did not act."""
    pauses = []
    codes = WAITING if scale > 1 else WAITING + WAITING_FOR_IMAGES
    for kind, longest in SILENCE.items():
        rows = states.get((robot, kind), [])
        last, sent = max(((time, message["utime"]) for time, message in rows if time <= begin), default=(begin, None))
        for now, message in [row for row in rows if begin < row[0] <= end] + [(end, None)]:
            # A recorder that is late on a busy machine writes late messages: their own time counts.
            own = (message["utime"] - sent) * 1e-6 if message and sent is not None else now - last
            if min(now - last, own) > longest * scale:
                pauses.append(f"{robot}: no {kind} for {now - last:.1f} s")
            last, sent = now, message and message["utime"]
    said = {message["reason"] for time, message in states.get((robot, "PLAY_STATE"), [])
            if begin < time <= end and message["reason_code"] in codes}
    pauses += [f"{robot}: nao-play waits: {reason}" for reason in sorted(said)]
    if any(message["behavior"] != AUTO for time, message in states.get((robot, "PLAY_STATE"), []) if begin < time <= end):
        pauses.append(f"{robot}: nao-play does not play")
    if any(message["mode"] == NO_ROBOT for time, message in states.get((robot, "MOTION_STATE"), []) if begin < time <= end):
        pauses.append(f"{robot}: nao-motion has no robot")
    return pauses


class Recording:
    """Records what the robots of a stack say, until it ends."""

    def __init__(self, stack):
        self.stack = stack
        self.log = stack.run_dir / "states.lcmlog"
        self.recorder = subprocess.Popen(
            [str(BIN_DIR / "nao"), "record", str(self.log), "--lcm-url", stack.lcm_url, "--channels", CHANNELS],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 10
        while not self.log.exists() and time.monotonic() < deadline:
            time.sleep(0.05)

    def end(self):
        """@return as read()."""
        self.recorder.send_signal(signal.SIGINT)
        self.recorder.wait(timeout=30)
        text = self.stack.run_dir / "states.json"
        said = self.stack.nao("log", "json", self.log, "--output", text)
        if said.returncode != 0:
            raise AssertionError(f"nao log json: {said.stderr}")
        with open(text, encoding="utf-8") as stream:
            return read(stream)
