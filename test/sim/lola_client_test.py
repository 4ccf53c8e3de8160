#!/usr/bin/python3
"""A client of LoLA that knows only docs/real-robot.md, with its own MessagePack reader, at nao-sim --lola."""

import json
import math
import socket
import struct
import tempfile
import time
import unittest
from pathlib import Path

from stack import BIN_DIR, DEADLINE, Program, private_lcm_url, run

# Keys of a state frame in their order, and how many values each has.
KEYS = {"Position": 25, "Stiffness": 25, "Temperature": 25, "Current": 25, "Status": 25, "Battery": 4,
        "Accelerometer": 3, "Gyroscope": 3, "Angles": 2, "Sonar": 2, "FSR": 8, "Touch": 14, "RobotConfig": 4}
FRAME_BYTES = 896
HEAD_YAW, L_KNEE_PITCH = 0, 10
# Tilt of a standing robot, rad: 0.1 when its servos yield under its weight.
UPRIGHT = 0.2


class Reader:
    """The MessagePack types of a state frame. Anything else is an error."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, count):
        self.at += count
        if self.at > len(self.data):
            raise EOFError
        return self.data[self.at - count:self.at]

    def value(self):
        first = self.take(1)[0]
        if first <= 0x7f:
            return first
        if first & 0xf0 == 0x80:
            return {self.value(): self.value() for _ in range(first & 0x0f)}
        if first & 0xf0 == 0x90:
            return [self.value() for _ in range(first & 0x0f)]
        if first & 0xe0 == 0xa0:
            return self.take(first & 0x1f).decode("ascii")
        if first == 0xca:
            return struct.unpack(">f", self.take(4))[0]
        if first == 0xdc:
            return [self.value() for _ in range(struct.unpack(">H", self.take(2))[0])]
        raise ValueError(f"type 0x{first:02x} at byte {self.at - 1}")


def pack(command):
    """A command map: lists of floats, or of bools."""
    data = bytes([0x80 + len(command)])
    for key, values in command.items():
        data += bytes([0xa0 + len(key)]) + key.encode("ascii")
        data += bytes([0x90 + len(values)]) if len(values) < 16 else b"\xdc" + struct.pack(">H", len(values))
        for value in values:
            data += (b"\xc3" if value else b"\xc2") if isinstance(value, bool) else b"\xca" + struct.pack(">f", value)
    return data


class Client:
    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.socket.settimeout(DEADLINE)
        self.socket.connect(str(path))

    def receive(self):
        """The next frame's bytes."""
        data = b""
        while len(data) < FRAME_BYTES:
            part = self.socket.recv(FRAME_BYTES - len(data))
            if not part:
                raise EOFError
            data += part
        return data

    def state(self):
        return Reader(self.receive()).value()

    def send(self, **command):
        self.socket.sendall(pack(command))

    def answer(self, **command):
        """Sends a command and returns the next frame."""
        self.send(**command)
        return self.state()

    def close(self):
        self.socket.close()


