#!/usr/bin/python3
"""Attacks on the gateway: each is refused and written to the audit log once, however often it is repeated, and a well-
behaved client is not affected."""

import json
import socket
import ssl
import struct
import tempfile
import threading
import time
import unittest
from pathlib import Path

from programs import DEADLINE, Gateway, wait_until

import phone
from nao_remote import remote_pb2 as pb

NUM_TRIES = 20
NUM_HALF_OPEN = 1000
WEBSOCKET = ("Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
             "Sec-WebSocket-Version: 13\r\n")


class GoodClient:
    """Pings ten times a second from a thread of its own, and requires every answer."""

    def __init__(self, gateway):
        self._phone = phone.Phone(port=gateway.tcp_port, timeout=DEADLINE, name="good")
        self._is_ending = threading.Event()
        self.error = None
        self.num_answers = 0
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _run(self):
        try:
            while not self._is_ending.wait(0.1):
                self._phone.ask(ping=pb.Ping())
                self.num_answers += 1
        except (phone.ConnectionLost, phone.Refused) as error:
            self.error = error

    def end(self):
        self._is_ending.set()
        self._thread.join()
        self._phone.__exit__()


def frame(**use_case):
    message = pb.Request(**use_case).SerializeToString()
    return struct.pack(">I", len(message)) + message


