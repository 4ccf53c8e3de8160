"""A second host, for tests of remote phones: a network namespace behind a virtual cable.

Needs no privileges where the kernel permits user namespaces; enter_private_network() returns whether it does.
"""

import contextlib
import ctypes
import os
import subprocess
import sys
import time

CLONE_NEWNET = 0x40000000
PRIVATE = "NAO_TEST_PRIVATE_NETWORK"


def enter_private_network():
    """Restarts the calling program in a private network namespace: call it first. The multicast bus works there.

    @return False if the system does not permit it."""
    if PRIVATE in os.environ:
        ip("link", "set", "lo", "up", "multicast", "on")
        ip("route", "add", "224.0.0.0/4", "dev", "lo")
        return True
    # Root needs no user namespace; in a chroot the kernel permits none.
    for unshare in (["unshare", "--net"], ["unshare", "--user", "--map-root-user", "--net"]):
        probe = [*unshare, "ip", "link", "add", "type", "veth"]
        if subprocess.run(probe, capture_output=True, check=False).returncode == 0:
            os.execvpe(unshare[0], [*unshare, sys.executable, *sys.argv], {**os.environ, PRIVATE: "1"})
    return False


def ip(*words):
    subprocess.run(["ip", *[str(word) for word in words]], check=True)


class OtherHost:
    """Use it in a with statement, in a private network.

    .gateway_address  how the other host reaches this one
    .address          how this one sees it
    """

    gateway_address = "10.77.0.1"
    address = "10.77.0.2"

    def __enter__(self):
        self._process = subprocess.Popen(["unshare", "--net", "sleep", "infinity"])
        self._namespace = f"/proc/{self._process.pid}/ns/net"
        here = os.readlink("/proc/self/ns/net")
        while os.readlink(self._namespace) == here:
            time.sleep(0.01)
        ip("link", "add", "cable", "type", "veth", "peer", "name", "cable", "netns", self._process.pid)
        ip("address", "add", f"{self.gateway_address}/24", "dev", "cable")
        ip("link", "set", "cable", "up")
        with self.inside():
            ip("address", "add", f"{self.address}/24", "dev", "cable")
            ip("link", "set", "cable", "up")
        return self

    def __exit__(self, *_):
        self._process.kill()
        self._process.wait()

    @contextlib.contextmanager
    def inside(self):
        """Context: sockets and processes created within belong to the other host."""
        here = os.open("/proc/self/ns/net", os.O_RDONLY)
        there = os.open(self._namespace, os.O_RDONLY)
        try:
            self._enter(there)
            yield
        finally:
            self._enter(here)
            os.close(here)
            os.close(there)

    @staticmethod
    def _enter(namespace):
        libc = ctypes.CDLL(None, use_errno=True)
        if libc.setns(namespace, CLONE_NEWNET) != 0:
            raise OSError(ctypes.get_errno(), "setns")

    @staticmethod
    def cut_cable():
        """Drops all packets without a notification to either end."""
        ip("link", "set", "cable", "down")

    @staticmethod
    def mend_cable():
        ip("link", "set", "cable", "up")
