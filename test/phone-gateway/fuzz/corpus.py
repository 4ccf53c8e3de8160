#!/usr/bin/python3
"""Usage: corpus.py seed FOLDER | unpack PACK FOLDER | pack FOLDER PACK

A pack has the stored inputs of one fuzzer: each after its length, 4 bytes, most significant first.
seed writes one input of fuzz_session for each use case; unpack writes each input of a pack to a file, as libFuzzer
reads them; pack makes a pack of such files. The tests run the fuzzers on the packs.
"""

import hashlib
import struct
import sys
from pathlib import Path


def use_cases(pb):
    return {
        "connect": dict(connect=pb.Connect(protocol_version=1, token="k", client_name="Ana", join_key="j")),
        "get_state": dict(get_state=pb.GetState(with_image=True, image=pb.ImageRequest(camera="top", width=320))),
        "subscribe": dict(subscribe=pb.Subscribe(state_rate=30, image_rate=15)),
        "walk_turn": dict(walk_turn=pb.WalkTurn(vx=0.1, vy=-0.1, wz=1)),
        "move_to": dict(move_to=pb.MoveTo(x=1, y=1, theta=1)),
        "go_to_posture": dict(go_to_posture=pb.GoToPosture(posture="Crouch", speed=0.5)),
        "change_joints": dict(change_joints=pb.ChangeJoints(group="head", yaw=0.1, pitch=0.1)),
        "do_action": dict(do_action=pb.DoAction(action="wave", ball_x=0.2, ball_y=0, strength=1)),
        "play": dict(play=pb.Play(behavior=pb.Play.KICK, target_x=1, target_y=0.5)),
        "stop": dict(stop=pb.Stop()),
        "release_control": dict(release_control=pb.ReleaseControl()),
        "held_walk_turn": dict(walk_turn=pb.WalkTurn(is_held=True)),
        "ping": dict(ping=pb.Ping(client_utime=1)),
        "attend": dict(attend=pb.Attend(visitor_key="0123456789abcdef", again=True)),
        "run_exhibition": dict(run_exhibition=pb.RunExhibition(secret="k", speed=0.5)),
        "operate": dict(operate=pb.Operate(operation=pb.Operate.KICK, client_id=1)),
    }


def seed(folder):
    # Only here: packs are read and written without the protocol's classes, which the preset dev builds.
    sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "build/dev/python"))
    from nao_remote import remote_pb2 as pb

    def encode(events, **use_case):
        message = pb.Request(request_id=1, **use_case).SerializeToString()
        return bytes([events, len(message)]) + message

    requests = use_cases(pb)
    begin = encode(6, **requests["connect"]) + encode(6, take_control=pb.TakeControl())
    # The second connection of the first client, and copies of requests over both.
    copies = b"".join(encode(events, walk_turn=pb.WalkTurn(vx=0.1)) for events in (6, 7, 7, 6))
    (folder / "join").write_bytes(begin + encode(7, join=pb.Join(client_id=1, key="j")) + copies)
    for name, request in requests.items():
        (folder / name).write_bytes(begin + encode(14, **request) + encode(6, **request))


def pack(folder, file):
    inputs = sorted((path.read_bytes() for path in folder.iterdir()), key=lambda bytes_: (len(bytes_), bytes_))
    file.write_bytes(b"".join(struct.pack(">I", len(bytes_)) + bytes_ for bytes_ in inputs))


def unpack(file, folder):
    packed = file.read_bytes()
    while packed:
        length, = struct.unpack_from(">I", packed)
        bytes_, packed = packed[4:4 + length], packed[4 + length:]
        (folder / hashlib.sha1(bytes_).hexdigest()).write_bytes(bytes_)


def main():
    if len(sys.argv) < 3 or sys.argv[1] not in ("seed", "pack", "unpack"):
        print(__doc__.strip())
        sys.exit(0 if "--help" in sys.argv else 2)
    paths = [Path(argument) for argument in sys.argv[2:]]
    if sys.argv[1] != "pack":
        paths[-1].mkdir(parents=True, exist_ok=True)
    {"seed": seed, "pack": pack, "unpack": unpack}[sys.argv[1]](*paths)


if __name__ == "__main__":
    main()
