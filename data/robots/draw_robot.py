#!/usr/bin/python3
"""Draws the shells of any robot: one binary glTF (.glb) for each mesh "meshes/NAME.glb" that a visual of its URDF
names, in meters, in the frame of the link, z up.

A link is drawn as its collision primitives with rounded edges, bars from its origin to the joints of the links that
hang on it, or to its shapes at the end of a limb, and a disc about the axis of its own joint. The cameras of the
robot.yaml beside the URDF are dark lenses on the links that carry them. With --add-visuals the URDF gets a visual for
each link that has something to draw and no visual yet."""

import argparse
import math
import pathlib
import re
import sys
import xml.etree.ElementTree as ET

from mesh import Mesh, replace_file
from solids import Tube, ball, puck, revolve

# Chosen for the look: density of a bar, kg/m^3, from which its thickness follows, and bounds of its radius relative to
# its length; radius of a joint's disc per cube root of its torque, m/(N m)^(1/3), and half its width relative to it.
DENSITY = 900
BAR_RADII = (0.12, 0.28)
DISC_RADIUS = 0.0115
DISC_WIDTH = 0.75
# Bars shorter than this part of their disc's radius are inside of it.
LEAST_BAR = 1.5
LENS_RADIUS = 0.014


def numbers(text, default):
    return [float(word) for word in text.split()] if text else list(default)


def rotation(roll, pitch, yaw):
    """Rows of Rz(yaw) Ry(pitch) Rx(roll)."""
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr]]


class Pose:
    """An <origin>."""

    def __init__(self, element):
        origin = element.find("origin")
        attributes = origin.attrib if origin is not None else {}
        self.xyz = numbers(attributes.get("xyz"), (0, 0, 0))
        self.rows = rotation(*numbers(attributes.get("rpy"), (0, 0, 0)))

    def point(self, p):
        return tuple(o + sum(r * x for r, x in zip(row, p)) for o, row in zip(self.xyz, self.rows))

    def solid(self, triangles):
        return [(material, *(self.point(corner) for corner in corners)) for material, *corners in triangles]


def rounded_box(size, material):
    """A box with rounded edges along z and flat domes."""
    a, b, h = (edge / 2 for edge in size)
    dome = 0.25 * min(a, b, h)
    stations = [(z, 0, 0, a * s, a * s, b * s, b * s, 5.0)
                for z, s in ((-h + dome, 0.96), (-h / 3, 1.0), (h / 3, 1.0), (h - dome, 0.96))]
    return Tube("z", stations, start_dome=dome, end_dome=dome).solid(material, segments=24)


def bar(start, end, radius, material):
    """A round bar with domes, thinner at its end."""
    along = tuple(b - a for a, b in zip(start, end))
    length = math.hypot(*along)
    tip = 0.75 * radius
    profile = [(0, -radius), (0.7 * radius, -0.7 * radius), (radius, 0), (1.05 * radius, length / 3), (tip, length),
               (0.7 * tip, length + 0.7 * tip), (0, length + tip)]
    return revolve(start, along, profile, material, 18)


def primitive(collision, material):
    """Triangles of a collision shape, or an empty list for a mesh."""
    pose = Pose(collision)
    geometry = collision.find("geometry")
    box, cylinder, sphere = (geometry.find(kind) for kind in ("box", "cylinder", "sphere"))
    if box is not None:
        return pose.solid(rounded_box(numbers(box.get("size"), ()), material))
    if sphere is not None:
        return pose.solid(ball((0, 0, 0), float(sphere.get("radius")), material, 24, 14))
    if cylinder is not None:
        radius, half = float(cylinder.get("radius")), float(cylinder.get("length")) / 2
        if collision.get("name", "").endswith("_capsule"):
            profile = [(0, -half - radius), (0.7 * radius, -half - 0.7 * radius), (radius, -half), (radius, half),
                       (0.7 * radius, half + 0.7 * radius), (0, half + radius)]
            return pose.solid(revolve((0, 0, 0), (0, 0, 1), profile, material, 20))
        return pose.solid(puck((0, 0, 0), (0, 0, 1), radius, half, 0.2 * min(radius, half), material, 22))
    return []


