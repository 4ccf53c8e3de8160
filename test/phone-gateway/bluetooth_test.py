#!/usr/bin/python3
"""A phone drives by Bluetooth: the gateway with a D-Bus and a bluetoothd of the test's own."""

import shutil
import tempfile
import time
import unittest
from pathlib import Path

from bluetooth_link import Bluez, BluetoothLink, Bus
from programs import Gateway, Robot, wait_until
from walking import WalkingTest

import phone
from nao_remote import remote_pb2 as pb

SERVICE, MESSAGES = "b1e6a0f2-4a53-4c0e-9d38-2f6c7e5d1a90", "b1e6a0f3-4a53-4c0e-9d38-2f6c7e5d1a90"
MEASURED_TIME = 10  # s


class BluetoothRobot(Robot):
    def start_gateway(self):
        self.programs["nao-phone-gateway"] = Gateway("--bluetooth", lcm_url=self.lcm_url)


def make_bus(test):
    folder = Path(tempfile.mkdtemp(prefix="nao-test-"))
    test.addClassCleanup(shutil.rmtree, folder, ignore_errors=True)
    bus = Bus(folder)
    test.addClassCleanup(bus.end)
    return bus


class Bluetooth(WalkingTest):
    @classmethod
    def setUpClass(cls):
        make_bus(cls)
        cls.bluez = Bluez()
        cls.addClassCleanup(cls.bluez.end)
        super().setUpClass()
        cls.advertised = cls.bluez.wait_for("advertised")

    @classmethod
    def make_robot(cls):
        return BluetoothRobot(scene="empty")

    def link(self, **options):
        link = BluetoothLink(self.bluez, **options)
        link.__enter__()
        self.addCleanup(link.__exit__)
        return link

    def test_offers_its_service(self):
        self.assertEqual(self.advertised["services"], [SERVICE])
        self.assertEqual(self.advertised["characteristics"], [MESSAGES])
        self.assertEqual(self.advertised["name"], "NAO")

    def test_needs_the_pairing_token(self):
        with self.assertRaises(phone.Refused) as refused:
            phone.Phone(port=self.link().port, token="wrong")
        self.assertEqual(refused.exception.code, pb.WRONG_TOKEN)

    def test_a_walk_ends_after_silence(self):
        client = phone.Phone(port=self.link().port, token="test-token")
        client.ask(take_control=pb.TakeControl())
        self.walk(client, 2)
        self.assert_stands_soon()

    def test_a_walk_ends_out_of_reach(self):
        link = self.link()
        client = phone.Phone(port=link.port, token="test-token")
        client.ask(take_control=pb.TakeControl())
        self.walk(client, 2)
        link.bluez.act("leave", phone="AA")
        self.assert_stands_soon()
        self.assertEqual(link.write(b"\x00x").get("error"), "This phone has no connection.")

    def test_20_states_and_an_image_a_second_at_100_kbit_a_second(self):
        link = self.link()
        client = phone.Phone(port=link.port, token="test-token")
        states, images, ages = [], [], []
        handle = client._handle

        def count(received):
            if received:
                message = pb.ServerMessage.FromString(received)
                states.extend([len(received)] * message.HasField("state"))
                images.extend([len(received)] * message.HasField("image"))
                if message.HasField("state"):
                    ages.append(time.monotonic() - message.state.sent_at)
            handle(received)

        client._handle = count
        client.ask(subscribe=pb.Subscribe(state_rate=25, image_rate=1, image=pb.ImageRequest(width=160, quality=30)))
        client.wait_until(lambda: len(images) > 1, 10)
        states.clear(), images.clear(), ages.clear()
        link.num_bytes = 0
        client.wait_until(lambda: False, MEASURED_TIME)
        rate = len(states) / MEASURED_TIME
        delay = sorted(age - min(ages) for age in ages)[int(0.95 * len(ages))]
        print(f"{rate:.1f} states a second of {sum(states) / len(states):.0f} bytes, {len(images) / MEASURED_TIME:.1f} images of "
              f"{sum(images) / max(1, len(images)):.0f}; {8e-3 * link.num_bytes / MEASURED_TIME:.0f} kbit/s; "
              f"later than the fastest state, p95: {delay * 1e3:.0f} ms")
        self.assertGreater(len(images), 0.7 * MEASURED_TIME)
        self.assertGreater(rate, 15)

    def test_one_phone_at_a_time_and_what_it_must_not_do(self):
        link = self.link()
        phone.Phone(port=link.port, token="test-token")
        other = self.bluez.act("read", phone="BB", mtu=185)
        self.assertEqual(other["error"], "Another phone is connected by Bluetooth.")
        self.assertIn("error", self.bluez.act("write", phone="BB", value="8041"))
        # The same phone anew, with the shortest values.
        self.assertEqual(self.bluez.act("read", phone="AA", mtu=23)["value"], "1400")
        self.assertEqual(link.write(b"\x85x").get("value"), "", "taken, and the connection ends")
        self.assertIn("error", link.write(b"\x81x"))
        self.assertEqual(self.bluez.act("read", phone="BB", mtu=517)["value"], "0002")
        self.bluez.act("stop")


class WithoutBluetooth(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bus = make_bus(cls)

    def test_the_gateway_says_why_and_goes_on(self):
        gateway = Gateway("--bluetooth", "--no-announce")
        self.addCleanup(gateway.end)
        gateway.wait_for_log("no Bluetooth: bluetoothd does not run")
        bluez = Bluez("--no-adapter")
        gateway.wait_for_log("no Bluetooth: this host has no Bluetooth adapter; everything else works on")
        bluez.end()
        bluez = Bluez()
        self.addCleanup(bluez.end)
        bluez.wait_for("advertised")
        gateway.wait_for_log("phones find this robot by Bluetooth")
        with phone.Phone(port=gateway.tcp_port, token="test-token") as client:
            wait_until(lambda: client.ask(ping=pb.Ping()), "TCP works on")


if __name__ == "__main__":
    unittest.main()
