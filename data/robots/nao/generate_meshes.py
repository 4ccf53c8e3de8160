#!/usr/bin/python3
"""Writes the NAO's meshes: one binary glTF (.glb) for each link, in meters, in the link frame, z up.

The shapes are this project's own, since the manufacturer's meshes may not be redistributed. All lengths
in this file are in meters. They were chosen so that the outer dimensions agree with the real shells to some
millimeters (573 mm high, 268 mm over the upper arms).

Adjacent links overlap in a ball or a cylinder about the axis of their joint, so that no posture shows a gap.
Only the left links are modeled; the URDF takes their mirror images for the right ones.
"""

import argparse
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from mesh import Mesh
from solids import Tube, ball, limb, patch, puck, revolve, skin


def panel(shell, center, view, up, size, exponent=2.6, taper=0.0, segments=24, material="accent"):
    """A raised colored plate on a shell, as patch() places it; `exponent` as in Tube."""
    return patch(shell, center, view, up, size, [
        (0.5, 0.0014, material), (0.92, 0.0014, material), (1.0, -0.0010, material)],
        segments, exponent, taper)


def torso():
    mesh = Mesh()
    #  along   center x, y +x      -x      +y      -y      exponent
    shell = Tube("z", [
        (-0.0860, 0.012, 0, 0.0210, 0.0220, 0.0140, 0.0140, 2.4),
        (-0.0620, 0.004, 0, 0.0390, 0.0440, 0.0390, 0.0390, 2.8),
        (-0.0430, 0.002, 0, 0.0440, 0.0480, 0.0470, 0.0470, 3.0),
        (-0.0200, 0.001, 0, 0.0440, 0.0460, 0.0475, 0.0475, 2.9),
        (-0.0010, 0.000, 0, 0.0405, 0.0415, 0.0430, 0.0430, 2.5),
        (0.0050, 0.000, 0, 0.0425, 0.0425, 0.0450, 0.0450, 2.6),
        (0.0280, 0.000, 0, 0.0520, 0.0490, 0.0570, 0.0570, 2.7),
        (0.0560, 0.000, 0, 0.0580, 0.0527, 0.0690, 0.0690, 2.8),
        (0.0850, 0.000, 0, 0.0560, 0.0520, 0.0745, 0.0745, 2.8),
        (0.1070, 0.000, 0, 0.0455, 0.0450, 0.0680, 0.0680, 2.5),
        (0.1220, 0.000, 0, 0.0300, 0.0320, 0.0430, 0.0430, 2.3),
    ], start_dome=0.0104, end_dome=0.009)
    mesh.add(shell.solid("white", segments=18,
                         spans={"start": "grey", 0: "grey", 4: "dark"}))
    front = ((-1, 0, 0), (0, 0, 1))
    mesh.add(panel(shell, (0.1, 0, 0.066), *front, (0.041, 0.034), 2.4, taper=0.30, segments=15))
    mesh.add(patch(shell, (-0.1, 0, 0.062), (1, 0, 0), (0, 0, 1), (0.027, 0.032), [
        (0.92, 0.0020, "accent"), (1.0, -0.0008, "accent")], 12, 2.1, 0.15))
    mesh.add(patch(shell, (0.1, 0, 0.0535), *front, (0.0115, 0.0115), [
        (0.55, 0.0045, "light"), (0.72, 0.0040, "grey"), (1.0, 0.0012, "grey")], 10))
    for side in (-1, 1):
        mesh.add(revolve((0, 0, 0.100), (0, side, 0), [
            (0, 0.040), (0.0305, 0.050), (0.0305, 0.078), (0.0275, 0.081), (0, 0.081)], "grey", 13))
    mesh.add(revolve((0, 0, 0.127), (0, 0, 1), [(0.022, 0), (0, 0.006)], "grey", 14))
    return mesh


def neck():
    mesh = Mesh()
    mesh.add(ball((0, 0, 0), 0.0165, "grey", 14, 7))
    return mesh


