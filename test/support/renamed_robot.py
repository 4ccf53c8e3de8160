#!/usr/bin/env python3
"""Copies a robot's folder with every link, joint, posture, action and camera renamed to a random
string, and with the links, joints and motors in a random order. The copy is the same robot: its
trials must be the same, bit for bit.

names.txt in the copy lists the names: kind, old name, new name."""

import argparse
import pathlib
import random
import shutil
import string
import xml.etree.ElementTree as ElementTree

import yaml

KEYFRAME_FILES = [("transitions.yaml", "transitions"), ("actions/keeper.yaml", "actions")]


class Names:
    """New names, by kind and old name."""

    def __init__(self, rng):
        self.rng = rng
        self.new = {}

    def add(self, kind, old):
        name = "".join(self.rng.choice(string.ascii_letters) for _ in range(12))
        return self.new.setdefault((kind, old), name)

    def of(self, kind, old):
        return self.new[kind, old]

    def joint(self, old):
        """A joint, or the name of a mirrored pair of joints."""
        return self.new[("joint", old) if ("joint", old) in self.new else ("pair", old)]

    def joints(self, entries):
        return {self.joint(name): value for name, value in entries.items()}


def rename_urdf(source, target, names):
    tree = ElementTree.parse(source)
    robot = tree.getroot()
    for kind in ("link", "joint"):
        for element in robot.findall(kind):
            element.set("name", names.add(kind, element.get("name")))
    for joint in robot.findall("joint"):
        for end in ("parent", "child"):
            joint.find(end).set("link", names.of("link", joint.find(end).get("link")))
        mimic = joint.find("mimic")
        if mimic is not None:
            mimic.set("joint", names.of("joint", mimic.get("joint")))
    elements = list(robot)
    for element in elements:
        robot.remove(element)
    names.rng.shuffle(elements)
    robot.extend(elements)
    tree.write(target)


def rename_robot(robot, names):
    """Renames what robot.yaml names, in place."""
    def link(name):
        return names.of("link", name)

    motors = list(robot["motors"].items())
    names.rng.shuffle(motors)
    robot["motors"] = names.joints(dict(motors))
    for limit in robot["coupled_limits"]:
        for key in ("joint", "depends_on"):
            limit[key] = names.joint(limit[key])
    for group in robot["joint_groups"]:
        for axis in ("yaw", "pitch", "roll", "opening"):
            if axis in group:
                group[axis] = names.joint(group[axis])
    for camera in robot["cameras"]:
        camera["name"] = names.add("camera", camera["name"])
        camera["link"] = link(camera["link"])
    for key in ("inertial_unit", "hands"):
        robot[key] = {part: link(name) for part, name in robot[key].items()}
    robot["foot_sensors"] = [link(name) for name in robot["foot_sensors"]]
    for sole in robot["soles"].values():
        sole["link"] = link(sole["link"])
    for pair in robot["mirrored_joints"]:
        if ("joint", pair["name"]) not in names.new:
            names.add("pair", pair["name"])
        pair["name"] = names.joint(pair["name"])
        for side in ("left", "right"):
            if side in pair:
                pair[side] = names.joint(pair[side])
    robot["contact_clusters"] = [[link(name) for name in cluster]
                                 for cluster in robot["contact_clusters"]]
    robot["reference_postures"] = {key: names.of("posture", name)
                                   for key, name in robot["reference_postures"].items()}
    for poses in (robot["fall_poses"], robot["walking_arms"]):
        for key in poses:
            poses[key] = names.joints(poses[key])
    for action in robot["actions"]:
        action.setdefault("keyframes", action["name"])
        action["name"] = names.add("action", action["name"])


def rename_keyframes(entry, names):
    """Renames what one transition or scripted action names, in place."""
    for end in ("from", "to"):
        if ("posture", entry.get(end)) in names.new:
            entry[end] = names.of("posture", entry[end])
    for keyframe in entry.get("keyframes", []):
        if "posture" in keyframe:
            keyframe["posture"] = names.of("posture", keyframe["posture"])
        if "joints" in keyframe:
            keyframe["joints"] = names.joints(keyframe["joints"])
        if "stiffness" in keyframe:
            keyframe["stiffness"] = {name if name == "all" else names.joint(name): value
                                     for name, value in keyframe["stiffness"].items()}


def rewrite(source, target, change):
    data = yaml.safe_load(source.read_text())
    change(data)
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(yaml.safe_dump(data, sort_keys=False))


def rename_posture(posture, names):
    posture["name"] = names.add("posture", posture["name"])
    posture["joints"] = names.joints(posture["joints"])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("source", type=pathlib.Path, help="folder of the robot")
    parser.add_argument("target", type=pathlib.Path, help="folder of the copy, made anew")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    source, target = arguments.source, arguments.target
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(source, target, ignore=shutil.ignore_patterns("*.stamp", "labels.yaml"))
    names = Names(random.Random(arguments.seed))

    urdf = yaml.safe_load((source / "robot.yaml").read_text())["urdf"]
    rename_urdf(source / urdf, target / urdf, names)
    # Postures name joints only; robot.yaml names postures and defines the pairs that keyframes name.
    rewrite(source / "postures.yaml", target / "postures.yaml",
            lambda data: [rename_posture(posture, names) for posture in data["postures"]])
    rewrite(source / "robot.yaml", target / "robot.yaml", lambda data: rename_robot(data, names))
    rewrite(source / "lights.yaml", target / "lights.yaml",
            lambda data: {"lights": [{**light, "link": names.of("link", light["link"])} for light in data["lights"]]})
    for file, key in KEYFRAME_FILES:
        rewrite(source / file, target / file,
                lambda data, key=key: [rename_keyframes(entry, names) for entry in data[key]])
    for file in source.glob("policies/*/policy.yaml"):
        rewrite(file, target / file.relative_to(source),
                lambda data: data.update(joints=[{**joint, "name": names.joint(joint["name"])} for joint in data["joints"]]))
    lines = [f"{kind} {old} {new}\n" for (kind, old), new in names.new.items()]
    (target / "names.txt").write_text("".join(lines))


if __name__ == "__main__":
    main()
