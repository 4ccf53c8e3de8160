"""Triangles of one link with their normals, and the binary glTF file that contains them."""

import json
import math
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from output_file import replace_file  # noqa: E402

# Linear RGB, chosen. A viewer may give each robot its own "accent" color, by the name of the material.
MATERIALS = {
    "white": (0.90, 0.90, 0.89),
    "accent": (0.95, 0.24, 0.02),
    "grey": (0.20, 0.21, 0.23),
    "dark": (0.015, 0.016, 0.02),
    "light": (0.45, 0.80, 1.00),
}

# Positions are rounded to 1/16384 m (0.06 mm) and normals to 1/256: not visible, and the compressed files
# become a third smaller.
POSITION_STEP = 1 / 16384
NORMAL_STEP = 1 / 256


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalized(a):
    length = math.sqrt(dot(a, a))
    return (a[0] / length, a[1] / length, a[2] / length)


def rounded(vector, step):
    return tuple(round(component / step) * step + 0.0 for component in vector)


class Mesh:
    """A list of triangles (material, three positions, three normals); meters, in the frame of the link."""

    def __init__(self):
        self.triangles = []

    def add(self, solid, crease_deg=50):
        """Adds one solid: a list of triangles (material, a, b, c), counter-clockwise from outside.

        The normals are smoothed between faces that differ by at most `crease_deg`; larger angles give a
        sharp edge. A vertex normal is the mean of the face normals, weighted by area.
        """
        faces = []
        around = {}
        for material, *corners in solid:
            corners = [rounded(corner, POSITION_STEP) for corner in corners]
            area = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]))
            if dot(area, area) < 1e-20:
                continue
            for corner in corners:
                around.setdefault(corner, []).append(len(faces))
            faces.append((material, corners, area, normalized(area)))
        limit = math.cos(math.radians(crease_deg))
        for material, corners, _, normal in faces:
            normals = []
            for corner in corners:
                smooth = [0, 0, 0]
                for other in around[corner]:
                    if dot(normal, faces[other][3]) >= limit:
                        smooth = [s + a for s, a in zip(smooth, faces[other][2])]
                normals.append(rounded(normalized(smooth), NORMAL_STEP))
            self.triangles.append((material, corners, normals))

    def write(self, path):
        """Writes binary glTF 2.0: one mesh with one primitive for each material."""
        file = _GlbFile()
        for material in MATERIALS:
            numbers = {}
            indices = []
            for name, corners, normals in self.triangles:
                if name == material:
                    for vertex in zip(corners, normals):
                        indices.append(numbers.setdefault(vertex, len(numbers)))
            if indices:
                positions, normals = zip(*numbers)
                file.add_primitive(material, positions, normals, indices)
        replace_file(path, file.bytes())


class _GlbFile:
    """Content of a .glb file. Source of the format: Khronos, "glTF 2.0 specification"."""

    # OpenGL's numbers of component types and buffer targets.
    FLOAT, UNSIGNED_SHORT = 5126, 5123
    VERTICES, INDICES = 34962, 34963

    def __init__(self):
        self.blob = bytearray()
        self.views = []
        self.accessors = []
        self.materials = []
        self.primitives = []

    def add_primitive(self, material, positions, normals, indices):
        columns = list(zip(*positions))
        position = self._add_accessor(
            positions, "3f", self.FLOAT, "VEC3", self.VERTICES,
            min=[min(column) for column in columns], max=[max(column) for column in columns])
        normal = self._add_accessor(normals, "3f", self.FLOAT, "VEC3", self.VERTICES)
        index = self._add_accessor(
            [(index,) for index in indices], "H", self.UNSIGNED_SHORT, "SCALAR", self.INDICES)
        self.primitives.append({
            "attributes": {"POSITION": position, "NORMAL": normal},
            "indices": index,
            "material": len(self.materials),
        })
        description = {
            "name": material,
            "pbrMetallicRoughness": {
                "baseColorFactor": [*MATERIALS[material], 1],
                "metallicFactor": 0,
                "roughnessFactor": 0.45,
            },
        }
        if material == "light":
            description["emissiveFactor"] = [0.6 * part for part in MATERIALS[material]]
        self.materials.append(description)

    def _add_accessor(self, rows, layout, component, kind, target, **bounds):
        data = b"".join(struct.pack("<" + layout, *row) for row in rows)
        self.blob.extend(b"\0" * (-len(self.blob) % 4))
        self.views.append({
            "buffer": 0,
            "byteOffset": len(self.blob),
            "byteLength": len(data),
            "target": target,
        })
        self.blob.extend(data)
        self.accessors.append({
            "bufferView": len(self.views) - 1,
            "componentType": component,
            "count": len(rows),
            "type": kind,
            **bounds,
        })
        return len(self.accessors) - 1

    def bytes(self):
        self.blob.extend(b"\0" * (-len(self.blob) % 4))
        text = json.dumps({
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": self.primitives}],
            "materials": self.materials,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": len(self.blob)}],
        }, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = (struct.pack("<I4s", len(text), b"JSON") + text
                  + struct.pack("<I4s", len(self.blob), b"BIN\0") + bytes(self.blob))
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
