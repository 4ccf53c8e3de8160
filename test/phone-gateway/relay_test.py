#!/usr/bin/python3
"""nao-relay: bounds, memory with as many phones and robots as it takes, what it serves and refuses."""

import asyncio
import hashlib
import os
import re
import ssl
import tempfile
import unittest
from pathlib import Path

from programs import DEADLINE, Program

NUM_ROBOTS = 100
NUM_PHONES = 1000
# kB, without the program itself, which is mapped from files.
MAX_MEMORY = 100_000
IMAGE = bytes(range(256)) * 60
BINARY, CLOSE, PING = 0x82, 0x88, 0x89
ALIVE = b"alive"
ALIVE_PERIOD = 3  # s

TLS = ssl.create_default_context()
TLS.check_hostname = False
TLS.verify_mode = ssl.CERT_NONE


def key(number):
    return hashlib.sha256(str(number).encode()).hexdigest()


def robot_of(robot_key):
    return hashlib.sha256(robot_key.encode()).hexdigest()[:32]


class Socket:
    """A WebSocket to the relay: RFC 6455, whole messages below 64 kB."""

    @classmethod
    async def open(cls, port, target, tls=True, source="127.0.0.1"):
        self = cls()
        self.reader, self.writer = await asyncio.open_connection("127.0.0.1", port, ssl=TLS if tls else None, local_addr=(source, 0))
        self.writer.write(f"GET {target} HTTP/1.1\r\nHost: relay.example\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                          "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        head = await self.reader.readuntil(b"\r\n\r\n")
        assert head.startswith(b"HTTP/1.1 101"), head
        return self

    def send(self, payload):
        # The mask 0 changes nothing (RFC 6455, 5.3).
        length = len(payload)
        size = bytes([0x80 | length]) if length < 126 else b"\xfe" + length.to_bytes(2, "big")
        self.writer.write(bytes([BINARY]) + size + bytes(4) + payload)

    async def receive(self):
        """The next message, its fragments joined; for a close frame its reason as a str."""
        message = b""
        while True:
            kind, size = await self.reader.readexactly(2)
            if size == 126:
                size = int.from_bytes(await self.reader.readexactly(2), "big")
            payload = await self.reader.readexactly(size)
            if kind == CLOSE:
                return payload[2:].decode()
            if kind == PING:
                self.writer.write(b"\x8a\x80" + bytes(4))
                continue
            message += payload
            if kind & 0x80:
                return message


class Robot:
    """The gateway's part: fetches phones, and sends each of its messages back, then an image."""

    @classmethod
    async def start(cls, port, number, source):
        self = cls()
        self.port = port
        self.control = await Socket.open(port, f"/ws?key={key(number)}", source=source)
        assert await self.control.receive() == b"connected"
        self.tasks = [asyncio.create_task(self.run())]
        return self

    async def run(self):
        while isinstance(ticket := await self.control.receive(), bytes):
            self.tasks.append(asyncio.create_task(self.serve(ticket.decode())))

    async def serve(self, ticket):
        phone = await Socket.open(self.port, f"/ws?ticket={ticket}", tls=False)
        while isinstance(message := await phone.receive(), bytes):
            phone.send(message)
            if message != ALIVE:
                phone.send(IMAGE)


async def exchange(port, number, source):
    phone = await Socket.open(port, f"/ws?robot={robot_of(key(number % NUM_ROBOTS))}", source=source)
    phone.send(f"phone {number}".encode())
    assert await phone.receive() == f"phone {number}".encode()
    assert await phone.receive() == IMAGE
    return phone


async def keep_alive(phones):
    """The relay closes a connection without messages."""
    while True:
        await asyncio.sleep(ALIVE_PERIOD)
        for phone in phones:
            phone.send(ALIVE)


class Relay(unittest.TestCase):
    def start(self, *options):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        program = Program("nao-relay", "--port", 0, "--bind", "127.0.0.1", "--tls-dir", Path(folder.name) / "tls", *options)
        self.addCleanup(program.end)
        return program, int(program.wait_for_log(r"listens on port (\d+)").group(1))

    def test_holds_1000_phones_and_100_robots_in_100_mb(self):
        program, port = self.start()

        async def load():
            robots = [await Robot.start(port, number, f"127.0.1.{1 + number // 20}") for number in range(NUM_ROBOTS)]
            phones = []
            alive = asyncio.create_task(keep_alive(phones))
            for first in range(0, NUM_PHONES, 50):
                phones += await asyncio.gather(*(exchange(port, number, f"127.0.2.{1 + number // 200}")
                                                 for number in range(first, first + 50)))
            status = Path(f"/proc/{program.process.pid}/status").read_text()
            memory = int(re.search(r"RssAnon:\s*(\d+)", status)[1])
            # One more is told why not.
            refused = await Socket.open(port, f"/ws?robot={robot_of(key(0))}", source="127.0.2.9")
            self.assertIn("1000 phones", await refused.receive())
            refused = await Socket.open(port, f"/ws?key={key('one more')}", source="127.0.1.9")
            self.assertIn("100 robots", await refused.receive())
            # All still work.
            for phone in phones[::100]:
                phone.send(b"again")
                while (answer := await phone.receive()) == ALIVE:
                    pass
                self.assertEqual(answer, b"again")
            alive.cancel()
            del robots
            return memory

        memory = asyncio.run(asyncio.wait_for(load(), 5 * DEADLINE))
        print(f"{NUM_PHONES} phones and {NUM_ROBOTS} robots: {memory / 1000:.1f} MB")
        self.assertLess(memory, MAX_MEMORY)

    def test_bounds_addresses_and_waiting(self):
        _, port = self.start("--max-robots-per-address", 1, "--max-phones-per-address", 2, "--max-phones-per-robot", 3)

        async def run():
            robot = await Robot.start(port, 0, "127.0.1.1")
            second = await Socket.open(port, f"/ws?key={key(1)}", source="127.0.1.1")
            self.assertIn("One address may offer 1", await second.receive())
            phones = [await exchange(port, 0, "127.0.2.1"), await exchange(port, 0, "127.0.2.1")]
            third = await Socket.open(port, f"/ws?robot={robot_of(key(0))}", source="127.0.2.1")
            self.assertIn("One address may connect 2", await third.receive())
            phones.append(await exchange(port, 0, "127.0.2.2"))
            fourth = await Socket.open(port, f"/ws?robot={robot_of(key(0))}", source="127.0.2.3")
            self.assertIn("3 phones already", await fourth.receive())
            unknown = await Socket.open(port, f"/ws?robot={'0' * 32}")
            self.assertIn("not connected with the relay", await unknown.receive())
            wrong = await Socket.open(port, f"/ws?ticket={'0' * 32}", tls=False)
            self.assertIn("No phone waits", await wrong.receive())
            nonsense = await Socket.open(port, "/ws?robot=nao")
            self.assertIn("no address of a robot", await nonsense.receive())
            # A gateway that does not come.
            for task in robot.tasks:
                task.cancel()
            for phone in phones:
                phone.writer.close()
            idle = await Socket.open(port, f"/ws?key={key(0)}", source="127.0.1.2")
            self.assertEqual(await idle.receive(), b"connected")
            ticket = asyncio.create_task(idle.receive())
            while not ticket.done():  # the phones before may be there still
                waiting = await Socket.open(port, f"/ws?robot={robot_of(key(0))}", source="127.0.2.4")
                await asyncio.wait([ticket], timeout=1)
            self.assertEqual(len(ticket.result()), 32)
            with self.assertRaises((asyncio.IncompleteReadError, ConnectionError)):
                await waiting.receive()

        asyncio.run(asyncio.wait_for(run(), 2 * DEADLINE))

    def test_serves_the_app_over_https_only(self):
        program, port = self.start()

        async def get(tls):
            reader, writer = await asyncio.open_connection("127.0.0.1", port, ssl=TLS if tls else None)
            writer.write(b"GET / HTTP/1.1\r\nHost: relay.example\r\nConnection: close\r\n\r\n")
            return await reader.read()

        self.assertIn(b"Location: https://relay.example/", asyncio.run(get(False)))
        self.assertIn(b"<!doctype html>", asyncio.run(get(True)).lower())
        self.assertTrue(any("signs its certificate itself" in line for line in program.log))


if __name__ == "__main__":
    os.umask(0o077)
    unittest.main()
