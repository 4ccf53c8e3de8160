#!/usr/bin/python3
"""scripts/start, stop and status, as users call them."""

import json
import os
import re
import signal
import socket
import time
import unittest
import urllib.request
from pathlib import Path
from unittest import mock

from stack import BIN_DIR, DEADLINE, ROOT, Program, Stack, run

PROGRAMS = {"nao-sim", "nao-motion", "nao-motion-files", "nao-head-camera", "nao-speaker", "nao-phone-gateway"}


class Start(unittest.TestCase):
    def test_brings_everything_up_and_stop_leaves_no_process(self):
        with Stack() as stack:
            started = stack.start_or_fail()
            url = re.search(r"http://127\.0\.0\.1:\d+/#token=\S+", started.stdout)
            self.assertIsNotNone(url, started.stdout)
            self.assertEqual(url[0], f"http://127.0.0.1:{stack.http_port}/#token={stack.token}")
            with urllib.request.urlopen(url[0], timeout=30) as page:
                self.assertEqual(page.status, 200)
                self.assertIn(b"<script", page.read())
            self.assertLessEqual(PROGRAMS, set(stack.pids()))

            stopped = stack.stop()
            self.assertEqual(stopped.returncode, 0, stopped.stderr)
            self.assertEqual(stack.pids(), {})
            self.assertIn("Nothing was running", stack.stop().stdout)

    def test_serves_foxglove_if_asked_to(self):
        with Stack() as stack:
            started = stack.start_or_fail("--only", "sim,motion", "--foxglove")
            address = re.search(r"ws://(127\.0\.0\.1:\d+)", started.stdout)
            self.assertIsNotNone(address, started.stdout)
            with urllib.request.urlopen(f"http://{address[1]}/robot/robot.urdf", timeout=30) as file:
                self.assertIn(b"<robot", file.read())
            self.assertIn(address[0], stack.start("--foxglove").stdout, "told again")

    def test_a_second_system_on_the_bus_is_refused_and_the_first_is_named(self):
        with Stack() as first, Stack() as second:
            second.lcm_url = first.lcm_url
            first.start_or_fail("--only", "sim,motion")
            refused = second.start("--only", "sim,motion")
            self.assertEqual(refused.returncode, 1, refused.stdout)
            self.assertRegex(refused.stderr, r"another system publishes on NAO_SENSOR_STATE.*nao-sim of host \S+ \(process \d+\)")
            self.assertEqual(second.pids(), {})
            # A part of one system, which publishes nothing that the first one does.
            second.start_or_fail("--only", "head-camera")

    def test_a_second_simulator_is_named_while_it_runs_and_never_obeyed_in_turns(self):
        with Stack() as stack:
            stack.start_or_fail("--only", "sim,motion")
            # As when two networks are joined.
            other = Program("nao-sim", stack.lcm_url)
            self.addCleanup(other.kill)
            deadline = time.monotonic() + DEADLINE
            status = stack.script("status")
            named = r"two programs publish on .*NAO_SENSOR_STATE: nao-sim of host \S+ \(process \d+\), nao-sim of host"
            while not re.search(named, status.stdout):
                self.assertLess(time.monotonic(), deadline, status.stdout)
                status = stack.script("status")
            for posture in ("Crouch", "StandInit"):
                result = stack.nao("posture", posture)
                self.assertEqual(result.returncode, 0, result.stderr)

    def test_needs_nothing_of_its_environment(self):
        with Stack() as stack:
            poor = {name: value for name, value in os.environ.items() if name not in ("HOME", "USER", "LOGNAME", "XDG_RUNTIME_DIR")}
            poor |= {"LC_ALL": "xx_YY.UTF-8", "PYTHONIOENCODING": "ascii", "TMPDIR": "/nonexistent"}
            switch = Path("/proc/sys/net/ipv6/conf/all/disable_ipv6")
            # A host without IPv6, where this test has a network of its own.
            if switch.exists() and os.access(switch, os.W_OK) and len(socket.if_nameindex()) == 1:
                switch.write_text("1")
                self.addCleanup(switch.write_text, "0")
            # Of a process that has ended, or is another one's.
            (stack.run_dir / "supervisord.pid").write_text(str(os.getpid()))
            started = run([ROOT / "scripts/start", "--bin", BIN_DIR, "--run-dir", stack.run_dir, "--lcm-url", stack.lcm_url, "--token", "t",
                           "--http-port", stack.http_port, "--tcp-port", stack.tcp_port, "--only", "sim,motion,phone-gateway"], env=poor)
            self.assertEqual(started.returncode, 0, started.stderr)
            obeyed = run([BIN_DIR / "nao", "--lcm-url", stack.lcm_url, "posture", "Crouch"], env=poor)
            self.assertEqual(obeyed.returncode, 0, obeyed.stderr)

    def test_status_says_when_nothing_runs(self):
        with Stack() as stack:
            status = stack.script("status")
            self.assertEqual(status.returncode, 1)
            self.assertIn("scripts/start", status.stderr)

    def test_names_who_holds_the_port(self):
        with Stack() as stack, socket.socket() as holder:
            holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            holder.bind(("127.0.0.1", stack.http_port))
            holder.listen()
            result = stack.start()
            self.assertEqual(result.returncode, 1)
            self.assertIn(f"port {stack.http_port} is in use", result.stderr)
            self.assertIn("--http-port", result.stderr)
            self.assertEqual(stack.pids(), {})

    def test_takes_the_next_port_if_it_may_choose(self):
        with Stack() as stack, socket.socket() as holder:
            try:
                holder.bind(("127.0.0.1", 8080))
                holder.listen()
            except OSError:
                pass  # another program holds it: equivalent
            started = stack.start("--only", "sim,motion,phone-gateway", ports=False)
            self.assertEqual(started.returncode, 0, started.stderr + stack.logs())
            self.assertRegex(started.stdout, r"Port 8080 is in use by .*; taking 80[89]\d instead")
            self.assertNotIn(":8080/", started.stdout)

    def test_two_stacks_do_not_hear_each_other(self):
        with Stack() as one, Stack() as other:
            one.start_or_fail("--only", "sim,motion")
            other.start_or_fail("--only", "sim,motion")
            for stack in (one, other):
                heard = json.loads(stack.nao("status", "--json").stdout)
                own = {stack.pids()[name] for name in ("nao-sim", "nao-motion", "nao")}
                self.assertEqual({program["process_id"] for program in heard}, own)

    def test_says_which_program_crashes_and_stops_the_others(self):
        with Stack() as stack:
            result = stack.start("--scene", "no-such-scene")
            self.assertEqual(result.returncode, 1)
            self.assertIn("nao-sim does not start", result.stderr)
            self.assertIn("no-such-scene", result.stderr)
            self.assertEqual(stack.pids(), {})

    def test_leaves_out_what_driving_does_not_need(self):
        # Without a vendor library EGL finds no driver: the camera crashes.
        with mock.patch.dict(os.environ, {"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent"}), Stack() as stack:
            result = stack.start_or_fail()
            self.assertIn("nao-head-camera does not start and is left out", result.stderr)
            self.assertIn("no OpenGL without a screen", result.stderr)
            self.assertIn(f"#token={stack.token}", result.stdout)
            self.assertEqual(stack.nao("walk", "0.1", "0", "0", "--for", "1").returncode, 0)

    def test_a_program_that_crashes_again_and_again_stays_down_and_status_says_so(self):
        with Stack() as stack:
            stack.start_or_fail("--only", "sim,motion")
            killed = set()
            # The delays between ten restarts add up to a minute.
            deadline = time.monotonic() + 5 * DEADLINE
            status = stack.script("status")
            while "given up" not in status.stdout:
                self.assertLess(time.monotonic(), deadline, status.stdout)
                pid = stack.pids().get("nao-motion")
                if pid is not None and pid not in killed:
                    os.kill(pid, signal.SIGKILL)
                    killed.add(pid)
                time.sleep(0.1)
                status = stack.script("status")
            self.assertGreaterEqual(len(killed), 10)
            self.assertEqual(status.returncode, 1)
            self.assertRegex(status.stdout, r"nao-motion .*given up.*crashed ten times.*nao-motion\.log|"
                                            r"nao-motion .*given up.*nao-motion\.log.*crashed ten times")
            self.assertRegex(status.stdout, r"nao-sim .*ready")


