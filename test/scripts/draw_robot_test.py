#!/usr/bin/python3
"""Shells of any robot are drawn from the joints and collision shapes of its URDF."""

import json
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET
from pathlib import Path

ROBOTS = Path(__file__).resolve().parents[2] / "data/robots"

# A trunk with a leg of one joint along y, in sizes of a small and of a large robot.
URDF = """<robot name="x">
<link name="trunk"><inertial><mass value="{mass}"/></inertial>
  <collision><origin xyz="0 0 {size}"/><geometry><box size="{size} {size} {size}"/></geometry></collision></link>
<joint name="hip" type="revolute"><parent link="trunk"/><child link="leg"/><origin xyz="0 {size} 0"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="1" effort="5" velocity="5"/></joint>
<link name="leg"><inertial><mass value="{mass}"/></inertial></link>
<joint name="knee" type="revolute"><parent link="leg"/><child link="shank"/><origin xyz="0 {size} 0"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="1" effort="5" velocity="5"/></joint>
<link name="shank"/>
<joint name="eye_mount" type="fixed"><parent link="trunk"/><child link="eye"/><origin xyz="{size} 0 0"/></joint>
<link name="eye"/>
</robot>"""


def draw(urdf, *words):
    subprocess.run([sys.executable, "-B", ROBOTS / "draw_robot.py", urdf, *words], check=True)


def bounds(glb):
    """Least and greatest position of a binary glTF, and the names of its materials."""
    data = glb.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    document = json.loads(data[20:20 + length])
    least, greatest = [1e9] * 3, [-1e9] * 3
    for primitive in document["meshes"][0]["primitives"]:
        accessor = document["accessors"][primitive["attributes"]["POSITION"]]
        least = [min(a, b) for a, b in zip(least, accessor["min"])]
        greatest = [max(a, b) for a, b in zip(greatest, accessor["max"])]
    return least, greatest, {material["name"] for material in document["materials"]}


class DrawRobot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_each_link_with_a_visual_gets_its_mesh(self):
        drawn = [path.parent for path in ROBOTS.glob("*/robot.yaml") if not (path.parent / "generate_meshes.py").exists()
                 and "extends: " not in path.read_text()]
        self.assertGreater(len(drawn), 1)
        for robot in drawn:
            with self.subTest(robot=robot.name):
                urdf, folder = robot / f"{robot.name}.urdf", self.folder / robot.name
                draw(urdf, folder)
                visuals = ET.parse(urdf).findall("link/visual/geometry/mesh")
                self.assertGreater(len(visuals), 20)
                self.assertEqual({mesh.get("filename") for mesh in visuals},
                                 {f"meshes/{file.name}" for file in folder.glob("*.glb")})

    def test_shells_have_the_size_of_the_robot(self):
        for size in (0.05, 0.4):
            urdf = self.folder / "x.urdf"
            urdf.write_text(URDF.format(size=size, mass=20 * size))
            draw(urdf, "--add-visuals")
            draw(urdf, self.folder)
            least, greatest, _ = bounds(self.folder / "leg.glb")
            # From the hip's disc to the dome about the knee.
            self.assertGreater(greatest[1], size)
            self.assertLess(greatest[1], 1.5 * size)
            self.assertLess(least[1], 0)

    def test_visuals_are_added_once(self):
        urdf = self.folder / "x.urdf"
        urdf.write_text(URDF.format(size=0.1, mass=1))
        draw(urdf, "--add-visuals")
        text = urdf.read_text()
        self.assertEqual(text.count("<visual>"), 3, "trunk, leg, and the disc of the knee")
        draw(urdf, "--add-visuals")
        self.assertEqual(urdf.read_text(), text)

    def test_a_camera_is_a_dark_lens(self):
        urdf = self.folder / "x.urdf"
        urdf.write_text(URDF.format(size=0.1, mass=1))
        draw(urdf, "--add-visuals")
        for link, has_lens in (("eye", True), ("leg", False)):
            (self.folder / "robot.yaml").write_text(f"cameras:\n  - {{name: a, link: {link}, horizontal_fov: 1}}\n")
            draw(urdf, self.folder)
            least, greatest, materials = bounds(self.folder / "trunk.glb")
            self.assertEqual(greatest[0] > 0.1, has_lens, link)


if __name__ == "__main__":
    unittest.main()
