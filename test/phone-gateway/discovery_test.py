#!/usr/bin/python3
"""Two gateways on two hosts (network namespaces) find each other by their hosts' avahi-daemons, each on a private D-Bus."""

import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "test/support"))

from hosts import Hosts, ip  # noqa: E402

BIN_DIR = Path(os.environ["NAO_BIN_DIR"])
DEADLINE = 60  # s

AVAHI_CONFIGURATION = """\
[server]
host-name={host}
use-ipv6=no
allow-interfaces=eth0
[publish]
publish-workstation=no
[rlimits]
"""


def missing():
    """What this test needs and is not there; empty if all is."""
    for program in ("avahi-daemon", "dbus-daemon", "unshare"):
        if shutil.which(program, path=os.environ["PATH"] + ":/usr/sbin:/sbin") is None:
            return f"no {program}"
    return Hosts.missing()


class Host:
    """A host with its own network, host name, D-Bus, avahi-daemon and gateway."""

    def __init__(self, name, robot, folder):
        self.name, self.robot, self.folder = name, robot, folder / name
        self.folder.mkdir()
        self.space = f"nao{os.getpid()}{name}"
        self.bus = self.folder / "bus"
        self.processes = {}

    def command(self, *words):
        """A command line in this host. /run/avahi-daemon is its own."""
        inside = f'hostname {self.name}; mkdir -p /run/avahi-daemon; mount -t tmpfs tmpfs /run/avahi-daemon; exec "$@"'
        return ["ip", "netns", "exec", self.space, "unshare", "-mu", "sh", "-c", inside, "sh", *map(str, words)]

    def environment(self):
        return {**os.environ, "DBUS_SYSTEM_BUS_ADDRESS": f"unix:path={self.bus}",
                "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}

    def start(self, name, *words):
        log = open(self.folder / f"{name}.log", "ab")
        self.processes[name] = subprocess.Popen(self.command(*words), env=self.environment(), stdout=log, stderr=log)
        log.close()

    def start_dbus(self):
        self.start("dbus", "dbus-daemon", "--nofork", f"--config-file={ROOT / 'test/support/system_bus.conf'}",
                   f"--address=unix:path={self.bus}")
        wait_for(self.bus.exists, self)

    def start_avahi(self):
        configuration = self.folder / "avahi.conf"
        configuration.write_text(AVAHI_CONFIGURATION.format(host=self.name))
        self.start("avahi", "avahi-daemon", "--no-drop-root", "--no-chroot", "--no-rlimits", "-f", configuration)

    def start_gateway(self):
        self.start("gateway", BIN_DIR / "nao-phone-gateway", "--lcm-url", "udpm://239.255.76.67:7667?ttl=0",
                   "--robot", self.robot, "--token", "secret")

    def stop(self, name):
        process = self.processes.pop(name)
        process.terminate()
        return process.wait()

    def stop_all(self):
        for name in reversed(list(self.processes)):
            self.stop(name)

    def run(self, *words):
        return subprocess.run(self.command(*words), env=self.environment(), check=False, capture_output=True, text=True)

    def get(self, path, host="127.0.0.1:8080"):
        """Status and text of a page of this host's gateway; status 0 if it does not answer."""
        code = ("import http.client, sys; c = http.client.HTTPConnection('127.0.0.1', 8080, timeout=5); "
                f"c.request('GET', '{path}', headers={{'Host': '{host}'}}); r = c.getresponse(); "
                "print(r.status); print(r.read().decode())")
        result = self.run(sys.executable, "-c", code)
        status, _, text = result.stdout.partition("\n")
        return (int(status), text) if result.returncode == 0 else (0, "")

    def gateways(self):
        status, text = self.get("/gateways")
        return json.loads(text) if status == 200 else {"gateways": [], "announced_as": "", "alias": ""}

    def names(self):
        return [gateway["name"] for gateway in self.gateways()["gateways"]]

    def logs(self):
        return "\n".join(f"{self.name} {file.name}:\n{file.read_text(errors='replace')}"
                         for file in sorted(self.folder.glob("*.log")))


def wait_for(condition, *hosts):
    deadline = time.monotonic() + DEADLINE
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError("\n".join(host.logs() for host in hosts))
        time.sleep(0.2)


@unittest.skipIf(missing(), missing())
class Discovery(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="nao-test-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.hosts = [Host("lab-a", "NAO", cls.folder), Host("lab-b", "PEPE", cls.folder)]
        for host in cls.hosts:
            ip("netns", "add", host.space)
            cls.addClassCleanup(subprocess.run, ["ip", "netns", "delete", host.space], check=False, capture_output=True)
        a, b = cls.hosts
        ip("-n", a.space, "link", "add", "name", "eth0", "type", "veth", "peer", "name", "eth0", "netns", b.space)
        for number, host in enumerate(cls.hosts, 1):
            ip("-n", host.space, "address", "add", f"192.168.77.{number}/24", "dev", "eth0")
            ip("-n", host.space, "link", "set", "eth0", "up")
            ip("-n", host.space, "link", "set", "lo", "up", "multicast", "on")
            ip("-n", host.space, "route", "add", "default", "dev", "eth0")
            cls.addClassCleanup(host.stop_all)
            host.start_dbus()
            host.start_avahi()
            host.start_gateway()
        wait_for(lambda: all(len(host.names()) == 1 for host in cls.hosts), *cls.hosts)

    def test_each_lists_the_other_and_not_itself(self):
        a, b = self.hosts
        self.assertEqual(a.names(), ["PEPE on lab-b"])
        self.assertEqual(b.names(), ["NAO on lab-a"])
        found = a.gateways()["gateways"][0]
        self.assertEqual((found["url"], found["robot"], found["tcp_port"], found["https"]),
                         ("http://192.168.77.2:8080", "PEPE", 7668, False))
        self.assertEqual(a.gateways()["announced_as"], "NAO on lab-a")

    def test_one_is_nao_local_the_other_nao_2_local(self):
        wait_for(lambda: sorted(host.gateways()["alias"] for host in self.hosts) == ["nao-2.local", "nao.local"], *self.hosts)
        for host in self.hosts:
            self.assertEqual(host.get("/", host.gateways()["alias"] + ":8080")[0], 200)
            self.assertNotEqual(host.get("/", "evil.local:8080")[0], 200)

    def test_clients_find_them(self):
        a, _ = self.hosts
        result = a.run(BIN_DIR / "nao-phone", "gateways")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("PEPE on lab-b  http://192.168.77.2:8080  tcp 192.168.77.2:7668", result.stdout)
        self.assertIn("NAO on lab-a", result.stdout)

    @unittest.skipUnless(importlib.util.find_spec("zeroconf"), "no python3-zeroconf")
    def test_the_python_package_finds_them(self):
        a, _ = self.hosts
        code = "from nao_remote.discovery import from_network; print(sorted(from_network(3)))"
        environment = f"PYTHONPATH={BIN_DIR.parent / 'python'}"
        result = a.run("env", environment, sys.executable, "-c", code)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.strip(), "['tcp://192.168.77.1:7668', 'tcp://192.168.77.2:7668']")

    def test_what_ends_disappears_and_what_starts_again_is_found(self):
        a, b = self.hosts
        self.assertEqual(b.stop("gateway"), 0, "an announced gateway ends well")
        wait_for(lambda: a.names() == [], a, b)
        b.start_gateway()
        wait_for(lambda: a.names() == ["PEPE on lab-b"], a, b)
        # Its avahi-daemon may be restarted, too.
        b.stop("avahi")
        wait_for(lambda: b.gateways()["announced_as"] == "", a, b)
        b.start_avahi()
        wait_for(lambda: b.gateways()["announced_as"] == "PEPE on lab-b" and b.names() == ["NAO on lab-a"], a, b)

    def test_without_avahi_the_gateway_serves_and_says_so(self):
        folder = Path(tempfile.mkdtemp(prefix="nao-test-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        lonely = Host("lab-c", "SOLO", folder)
        ip("netns", "add", lonely.space)
        self.addCleanup(subprocess.run, ["ip", "netns", "delete", lonely.space], check=False, capture_output=True)
        ip("-n", lonely.space, "link", "set", "lo", "up", "multicast", "on")
        ip("-n", lonely.space, "route", "add", "default", "dev", "lo")
        self.addCleanup(lonely.stop_all)
        lonely.start_gateway()
        wait_for(lambda: "not announced in the local network: no D-Bus" in lonely.logs(), lonely)
        self.assertEqual(lonely.gateways(), {"announced_as": "", "alias": "", "gateways": []})


if __name__ == "__main__":
    unittest.main()
