"""A TCP link with the faults of a phone's link: latency, stalls without closing, resets."""

import collections
import select
import socket
import struct
import threading
import time


class FaultyLink:
    """Relays connections from .port to a port of this host, both ways. Use it in a with statement.

    .delay    seconds that every byte takes, each way
    .stalled  True: no data passes and neither end is notified, as with a phone out of range
    """

    def __init__(self, target_port):
        self.delay = 0.0
        self.stalled = False
        self._target_port = target_port
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        self._pairs = []
        self._is_ending = False
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._is_ending = True
        self._thread.join()
        self.reset()
        self._listener.close()

    def reset(self):
        """Breaks every connection with a reset at both ends."""
        pairs, self._pairs = self._pairs, []
        for pair in pairs:
            for connection in pair.ends:
                # SO_LINGER with 0 s makes close() send a reset.
                connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                connection.close()

    def _run(self):
        while not self._is_ending:
            pairs = self._pairs
            ends = [end for pair in pairs for end in pair.ends if not pair.is_over]
            readable, _, _ = select.select([self._listener, *([] if self.stalled else ends)], [], [], 0.002)
            if self._listener in readable:
                self._pairs = [*self._pairs, _Pair(self._listener.accept()[0], self._target_port)]
            for pair in pairs:
                if not self.stalled:
                    pair.relay(readable, self.delay)
            if any(pair.is_over for pair in self._pairs):
                self._pairs = [pair for pair in self._pairs if not pair.is_over]


class _Pair:
    """The two ends of one connection, and the data in transit between them."""

    def __init__(self, near, target_port):
        far = socket.create_connection(("127.0.0.1", target_port))
        self.ends = (near, far)
        self.is_over = False
        self._on_the_way = {near: collections.deque(), far: collections.deque()}
        for end in self.ends:
            end.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def relay(self, readable, delay):
        now = time.monotonic()
        try:
            for end, other in (self.ends, self.ends[::-1]):
                if end in readable:
                    self._on_the_way[other].append((now + delay, end.recv(65536)))
                queue = self._on_the_way[other]
                while queue and queue[0][0] <= now:
                    received = queue.popleft()[1]
                    if not received:
                        raise ConnectionResetError
                    other.sendall(received)
        except (OSError, ValueError):
            self.is_over = True
            for end in self.ends:
                end.close()
