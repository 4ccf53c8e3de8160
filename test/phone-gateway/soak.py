#!/usr/bin/python3
"""Usage: test/phone-gateway/soak.py [--minutes M] [--csv FILE]

Simulator, motion, camera and gateway, and phones that come and go: each second one comes, by turns over raw TCP
and WebSocket, watches 30 states and 15 images a second, and goes some seconds later: closing properly, by
resetting the connection, or without ever having read. Prints the gateway's memory and its descriptors beside
those of the phones, 60 times, and how they grew. Not part of the test run, for it takes as long as it says
(default: 60 minutes); exit status 1 if memory or descriptors grow, or a phone is thrown out.
"""

import argparse
import itertools
import os
import random
import select
import socket
import statistics
import struct
import sys
import time
from pathlib import Path

from programs import Robot
from remote_protocol import remote_pb2 as pb

WARM_UP = 180  # s: until every buffer has been as large as it gets
STAY = 8  # s, the longest
NUM_SAMPLES = 60
MAX_SLOPE = 0.5  # MiB an hour
MAX_GROWTH = 2  # descriptors beside those of the phones; one may be on its way out

HANDSHAKE = (b"GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
             b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n")
REQUESTS = [pb.Request(request_id=1, connect=pb.Connect(protocol_version=1, client_name="soak")),
            pb.Request(request_id=2, subscribe=pb.Subscribe(state_rate=30, image_rate=15)),
            pb.Request(request_id=3, take_control=pb.TakeControl()),
            pb.Request(request_id=4, stop=pb.Stop())]
PING = pb.Request(ping=pb.Ping())


def tcp_frame(message):
    return struct.pack(">I", len(message)) + message


def websocket_frame(message):
    """Short and binary; a mask of zero leaves the payload as it is."""
    return struct.pack(">BBI", 0x82, 0x80 | len(message), 0) + message


class Visitor:
    """A phone that throws away what it gets."""

    def __init__(self, gateway, number, dice):
        is_websocket = number % 2 == 0
        self.ends_at = time.monotonic() + dice.uniform(0.5, STAY)
        self.way_out = dice.choice(("close", "reset", "stall"))
        self.socket = socket.create_connection(
            ("127.0.0.1", gateway.http_port if is_websocket else gateway.tcp_port), 10)
        self.frame = websocket_frame if is_websocket else tcp_frame
        if is_websocket:
            self.socket.sendall(HANDSHAKE)
            # RFC 6455, 4.1: nothing more before the answer.
            if b" 101 " not in self.socket.recv(4096):
                raise AssertionError("the gateway refuses a WebSocket")
        for request in REQUESTS:
            self.send(request)
        self.num_bytes = 0

    def send(self, request):
        self.socket.sendall(self.frame(request.SerializeToString()))

    def read(self):
        received = self.socket.recv(1 << 16)
        self.num_bytes += len(received)
        return bool(received)

    def leave(self):
        if self.way_out == "reset":
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.socket.close()


def usage(pid):
    """@return resident memory, MiB, and open descriptors."""
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGESIZE") / 2 ** 20, len(os.listdir(f"/proc/{pid}/fd"))


def slope(samples):
    """Growth an hour of (seconds, value), least squares."""
    return 3600 * statistics.linear_regression(*zip(*samples)).slope


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--csv", type=Path, help="file for the samples: minutes,MiB,descriptors")
    options = parser.parse_args()
    dice = random.Random(1)
    visitors, samples = [], []
    num_bytes = num_lost = 0
    with Robot(scene="empty") as robot:
        start = next_visit = next_sample = time.monotonic()
        numbers = itertools.count(1)
        while (now := time.monotonic()) < start + 60 * options.minutes:
            if now >= next_visit:
                next_visit += 1
                visitors.append(Visitor(robot.gateway, next(numbers), dice))
                for visitor in visitors:
                    visitor.send(PING)
            if now >= next_sample:
                memory, descriptors = usage(robot.gateway.process.pid)
                descriptors -= len(visitors)
                samples.append((now - start, memory, descriptors))
                line = f"{(now - start) / 60:.1f},{memory:.2f},{descriptors}"
                print(line, flush=True)
                if options.csv:
                    with options.csv.open("a") as file:
                        file.write(line + "\n")
                next_sample += 60 * options.minutes / NUM_SAMPLES
            readers = [visitor for visitor in visitors if visitor.way_out != "stall"]
            readable, _, _ = select.select([visitor.socket for visitor in readers], [], [], 0.05)
            for visitor in readers:
                if visitor.socket in readable and not visitor.read():
                    num_lost += 1
                    visitor.ends_at = 0
            for visitor in [visitor for visitor in visitors if visitor.ends_at < now]:
                visitors.remove(visitor)
                num_bytes += visitor.num_bytes
                visitor.leave()
    settled = [sample for sample in samples if sample[0] >= min(WARM_UP, 60 * options.minutes / 4)]
    memory = slope([(seconds, mib) for seconds, mib, _ in settled])
    growth = settled[-1][2] - settled[0][2]
    print(f"{next(numbers) - 1} visits, {num_bytes / 2 ** 20:.0f} MiB read, {num_lost} thrown out\n"
          f"memory {settled[0][1]:.2f} -> {settled[-1][1]:.2f} MiB, {memory:+.3f} MiB an hour; "
          f"descriptors {settled[0][2]} -> {settled[-1][2]}")
    return 0 if memory <= MAX_SLOPE and growth <= MAX_GROWTH and num_lost == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
