#!/usr/bin/python3
"""Sends the robot to a posture, prints its height while it moves, and saves a picture at the end.

go_to_posture.py [--host HOST] [--port 7668] [--token TOKEN] [--picture FILE] POSTURE
Exit status: 0 done, 1 refused or failed.
"""

import argparse
import sys

from phone import ConnectionLost, Phone, Refused
from remote_protocol import remote_pb2 as pb


def go(phone, posture, picture_file):
    """@return what became of it, as a Notice."""
    phone.ask(subscribe=pb.Subscribe(state_rate=10, picture_rate=10 if picture_file else 0))
    phone.ask(take_control=pb.TakeControl())
    request_id = phone.ask(go_to_posture=pb.GoToPosture(posture=posture)).request_id
    while True:
        outcome = phone.wait_for_outcome(request_id, 1.0)
        if phone.state:
            print(f"{phone.state.mode:10} {phone.state.activity:20} torso {phone.state.torso_position[2]:.3f} m")
        if outcome:
            break
    if picture_file:
        phone.wait_until(lambda: phone.picture, 5.0)
        if phone.picture:
            with open(picture_file, "wb") as file:
                file.write(phone.picture.jpeg)
            print(f"{picture_file}: {phone.picture.width}x{phone.picture.height}")
    return outcome


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("posture")
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=7668)
    parser.add_argument("--token", default="")
    parser.add_argument("--picture", metavar="FILE", help="JPEG file for a picture of the head camera")
    options = parser.parse_args()
    try:
        with Phone(options.host, options.port, options.token, "python example") as phone:
            outcome = go(phone, options.posture, options.picture)
    except (ConnectionLost, Refused) as error:
        print(error, file=sys.stderr)
        return 1
    print(pb.Notice.Outcome.Name(outcome.outcome), outcome.message)
    return 0 if outcome.outcome == pb.Notice.DONE else 1


if __name__ == "__main__":
    sys.exit(main())
