#!/usr/bin/python3
"""data/robots/derive.py makes complete files of a robot that extends another."""

import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "data/robots"))
import derive  # noqa: E402

BASE_YAML = """# Head.
urdf: a.urdf

# Of motors.
motors:
  - {name: a}

# Of cameras.
cameras:
  - one
  # comment inside
  - two

last: 1
"""
BASE_URDF = """<?xml version="1.0"?>
<robot name="a">
  <!-- kept -->
  <link name="x"><inertial><mass value="1"/></inertial><visual/><collision name="p"/><collision name="q"/></link>
  <joint name="x"><limit lower="0"/><axis xyz="1 0 0"/></joint>
</robot>
"""


class Derive(unittest.TestCase):
    def test_a_section_is_replaced_with_its_comment(self):
        merged = derive.merge_yaml(BASE_YAML, "# Own.\nextends: a\n\n# Other cameras.\ncameras: [three]\n\nown: 2\n")
        self.assertEqual(merged, BASE_YAML.replace(
            "# Of cameras.\ncameras:\n  - one\n  # comment inside\n  - two\n", "# Other cameras.\ncameras: [three]\n") + "own: 2\n")

    def test_without_differences_the_file_is_the_same(self):
        for file in (ROOT / "data/robots/nao").glob("*.yaml"):
            self.assertEqual(derive.merge_yaml(file.read_text(), "extends: nao\n"), file.read_text(), file)

    def test_a_section_that_is_there_twice_is_refused(self):
        with self.assertRaisesRegex(derive.DeriveError, "'a' is there twice"):
            derive.merge_yaml("a: 1\na: 2\n", "")

    def test_parts_of_links_and_joints_are_replaced(self):
        merged = derive.merge_urdf(BASE_URDF, """<robot name="b">
            <!-- own --><link name="x"><inertial><mass value="2"/></inertial><collision name="r"/></link>
            <joint name="x"><limit lower="-1"/></joint></robot>""")
        self.assertIn("<!-- kept -->", merged)
        robot = ET.fromstring(merged)
        self.assertEqual(robot.get("name"), "b")
        self.assertEqual([mass.get("value") for mass in robot.iter("mass")], ["2"])
        self.assertEqual([shape.get("name") for shape in robot.iter("collision")], ["r"])
        self.assertEqual(len(list(robot.iter("visual"))), 1)
        self.assertEqual([limit.get("lower") for limit in robot.iter("limit")], ["-1"])
        self.assertEqual(len(list(robot.iter("axis"))), 1)

    def test_a_link_that_the_base_lacks_is_refused(self):
        with self.assertRaisesRegex(derive.DeriveError, "no link 'y'"):
            derive.merge_urdf(BASE_URDF, '<robot name="b"><link name="y"/></robot>')

    def test_a_wrong_file_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            base, own = Path(folder) / "base", Path(folder) / "own"
            for robot, text in ((base, BASE_URDF), (own, "<robot")):
                robot.mkdir()
                (robot / "a.urdf").write_text(text)
            with self.assertRaisesRegex(derive.DeriveError, "own/a.urdf: "):
                derive.derive(base, own, Path(folder) / "output")

    def test_the_v6_differs_from_the_v5_as_its_files_say(self):
        with tempfile.TemporaryDirectory() as folder:
            base, own, output = ROOT / "data/robots/nao", ROOT / "data/robots/nao_v6", Path(folder)
            derive.derive(base, own, output)
            self.assertEqual(derive.files_of(output), sorted([*derive.files_of(base), "head_cameras.yaml"]))

            def masses(file):
                return {link.get("name"): float(link.find("inertial/mass").get("value"))
                        for link in ET.parse(file).getroot().iter("link") if link.find("inertial") is not None}

            v5, v6 = masses(base / "nao.urdf"), masses(output / "nao.urdf")
            self.assertEqual(v6, {**v5, "Head": 0.65937})
            self.assertNotIn("extends", (output / "robot.yaml").read_text())
            for name in derive.files_of(base):
                if name not in derive.files_of(own):
                    self.assertEqual((output / name).read_bytes(), (base / name).read_bytes())


if __name__ == "__main__":
    unittest.main()
