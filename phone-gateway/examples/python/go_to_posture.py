#!/usr/bin/python3
"""Sends the robot to a posture, prints its height while it moves, and saves an image at the end.

go_to_posture.py [--host HOST] [--port 7668] [--token TOKEN] [--image FILE] POSTURE
Exit status: 0 done, 1 refused or failed.
"""

import argparse
import sys

from phone import ConnectionLost, Phone, Refused
from remote_protocol import remote_pb2 as pb


def go(phone, posture, image_file):
    """@return its final result, a Notice."""
    phone.ask(subscribe=pb.Subscribe(state_rate=10, image_rate=10 if image_file else 0))
    phone.ask(take_control=pb.TakeControl())
    request_id = phone.ask(go_to_posture=pb.GoToPosture(posture=posture)).request_id
    while True:
        result = phone.wait_for_result(request_id, 1.0)
        if phone.state:
            print(f"{pb.Mode.Name(phone.state.mode):16} {phone.state.activity.name:12} torso {phone.state.torso_position[2]:.3f} m")
        if result:
            break
    if image_file:
        phone.wait_until(lambda: phone.image, 5.0)
        if phone.image:
            with open(image_file, "wb") as file:
                file.write(phone.image.jpeg)
            print(f"{image_file}: {phone.image.width}x{phone.image.height}")
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("posture")
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=7668)
    parser.add_argument("--token", default="")
    parser.add_argument("--image", metavar="FILE", help="JPEG file for an image of the head camera")
    options = parser.parse_args()
    try:
        with Phone(options.host, options.port, options.token, "python example") as phone:
            result = go(phone, options.posture, options.image)
    except (ConnectionLost, Refused) as error:
        print(error, file=sys.stderr)
        return 1
    print(pb.Notice.Status.Name(result.status), result.message)
    return 0 if result.status == pb.Notice.DONE else 1


if __name__ == "__main__":
    sys.exit(main())