class LolaClient(unittest.TestCase):
    options = ["--lock-step", "--scene", "empty"]

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "lola"
        self.lcm_url = private_lcm_url()
        self.simulator = Program("nao-sim", self.lcm_url, "--lola", self.path, *self.options)
        self.addCleanup(self.simulator.kill)
        deadline = time.monotonic() + DEADLINE
        # The socket is there before anybody listens.
        while True:
            try:
                self.client = self.connect()
                break
            except (FileNotFoundError, ConnectionRefusedError):
                self.assertLess(time.monotonic(), deadline, "nobody listens")
                time.sleep(0.01)

    def connect(self):
        client = Client(self.path)
        self.addCleanup(client.close)
        return client

    def nao(self, *arguments):
        return run([BIN_DIR / "nao", "--lcm-url", self.lcm_url, *arguments])

    def test_reads_every_field(self):
        data = self.client.receive()
        state = Reader(data).value()
        self.assertEqual(list(state), list(KEYS))
        self.assertEqual({key: len(values) for key, values in state.items()}, KEYS)
        for key, values in state.items():
            kind = {"Status": int, "RobotConfig": str}.get(key, float)
            self.assertTrue(all(type(value) is kind for value in values), key)
        self.assertEqual([len(text) for text in state["RobotConfig"]], [20, 5, 20, 5])
        for _ in range(50):
            state = self.client.answer()
        # A standing robot: gravity with the vendor's sign, upright, its weight of 5.3 kg on eight sensors.
        self.assertAlmostEqual(state["Accelerometer"][2], -9.81, delta=0.5)
        self.assertLess(max(map(abs, state["Angles"])), UPRIGHT)
        self.assertAlmostEqual(sum(state["FSR"]), 5.3, delta=1)
        self.assertEqual(state["Stiffness"], [1.0] * 25)
        self.assertTrue(all(30 < value < 60 for value in state["Temperature"]))
        self.assertGreater(max(state["Current"]), 0)
        self.assertEqual(state["Status"], [0] * 25)
        charge, status, current, temperature = state["Battery"]
        self.assertAlmostEqual(charge, 0.9, delta=0.1)
        self.assertEqual(status, -32724)
        self.assertLess(current, 0)
        self.assertTrue(20 < temperature < 50)
        self.assertEqual(state["Touch"], [0.0] * 14)

    def test_moves_a_joint(self):
        position = self.client.state()["Position"]
        position[HEAD_YAW] = 0.5
        for _ in range(100):
            state = self.client.answer(Position=position)
        self.assertAlmostEqual(state["Position"][HEAD_YAW], 0.5, delta=0.03)
        # Joints that are not named keep their targets: the robot stands.
        self.assertEqual(state["Stiffness"], [1.0] * 25)

    def test_accelerometer_and_gyroscope_change_in_turns(self):
        last = self.client.state()
        changed = []
        for _ in range(20):
            state = self.client.answer()
            changed.append((state["Accelerometer"] != last["Accelerometer"], state["Gyroscope"] != last["Gyroscope"]))
            last = state
        self.assertTrue(all(accelerometer != gyroscope for accelerometer, gyroscope in changed), changed)
        self.assertTrue(all(one != next_ for one, next_ in zip(changed, changed[1:])), changed)

    def test_stiffness_zero_and_below_is_limp(self):
        self.client.state()
        for limp in (0.0, -1.0):
            state = self.client.answer(Stiffness=[limp] * 25)
            state = self.client.answer()
            self.assertEqual(state["Stiffness"], [0.0] * 25)
            self.client.answer(Stiffness=[1.0] * 25)
        self.client.answer(Stiffness=[0.0] * 25)
        for _ in range(300):
            state = self.client.answer()
        truth = json.loads(self.nao("world", "show", "--json").stdout)
        self.assertLess(truth["robots"][0]["position_torso_in_world"][2], 0.25, "it has collapsed")

    def test_two_maps_in_one_read_are_two_frames(self):
        self.client.state()
        self.client.socket.sendall(pack({"Sonar": [True, True]}) + pack({"Chest": [1.0, 0.5, 0.0]}))
        self.client.state()
        self.assertGreater(min(self.client.state()["Sonar"]), 1)
        truth = json.loads(self.nao("world", "show", "--json").stdout)["robots"][0]
        self.assertEqual(truth["light_rgb"][truth["light_names"].index("chest")], [1, 0.5, 0])

    def test_servos_hold_after_any_cut_and_the_next_client_is_served(self):
        position = self.client.state()["Position"]
        command = pack({"Position": position, "Stiffness": [1.0] * 25})
        for size in [*range(0, len(command), 23), len(command) - 1]:
            self.client.socket.sendall(command[:size])
            self.client.close()
            self.client = self.connect()
            state = self.client.state()
        self.assertEqual(state["Stiffness"], [1.0] * 25)
        for _ in range(50):
            state = self.client.answer()
        self.assertLess(math.dist(position, state["Position"]), 0.3)

    def test_a_malformed_command_ends_the_connection_and_nothing_else(self):
        for garbage in (b"\xc1", b"\x93\1\2\3", b"\x81\xa8Position\x91\xca\0\0\0\0", b"\x81\xdb\xff\xff\xff\xff", b"\x81" * 5000):
            self.client.state()
            try:
                self.client.socket.sendall(garbage)
                self.client.socket.shutdown(socket.SHUT_WR)
                with self.assertRaises((EOFError, ConnectionError)):
                    while True:
                        self.client.receive()
            except ConnectionError:
                pass
            self.client.close()
            self.client = self.connect()
        self.client.state()

    def test_a_number_that_is_not_finite_is_ignored(self):
        position = self.client.state()["Position"]
        position[HEAD_YAW], position[L_KNEE_PITCH] = 0.4, math.nan
        for _ in range(100):
            state = self.client.answer(Position=position, Stiffness=[math.inf] * 25)
        self.assertAlmostEqual(state["Position"][HEAD_YAW], 0.4, delta=0.03)
        self.assertLess(max(map(abs, state["Angles"])), UPRIGHT)

    def test_serves_one_client_at_a_time(self):
        self.client.state()
        second = self.connect()
        second.socket.settimeout(0.2)
        self.assertRaises(TimeoutError, second.receive)
        second.socket.settimeout(DEADLINE)
        self.client.close()
        self.assertEqual(len(second.receive()), FRAME_BYTES)

    def test_the_world_can_touch_it(self):
        self.client.state()
        self.assertNotEqual(self.nao("world", "touch", "tail").returncode, 0)
        self.assertEqual(self.nao("world", "touch", "chest-button", "--ticks", "3").returncode, 0)
        touched = [self.client.answer()["Touch"][0] for _ in range(6)]
        self.assertEqual(touched, [1, 1, 1, 0, 0, 0])

    def test_publishes_no_sensor_state(self):
        self.client.state()
        for _ in range(20):
            self.client.answer()
        listed = self.nao("spy", "--for", "1", "--json").stdout
        self.assertIn("WORLD_TRUTH", listed)
        self.assertNotIn("NAO_SENSOR_STATE", listed)


class LolaClientInRealTime(LolaClient):
    """Frames come by themselves; a client that is silent does not hold the world up."""

    options = ["--scene", "empty"]

    # Those count frames.
    test_two_maps_in_one_read_are_two_frames = None
    test_the_world_can_touch_it = None
    test_publishes_no_sensor_state = None

    def test_frames_come_without_commands_and_the_robot_stands(self):
        for _ in range(100):
            state = self.client.state()
        self.assertLess(max(map(abs, state["Angles"])), UPRIGHT)

    def test_a_client_that_does_not_read_is_left(self):
        deadline = time.monotonic() + DEADLINE
        self.client.state()
        second = self.connect()
        second.socket.settimeout(1)
        while time.monotonic() < deadline:
            try:
                second.receive()
                return
            except TimeoutError:
                continue
        self.fail("the second client was never served")


if __name__ == "__main__":
    unittest.main()