class Security(unittest.TestCase):
    gateway_options = ()

    def setUp(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        self.audit_file = Path(folder) / "audit.jsonl"
        self.gateway = Gateway("--audit-log", self.audit_file, "--tls-dir", folder, *self.gateway_options)
        self.addCleanup(self.gateway.kill)
        self.good = GoodClient(self.gateway)
        self.addCleanup(self.good.end)

    def assert_good_client_is_served(self):
        before = self.good.num_answers
        wait_until(lambda: self.good.error or self.good.num_answers > before + 2, "the good client is served")
        self.assertIsNone(self.good.error)

    def refusals(self, detail):
        """The lines of the audit log about one kind of refusal."""
        return [line for line in map(json.loads, self.audit_file.read_text().splitlines())
                if line["event"] == "refused" and detail in line["detail"]]

    def assert_refused_and_audited_once(self, detail):
        found = wait_until(lambda: self.refusals(detail), f"{detail} in the audit log")
        self.assertEqual(len(found), 1, found)
        self.assertEqual(found[0]["address"], "127.0.0.1")
        self.assert_good_client_is_served()

    def http(self, head):
        """@return the status that the gateway answers a request with."""
        with socket.create_connection(("127.0.0.1", self.gateway.http_port), DEADLINE) as connection:
            connection.sendall(head.encode() + b"\r\n")
            return int(connection.recv(4096).split()[1])

    def test_wrong_tokens(self):
        # Five are compared, then the address is refused for 10 s.
        for i in range(NUM_TRIES):
            with self.assertRaises(phone.Refused) as refused:
                phone.Phone(port=self.gateway.tcp_port, token=f"guess {i}", timeout=DEADLINE)
            self.assertEqual(refused.exception.code, pb.WRONG_TOKEN)
        self.assertIn("wait", str(refused.exception))
        self.assert_refused_and_audited_once("token-wrong")
        self.assertNotIn("guess", self.audit_file.read_text())
        # In that time the right token is refused, too: otherwise guessing could go on.
        with self.assertRaises(phone.Refused):
            phone.Phone(port=self.gateway.tcp_port, token="test-token", timeout=DEADLINE)

    def test_different_versions_do_not_fill_the_log(self):
        for version in range(2, 2 + NUM_TRIES):
            with socket.create_connection(("127.0.0.1", self.gateway.tcp_port), DEADLINE) as connection:
                connection.sendall(frame(connect=pb.Connect(protocol_version=version)))
                self.assertTrue(connection.recv(4096))
        self.assert_refused_and_audited_once("protocol-version-unsupported")

    def test_pages_of_other_sites(self):
        host = f"localhost:{self.gateway.http_port}"
        for origin in ("http://evil.example", f"https://{host}", "null", f"http://{host}.evil.example",
                       f"http://evil.example/{host}", "http://localhost", f"http://localhost:{self.gateway.tcp_port}"):
            head = f"GET /ws HTTP/1.1\r\nHost: {host}\r\nOrigin: {origin}\r\n{WEBSOCKET}"
            self.assertEqual(self.http(head), 403, origin)
        self.assertEqual(self.http(f"GET /ws HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n{WEBSOCKET}"), 101)
        self.assert_refused_and_audited_once("Origin")

    def test_dns_rebinding(self):
        for host in ("evil.example", "evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example", "",
                     "[evil.example]", "localhost:8080@evil.example"):
            for target in ("/", "/ws", "/metrics"):
                # With the matching Origin, as a browser sends it.
                head = f"GET {target} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n{WEBSOCKET}"
                self.assertEqual(self.http(head), 421, host)
        self.assert_refused_and_audited_once("Host")
        for twice in ("Host: evil.example", "Origin: http://localhost\r\nOrigin: http://evil.example"):
            self.assertEqual(self.http(f"GET /ws HTTP/1.1\r\nHost: localhost\r\n{twice}\r\n{WEBSOCKET}"), 400, twice)

    def test_paths_outside_the_served_folders(self):
        for target in ("/../etc/passwd", "/robots/../../../etc/passwd", "/%2e%2e/etc/passwd", "/robots/%2e%2e%2f%2e%2e/x",
                       "/..%5c..%5cx", "/.git/config", "/robots/nao/\\..\\x", "//../etc/passwd", "etc/passwd",
                       "//etc/passwd", "///etc/passwd", "/%2fetc/passwd", "/robots//etc/passwd",
                       "/robots/%00/x", "/%", "/%zz"):
            self.assertEqual(self.http(f"GET {target} HTTP/1.1\r\nHost: localhost\r\n"), 400, target)
        for target in ("/etc/passwd", "/robots/etc/passwd", "/robots/nao"):
            self.assertEqual(self.http(f"GET {target} HTTP/1.1\r\nHost: localhost\r\n"), 404, target)
        self.assert_refused_and_audited_once("not a path")

    def test_a_lease_that_is_replayed(self):
        def record(connection):
            for request in (frame(request_id=1, connect=pb.Connect(protocol_version=1, client_name="Ana")),
                            frame(request_id=2, take_control=pb.TakeControl())):
                connection.sendall(request)
            return self.response(connection, 2)

        with socket.create_connection(("127.0.0.1", self.gateway.tcp_port), DEADLINE) as ana:
            self.assertTrue(record(ana).control.is_mine)
            # Control belongs to the connection: a client that repeats all of Ana's messages does not get it.
            with socket.create_connection(("127.0.0.1", self.gateway.tcp_port), DEADLINE) as thief:
                answer = record(thief)
                self.assertEqual(answer.error, pb.CONTROL_TAKEN)
                self.assertEqual(answer.control.driver_name, "Ana")
                thief.sendall(frame(request_id=3, walk_turn=pb.WalkTurn(vx=0.1)))
                self.assertEqual(self.response(thief, 3).error, pb.CONTROL_TAKEN)
        # After Ana has disconnected, a new connection has no control until it asks for it.
        with socket.create_connection(("127.0.0.1", self.gateway.tcp_port), DEADLINE) as late:
            late.sendall(frame(request_id=1, connect=pb.Connect(protocol_version=1, client_name="Ana")))
            late.sendall(frame(request_id=2, walk_turn=pb.WalkTurn(vx=0.1)))
            self.assertEqual(self.response(late, 2).error, pb.NO_CONTROL)
        self.assert_good_client_is_served()

    @staticmethod
    def response(connection, request_id):
        while True:
            length, = struct.unpack(">I", connection.recv(4, socket.MSG_WAITALL))
            message = pb.ServerMessage.FromString(connection.recv(length, socket.MSG_WAITALL))
            if message.HasField("response") and message.response.request_id == request_id:
                return message.response

    def test_a_thousand_half_open_connections(self):
        half_open = []
        for i in range(NUM_HALF_OPEN):
            port = self.gateway.tcp_port if i % 2 else self.gateway.http_port
            half_open.append(self.enterContext(socket.create_connection(("127.0.0.1", port), DEADLINE)))
            if i % 2:
                half_open[-1].sendall(b"\0\0\0\x20half")
            if i % 100 == 50:
                # New clients can connect all the time.
                with phone.Phone(port=self.gateway.tcp_port, timeout=DEADLINE) as client:
                    client.ask(ping=pb.Ping())
        num_descriptors = len(list(Path(f"/proc/{self.gateway.process.pid}/fd").iterdir()))
        self.assertLess(num_descriptors, 200)
        self.assert_refused_and_audited_once("Too many connections")
        # The last ones are closed after their 5 s.
        wait_until(lambda: len(list(Path(f"/proc/{self.gateway.process.pid}/fd").iterdir())) < 30, "the half-open connections are closed")
        self.assertEqual(len(self.refusals("connect-timeout")), 1)
        self.assertEqual(len(self.refusals("No request")), 1)
        self.assert_good_client_is_served()

    def trickle(self, port, octets, wrap=lambda connection: connection):
        """Sends bytes one by one. @return time until the gateway closed the connection, s."""
        start = time.monotonic()
        with wrap(socket.create_connection(("127.0.0.1", port), DEADLINE)) as connection:
            connection.settimeout(DEADLINE)
            try:
                for octet in octets:
                    connection.sendall(bytes([octet]))
                    time.sleep(0.1)
            except OSError:
                return time.monotonic() - start
        self.fail("the gateway has not closed the connection")

    def test_slow_handshakes(self):
        head = b"GET /ws HTTP/1.1\r\nHost: localhost\r\nX-Slow: " + 600 * b"y"
        hello = frame(connect=pb.Connect(protocol_version=1, client_software=120 * "slow "))
        for port, octets in ((self.gateway.http_port, head), (self.gateway.tcp_port, hello)):
            self.assertLess(self.trickle(port, octets), 30)
        self.assert_refused_and_audited_once("No request within 5 s")
        self.assert_refused_and_audited_once("connect-timeout")

    def test_requests_without_end(self):
        for _ in range(NUM_TRIES):
            self.assertEqual(self.http("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + 10000 * "x" + "\r\n"), 431)
        self.assert_refused_and_audited_once("HTTP")


class SecureSecurity(Security):
    """The same with https on the same port, where the first bytes decide, and a TLS handshake that does not end."""

    gateway_options = ("--tls",)

    def test_slow_handshakes(self):
        super().test_slow_handshakes()
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
        incoming, outgoing = ssl.MemoryBIO(), ssl.MemoryBIO()
        with self.assertRaises(ssl.SSLWantReadError):
            context.wrap_bio(incoming, outgoing).do_handshake()
        client_hello = outgoing.read()
        self.assertLess(self.trickle(self.gateway.http_port, client_hello), 30)
        self.assert_good_client_is_served()


if __name__ == "__main__":
    unittest.main()