def head():
    mesh = Mesh()
    shell = Tube("z", [
        (0.0040, -0.002, 0, 0.028, 0.028, 0.029, 0.029, 2.3),
        (0.0140, -0.001, 0, 0.0455, 0.0455, 0.0465, 0.0465, 2.3),
        (0.0340, 0.000, 0, 0.0545, 0.0570, 0.0575, 0.0575, 2.25),
        (0.0500, 0.000, 0, 0.0565, 0.0600, 0.0592, 0.0592, 2.2),
        (0.0660, 0.000, 0, 0.0575, 0.0605, 0.0585, 0.0585, 2.15),
        (0.0810, 0.000, 0, 0.0540, 0.0570, 0.0545, 0.0545, 2.1),
        (0.0940, 0.000, 0, 0.0460, 0.0480, 0.0465, 0.0465, 2.05),
        (0.1040, 0.000, 0, 0.0330, 0.0350, 0.0340, 0.0340, 2.0),
    ], start_dome=0.0048, end_dome=0.0096)
    mesh.add(shell.solid("white", segments=20))
    for side in (-1, 1):
        # The eyes are rotated outwards by 17 degrees (atan 0.3), as the surface of the face is there.
        mesh.add(patch(shell, (0.1, 0.0425 * side, 0.0480), (-1, -0.3 * side, 0), (0, 0, 1),
                       (0.0150, 0.0150),
                       [(0.58, 0.0010, "dark"), (0.84, 0.0015, "light"), (1.0, 0.0004, "grey")],
                       13))
        mesh.add(revolve((0, 0, 0.050), (0, side, 0), [
            (0.0295, 0.0500), (0.0290, 0.0600), (0.0245, 0.0664), (0.0150, 0.0640), (0, 0.0632)],
            ["white", "accent", "accent", "grey"], 14))
    for z, radius in ((0.0690, 0.0048), (0.0180, 0.0048)):
        mesh.add(patch(shell, (0.1, 0, z), (-1, 0, 0), (0, 0, 1), (radius, radius),
                       [(1.0, 0.0012, "dark")], 8))
    mesh.add(patch(shell, (0.002, 0, 0.2), (0, 0, -1), (1, 0, 0), (0.0105, 0.0350),
                   [(0.6, 0.0018, "accent"), (1.0, 0.0012, "accent")], 12, 2.4))
    return mesh


def shoulder():
    mesh = Mesh()
    mesh.add(puck((0, -0.0139, 0), (0, 1, 0), 0.0325, 0.0119, 0.003, "grey", 24))
    return mesh


def bicep():
    mesh = Mesh()
    pad = Tube("y", [
        (-0.0195, 0, -0.010, 0.0335, 0.0335, 0.0270, 0.0285, 2.2),
        (-0.0050, 0, -0.011, 0.0400, 0.0400, 0.0340, 0.0340, 2.3),
        (0.0120, 0, -0.012, 0.0400, 0.0400, 0.0345, 0.0345, 2.3),
        (0.0240, 0, -0.012, 0.0340, 0.0340, 0.0290, 0.0290, 2.2),
    ], start_dome=0.004, end_dome=0.0100)
    mesh.add(pad.solid("white", segments=20, dome_steps=2))
    mesh.add(panel(pad, (-0.012, 0.1, 0), (0, -1, 0), (0, 0, 1), (0.019, 0.024), 2.2, segments=20))
    arm = Tube("x", [
        (0.006, 0.006, 0, 0.024, 0.024, 0.027, 0.027, 2.2),
        (0.035, 0.0085, 0.0005, 0.0262, 0.0262, 0.0270, 0.0268, 2.2),
        (0.065, 0.0110, 0.001, 0.0250, 0.0258, 0.0262, 0.0258, 2.2),
        (0.088, 0.0130, 0.001, 0.0230, 0.0240, 0.0245, 0.0240, 2.1),
    ], end_dome=0.008)
    mesh.add(arm.solid("white", segments=18, spans={"end": "grey"}))
    return mesh


def elbow():
    mesh = Mesh()
    mesh.add(ball((0, 0, 0), 0.0225, "grey", 18, 10))
    return mesh


def forearm():
    mesh = Mesh()
    arm = Tube("x", [
        (0.0080, 0, 0.0000, 0.0205, 0.0205, 0.0215, 0.0205, 2.1),
        (0.0180, 0, 0.0005, 0.0245, 0.0215, 0.0255, 0.0225, 2.2),
        (0.0330, 0, 0.0005, 0.0250, 0.0215, 0.0260, 0.0228, 2.2),
        (0.0430, 0, 0.0000, 0.0225, 0.0205, 0.0235, 0.0215, 2.1),
        (0.0500, 0, 0.0000, 0.0200, 0.0190, 0.0205, 0.0200, 2.0),
        (0.0572, 0, 0.0000, 0.0175, 0.0175, 0.0175, 0.0175, 2.0),
    ], start_dome=0.006)
    mesh.add(arm.solid("white", segments=18, spans={3: "accent", 4: "grey", "end": "grey"}))
    mesh.add(ball((0, 0, 0), 0.0195, "grey", 14, 7))
    return mesh


