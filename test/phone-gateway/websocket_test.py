#!/usr/bin/python3
"""The gateway's WebSocket and HTTP, tested with an independent client (python3-websockets) and with frames that violate
RFC 6455."""

import asyncio
import json
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
from websockets import frames
from websockets.streams import StreamReader

from nao_remote import remote_pb2 as pb

HANDSHAKE = ("GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n")

TEXT, BINARY, CLOSE, PING, PONG, CONTINUATION = 1, 2, 8, 9, 10, 0


def request(request_id, **use_case):
    return pb.Request(request_id=request_id, **use_case).SerializeToString()


HELLO = request(1, connect=pb.Connect(protocol_version=1, client_name="test"))
PING_REQUEST = request(2, ping=pb.Ping(client_utime=5))


class UncheckedFrame(frames.Frame):
    """A frame that may violate RFC 6455."""

    def check(self):
        pass


class RawWebSocket:
    """A WebSocket client that sends any frame, valid or not."""

    def __init__(self, port, handshake=HANDSHAKE):
        self.socket = socket.create_connection(("127.0.0.1", port), DEADLINE)
        self.socket.sendall(handshake.encode())
        received = b""
        while b"\r\n\r\n" not in received and (part := self.socket.recv(4096)):
            received += part
        self.head, _, rest = received.partition(b"\r\n\r\n")
        self.reader = StreamReader()
        self.reader.feed_data(rest)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def send_frame(self, opcode, payload, is_final=True, is_masked=True, has_reserved_bit=False):
        frame = UncheckedFrame(opcode, payload, fin=is_final, rsv1=has_reserved_bit)
        self.socket.sendall(frame.serialize(mask=is_masked))

    def receive_frame(self):
        """@return the next frame. @raise EOFError at the end of the connection."""
        parser = frames.Frame.parse(self.reader.read_exact, mask=False)
        while True:
            try:
                next(parser)
            except StopIteration as parsed:
                return parsed.value
            received = self.socket.recv(65536)
            if not received:
                raise EOFError
            self.reader.feed_data(received)

    def next(self, opcode):
        """@return the payload of the next frame of a kind."""
        while True:
            frame = self.receive_frame()
            if frame.opcode == opcode:
                return frame.data

    def response(self, request_id):
        while True:
            message = pb.ServerMessage.FromString(self.next(BINARY))
            if message.HasField("response") and message.response.request_id == request_id:
                return message.response

    def close_code(self):
        """@return the code with which the gateway closes; None if it closes without a code."""
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

    def connected(self):
        connection = self.raw()
        connection.send_frame(BINARY, HELLO)
        self.assertEqual(connection.response(1).error, pb.OK)
        return connection

    def tearDown(self):
        # After every test a well-behaved client can connect.
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

    def test_a_page_of_another_site_is_refused(self):
        async def talk(origin):
            async with websockets.connect(self.url, origin=origin):
                pass
        for origin in ("http://evil.example", "https://127.0.0.1", "null",
                       f"http://127.0.0.1:{self.gateway.http_port + 1}"):
            with self.assertRaisesRegex(websockets.InvalidHandshake, "HTTP 403", msg=origin):
                asyncio.run(talk(origin))
        asyncio.run(talk(f"http://127.0.0.1:{self.gateway.http_port}"))

    # ---- Frames ----

    def test_a_message_in_fragments_is_one_message(self):
        connection = self.connected()
        pieces = [PING_REQUEST[i:i + 1] for i in range(len(PING_REQUEST))]
        connection.send_frame(BINARY, pieces[0], is_final=False)
        for piece in pieces[1:-1]:
            connection.send_frame(CONTINUATION, piece, is_final=False)
            connection.send_frame(PING, b"between")
        connection.send_frame(CONTINUATION, pieces[-1])
        self.assertEqual(connection.next(PONG), b"between")
        self.assertEqual(connection.response(2).pong.client_utime, 5)

    def test_a_ping_is_answered_with_its_payload(self):
        connection = self.connected()
        for payload in (b"", b"x" * 125):
            connection.send_frame(PING, payload)
            self.assertEqual(connection.next(PONG), payload)
        connection.send_frame(PONG, b"unsolicited")
        connection.send_frame(BINARY, PING_REQUEST)
        self.assertEqual(connection.response(2).error, pb.OK)

    def test_the_longest_message_is_accepted_and_one_byte_more_is_refused(self):
        connection = self.connected()
        connection.send_frame(BINARY, b"\xff" * 262144)
        self.assertEqual(connection.response(0).error, pb.INVALID_REQUEST)
        connection.send_frame(BINARY, b"\xff" * 262145)
        self.assertEqual(connection.close_code(), 1009)

    def test_a_message_that_grows_too_long_in_fragments_is_refused(self):
        connection = self.connected()
        connection.send_frame(BINARY, b"\xff" * 140000, is_final=False)
        connection.send_frame(CONTINUATION, b"\xff" * 140000)
        self.assertEqual(connection.close_code(), 1009)

    def test_a_length_of_exabytes_is_refused_at_once(self):
        connection = self.connected()
        connection.socket.sendall(struct.pack(">BBQ", 0x82, 0xff, 1 << 62) + b"\0\0\0\0")
        self.assertIn(connection.close_code(), (1002, 1009))

    def test_a_text_message_is_refused(self):
        connection = self.connected()
        connection.send_frame(TEXT, b"hello")
        self.assertEqual(connection.close_code(), 1003)

    def test_text_that_is_not_utf8_is_refused(self):
        connection = self.connected()
        connection.send_frame(TEXT, b"\xc3\x28")
        self.assertIn(connection.close_code(), (1003, 1007))

    def test_violations_are_closed_with_a_protocol_error(self):
        def unmasked(connection):
            connection.send_frame(BINARY, PING_REQUEST, is_masked=False)

        def reserved_bit(connection):
            connection.send_frame(BINARY, PING_REQUEST, has_reserved_bit=True)

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
                connection = self.connected()
                violate(connection)
                self.assertIn(connection.close_code(), (1002, 1007))

    def test_a_close_is_answered_with_its_code(self):
        for code in (1000, 1001, 3000, 4999):
            connection = self.connected()
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

    def test_a_slow_handshake_times_out(self):
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

    def test_a_client_without_connect_is_notified_and_closed(self):
        connection = self.raw()
        notice = pb.ServerMessage.FromString(connection.next(BINARY)).notice
        self.assertEqual(notice.kind, pb.Notice.CLOSING)
        self.assertEqual(connection.close_code(), 1008)

    # ---- Pages ----

    def test_metrics_are_served_to_the_own_host(self):
        url = f"http://127.0.0.1:{self.gateway.http_port}/metrics"
        connection = self.connected()
        connection.send_frame(BINARY, PING_REQUEST)
        connection.response(2)
        with urllib.request.urlopen(url, timeout=DEADLINE) as response:
            lines = response.read().decode().splitlines()
        # Text exposition format of Prometheus: each metric once, its samples together, after its TYPE.
        metrics = [line.split()[2] for line in lines if line.startswith("# TYPE ")]
        self.assertEqual(len(metrics), len(set(metrics)))
        samples = {}
        metric = None
        for line in lines:
            if line.startswith("# TYPE "):
                metric = line.split()[2]
            elif not line.startswith("#"):
                match = re.fullmatch(r'([a-z_]+)(\{[a-z]+="[^"]*"(?:,[a-z]+="[^"]*")*\})? ([0-9.e+-]+)', line)
                self.assertTrue(match, line)
                self.assertEqual(match.group(1), metric)
                samples.setdefault(metric, []).append(float(match.group(3)))
        self.assertEqual(samples["nao_gateway_clients"], [len(samples["nao_gateway_client_requests_total"])])
        self.assertIn(2, samples["nao_gateway_client_requests_total"])
        self.assertGreater(samples["nao_gateway_accepted_total"][0], 1)

    def test_the_robots_files_are_served(self):
        url = f"http://127.0.0.1:{self.gateway.http_port}/robots/nao/nao.urdf"
        with urllib.request.urlopen(url, timeout=DEADLINE) as response:
            self.assertEqual(response.headers["Content-Type"], "application/xml")
            self.assertIn(b"<robot", response.read())


