#!/usr/bin/python3
"""A stack that a deployment file spreads over three hosts, and what is wrong with other files."""

import json
import os
import tempfile
import time
import unittest
from pathlib import Path

from hosts import GROUP, Hosts
from stack import BIN_DIR, DEADLINE, ROOT, run

FIELD, EYES, BRAIN = "field", "eyes", "brain"


class Files(unittest.TestCase):
    """Nothing is started."""

    def refusal(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "hosts.yaml"
            file.write_text(text)
            result = run([ROOT / "scripts/hosts", file, "status", "--ssh", "false"])
            self.assertNotEqual(result.returncode, 0)
            return result.stderr

    def test_what_is_wrong_is_named(self):
        here = "hosts:\n  - name: a\n    programs: sim motion-files speaker phone-gateway head-camera"
        for text, said in (
                ("", "has no keys"),
                ("hosts: 3", "hosts is not a list"),
                ("host: []", "unknown key 'host'"),
                ("hosts:\n  - {name: a, programs: [sim], where: b}", "host 1 has the unknown key 'where'"),
                ("hosts: [{programs: sim}]", "name of host 1 is not text"),
                (here, "nao-motion runs on no host"),
                (here + " motion\n  - name: b\n    programs: motion", "nao-motion runs on a and b"),
                (here + " motion toaster", "unknown program 'nao-toaster'"),
                (here + " motion\n  - name: a\n    programs: []", "two hosts are called a"),
                (here + " motion\n    robots: NAO7", "unknown robot 'NAO7'; there are: NAO"),
                ("start: --match 1v1\n" + here + " motion referee\n    robots: NAO1", "nao-motion of NAO2 runs on no host"),
                ("start: --only sim\n" + here + " motion", "start has --only"),
                ("start: --no-such\n" + here, "unknown option --no-such"),
                ("hosts: [", "cannot be read")):
            with self.subTest(text=text):
                self.assertIn(said, self.refusal(text))

    def test_a_host_without_a_connection_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "hosts.yaml"
            file.write_text("hosts:\n  - {name: far, ssh: ana@nowhere, programs: "
                            "sim motion motion-files speaker phone-gateway head-camera}")
            far = Path(folder) / "ssh"
            far.write_text("#!/bin/sh\nexit 255\n")
            far.chmod(0o755)
            result = run([ROOT / "scripts/hosts", file, "--ssh", far])
            self.assertEqual(result.returncode, 1)
            self.assertIn("no connection to ana@nowhere", result.stderr)
            self.assertIn("far does not start", result.stderr)


@unittest.skipIf(Hosts.missing(), Hosts.missing())
class Deployment(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hosts = Hosts([FIELD, EYES, BRAIN], 20000 + os.getpid() % 10000, 0.001, 0)
        cls.hosts.__enter__()
        cls.addClassCleanup(cls.hosts.__exit__)
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.file = cls.folder / "hosts.yaml"
        cls.lcm_url = f"udpm://{GROUP}:{cls.hosts.port}?ttl=1"
        common = f"--bin {BIN_DIR} --bind 127.0.0.1 --token x"
        cls.file.write_text(f"""
start: --match 1v1 {common}
lcm_url: {cls.lcm_url}
hosts:
  - {{name: field, ssh: {FIELD}, folder: {ROOT}, programs: sim referee phone-gateway motion-files speaker,
      options: --http-port 8080 --tcp-port 7668, run_dir: {cls.folder}/{FIELD}}}
  - {{name: eyes, ssh: {EYES}, folder: {ROOT}, programs: head-camera motion, robots: NAO1,
      run_dir: {cls.folder}/{EYES}}}
  - {{name: brain, ssh: {BRAIN}, folder: {ROOT}, programs: [head-camera, motion], robots: [NAO2],
      run_dir: {cls.folder}/{BRAIN}}}
""")
        # In place of ssh: the host is a network namespace of this machine.
        cls.ssh = cls.folder / "ssh"
        cls.ssh.write_text('#!/bin/sh\nshift 4\nhost=$1\nshift\n'
                           f'exec ip netns exec "{cls.hosts.prefix}$host" sh -c "$*"\n')
        cls.ssh.chmod(0o755)

    def call(self, command):
        return run([ROOT / "scripts/hosts", self.file, command, "--ssh", self.ssh])

    def on_field(self, *words):
        return run([*self.hosts.on(FIELD), BIN_DIR / words[0], *words[1:]])

    def processes(self):
        found = []
        for process in Path("/proc").glob("[0-9]*"):
            try:
                if f"NAO_REMOTE_STACK={self.folder}".encode() in (process / "environ").read_bytes():
                    found.append((process / "cmdline").read_bytes().split(b"\0")[0].decode())
            except OSError:
                continue
        return sorted(Path(name).name for name in found if name.startswith(str(BIN_DIR)))

    def test_parts_on_three_hosts_make_one_match(self):
        started = self.call("start")
        self.addCleanup(self.call, "stop")
        self.assertEqual(started.returncode, 0, started.stdout + started.stderr)
        ready = self.on_field("nao", "--lcm-url", self.lcm_url, "status", "--wait",
                              "nao-sim,nao-referee,nao-phone-gateway" + 2 * ",nao-motion,nao-head-camera,nao-motion-files",
                              "--timeout", "60")
        self.assertEqual(ready.returncode, 0, ready.stderr)
        programs = self.processes()
        for program, count in (("nao-sim", 1), ("nao-referee", 1), ("nao-phone-gateway", 1), ("nao-motion", 2),
                               ("nao-head-camera", 2), ("nao-motion-files", 2)):
            self.assertEqual(programs.count(program), count, programs)
        # A robot whose motion is on another host, by a phone.
        done = self.on_field("nao-phone", "--port", "7668", "--robot", "NAO2", "posture", "Crouch")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        truth = json.loads(self.on_field("nao", "--lcm-url", self.lcm_url, "world", "show", "--json").stdout)
        heights = [robot["position_torso_in_world"][2] for robot in truth["robots"]]
        self.assertAlmostEqual(heights[1], 0.229, delta=0.02)
        image = self.folder / "image.jpg"
        taken = self.on_field("nao-phone", "--port", "7668", "--robot", "NAO1", "image", image)
        self.assertEqual(taken.returncode, 0, taken.stdout + taken.stderr)
        self.assertTrue(image.read_bytes().startswith(b"\xff\xd8"))
        status = self.call("status")
        self.assertEqual(status.returncode, 0, status.stderr)
        self.assertIn("== brain", status.stdout)

        stopped = self.call("stop")
        self.assertEqual(stopped.returncode, 0, stopped.stderr)
        deadline = time.monotonic() + DEADLINE
        while self.processes() and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertEqual(self.processes(), [])


if __name__ == "__main__":
    unittest.main()
