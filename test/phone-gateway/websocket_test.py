#!/usr/bin/python3
"""The gateway's WebSocket and HTTP, seen from an independent client (python3-websockets) and from raw
sockets that break the rules of RFC 6455."""

import asyncio
import json
import os
import re
import socket
import ssl
import struct
import tempfile
import time
import unittest
import urllib.request
import warnings
from pathlib import Path

import websockets
from programs import DEADLINE, Gateway

from remote_protocol import remote_pb2 as pb

HANDSHAKE = ("GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n")

TEXT, BINARY, CLOSE, PING, PONG, CONTINUATION = 1, 2, 8, 9, 10, 0


def request(request_id, **use_case):
    return pb.Request(request_id=request_id, **use_case).SerializeToString()


HELLO = request(1, connect=pb.Connect(protocol_version=1, client_name="test"))
PING_REQUEST = request(2, ping=pb.Ping(client_utime=5))


class RawWebSocket:
    """A WebSocket client that sends whatever a test wants."""

    def __init__(self, port, handshake=HANDSHAKE):
        self.socket = socket.create_connection(("127.0.0.1", port), DEADLINE)
        self.socket.sendall(handshake.encode())
        self.bytes = b""
        while b"\r\n\r\n" not in self.bytes:
            received = self.socket.recv(4096)
            if not received:
                break
            self.bytes += received
        self.head, _, self.bytes = self.bytes.partition(b"\r\n\r\n")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def send_frame(self, opcode, payload, is_final=True, is_masked=True, reserved=0):
        first = (0x80 if is_final else 0) | reserved << 4 | opcode
        mask_bit = 0x80 if is_masked else 0
        if len(payload) < 126:
            head = struct.pack(">BB", first, mask_bit | len(payload))
        elif len(payload) < 65536:
            head = struct.pack(">BBH", first, mask_bit | 126, len(payload))
        else:
            head = struct.pack(">BBQ", first, mask_bit | 127, len(payload))
        if is_masked:
            key = os.urandom(4)
            payload = bytes(byte ^ key[i % 4] for i, byte in enumerate(payload))
            head += key
        self.socket.sendall(head + payload)

    def _take(self, size):
        while len(self.bytes) < size:
            received = self.socket.recv(65536)
            if not received:
                raise EOFError
            self.bytes += received
        taken, self.bytes = self.bytes[:size], self.bytes[size:]
        return taken

    def receive_frame(self):
        """@return (opcode, payload); raises EOFError at the end."""
        first, length = self._take(2)
        if length & 0x80:
            raise AssertionError("a server must not mask")
        if length == 126:
            length, = struct.unpack(">H", self._take(2))
        elif length == 127:
            length, = struct.unpack(">Q", self._take(8))
        return first & 0x0f, self._take(length)

    def next(self, opcode):
        """The payload of the next frame of a kind."""
        while True:
            received, payload = self.receive_frame()
            if received == opcode:
                return payload

    def response(self, request_id):
        while True:
            message = pb.ServerMessage.FromString(self.next(BINARY))
            if message.HasField("response") and message.response.request_id == request_id:
                return message.response

    def close_code(self):
        """The code that the gateway closes with; None if it closes without one."""
        try:
            payload = self.next(CLOSE)
        except (EOFError, ConnectionResetError):
            return None
        return struct.unpack(">H", payload[:2])[0] if payload else None


