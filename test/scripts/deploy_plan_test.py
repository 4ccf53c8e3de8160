#!/usr/bin/python3
"""scripts/deploy without a robot: its steps, what it copies, which robots it refuses; and whether a robot is seated."""

import os
import platform
import socket
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import deploy  # noqa: E402
import seat  # noqa: E402

RELEASE = platform.freedesktop_os_release()["VERSION_CODENAME"]
MODEL = ROOT / "data/robots/nao"


def run(command, **keywords):
    return subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=False, **keywords)


class Planning(unittest.TestCase):
    def test_a_dry_run_prints_every_step_and_contacts_nobody(self):
        with tempfile.NamedTemporaryFile(suffix=".deb") as package:
            for command, steps in (
                    ("install", [f"debootstrap --variant=minbase {RELEASE} ", "apt-get install", "sse4_2", "control stop",
                                 "rsync --archive", "nao@robot:/home/nao/nao-remote/root/", "touch /home/nao/nao-remote/complete"]),
                    ("start", ["sudo -n /home/nao/nao-remote/control start --model nao_v6"]),
                    ("stop", ["control stop"]), ("status", ["control status"]), ("logs", ["control logs"]),
                    ("remove", ["control remove"])):
                with self.subTest(command):
                    result = run([ROOT / "scripts/deploy", "nao@robot", command, "--dry-run", "--package", package.name],
                                 env={**os.environ, "PATH": "/usr/bin:/bin"})
                    self.assertEqual(result.returncode, 0, result.stderr)
                    position = 0
                    for step in steps:
                        position = result.stdout.find(step, position)
                        self.assertGreaterEqual(position, 0, f"{step} in {result.stdout}")
            result = run([ROOT / "scripts/deploy", "nao@robot", "--dry-run", "--tar", "--package", package.name])
            self.assertIn("tar --directory", result.stdout)
            self.assertNotIn("rsync --archive", result.stdout)

    def test_a_wrong_command_line_is_refused(self):
        for words, said in ((["--oProxyCommand=x"], "USER@HOST"), (["robot;reboot"], "USER@HOST"),
                            (["nao@robot", "fly"], "no command 'fly'"), (["nao@robot", "--dir", "/"], "two folders deep"),
                            (["nao@robot", "--dir", "/home/../etc"], "two folders deep"),
                            (["nao@robot", "--dir", "/home/nao/$(x)"], "two folders deep"),
                            (["nao@robot", "logs", "../x"], "does not belong"), (["nao@robot", "--no-such"], "--no-such"),
                            (["nao@robot", "--package", "/no/such.deb"], "there is no")):
            with self.subTest(words=words):
                result = run([ROOT / "scripts/deploy", *words, "--dry-run"])
                self.assertEqual(result.returncode, 2, result.stdout)
                self.assertIn(said, result.stderr)

    def test_what_differs_is_copied(self):
        local = {"a": ("d", 0, 0), "a/same": ("f", 5, 100), "a/cut": ("f", 5, 100), "link": ("l", 1, 100), "kind": ("f", 1, 1)}
        remote = {"a": ("d", 0, 0), "a/same": ("f", 5, 100), "a/cut": ("f", 3, 200), "old": ("d", 0, 0), "old/x": ("f", 1, 1),
                  "kind": ("d", 0, 0), "tmp": ("d", 0, 0)}
        send, remove = deploy.plan_copy(local, remote)
        self.assertEqual(send, ["a/cut", "kind", "link"])
        self.assertEqual(remove, ["old/x", "old", "kind"])

    def test_unfit_robots_are_refused(self):
        fit = {"machine": "x86_64", "sse": "yes", "free_kb": "20000000", "partition": "/home", "tar": "yes"}
        deploy.check_facts(fit, 1e9, "/home/nao/nao-remote")
        for change, said in (({"machine": "armv7l"}, "armv7l"), ({"machine": ""}, "unknown"), ({"sse": ""}, "SSE4.2"),
                             ({"free_kb": "900000"}, "0.9 GB free, 1.5 GB are needed"), ({"tar": ""}, "no tar")):
            with self.subTest(change=change), self.assertRaises(deploy.Failure) as raised:
                deploy.check_facts({**fit, **change}, 1e9, "/home/nao/nao-remote")
            self.assertIn(said, str(raised.exception))


class Seat(unittest.TestCase):
    """The posture before the start, against a robot that sends one frame."""

    def setUp(self):
        try:
            import msgpack
            import yaml
        except ImportError as error:
            self.skipTest(f"{error}: scripts/setup")
        self.msgpack = msgpack
        self.postures = {posture["name"]: posture["joints"]
                         for posture in yaml.safe_load((MODEL / "postures.yaml").read_text())["postures"]}
        self.joints = [entry["joint"] for entry in yaml.safe_load((MODEL / "lola.yaml").read_text())["joints"]]

    def check(self, sent):
        with tempfile.TemporaryDirectory(prefix="nao-") as folder:
            path = Path(folder) / "lola"
            with socket.socket(socket.AF_UNIX) as server:
                server.bind(str(path))
                server.listen()

                def serve():
                    with server.accept()[0] as connection:
                        connection.sendall(sent)

                thread = threading.Thread(target=serve, daemon=True)
                thread.start()
                try:
                    seat.check_seated(MODEL, path)
                finally:
                    thread.join()

    def frame(self, posture):
        return self.msgpack.packb({"Position": [self.postures[posture][joint] for joint in self.joints]},
                                  use_single_float=True)

    def test_only_a_seated_robot_is_started(self):
        self.check(self.frame("Crouch"))
        for posture in ("Stand", "StandInit", "StandZero", "LyingBelly"):
            with self.subTest(posture), self.assertRaises(seat.Failure) as raised:
                self.check(self.frame(posture))
            self.assertIn("not seated", str(raised.exception))

    def test_what_is_no_frame_is_refused(self):
        for name, sent in (("nothing", b""), ("cut off", self.frame("Crouch")[:50]), ("a number", b"\x01"),
                           ("garbage", b"\xc1" * 900), ("few joints", self.msgpack.packb({"Position": [0.0] * 3})),
                           ("a text", self.msgpack.packb({"Position": "x"})),
                           ("texts", self.msgpack.packb({"Position": ["x"] * 25})),
                           ("no numbers", self.msgpack.packb({"Position": [float("nan")] * 25}))):
            with self.subTest(name), self.assertRaises(seat.Failure):
                self.check(sent)

    def test_without_lola_it_says_what_to_do(self):
        with self.assertRaises(seat.Failure) as raised:
            seat.check_seated(MODEL, "/no/such/socket")
        self.assertIn("robocup.conf", str(raised.exception))


if __name__ == "__main__":
    unittest.main()