class Robot:
    """The links and joints of a URDF. `cameras` are names of the links that are their frames."""

    def __init__(self, root, cameras):
        self.cameras = cameras
        self.links = {link.get("name"): link for link in root.findall("link")}
        self.joints = root.findall("joint")

    def children(self, link):
        return [joint for joint in self.joints if joint.find("parent").get("link") == link]

    def parent_joint(self, link):
        return next((joint for joint in self.joints if joint.find("child").get("link") == link), None)

    def mass(self, link):
        mass = self.links[link].find("inertial/mass")
        return float(mass.get("value")) if mass is not None else 0

    def shapes(self, link):
        return self.links[link].findall("collision")

    def draw(self, link):
        """The mesh of a link; without triangles if there is nothing to draw."""
        mesh = Mesh()
        own = self.parent_joint(link)
        is_end = not any(joint.get("type") != "fixed" for joint in self.children(link))
        for shape in self.shapes(link):
            mesh.add(primitive(shape, "dark" if is_end and own is not None and self.is_flat(shape) else "white"))
        disc = 0
        if own is not None and own.get("type") != "fixed":
            effort = float(own.find("limit").get("effort"))
            disc = DISC_RADIUS * effort ** (1 / 3)
            mesh.add(puck((0, 0, 0), numbers(own.find("axis").get("xyz"), (1, 0, 0)), disc, DISC_WIDTH * disc,
                          0.15 * disc, "grey", 20))
            if is_end:
                for shape in self.shapes(link):
                    self.add_bar(mesh, link, tuple(Pose(shape).xyz), disc)
        for joint in self.children(link):
            end = tuple(Pose(joint).xyz)
            if joint.find("child").get("link") in self.cameras:
                axis = tuple(row[0] for row in Pose(joint).rows)
                mesh.add(puck(end, axis, LENS_RADIUS, 0.006, 0.002, "dark", 16))
            elif joint.get("type") != "fixed":
                self.add_bar(mesh, link, end, disc)
        return mesh

    def add_bar(self, mesh, link, end, disc):
        length = math.hypot(*end)
        if length < LEAST_BAR * max(disc, 0.01):
            return
        radius = math.sqrt(self.mass(link) / (DENSITY * math.pi * length))
        radius = min(max(radius, BAR_RADII[0] * length), BAR_RADII[1] * length)
        # The root is drawn as its shapes; bars only lead to its joints.
        if self.parent_joint(link) is None:
            radius = min(radius, BAR_RADII[0] * length)
        mesh.add(bar((0, 0, 0), end, radius, "white" if self.parent_joint(link) is not None else "grey"))

    @staticmethod
    def is_flat(shape):
        box = shape.find("geometry/box")
        if box is None:
            return False
        size = numbers(box.get("size"), ())
        return size[2] < 0.5 * max(size)


def add_visuals(text, robot):
    """The URDF with a visual for each link that has something to draw and none yet."""
    for name, link in robot.links.items():
        if link.find("visual") is not None or not robot.draw(name).triangles:
            continue
        visual = f'\n        <visual><geometry><mesh filename="meshes/{name}.glb"/></geometry></visual>'
        text, count = re.subn(rf'<link name="{re.escape(name)}"\s*(/?)>', lambda match: f'<link name="{name}">{visual}' +
                              ("\n    </link>" if match[1] else ""), text)
        if count != 1:
            raise SystemExit(f"link {name} is written in a way that --add-visuals does not know; add its visual by hand")
    return text


def find_cameras(description):
    """Names of the links of `cameras` in a robot.yaml, one camera in a line."""
    found, is_inside = set(), False
    for line in description.splitlines():
        is_inside = line.startswith("cameras:") or (is_inside and line.startswith((" ", "#")))
        match = re.search(r"[{ ]link: *\"?([^,}\"]+)", line) if is_inside else None
        if match:
            found.add(match[1].strip())
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("urdf", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path, nargs="?", default=pathlib.Path("meshes"),
                        help="where the .glb files go")
    parser.add_argument("--add-visuals", action="store_true", help="write the URDF's missing visuals, and no mesh")
    arguments = parser.parse_args()
    text = arguments.urdf.read_text()
    description = arguments.urdf.parent / "robot.yaml"
    robot = Robot(ET.fromstring(text), find_cameras(description.read_text()) if description.exists() else set())
    if arguments.add_visuals:
        replace_file(arguments.urdf, add_visuals(text, robot))
        return
    for name, link in robot.links.items():
        for mesh in link.findall("visual/geometry/mesh"):
            file = mesh.get("filename")
            if file != f"meshes/{name}.glb":
                continue
            arguments.folder.mkdir(parents=True, exist_ok=True)
            drawn = robot.draw(name)
            if not drawn.triangles:
                sys.exit(f"{arguments.urdf}: link {name} has a visual and nothing to draw: no joint or collision shape")
            drawn.write(arguments.folder / f"{name}.glb")


if __name__ == "__main__":
    main()
