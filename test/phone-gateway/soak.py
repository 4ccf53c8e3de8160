#!/usr/bin/python3
"""Usage: test/phone-gateway/soak.py [--minutes M] [--csv FILE]

Simulator, motion, camera and gateway with clients that connect and disconnect: once a second a client connects, by turns
over raw TCP and WebSocket, subscribes to 30 states and 15 images a second, and disconnects some seconds later: by closing
properly, by resetting the connection, or without having read anything. Prints the gateway's memory and its file descriptors
without those of the clients, 60 times, and their growth. Not part of the test run, because of its duration (default: 60
minutes). Exit status 1 if memory or descriptors grow, or the gateway closes a client that reads.
"""

import argparse
import asyncio
import os
import random
import socket
import statistics
import struct
import sys
import time
from pathlib import Path

import websockets
from programs import Robot
from nao_remote import remote_pb2 as pb

WARM_UP = 180  # s: until every buffer has its largest size
MAX_STAY = 8  # s, of one client
NUM_SAMPLES = 60
MAX_SLOPE = 0.5  # MiB an hour
MAX_GROWTH = 2  # descriptors without those of clients; one connection may be closing

REQUESTS = [pb.Request(request_id=1, connect=pb.Connect(protocol_version=1, client_name="soak")),
            pb.Request(request_id=2, subscribe=pb.Subscribe(state_rate=30, image_rate=15)),
            pb.Request(request_id=3, take_control=pb.TakeControl()),
            pb.Request(request_id=4, stop=pb.Stop())]
PING = pb.Request(ping=pb.Ping())


class TcpTransport:
    """Messages over raw TCP."""

    @classmethod
    async def connect(cls, gateway):
        self = cls()
        self.reader, self.writer = await asyncio.open_connection("127.0.0.1", gateway.tcp_port)
        return self

    async def send(self, message):
        self.writer.write(struct.pack(">I", len(message)) + message)
        await self.writer.drain()

    async def receive(self):
        length, = struct.unpack(">I", await self.reader.readexactly(4))
        return await self.reader.readexactly(length)

    @property
    def transport(self):
        return self.writer.transport

    async def close(self):
        self.writer.close()
        await self.writer.wait_closed()


class WebSocketTransport:
    """Messages over a WebSocket."""

    @classmethod
    async def connect(cls, gateway):
        self = cls()
        # With a queue of one message the library stops reading until a message is received.
        self.websocket = await websockets.connect(f"ws://localhost:{gateway.http_port}/ws", max_queue=1,
                                                  ping_interval=None, close_timeout=1)
        return self

    async def send(self, message):
        await self.websocket.send(message)

    async def receive(self):
        return await self.websocket.recv()

    @property
    def transport(self):
        return self.websocket.transport

    async def close(self):
        await self.websocket.close()


class Clients:
    """Clients that connect, stay for some seconds, and disconnect."""

    def __init__(self, gateway, rng):
        self.gateway = gateway
        self.rng = rng
        self.num_open = self.num_visits = self.num_bytes = self.num_lost = 0

    async def visit(self):
        self.num_visits += 1
        kind = (TcpTransport, WebSocketTransport)[self.num_visits % 2]
        stay = self.rng.uniform(0.5, MAX_STAY)
        way_out = self.rng.choice(("close", "reset", "stall"))
        connection = await kind.connect(self.gateway)
        self.num_open += 1
        tasks = [asyncio.create_task(self.ping(connection))]
        try:
            for request in REQUESTS:
                await connection.send(request.SerializeToString())
            if way_out != "stall":
                tasks.append(asyncio.create_task(self.read(connection)))
            done, _ = await asyncio.wait(tasks, timeout=stay, return_when=asyncio.FIRST_COMPLETED)
            self.num_lost += bool(done)
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
            await self.leave(connection, way_out)
            self.num_open -= 1

    async def ping(self, connection):
        while True:
            await asyncio.sleep(1)
            await connection.send(PING.SerializeToString())

    async def read(self, connection):
        while True:
            self.num_bytes += len(await connection.receive())

    @staticmethod
    async def leave(connection, way_out):
        if way_out == "close":
            await connection.close()
            return
        if way_out == "reset":
            # A linger time of 0 sends RST instead of FIN.
            connection.transport.get_extra_info("socket").setsockopt(
                socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        connection.transport.abort()


def usage(pid):
    """@return resident memory, MiB, and open descriptors."""
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGESIZE") / 2 ** 20, len(os.listdir(f"/proc/{pid}/fd"))


def slope(samples):
    """Growth an hour of (seconds, value), least squares."""
    return 3600 * statistics.linear_regression(*zip(*samples)).slope


async def soak(robot, options):
    """@return the clients, and samples (seconds, MiB, descriptors)."""
    clients = Clients(robot.gateway, random.Random(1))
    visits, samples = set(), []
    start = next_sample = time.monotonic()
    while (now := time.monotonic()) < start + 60 * options.minutes:
        visit = asyncio.create_task(clients.visit())
        visits.add(visit)
        visit.add_done_callback(visits.discard)
        if now >= next_sample:
            memory, descriptors = usage(robot.gateway.process.pid)
            samples.append((now - start, memory, descriptors - clients.num_open))
            line = f"{(now - start) / 60:.1f},{memory:.2f},{samples[-1][2]}"
            print(line, flush=True)
            if options.csv:
                with options.csv.open("a") as file:
                    file.write(line + "\n")
            next_sample += 60 * options.minutes / NUM_SAMPLES
        await asyncio.sleep(1)
    await asyncio.gather(*visits, return_exceptions=True)
    return clients, samples


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--csv", type=Path, help="file for the samples: minutes,MiB,descriptors")
    options = parser.parse_args()
    with Robot(scene="empty") as robot:
        clients, samples = asyncio.run(soak(robot, options))
    settled = [sample for sample in samples if sample[0] >= min(WARM_UP, 60 * options.minutes / 4)]
    memory = slope([(seconds, mib) for seconds, mib, _ in settled])
    growth = settled[-1][2] - settled[0][2]
    print(f"{clients.num_visits} visits, {clients.num_bytes / 2 ** 20:.0f} MiB read, {clients.num_lost} lost\n"
          f"memory {settled[0][1]:.2f} -> {settled[-1][1]:.2f} MiB, {memory:+.3f} MiB an hour; "
          f"descriptors {settled[0][2]} -> {settled[-1][2]}")
    return 0 if memory <= MAX_SLOPE and growth <= MAX_GROWTH and clients.num_lost == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