def wrist():
    mesh = Mesh()
    hand = Tube("x", [
        (0.0020, 0, 0, 0.0165, 0.0165, 0.0165, 0.0165, 2.0),
        (0.0110, 0, 0, 0.0250, 0.0250, 0.0240, 0.0240, 2.3),
        (0.0260, 0, 0, 0.0325, 0.0325, 0.0300, 0.0280, 2.5),
        (0.0440, 0, 0, 0.0335, 0.0335, 0.0285, 0.0290, 2.6),
        (0.0600, 0, -0.001, 0.0300, 0.0300, 0.0195, 0.0215, 2.6),
    ], start_dome=0.002, end_dome=0.010)
    mesh.add(hand.solid("white", segments=18, spans={"start": "grey"}))
    for y in (-0.01157, 0.01157):
        mesh.add(puck((0.06907, y, -0.00304), (0, 1, 0), 0.0092, 0.0082, 0.002, "grey", 12))
    # The opposing finger.
    points = [(0.046, 0, -0.0250), (0.0600, 0, -0.0330), (0.0730, 0, -0.0365)]
    mesh.add(limb(points, [0.0088, 0.0080, 0.0070], "grey", 10))
    return mesh


def fingers():
    """In the frame of the fingers' joint: closed at angle 0, straight at 1 rad."""
    mesh = Mesh()
    for y in (-0.01157, 0.01157):
        points = [(0.0, y, 0.0)]
        for down in (1.0, 1.45, 1.9):
            x, _, z = points[-1]
            points.append((x + 0.0136 * math.cos(down), y, z - 0.0136 * math.sin(down)))
        mesh.add(limb(points, [0.0080, 0.0078, 0.0072, 0.0064], "grey", 10))
    return mesh


def pelvis():
    mesh = Mesh()
    housing = Tube("y", [
        (-0.0280, 0.010, -0.010, 0.0200, 0.0200, 0.0270, 0.0280, 2.8),
        (-0.0210, 0.010, -0.010, 0.0230, 0.0230, 0.0310, 0.0330, 3.0),
        (-0.0020, 0.010, -0.010, 0.0230, 0.0230, 0.0310, 0.0330, 3.0),
        (0.0060, 0.010, -0.010, 0.0200, 0.0200, 0.0270, 0.0280, 2.8),
    ], start_dome=0.004, end_dome=0.004)
    mesh.add(housing.solid("grey", segments=18))
    mesh.add(ball((0, 0, 0), 0.026, "grey", 14, 8))
    return mesh


def hip():
    mesh = Mesh()
    mesh.add(puck((-0.0095, 0.0005, -0.008), (1, 0, 0), 0.0215, 0.0300, 0.004, "grey", 18))
    return mesh


def thigh():
    mesh = Mesh()
    shell = Tube("z", [
        (-0.0900, 0.002, 0.000, 0.0330, 0.0300, 0.0360, 0.0340, 2.8),
        (-0.0740, 0.003, 0.002, 0.0400, 0.0385, 0.0415, 0.0390, 2.9),
        (-0.0500, 0.004, 0.003, 0.0460, 0.0450, 0.0450, 0.0435, 2.9),
        (-0.0250, 0.004, 0.003, 0.0470, 0.0455, 0.0450, 0.0435, 2.8),
        (-0.0060, 0.002, 0.002, 0.0420, 0.0410, 0.0420, 0.0400, 2.6),
        (0.0060, 0.000, 0.001, 0.0320, 0.0320, 0.0350, 0.0330, 2.4),
    ], start_dome=0.005, end_dome=0.0120)
    mesh.add(shell.solid("white", segments=22, spans={"start": "grey"}))
    mesh.add(panel(shell, (0.004, 0.1, -0.043), (0, -1, 0), (0, 0, 1), (0.026, 0.031), 3.0, 0.12))
    mesh.add(puck((0, 0.0005, -0.100), (0, 1, 0), 0.0235, 0.0345, 0.003, "grey", 20))
    return mesh


