#!/usr/bin/python3
"""A replayed recording publishes the messages of the recorded run."""

import json
import signal
import subprocess
import time
import unittest
from pathlib import Path

from lcm_log import read_log
from stack import DEADLINE, ROOT, Stack


def messages(path, channel):
    return [event.data for event in read_log(path) if event.channel == channel]


class RecordReplay(unittest.TestCase):
    def test_a_replay_repeats_every_robot_state(self):
        with Stack() as stack, Stack() as silent:
            stack.start_or_fail("--only", "sim,motion")
            log = stack.run_dir / "run.lcmlog"
            recorder = subprocess.Popen([ROOT / "scripts/record", "--run-dir", stack.run_dir, log],
                                        stdout=subprocess.DEVNULL)
            self.addCleanup(recorder.kill)
            self.wait_for_file(log)
            self.assertEqual(stack.nao("posture", "Crouch").returncode, 0)
            recorder.terminate()
            recorder.wait(DEADLINE)
            states = messages(log, "NAO_ROBOT_STATE")
            self.assertGreater(len(states), 20)

            refused = stack.script("replay", log)
            self.assertEqual(refused.returncode, 1)
            self.assertIn("publishes the same channels as the log", refused.stderr)

            # Replay on another bus without other traffic.
            copy = stack.run_dir / "copy.lcmlog"
            second_recorder = subprocess.Popen(["lcm-logger", "--quiet", f"--lcm-url={silent.lcm_url}", copy])
            self.addCleanup(second_recorder.kill)
            self.wait_for_listener(silent.lcm_url)
            replayed = stack.script("replay", "--lcm-url", silent.lcm_url, log)
            self.assertEqual(replayed.returncode, 0, replayed.stderr)
            self.wait_for_silence(copy)
            second_recorder.terminate()
            second_recorder.wait(DEADLINE)
            # Under load the bus may lose messages, but it neither invents nor reorders them.
            heard = messages(copy, "NAO_ROBOT_STATE")
            rest = iter(states)
            self.assertTrue(all(state in rest for state in heard))
            self.assertGreater(len(heard), len(states) / 2)
            self.assertEqual(messages(copy, "NAO_JOINT_COMMAND"), [], "commands are not played unless asked for")

    def test_a_recorder_that_is_held_up_loses_nothing(self):
        with Stack() as stack:
            stack.start_or_fail("--only", "sim,motion")
            log = stack.run_dir / "run.lcmlog"
            recorder = subprocess.Popen([ROOT / "scripts/record", "--run-dir", stack.run_dir, log],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.addCleanup(recorder.kill)
            self.wait_for_file(log)
            for _ in range(3):
                recorder.send_signal(signal.SIGSTOP)
                time.sleep(0.5)
                recorder.send_signal(signal.SIGCONT)
                time.sleep(0.5)
            recorder.terminate()
            recorder.wait(DEADLINE)
            said = stack.nao("log", "info", "--json", log)
            self.assertEqual(said.returncode, 0, said.stderr)
            channels = {row["channel"]: row for row in json.loads(said.stdout)["channels"]}
            self.assertGreater(channels["NAO_SENSOR_STATE"]["messages"], 100)
            self.assertEqual(channels["NAO_SENSOR_STATE"]["missing_ticks"], 0)
            self.assertTrue(all(row["undecodable"] == 0 for row in channels.values()))

            # A part of the log, with a renamed channel.
            part = stack.run_dir / "part.lcmlog"
            cut = stack.nao("log", "cut", log, part, "--from", "1", "--to", "2", "--rename",
                            "NAO_SENSOR_STATE=OLD_SENSOR_STATE")
            self.assertEqual(cut.returncode, 0, cut.stderr)
            times = [event.time for event in read_log(part)]
            self.assertLessEqual(times[-1] - times[0], 1e6)
            self.assertGreater(len(messages(part, "OLD_SENSOR_STATE")), 20)
            self.assertEqual(messages(part, "NAO_SENSOR_STATE"), [])

            # The log itself is no output, also by a link.
            link = stack.run_dir / "link.lcmlog"
            link.symlink_to(part)
            before = part.read_bytes()
            for output in (part, link):
                refused = stack.nao("log", "cut", part, output)
                self.assertEqual(refused.returncode, 1)
                self.assertIn("itself", refused.stderr)
                self.assertEqual(part.read_bytes(), before)

            table = stack.nao("log", "csv", part, "OLD_SENSOR_STATE")
            self.assertIn("joint_position[HeadYaw]", table.stdout.splitlines()[0])
            missing = stack.nao("log", "csv", part, "NAO_SENSOR_STATE")
            self.assertEqual(missing.returncode, 1)
            self.assertIn("contains no message on NAO_SENSOR_STATE", missing.stderr)

    def wait_for_file(self, path):
        deadline = time.monotonic() + DEADLINE
        while not path.exists() or path.stat().st_size == 0:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)

    def wait_for_silence(self, path):
        """Waits until a recorder has stopped writing."""
        size = -1
        while path.stat().st_size != size:
            size = path.stat().st_size
            time.sleep(1)

    def wait_for_listener(self, lcm_url):
        """Waits until a process has opened the bus's port."""
        port = f"{int(lcm_url.split(':')[2].split('?')[0]):04X}"
        deadline = time.monotonic() + DEADLINE
        while f":{port} " not in Path("/proc/net/udp").read_text():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)


if __name__ == "__main__":
    unittest.main()
