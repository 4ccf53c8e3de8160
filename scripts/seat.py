"""Whether a robot is seated, read from LoLA, its interface to motors and sensors, before anything drives it."""

import socket
import time
from pathlib import Path

from stack import Failure

# Time for a state frame to come, s. LoLA sends one every 12 ms.
FRAME_TIMEOUT = 2
# A joint that differs by more between the robot's stand and rest postures tells one from the other, rad.
TELLING_DIFFERENCE = 1.0
# LoLA needs some time after a client has left (100 ms: B-Human's bridge waits so long), s.
RECONNECT_PAUSE = 0.2


def read_frame(path):
    """@return the next state frame, a dictionary. @param path  LoLA's socket."""
    import msgpack  # python3-msgpack is needed for robots only

    unpacker = msgpack.Unpacker(raw=False)
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
            connection.settimeout(FRAME_TIMEOUT)
            connection.connect(str(path))
            while data := connection.recv(4096):
                unpacker.feed(data)
                for frame in unpacker:
                    return frame
    except FileNotFoundError:
        raise Failure(f"there is no {path}; on the robot: touch /home/nao/robocup.conf, then restart it") from None
    except (OSError, ValueError, msgpack.exceptions.UnpackException) as error:
        raise Failure(f"LoLA at {path} sends no state ({error}); end its other client, or restart the robot") from None
    raise Failure(f"LoLA at {path} has closed the connection; end its other client, or restart the robot")


def standing_joint(model_folder, frame):
    """@return a joint that is nearer to the stand than to the rest posture, as (name, angle, angle at rest); None if the
    robot is seated. @param model_folder  The robot's files."""
    import yaml

    def load(name):
        return yaml.safe_load((Path(model_folder) / name).read_text())

    names = [entry["joint"] for entry in load("lola.yaml")["joints"]]
    signs = [entry["sign"] for entry in load("lola.yaml")["joints"]]
    references = load("robot.yaml")["reference_postures"]
    postures = {posture["name"]: posture["joints"] for posture in load("postures.yaml")["postures"]}
    stand, rest = postures[references["stand"]], postures[references["rest"]]
    measured = frame.get("Position") if isinstance(frame, dict) else None
    if not isinstance(measured, list) or len(measured) != len(names) or \
            not all(isinstance(angle, (int, float)) for angle in measured):
        raise Failure(f"LoLA's frame does not have the {len(names)} angles of {model_folder}/lola.yaml; "
                      "is this a NAO V6?")
    for name, sign, angle in zip(names, signs, measured):
        if abs(stand[name] - rest[name]) > TELLING_DIFFERENCE and \
                not abs(sign * angle - rest[name]) < abs(sign * angle - stand[name]):
            return name, sign * angle, rest[name]
    return None


def check_seated(model_folder, path):
    """@throws Failure  if the robot is not seated, or does not answer."""
    found = standing_joint(model_folder, read_frame(path))
    time.sleep(RECONNECT_PAUSE)
    if found:
        name, angle, rest = found
        raise Failure(f"the robot is not seated: {name} is at {angle:.2f} rad, seated {rest:.2f}. "
                      "Hold it, sit it on its heels, and try again; or lay it down and start with --any-posture")