def tibia():
    mesh = Mesh()
    shell = Tube("z", [
        (-0.0960, 0.000, 0.000, 0.0220, 0.0230, 0.0290, 0.0270, 2.4),
        (-0.0840, 0.000, 0.001, 0.0290, 0.0300, 0.0360, 0.0330, 2.5),
        (-0.0640, 0.002, 0.002, 0.0390, 0.0380, 0.0440, 0.0395, 2.6),
        (-0.0400, 0.004, 0.004, 0.0450, 0.0420, 0.0470, 0.0440, 2.7),
        (-0.0180, 0.006, 0.004, 0.0440, 0.0390, 0.0450, 0.0430, 2.8),
        (0.0000, 0.014, 0.003, 0.0345, 0.0330, 0.0410, 0.0400, 2.8),
        (0.0130, 0.025, 0.001, 0.0210, 0.0200, 0.0350, 0.0345, 2.6),
    ], start_dome=0.004, end_dome=0.0085)
    mesh.add(shell.solid("white", segments=22, spans={"start": "grey"}))
    mesh.add(panel(shell, (0.1, 0.003, -0.022), (-1, 0, 0), (0, 0, 1), (0.026, 0.027), 2.8, 0.1))
    mesh.add(ball((0, 0, -0.1029), 0.0230, "grey", 14, 8))
    return mesh


def ankle():
    mesh = Mesh()
    mesh.add(puck((0, 0, 0), (0, 1, 0), 0.0225, 0.0142, 0.003, "grey", 18))
    return mesh


# Outline of the left sole, counter-clockwise from above: the same as in robot.yaml, which a test compares.
SOLE = [(-0.05072, -0.02138), (-0.04262, -0.0306), (-0.03297, -0.03435), (0.0577, -0.03877),
        (0.07395, -0.03729), (0.08765, -0.03148), (0.09687, -0.0188), (0.09942, -0.01015),
        (0.09899, 0.00869), (0.094, 0.02418), (0.08454, 0.0361), (0.06568, 0.04615),
        (0.04991, 0.04818), (-0.03125, 0.05002), (-0.04905, 0.0376)]


def foot():
    mesh = Mesh()
    levels = ((-0.04519, 0.985), (-0.0440, 1.0), (-0.0385, 1.0))
    rings = [[(0.022 + (x - 0.022) * s, 0.0065 + (y - 0.0065) * s, z) for x, y in SOLE]
             for z, s in levels]
    mesh.add(skin(rings, ["dark"] * 2, (0.022, 0.0065, levels[0][0]), (0.022, 0.0065, -0.0385)),
             30)
    shell = Tube("z", [
        (-0.0405, 0.0215, 0.0062, 0.0790, 0.0760, 0.0440, 0.0440, 2.7),
        (-0.0350, 0.0215, 0.0064, 0.0806, 0.0800, 0.0452, 0.0452, 2.7),
        (-0.0270, 0.0200, 0.0064, 0.0780, 0.0790, 0.0448, 0.0445, 2.6),
        (-0.0180, 0.0130, 0.0055, 0.0660, 0.0700, 0.0420, 0.0415, 2.4),
        (-0.0080, 0.0050, 0.0040, 0.0500, 0.0560, 0.0375, 0.0370, 2.3),
        (0.0030, 0.0000, 0.0020, 0.0380, 0.0440, 0.0325, 0.0320, 2.2),
    ], end_dome=0.0110)
    mesh.add(shell.solid("white", segments=24))
    mesh.add(panel(shell, (0.250, 0.0064, 0.0850), (-0.82, 0, -0.57), (-0.57, 0, 0.82),
                   (0.030, 0.0115), 2.6, -0.15))
    return mesh


CENTER = {"torso": torso, "Neck": neck, "Head": head}
LEFT = {"Shoulder": shoulder, "Bicep": bicep, "Elbow": elbow, "ForeArm": forearm, "Wrist": wrist,
        "Fingers": fingers, "Pelvis": pelvis, "Hip": hip, "Thigh": thigh, "Tibia": tibia,
        "Ankle": ankle, "Foot": foot}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path, help="where the .glb files go")
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in CENTER.items():
        make().write(folder / f"{name}.glb")
    for name, make in LEFT.items():
        make().write(folder / f"L{name}.glb")


if __name__ == "__main__":
    main()