class Running(unittest.TestCase):
    """What a running stack shows; the tests share one start."""

    @classmethod
    def setUpClass(cls):
        cls.stack = Stack()
        cls.addClassCleanup(cls.stack.__exit__)
        cls.started = cls.stack.start_or_fail("--no-camera")

    def test_the_token_is_only_in_a_file_of_its_owner(self):
        file = self.stack.run_dir / "token"
        self.assertEqual(file.read_text(), f"{self.stack.token}\n")
        self.assertEqual(file.stat().st_mode & 0o777, 0o600)
        # Every user of this machine may read command lines.
        for pid in self.stack.pids().values():
            self.assertNotIn(self.stack.token.encode(), Path(f"/proc/{pid}/cmdline").read_bytes())

    def test_twice_says_so_and_gives_the_same_address(self):
        pids = self.stack.pids()
        second = self.stack.start()
        self.assertEqual(second.returncode, 0, second.stderr)
        self.assertIn("running already", second.stdout)
        address = re.search(r"http://\S+#token=\S+", self.started.stdout)[0]
        self.assertIn(address, second.stdout)
        self.assertEqual(self.stack.pids(), pids)

    def test_status_shows_every_program(self):
        rows = {row["program"]: row for row in json.loads(self.stack.script("status", "--json").stdout)}
        self.assertEqual(set(rows), PROGRAMS - {"nao-head-camera"} | {"nao-watchdog"})
        for row in rows.values():
            self.assertEqual(row["state"], "ready", row)
            self.assertGreater(row["memory_mb"], 1)
            self.assertEqual(row["restarts"], 0)
        table = self.stack.script("status")
        self.assertEqual(table.returncode, 0)
        self.assertEqual(len(table.stdout.splitlines()), 1 + len(rows))


    def test_status_and_start_agree_when_supervisors_socket_was_removed(self):
        socket_file = self.stack.run_dir / "supervisor.sock"
        kept = socket_file.with_suffix(".kept")
        socket_file.rename(kept)
        self.addCleanup(kept.rename, socket_file)
        status = self.stack.script("status", "--json")
        self.assertEqual(status.returncode, 0, status.stderr)
        self.assertIn("supervisor.sock has been removed", status.stderr)
        self.assertEqual({row["program"] for row in json.loads(status.stdout)}, PROGRAMS - {"nao-head-camera"} | {"nao-watchdog"})
        self.assertIn("running already", self.stack.start().stdout)


class CommandLine(unittest.TestCase):
    def test_every_script_explains_itself(self):
        for script in sorted((ROOT / "scripts").iterdir()):
            if not script.stat().st_mode & 0o100:
                continue
            with self.subTest(script=script.name):
                result = run([script, "--help"])
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertTrue(result.stdout.startswith(f"Usage: scripts/{script.name}"), result.stdout)

    def test_wrong_options_are_refused(self):
        for words in (["start", "--no-such"], ["start", "--http-port", "http"], ["start", "--only", "toaster"],
                      ["start", "--scene"], ["stop", "now"], ["status", "--no-such"], ["record", "--no-such"],
                      ["replay"], ["setup", "--with", "nothing"]):
            with self.subTest(words=words), Stack() as stack:
                result = run([ROOT / "scripts" / words[0], *words[1:]],
                             env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "NAO_REMOTE_RUN_DIR": str(stack.run_dir)})
                self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
                self.assertIn("--help", result.stderr)


if __name__ == "__main__":
    unittest.main()
