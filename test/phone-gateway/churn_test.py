#!/usr/bin/python3
"""Many clients that connect, disconnect and misbehave: file descriptors and memory do not grow.

NAO_TEST_STREAMS sets the number of random byte streams (default 2000).
"""

import os
import random
import re
import socket
import unittest
import urllib.request
from pathlib import Path

from programs import DEADLINE, Gateway, wait_until

import phone
from nao_remote import remote_pb2 as pb

NUM_STREAMS = int(os.environ.get("NAO_TEST_STREAMS", "2000"))
NUM_CLIENTS = 300
# Fragmentation of the allocator; a leaked buffer for each of the connections would be tens of MiB.
MEMORY_MIB = 4


class Churn(unittest.TestCase):
    def setUp(self):
        self.gateway = Gateway()
        self.addCleanup(self.gateway.kill)

    def num_descriptors(self):
        return len(list(Path(f"/proc/{self.gateway.process.pid}/fd").iterdir()))

    def memory_mib(self):
        resident_pages = int(Path(f"/proc/{self.gateway.process.pid}/statm").read_text().split()[1])
        return resident_pages * os.sysconf("SC_PAGESIZE") / 2 ** 20

    def num_accepted(self):
        url = f"http://127.0.0.1:{self.gateway.http_port}/metrics"
        with urllib.request.urlopen(url, timeout=DEADLINE) as response:
            return int(re.search(r"^nao_gateway_accepted_total (\S+)$", response.read().decode(), re.MULTILINE).group(1))

    def connect_once(self):
        with phone.Phone(port=self.gateway.tcp_port, timeout=DEADLINE) as client:
            client.ask(subscribe=pb.Subscribe(state_rate=60, image_rate=30))
            client.ask(ping=pb.Ping())

    def assert_no_growth(self, disturb, num_times):
        """Calls disturb() 100 times as a warm-up, then `num_times`, and compares."""
        for _ in range(100):
            disturb()
        self.connect_once()
        wait_until(lambda: self.num_descriptors() < 60, "the first connections end")
        descriptors, memory, accepted = self.num_descriptors(), self.memory_mib(), self.num_accepted()
        for _ in range(num_times):
            disturb()
        self.connect_once()
        wait_until(lambda: self.num_descriptors() <= descriptors, "every connection ends")
        self.assertLess(self.memory_mib() - memory, MEMORY_MIB)
        self.assertGreaterEqual(self.num_accepted() - accepted, num_times)

    def test_clients_that_connect_and_disconnect(self):
        self.assert_no_growth(self.connect_once, NUM_CLIENTS)

    def test_random_byte_streams(self):
        rng = random.Random(4)

        def disturb():
            port = rng.choice((self.gateway.tcp_port, self.gateway.http_port))
            start = rng.choice((b"", b"", b"\0\0\0\x20", b"GET /ws HTTP/1.1\r\n", b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"))
            with socket.create_connection(("127.0.0.1", port), DEADLINE) as connection:
                try:
                    connection.sendall(start + rng.randbytes(rng.randrange(1500)))
                except OSError:
                    pass  # the gateway has closed the connection already
        self.assert_no_growth(disturb, NUM_STREAMS)


if __name__ == "__main__":
    unittest.main()
