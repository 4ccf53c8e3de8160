"""Several hosts on one machine: network namespaces, connected by a network that delays and drops datagrams.

    net ── veth ── host "a"
     │
     └──── veth ── host "b"

The relay in "net" copies what a host sends to a multicast group to every other host, later, or never.
Needs root; Hosts.missing() says what else is not there.
"""

import heapq
import os
import random
import select
import socket
import struct
import subprocess
import sys
import time

GROUP = "239.255.76.67"


def ip(*words):
    subprocess.run(["ip", *words], check=True, capture_output=True)


class Hosts:
    """Use it in a with statement: its end removes all namespaces and processes."""

    @staticmethod
    def missing():
        """Why there can be no namespaces here; empty if there can."""
        if os.geteuid() != 0:
            return "needs root"
        probe = f"nao{os.getpid()}probe"
        try:
            ip("netns", "add", probe)
            try:
                ip("-n", probe, "link", "add", "name", "probe0", "type", "veth", "peer", "name", "probe1")
            finally:
                ip("netns", "delete", probe)
        except (OSError, subprocess.CalledProcessError) as error:
            return f"no network namespaces: {getattr(error, 'stderr', error)}"
        return ""

    def __init__(self, names, port, delay, loss):
        """@param delay  One way, s. @param loss  Fraction of dropped datagrams."""
        self.prefix = f"nao{os.getpid()}"
        self.names = names
        self.port = port
        self.delay = delay
        self.loss = loss
        self.relay = None

    def __enter__(self):
        net = self.space("net")
        ip("netns", "add", net)
        for number, name in enumerate(self.names):
            host = self.space(name)
            ip("netns", "add", host)
            ip("-n", net, "link", "add", "name", name, "type", "veth", "peer", "name", "eth0", "netns", host)
            ip("-n", net, "address", "add", f"10.76.{number}.1/24", "dev", name)
            ip("-n", net, "link", "set", name, "up")
            ip("-n", host, "address", "add", f"10.76.{number}.2/24", "dev", "eth0")
            ip("-n", host, "link", "set", "eth0", "up")
            ip("-n", host, "link", "set", "lo", "up")
            ip("-n", host, "route", "add", "default", "via", f"10.76.{number}.1")
        self.relay = subprocess.Popen(
            ["ip", "netns", "exec", net, sys.executable, __file__, str(self.port), str(self.delay),
             str(self.loss), *self.names], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.relay.stdout.readline()
        return self

    def __exit__(self, *_):
        if self.relay is not None:
            self.relay.kill()
            self.relay.communicate()
        for name in ["net", *self.names]:
            subprocess.run(["ip", "netns", "delete", self.space(name)], check=False, capture_output=True)

    def space(self, name):
        """Name of a host's network namespace."""
        return f"{self.prefix}{name}"

    def on(self, name):
        """Prefix of a command that runs it on a host."""
        return ["ip", "netns", "exec", self.space(name)]

    def cut(self, name):
        """Disconnects a host from the network."""
        ip("-n", self.space("net"), "link", "set", name, "down")

    def mend(self, name):
        """Reconnects a host."""
        ip("-n", self.space("net"), "link", "set", name, "up")


class Link:
    """One host's end in the relay."""

    def __init__(self, device, port):
        self.device = device
        self.receiver = self._socket(device)
        self.receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        self.receiver.bind((GROUP, port))
        index = socket.if_nametoindex(device)
        group = struct.pack("4s4si", socket.inet_aton(GROUP), socket.inet_aton("0.0.0.0"), index)
        self.receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
        # One socket per sending host: receivers reassemble fragments by sender address.
        self.senders = {}

    @staticmethod
    def _socket(device):
        made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        made.setsockopt(socket.SOL_SOCKET, socket.SO_BINDTODEVICE, device.encode())
        return made

    def send(self, origin, data, port):
        if origin not in self.senders:
            sender = self._socket(self.device)
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 1)
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 0)
            sender.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4 << 20)
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF,
                              struct.pack("4s4si", b"\0" * 4, b"\0" * 4, socket.if_nametoindex(self.device)))
            self.senders[origin] = sender
        try:
            self.senders[origin].sendto(data, (GROUP, port))
        except OSError:
            pass  # its cable is cut


def relay(port, delay, loss, devices):
    links = [Link(device, port) for device in devices]
    print("ready", flush=True)
    on_the_way = []
    number = 0
    while True:
        now = time.monotonic()
        wait = max(0.0, on_the_way[0][0] - now) if on_the_way else 1.0
        for receiver in select.select([link.receiver for link in links], [], [], wait)[0]:
            origin = next(link for link in links if link.receiver is receiver)
            data, source = receiver.recvfrom(65535)
            for link in links:
                if link is not origin and random.random() >= loss:
                    number += 1
                    heapq.heappush(on_the_way, (time.monotonic() + delay, number, link, source, data))
        while on_the_way and on_the_way[0][0] <= time.monotonic():
            _, _, link, source, data = heapq.heappop(on_the_way)
            link.send(source, data, port)


if __name__ == "__main__":
    relay(int(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3]), sys.argv[4:])