class WebSocket(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.gateway = Gateway()
        cls.addClassCleanup(cls.gateway.kill)
        cls.url = f"ws://127.0.0.1:{cls.gateway.http_port}/ws"

    def raw(self):
        connection = RawWebSocket(self.gateway.http_port)
        self.addCleanup(connection.socket.close)
        self.assertIn(b" 101 ", connection.head.split(b"\r\n")[0])
        return connection

    def greeted(self):
        connection = self.raw()
        connection.send_frame(BINARY, HELLO)
        self.assertEqual(connection.response(1).error, pb.OK)
        return connection

    def tearDown(self):
        # Whatever happened, good clients are served.
        connection = RawWebSocket(self.gateway.http_port)
        with connection:
            connection.send_frame(BINARY, HELLO)
            self.assertEqual(connection.response(1).error, pb.OK)

    # ---- An independent client ----

    def test_an_independent_client_connects_and_is_answered_in_order(self):
        async def talk():
            async with websockets.connect(self.url) as connection:
                await connection.send(HELLO)
                for i in range(2, 52):
                    await connection.send(request(i, ping=pb.Ping(client_utime=i)))
                ids = []
                while len(ids) < 51:
                    message = pb.ServerMessage.FromString(await asyncio.wait_for(connection.recv(), DEADLINE))
                    if message.HasField("response"):
                        ids.append(message.response.request_id)
                await (await connection.ping())
                return ids
        self.assertEqual(asyncio.run(talk()), list(range(1, 52)))

    def test_an_independent_client_closes_in_order(self):
        async def talk():
            connection = await websockets.connect(self.url)
            await connection.send(HELLO)
            await connection.close(1000, "enough")
            return connection.close_code
        self.assertEqual(asyncio.run(talk()), 1000)

    def test_sixteen_clients_at_once(self):
        async def one(i):
            async with websockets.connect(self.url) as connection:
                await connection.send(request(1, connect=pb.Connect(protocol_version=1, client_name=f"phone {i}")))
                message = pb.ServerMessage.FromString(await asyncio.wait_for(connection.recv(), DEADLINE))
                await asyncio.sleep(0.2)
                return message.response.connected.client_name

        async def all_of_them():
            return await asyncio.gather(*[one(i) for i in range(16)])
        self.assertEqual(len(set(asyncio.run(all_of_them()))), 16)

    def test_a_page_from_elsewhere_is_refused(self):
        async def talk(origin):
            async with websockets.connect(self.url, origin=origin):
                pass
        for origin in ("http://evil.example", "https://127.0.0.1", "null",
                       f"http://127.0.0.1:{self.gateway.http_port + 1}"):
            with self.assertRaises(websockets.InvalidStatusCode) as refused:
                asyncio.run(talk(origin))
            self.assertEqual(refused.exception.status_code, 403, origin)
        asyncio.run(talk(f"http://127.0.0.1:{self.gateway.http_port}"))

    # ---- Frames ----

    def test_a_message_in_fragments_is_one_message(self):
        connection = self.greeted()
        pieces = [PING_REQUEST[i:i + 1] for i in range(len(PING_REQUEST))]
        connection.send_frame(BINARY, pieces[0], is_final=False)
        for piece in pieces[1:-1]:
            connection.send_frame(CONTINUATION, piece, is_final=False)
            connection.send_frame(PING, b"between")
        connection.send_frame(CONTINUATION, pieces[-1])
        self.assertEqual(connection.next(PONG), b"between")
        self.assertEqual(connection.response(2).pong.client_utime, 5)

    def test_a_ping_is_answered_with_its_payload(self):
        connection = self.greeted()
        for payload in (b"", b"x" * 125):
            connection.send_frame(PING, payload)
            self.assertEqual(connection.next(PONG), payload)
        connection.send_frame(PONG, b"nobody asked")
        connection.send_frame(BINARY, PING_REQUEST)
        self.assertEqual(connection.response(2).error, pb.OK)

    def test_the_longest_message_is_taken_and_one_byte_more_is_not(self):
        connection = self.greeted()
        connection.send_frame(BINARY, b"\xff" * 65536)
        self.assertEqual(connection.response(0).error, pb.INVALID_REQUEST)
        connection.send_frame(BINARY, b"\xff" * 65537)
        self.assertEqual(connection.close_code(), 1009)

    def test_a_message_that_grows_too_long_in_fragments_is_refused(self):
        connection = self.greeted()
        connection.send_frame(BINARY, b"\xff" * 40000, is_final=False)
        connection.send_frame(CONTINUATION, b"\xff" * 40000)
        self.assertEqual(connection.close_code(), 1009)

    def test_a_length_of_exabytes_is_refused_before_it_comes(self):
        connection = self.greeted()
        connection.socket.sendall(struct.pack(">BBQ", 0x82, 0xff, 1 << 62) + b"\0\0\0\0")
        self.assertIn(connection.close_code(), (1002, 1009))

    def test_text_is_no_message(self):
        connection = self.greeted()
        connection.send_frame(TEXT, b"hello")
        self.assertEqual(connection.close_code(), 1003)

    def test_text_that_is_not_utf8_is_refused(self):
        connection = self.greeted()
        connection.send_frame(TEXT, b"\xc3\x28")
        self.assertIn(connection.close_code(), (1003, 1007))

    def test_violations_are_closed_with_a_protocol_error(self):
        def unmasked(connection):
            connection.send_frame(BINARY, PING_REQUEST, is_masked=False)

        def reserved_bit(connection):
            connection.send_frame(BINARY, PING_REQUEST, reserved=4)

        def reserved_opcode(connection):
            connection.send_frame(3, b"")

        def reserved_control_opcode(connection):
            connection.send_frame(11, b"")

        def long_ping(connection):
            connection.send_frame(PING, b"x" * 126)

        def fragmented_ping(connection):
            connection.send_frame(PING, b"x", is_final=False)

        def continuation_of_nothing(connection):
            connection.send_frame(CONTINUATION, b"x")

        def message_within_a_message(connection):
            connection.send_frame(BINARY, b"x", is_final=False)
            connection.send_frame(BINARY, b"x")

        def close_of_one_byte(connection):
            connection.send_frame(CLOSE, b"x")

        def close_with_a_code_that_is_none(connection):
            connection.send_frame(CLOSE, struct.pack(">H", 999))

        def close_with_a_reason_that_is_not_utf8(connection):
            connection.send_frame(CLOSE, struct.pack(">H", 1000) + b"\xc3\x28")

        for violate in (unmasked, reserved_bit, reserved_opcode, reserved_control_opcode, long_ping, fragmented_ping,
                        continuation_of_nothing, message_within_a_message, close_of_one_byte,
                        close_with_a_code_that_is_none, close_with_a_reason_that_is_not_utf8):
            with self.subTest(violate.__name__):
                connection = self.greeted()
                violate(connection)
                self.assertIn(connection.close_code(), (1002, 1007))

    def test_a_close_is_answered_with_its_code(self):
        for code in (1000, 1001, 3000, 4999):
            connection = self.greeted()
            connection.send_frame(CLOSE, struct.pack(">H", code) + b"bye")
            self.assertEqual(connection.close_code(), code)

    # ---- Handshakes ----

    def test_bad_handshakes_are_refused(self):
        good = HANDSHAKE
        for bad in (good.replace("Version: 13", "Version: 12"), good.replace("Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n", ""),
                    good.replace("Upgrade: websocket\r\n", ""), good.replace("Connection: Upgrade\r\n", ""),
                    good.replace("GET", "POST"), good.replace("Host: localhost", "Host: evil.example"),
                    good.replace("Host: localhost\r\n", "")):
            with self.subTest(bad), RawWebSocket(self.gateway.http_port, bad) as connection:
                self.assertIn(connection.head.split(b" ")[1][:1], b"4", connection.head)

    def test_a_slow_handshake_is_not_waited_for(self):
        with socket.create_connection(("127.0.0.1", self.gateway.http_port)) as connection:
            connection.settimeout(DEADLINE)
            start = time.monotonic()
            try:
                for byte in HANDSHAKE.encode() * 10:
                    connection.sendall(bytes([byte]))
                    time.sleep(0.2)
            except OSError:
                pass
            self.assertLess(time.monotonic() - start, 30)

    def test_a_client_that_never_says_connect_is_told_and_closed(self):
        connection = self.raw()
        notice = pb.ServerMessage.FromString(connection.next(BINARY)).notice
        self.assertEqual(notice.kind, pb.Notice.CLOSING)
        self.assertEqual(connection.close_code(), 1008)

    # ---- Pages ----

    def test_metrics_are_served_to_the_own_host(self):
        url = f"http://127.0.0.1:{self.gateway.http_port}/metrics"
        connection = self.greeted()
        connection.send_frame(BINARY, PING_REQUEST)
        connection.response(2)
        with urllib.request.urlopen(url, timeout=DEADLINE) as response:
            lines = response.read().decode().splitlines()
        # As Prometheus wants them: each figure once, its samples together, after its TYPE.
        figures = [line.split()[2] for line in lines if line.startswith("# TYPE ")]
        self.assertEqual(len(figures), len(set(figures)))
        samples = {}
        figure = None
        for line in lines:
            if line.startswith("# TYPE "):
                figure = line.split()[2]
            elif not line.startswith("#"):
                match = re.fullmatch(r'([a-z_]+)(\{[a-z]+="[^"]*"(?:,[a-z]+="[^"]*")*\})? ([0-9.e+-]+)', line)
                self.assertTrue(match, line)
                self.assertEqual(match.group(1), figure)
                samples.setdefault(figure, []).append(float(match.group(3)))
        self.assertEqual(samples["nao_gateway_clients"], [len(samples["nao_gateway_client_requests_total"])])
        self.assertIn(2, samples["nao_gateway_client_requests_total"])
        self.assertGreater(samples["nao_gateway_accepted_total"][0], 1)

    def test_the_robots_files_are_served(self):
        url = f"http://127.0.0.1:{self.gateway.http_port}/robots/nao/nao.urdf"
        with urllib.request.urlopen(url, timeout=DEADLINE) as response:
            self.assertEqual(response.headers["Content-Type"], "application/xml")
            self.assertIn(b"<robot", response.read())


class Secure(unittest.TestCase):
    """https and http on one port, with a certificate that the gateway made itself."""

    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.gateway = Gateway("--tls", "--tls-dir", cls.folder)
        cls.addClassCleanup(cls.gateway.kill)
        # Trusts this certificate only, and checks that it is for this address.
        cls.context = ssl.create_default_context(cafile=f"{cls.folder}/gateway-certificate.pem")

    def test_pages_come_over_https_and_http(self):
        for scheme, context in (("https", self.context), ("http", None)):
            url = f"{scheme}://127.0.0.1:{self.gateway.http_port}/robots/nao/nao.urdf"
            with urllib.request.urlopen(url, timeout=DEADLINE, context=context) as response:
                self.assertIn(b"<robot", response.read())

    def test_the_protocol_is_spoken_over_a_secure_websocket(self):
        async def talk():
            address = f"127.0.0.1:{self.gateway.http_port}"
            async with websockets.connect(f"wss://{address}/ws", ssl=self.context, origin=f"https://{address}") as connection:
                await connection.send(HELLO)
                return pb.ServerMessage.FromString(await asyncio.wait_for(connection.recv(), DEADLINE))
        self.assertEqual(asyncio.run(talk()).response.error, pb.OK)

    def test_old_versions_of_tls_are_refused(self):
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
        context.set_ciphers("ALL:@SECLEVEL=0")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            context.minimum_version = ssl.TLSVersion.TLSv1
            context.maximum_version = ssl.TLSVersion.TLSv1_1
        with socket.create_connection(("127.0.0.1", self.gateway.http_port)) as plain:
            with self.assertRaises(ssl.SSLError):
                context.wrap_socket(plain)

    def test_the_certificate_is_kept(self):
        before = (Path(self.folder) / "gateway-certificate.pem").read_bytes()
        again = Gateway("--tls", "--tls-dir", self.folder)
        again.kill()
        self.assertEqual((Path(self.folder) / "gateway-certificate.pem").read_bytes(), before)


class Pairing(unittest.TestCase):
    def test_the_address_is_shown_as_a_code(self):
        with tempfile.TemporaryDirectory() as folder:
            gateway = Gateway("--qr-png", f"{folder}/code.png")
            self.addCleanup(gateway.kill)
            with urllib.request.urlopen(f"http://127.0.0.1:{gateway.http_port}/qr.png", timeout=DEADLINE) as response:
                self.assertEqual(response.headers["Content-Type"], "image/png")
                served = response.read()
            self.assertEqual(served[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual((Path(folder) / "code.png").read_bytes(), served)

    def test_the_audit_log_is_kept_in_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            gateway = Gateway("--audit-log", f"{folder}/audit.jsonl")
            self.addCleanup(gateway.kill)
            with RawWebSocket(gateway.http_port) as connection:
                connection.send_frame(BINARY, request(1, connect=pb.Connect(protocol_version=1, token="wrong")))
                self.assertEqual(connection.response(1).error, pb.WRONG_TOKEN)
            line = json.loads((Path(folder) / "audit.jsonl").read_text())
            self.assertEqual((line["event"], line["address"]), ("refused", "127.0.0.1"))
            self.assertNotIn("test-token", str(line))


class Ending(unittest.TestCase):
    def test_a_terminated_gateway_says_goodbye_within_two_seconds(self):
        gateway = Gateway()
        self.addCleanup(gateway.kill)
        with RawWebSocket(gateway.http_port) as connection:
            connection.send_frame(BINARY, HELLO)
            connection.response(1)
            gateway.process.terminate()
            while True:
                message = pb.ServerMessage.FromString(connection.next(BINARY))
                if message.HasField("notice") and message.notice.kind == pb.Notice.CLOSING:
                    break
        self.assertEqual(gateway.end(), 0)

    def test_a_port_in_use_is_named(self):
        gateway = Gateway()
        self.addCleanup(gateway.kill)
        with self.assertRaises(AssertionError) as failed:
            Gateway(http_port=gateway.http_port)
        self.assertIn(str(gateway.http_port), str(failed.exception))
        self.assertIn("in use", str(failed.exception))


if __name__ == "__main__":
    unittest.main()
