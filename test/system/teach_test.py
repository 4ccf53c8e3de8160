#!/usr/bin/python3
"""A motion is taught from a terminal: checked, saved, played, and still there after every program was restarted."""

import time
import unittest
from pathlib import Path

from stack import DEADLINE, Stack

BOW = """\
actions:
  - name: {name}
    keyframes:
      - {{duration: {duration}, joints: {{HipPitch: {hip}, AnklePitch: -0.22, ShoulderPitch: {shoulder}}}, pause: 0.3}}
      - {{duration: {duration}, posture: StandInit}}
"""


class Teaching(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = Stack()
        cls.addClassCleanup(cls.stack.__exit__)
        cls.start()

    @classmethod
    def start(cls):
        cls.stack.start_or_fail("--only", "sim,motion,motion-files")

    def write(self, name, duration=1.2, hip=-0.7, shoulder=1.4):
        path = self.stack.run_dir / f"{name}.yaml"
        path.write_text(BOW.format(name=name, duration=duration, hip=hip, shoulder=shoulder))
        return path

    def obeyed(self, *arguments):
        result = self.stack.nao(*arguments)
        self.assertEqual(result.returncode, 0, f"{arguments}: {result.stdout}{result.stderr}{self.stack.logs()}")
        return result.stdout

    def refused(self, *arguments):
        result = self.stack.nao(*arguments)
        self.assertEqual(result.returncode, 1, f"{arguments}: {result.stdout}{result.stderr}")
        return result

    def test_a_motion_is_saved_played_kept_and_deleted(self):
        file = self.write("bow")
        self.assertIn("safe", self.obeyed("motion", "check", file))
        self.obeyed("motion", "save", file)
        self.assertEqual(self.obeyed("motion", "list"), "bow\n")
        self.assertTrue((self.stack.run_dir / "motions/bow.yaml").exists())
        self.assertIn("is saved already", self.refused("motion", "save", file).stderr)
        self.obeyed("motion", "save", file, "--replace")
        self.obeyed("motion", "play", "bow")
        self.stack.stop()
        self.start()
        self.assertEqual(self.obeyed("motion", "list"), "bow\n")
        # nao-motion-files sends the saved motions to nao-motion twice a second.
        deadline = time.monotonic() + DEADLINE
        while "has no action" in self.stack.nao("motion", "play", "bow").stderr and time.monotonic() < deadline:
            time.sleep(0.1)
        self.obeyed("motion", "play", "bow")
        copy = Path(self.stack.run_dir / "copy.yaml")
        copy.write_text(self.obeyed("motion", "get", "bow"))
        self.obeyed("motion", "delete", "bow")
        self.assertEqual(self.obeyed("motion", "list"), "")
        self.obeyed("motion", "save", copy)
        self.obeyed("motion", "delete", "bow")

    def test_a_fall_is_told_with_its_keyframe(self):
        said = self.refused("motion", "save", self.write("dive", hip=-1.4)).stderr
        self.assertIn("keyframe 1: The robot would fall.", said)
        self.assertEqual(self.obeyed("motion", "list"), "")

    def test_what_is_too_fast_is_repaired(self):
        result = self.refused("motion", "save", self.write("fast", duration=0.11, hip=-0.6, shoulder=0.2))
        self.assertIn("needs at least", result.stderr)
        repaired = self.stack.run_dir / "repaired.yaml"
        repaired.write_text(result.stdout)
        self.assertIn("safe", self.obeyed("motion", "check", repaired))


if __name__ == "__main__":
    unittest.main()
