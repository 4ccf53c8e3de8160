#!/usr/bin/python3
"""A replayed recording publishes the messages of the recorded run."""

import json
import signal
import subprocess
import time
import unittest
from pathlib import Path

from lcm_log import HEADER, Event, read_log, write_log
from stack import BIN_DIR, DEADLINE, ROOT, Stack, run


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
            second_recorder = subprocess.Popen([BIN_DIR / "nao", "record", copy, "--lcm-url", silent.lcm_url],
                                               stderr=subprocess.DEVNULL)
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
            # At rest the simulator would send one state in ten ticks.
            walk = subprocess.Popen([BIN_DIR / "nao", "--lcm-url", stack.lcm_url, "walk", "0", "0", "0.2", "--for", "20"],
                                    stdout=subprocess.DEVNULL)
            self.addCleanup(walk.kill)
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

            # The log itself is not a valid output, also by a link.
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

    def test_a_damaged_log_is_read_to_its_end_and_every_tool_says_what_was_skipped(self):
        with Stack() as stack:
            stack.start_or_fail("--only", "sim,motion")
            log = stack.run_dir / "run.lcmlog"
            self.assertEqual(stack.nao("record", log, "--for", "3").returncode, 0)
            events = read_log(log)
            damaged = stack.run_dir / "damaged.lcmlog"
            num_sensed = sum(event.channel == "NAO_SENSOR_STATE" and 1e6 <= event.time - events[0].time < 2e6
                             for event in events)
            self.assertGreater(num_sensed, 0)

            # One message of 1970, one whose content is damaged, and one with a length of 2 GB.
            middle = len(events) // 2
            index = next(i for i, event in enumerate(events) if event.channel == "NAO_SENSOR_STATE" and i > 20)
            events[middle] = events[middle]._replace(time=12)
            events[index] = events[index]._replace(data=events[index].data[:-8])
            write_log(damaged, events)
            content = bytearray(damaged.read_bytes())
            place = sum(HEADER.size + len(event.channel) + len(event.data) for event in events[:10])
            for length in (b"\x7f\xff\xff\xff", (len(content) // 2).to_bytes(4, "big")):
                with self.subTest(length=length):
                    content[place + 24:place + 28] = length
                    damaged.write_bytes(content)
                    self.check_damaged(stack, damaged, len(events) - 1, num_sensed)

    def check_damaged(self, stack, log, num_messages, num_sensed):
        info = stack.nao("log", "info", "--json", log)
        said = json.loads(info.stdout)
        self.assertEqual(sum(row["messages"] for row in said["channels"]), num_messages)
        self.assertLess(said["duration_s"], 10)
        self.assertRegex(info.stderr, r"skipped \d+ damaged bytes, by their numbers 1 messages")
        self.assertRegex(info.stderr, "the times of the messages step 2 times")
        part = stack.run_dir / "part.lcmlog"
        cut = stack.nao("log", "cut", log, part, "--from", "1", "--to", "2")
        self.assertEqual(cut.returncode, 0, cut.stderr)
        self.assertAlmostEqual(len(messages(part, "NAO_SENSOR_STATE")), num_sensed, delta=2)
        table = stack.nao("log", "csv", log, "NAO_SENSOR_STATE")
        self.assertIn("NAO_SENSOR_STATE: skipped 1 damaged messages", table.stderr)
        self.assertNotIn("another version", table.stderr)
        mcap = stack.nao("log", "mcap", log, stack.run_dir / "run.mcap")
        self.assertEqual(mcap.returncode, 0, mcap.stderr)
        begin = time.monotonic()
        replayed = stack.script("replay", "--force", "--speed", "3", "--all", log)
        self.assertLess(time.monotonic() - begin, 30)
        self.assertEqual(replayed.returncode, 0, replayed.stderr)
        self.assertIn("damaged bytes", replayed.stderr)

    def test_an_export_that_fails_leaves_no_file(self):
        with Stack() as stack:
            log = stack.run_dir / "run.lcmlog"
            write_log(log, [Event(0, 1, "A", b"12345678" * 1000)] * 100)
            for words in (["mcap", log, stack.run_dir / "full/run.mcap"], ["cut", log, stack.run_dir / "full/part.lcmlog"]):
                with self.subTest(words):
                    (stack.run_dir / "full").mkdir(exist_ok=True)
                    failed = run(["prlimit", "--fsize=100", "sh", "-c", "trap '' XFSZ; exec \"$@\"", "sh", BIN_DIR / "nao", "log",
                                  *words])
                    self.assertEqual(failed.returncode, 1)
                    self.assertIn("File too large", failed.stderr)
                    self.assertEqual(list((stack.run_dir / "full").iterdir()), [], failed.stderr)

    def wait_for_file(self, path):
        deadline = time.monotonic() + DEADLINE
        while not path.exists() or path.stat().st_size == 0:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)

    def wait_for_silence(self, path):
        """Waits until a recorder hears no states any more; its own status goes on."""
        num_states = -1
        while len(messages(path, "NAO_ROBOT_STATE")) != num_states:
            num_states = len(messages(path, "NAO_ROBOT_STATE"))
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
