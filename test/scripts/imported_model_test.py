#!/usr/bin/python3
"""scripts/start --model FILE.urdf: the robot is imported once, into a folder that the programs read."""

import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from imported_model import import_model, robot_name  # noqa: E402
from stack import Failure  # noqa: E402

# Writes what an import writes, counts its calls, and refuses an empty URDF.
TOOL = """#!/bin/sh
echo "$@" >> {calls}
test -s "$3" || exit 1
mkdir -p "$7/$5" && cp "$3" "$7/$5/$5.urdf"
"""


class ImportedModelTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.data = self.folder / "data"
        for name in ("scenes", "robots/nao"):
            (self.data / name).mkdir(parents=True)
        self.calls = self.folder / "calls"
        tool = self.folder / "bin/nao-tools"
        tool.parent.mkdir()
        tool.write_text(TOOL.format(calls=self.calls))
        tool.chmod(0o755)
        before = dict(os.environ)
        self.addCleanup(lambda: (os.environ.clear(), os.environ.update(before)))
        os.environ["XDG_CACHE_HOME"] = str(self.folder / "cache")
        self.urdf = self.folder / "My-Robot 2.urdf"
        self.urdf.write_text("<robot><mesh/></robot>")

    def start(self):
        os.environ["NAO_REMOTE_DATA"] = str(self.data)
        name = import_model(str(self.urdf), self.folder / "bin")
        return name, Path(os.environ["NAO_REMOTE_DATA"])

    def test_programs_read_the_imported_robot_beside_the_installed_data(self):
        name, data = self.start()
        self.assertEqual(name, "my_robot_2")
        self.assertTrue((data / "robots/my_robot_2/my_robot_2.urdf").is_file())
        self.assertEqual((data / "robots/nao").resolve(), (self.data / "robots/nao").resolve())
        self.assertTrue((data / "scenes").is_dir())

    def test_it_is_imported_again_only_when_the_file_has_changed(self):
        first = self.start()
        self.assertEqual(self.start(), first)
        self.assertEqual(len(self.calls.read_text().splitlines()), 1)
        self.urdf.write_text("<robot><mesh/><link/></robot>")
        self.assertNotEqual(self.start()[1], first[1])
        self.assertEqual(len(self.calls.read_text().splitlines()), 2)

    def test_a_failed_import_leaves_nothing_and_is_told(self):
        self.urdf.write_text("")
        with self.assertRaisesRegex(Failure, "is not imported"):
            self.start()
        self.assertEqual(list((self.folder / "cache/nao-remote").iterdir()), [])
        with self.assertRaisesRegex(Failure, "there is no"):
            import_model("nowhere.urdf", self.folder / "bin")

    def test_a_file_with_a_general_name_is_called_like_its_folder(self):
        self.assertEqual(robot_name(Path("/x/Big Bot/robot.urdf")), "big_bot")


if __name__ == "__main__":
    unittest.main()