class Secure(unittest.TestCase):
    """https and http on one port, with the gateway's own certificate."""

    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.gateway = Gateway("--tls", "--tls-dir", cls.folder)
        cls.addClassCleanup(cls.gateway.kill)
        # Trusts this certificate only, and checks its address.
        cls.context = ssl.create_default_context(cafile=f"{cls.folder}/gateway-certificate.pem")

    def test_pages_are_served_over_https_and_http(self):
        for scheme, context in (("https", self.context), ("http", None)):
            url = f"{scheme}://127.0.0.1:{self.gateway.http_port}/robots/nao/nao.urdf"
            with urllib.request.urlopen(url, timeout=DEADLINE, context=context) as response:
                self.assertIn(b"<robot", response.read())

    def test_a_secure_websocket_is_served(self):
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

    def test_the_certificate_is_reused(self):
        before = (Path(self.folder) / "gateway-certificate.pem").read_bytes()
        again = Gateway("--tls", "--tls-dir", self.folder)
        again.kill()
        self.assertEqual((Path(self.folder) / "gateway-certificate.pem").read_bytes(), before)


class Pairing(unittest.TestCase):
    def test_the_address_is_drawn_as_a_qr_code(self):
        with tempfile.TemporaryDirectory() as folder:
            gateway = Gateway("--qr-png", f"{folder}/code.png")
            self.addCleanup(gateway.kill)
            with urllib.request.urlopen(f"http://127.0.0.1:{gateway.http_port}/qr.png", timeout=DEADLINE) as response:
                self.assertEqual(response.headers["Content-Type"], "image/png")
                served = response.read()
            self.assertEqual(served[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual((Path(folder) / "code.png").read_bytes(), served)

    def test_the_audit_log_is_written_to_a_file(self):
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
    def test_a_terminated_gateway_notifies_its_clients(self):
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
