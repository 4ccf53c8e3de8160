#!/usr/bin/python3
"""The operator's console: nao driver list, take, release and kick."""

import json
import subprocess
import unittest

from programs import BIN_DIR, DEADLINE, Gateway

import phone
from nao_remote import remote_pb2 as pb


class Operator(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.gateway = Gateway()
        cls.addClassCleanup(cls.gateway.kill)

    def driver(self, *arguments):
        return subprocess.run([str(BIN_DIR / "nao"), "driver", "--port", str(self.gateway.tcp_port), *arguments],
                              capture_output=True, text=True, timeout=DEADLINE, check=False)

    def phone(self, name):
        client = phone.Phone(port=self.gateway.tcp_port, name=name, timeout=DEADLINE)
        self.addCleanup(client.__exit__)
        return client

    def test_lists_clients_and_the_driver(self):
        ana = self.phone("Ana")
        self.phone("Ben")
        ana.ask(take_control=pb.TakeControl())
        clients = {client["name"]: client for client in json.loads(self.driver("list", "--json").stdout)}
        self.assertTrue(clients["Ana"]["is_driver"])
        self.assertFalse(clients["Ben"]["is_driver"])
        self.assertEqual(clients["Ana"]["transport"], "tcp")
        self.assertIn("Ana", self.driver("list").stdout)
        ana.ask(release_control=pb.ReleaseControl())

    def test_takes_and_releases_control(self):
        ana = self.phone("Ana")
        ana.ask(take_control=pb.TakeControl())
        self.assertEqual(self.driver("take").returncode, 0)
        with self.assertRaises(phone.Refused) as refused:
            ana.ask(take_control=pb.TakeControl())
        self.assertEqual(refused.exception.response.control.driver_name, "the operator")
        self.assertEqual(self.driver("release").returncode, 0)
        self.assertTrue(ana.ask(take_control=pb.TakeControl()).control.is_mine)

    def test_closes_the_connection_of_a_client(self):
        ana = self.phone("Ana")
        self.assertEqual(self.driver("kick", str(ana.connected.client_id)).returncode, 0)
        with self.assertRaises(phone.ConnectionLost):
            ana.wait_until(lambda: False, DEADLINE)
        self.assertEqual(ana.notices[-1].kind, pb.Notice.CLOSING)
        refused = self.driver("kick", "4711")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("refused", refused.stderr)

    def test_lets_a_client_watch_only(self):
        ana = self.phone("Ana")
        number = str(ana.connected.client_id)
        self.assertEqual(self.driver("mute", number).returncode, 0)
        with self.assertRaises(phone.Refused) as refused:
            ana.ask(take_control=pb.TakeControl())
        self.assertEqual(refused.exception.response.reason_code, "muted-by-operator")
        clients = {client["name"]: client for client in json.loads(self.driver("list", "--json").stdout)}
        self.assertTrue(clients["Ana"]["is_muted"])
        self.assertEqual(self.driver("unmute", number).returncode, 0)
        self.assertTrue(ana.ask(take_control=pb.TakeControl()).control.is_mine)

    def test_gives_control_to_a_client(self):
        ana, ben = self.phone("Ana"), self.phone("Ben")
        ana.ask(take_control=pb.TakeControl())
        self.assertEqual(self.driver("assign", str(ben.connected.client_id), "NAO").returncode, 0)
        with self.assertRaises(phone.Refused) as refused:
            ana.ask(take_control=pb.TakeControl())
        self.assertEqual(refused.exception.response.control.driver_name, "Ben")
        unknown = self.driver("assign", str(ben.connected.client_id), "NAO9")
        self.assertEqual(unknown.returncode, 1)
        self.assertIn("NAO9", unknown.stderr)

    def test_reports_a_missing_gateway(self):
        result = subprocess.run([str(BIN_DIR / "nao"), "driver", "--port", "1", "list"], capture_output=True,
                                text=True, timeout=DEADLINE, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn("nao-phone-gateway", result.stderr)


if __name__ == "__main__":
    unittest.main()
