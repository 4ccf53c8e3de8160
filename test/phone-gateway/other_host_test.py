#!/usr/bin/python3
"""Clients on another host: what only the gateway's own host may do, and a cable that is cut during a walk."""

import socket
import sys
import unittest
import urllib.error
import urllib.request

from programs import DEADLINE, ROOT, wait_until
from walking import WalkingTest

sys.path.insert(0, str(ROOT / "test/support"))

import phone
from other_host import OtherHost, enter_private_network
from nao_remote import remote_pb2 as pb

TOKEN = "test-token"
CLIENTS_PER_ADDRESS = 32


class OtherHostTest(WalkingTest):
    bind = "0.0.0.0"

    @classmethod
    def setUpClass(cls):
        cls.other = cls.enterClassContext(OtherHost())
        super().setUpClass()

    def remote_client(self, token=TOKEN, name="remote"):
        with self.other.inside():
            client = phone.Phone(host=self.other.gateway_address, port=self.robot.gateway.tcp_port, timeout=DEADLINE,
                                 token=token, name=name)
        self.addCleanup(client.__exit__)
        return client

    def fetch(self, path):
        """@return the HTTP status of a page, requested by the other host."""
        url = f"http://{self.other.gateway_address}:{self.robot.gateway.http_port}{path}"
        with self.other.inside():
            try:
                return urllib.request.urlopen(url, timeout=DEADLINE).status
            except urllib.error.HTTPError as error:
                return error.code

    def test_the_token_is_required(self):
        for token in ("", "wrong"):
            with self.assertRaises(phone.Refused) as refused:
                self.remote_client(token)
            self.assertEqual(refused.exception.code, pb.WRONG_TOKEN)
        self.assertEqual(self.remote_client().connected.client_name, "remote")

    def test_the_operators_pages_and_commands_are_for_the_own_host(self):
        self.assertEqual(self.fetch("/metrics"), 403)
        self.assertEqual(self.fetch("/qr.png"), 403)
        self.assertEqual(self.fetch("/robots/nao/nao.urdf"), 200)
        with self.assertRaises(phone.Refused) as refused:
            self.remote_client().ask(operate=pb.Operate(operation=pb.Operate.TAKE))
        self.assertEqual(refused.exception.code, pb.NOT_ALLOWED)

    def test_one_address_does_not_use_up_all_clients(self):
        for _ in range(CLIENTS_PER_ADDRESS):
            self.remote_client()
        with self.assertRaises(phone.Refused) as refused:
            self.remote_client()
        self.assertEqual(refused.exception.code, pb.TOO_MANY_CLIENTS)
        with phone.Phone(port=self.robot.gateway.tcp_port, timeout=DEADLINE) as near:
            near.ask(ping=pb.Ping())

    def test_a_cut_cable_ends_the_walk_and_frees_control(self):
        client = self.remote_client(name="driver")
        client.ask(take_control=pb.TakeControl())
        self.walk(client, 2)
        self.other.cut_cable()
        self.addCleanup(self.other.mend_cable)
        self.assert_stands_soon()
        # The half-open connection times out, and its control is released.
        with phone.Phone(port=self.robot.gateway.tcp_port, timeout=DEADLINE) as near:
            near.wait_until(lambda: any(not notice.control.driver_id for notice in near.notices
                                        if notice.kind == pb.Notice.CONTROL_CHANGED), 10)
            self.assertTrue(near.ask(take_control=pb.TakeControl()).control.is_mine)
        self.other.mend_cable()

        def is_connected_again():
            try:
                return self.remote_client(name="driver").ask(take_control=pb.TakeControl()).control.is_mine
            except (phone.ConnectionLost, socket.timeout):
                return False
        wait_until(is_connected_again, "the client is connected again")


if __name__ == "__main__":
    if not enter_private_network():
        print("SKIPPED: this machine does not allow network namespaces")
        sys.exit(77)
    unittest.main()
