#!/usr/bin/python3
"""A log of states and images, played to nao-phone-gateway, reaches a phone as it was."""

import json
import os
import signal
import subprocess
import sys
import unittest
from pathlib import Path

from lcm_log import read_log
from message_fields import read_utime
from stack import BIN_DIR, ROOT, Stack, run

sys.path[:0] = [str(ROOT / "test/phone-gateway"), str(BIN_DIR.parent / "python")]
from phone import Phone, pb  # noqa: E402

LOG = Path(__file__).resolve().parent / "sessions/gateway.states.lcmlog"
DEADLINE = 60


def logged(channel):
    """The messages of a channel of the frozen log by their time, as dictionaries."""
    said = run([BIN_DIR / "nao", "log", "json", LOG, "--channels", channel])
    assert said.returncode == 0, said.stderr
    messages = [json.loads(line)["message"] for line in said.stdout.splitlines()]
    assert messages, f"{LOG} has nothing on {channel}, or its type has changed: test/playback/record --all"
    return {message["utime"]: message for message in messages}


class GatewayPlayback(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = Stack()
        cls.addClassCleanup(cls.stack.__exit__)
        started = cls.stack.start("--only", "phone-gateway")
        if started.returncode != 0:
            raise AssertionError(started.stdout + started.stderr + cls.stack.logs())
        cls.player = subprocess.Popen(
            [str(ROOT / "scripts/replay"), "--run-dir", str(cls.stack.run_dir), "--loop", str(LOG)],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        cls.addClassCleanup(cls.end_player)

    @classmethod
    def end_player(cls):
        os.killpg(cls.player.pid, signal.SIGKILL)
        cls.player.wait()

    def phone(self):
        return Phone(port=self.stack.tcp_port, token=self.stack.token, timeout=DEADLINE)

    def assert_close(self, shown, said):
        self.assertEqual(len(shown), len(said))
        for one, other in zip(shown, said):
            self.assertAlmostEqual(one, other, places=5)  # the phone's are floats

    def test_the_state_reaches_the_phone(self):
        states = logged("NAO_ROBOT_STATE")
        modes = {message["mode"] for message in logged("NAO_MOTION_STATE").values()}
        with self.phone() as phone:
            phone.ask(subscribe=pb.Subscribe(state_rate=30))
            # Between two rounds of a slow player the gateway correctly reports for a short time that no robot is connected.
            self.assertTrue(phone.wait_until(
                lambda: phone.state is not None and phone.state.utime in states and phone.state.mode in modes,
                DEADLINE), f"{phone.state}{self.stack.logs()}")
            shown = phone.state
            names = [joint.name for joint in phone.robot.joints]
        said = states[shown.utime]
        by_name = dict(zip(said["joint_names"], said["joint_position"]))
        self.assert_close(shown.joint_position, [by_name[name] for name in names])
        self.assert_close(shown.torso_orientation, said["orientation_torso_in_odometry"])
        self.assert_close(shown.torso_position, said["position_torso_in_odometry"])

    def test_the_image_reaches_the_phone_byte_by_byte(self):
        images = {read_utime(event.data): event.data for event in read_log(LOG)
                    if event.channel == "NAO_HEAD_CAMERA_IMAGE"}
        with self.phone() as phone:
            phone.ask(subscribe=pb.Subscribe(state_rate=1, image_rate=10, image=pb.ImageRequest(width=320)))
            self.assertTrue(phone.wait_until(lambda: phone.image is not None, DEADLINE), self.stack.logs())
            shown = phone.image
        # The image is the end of the message.
        self.assertTrue(images[shown.utime].endswith(shown.jpeg))
        self.assertTrue(shown.jpeg.startswith(b"\xff\xd8"))


if __name__ == "__main__":
    unittest.main()
