"""Solids to build links from. Each is a list of (material, a, b, c): triangles, counter-clockwise
from outside. Lengths in metres."""

import math

from mesh import cross, dot, normalized, subtract


def skin(rings, materials, start=None, end=None):
    """Joins closed rings of equally many points, which run counter-clockwise about the way ahead.

    `materials` names one for each gap between rings. `start` and `end` are points that close the
    first and last ring, or None to leave it open.
    """
    count = len(rings[0])
    solid = []
    for ring, after, material in zip(rings, rings[1:], materials):
        for i in range(count):
            j = (i + 1) % count
            solid.append((material, ring[i], ring[j], after[i]))
            solid.append((material, ring[j], after[j], after[i]))
    for i in range(count):
        j = (i + 1) % count
        if start is not None:
            solid.append((materials[0], start, rings[0][j], rings[0][i]))
        if end is not None:
            solid.append((materials[-1], end, rings[-1][i], rings[-1][j]))
    return solid


def revolve(centre, axis, profile, materials, segments=20):
    """Turns a profile of (radius, along) about an axis through `centre`.

    `along` rises; a radius of 0 at either end closes the solid there. `materials` as in skin(),
    a single name for all.
    """
    axis = normalized(axis)
    across = normalized(cross(axis, (0, 0, 1) if abs(axis[2]) < 0.9 else (1, 0, 0)))
    third = cross(axis, across)

    def point(radius, along, turn):
        c, s = radius * math.cos(turn), radius * math.sin(turn)
        return tuple(o + along * a + c * u + s * v
                     for o, a, u, v in zip(centre, axis, across, third))

    if isinstance(materials, str):
        materials = [materials] * (len(profile) - 1)
    first = 1 if profile[0][0] == 0 else 0
    last = len(profile) - (1 if profile[-1][0] == 0 else 0)
    rings = [[point(radius, along, 2 * math.pi * i / segments) for i in range(segments)]
             for radius, along in profile[first:last]]
    start = point(0, profile[0][1], 0) if first else None
    end = point(0, profile[-1][1], 0) if last < len(profile) else None
    solid = skin(rings, materials[first:last - 1] or materials, start, end)
    if start is not None:
        solid = [(materials[0], *t[1:]) if start in t[1:] else t for t in solid]
    if end is not None:
        solid = [(materials[-1], *t[1:]) if end in t[1:] else t for t in solid]
    return solid


def puck(centre, axis, radius, half_width, chamfer, material, segments=20):
    """A cylinder with chamfered rims."""
    profile = [(0, -half_width), (radius - chamfer, -half_width), (radius, chamfer - half_width),
               (radius, half_width - chamfer), (radius - chamfer, half_width), (0, half_width)]
    return revolve(centre, axis, profile, material, segments)


def ball(centre, radius, material, segments=16, rings=8):
    profile = [(radius * math.sin(math.pi * i / rings), -radius * math.cos(math.pi * i / rings))
               for i in range(rings + 1)]
    profile[0] = (0, -radius)
    profile[-1] = (0, radius)
    return revolve(centre, (0, 0, 1), profile, material, segments)


def limb(points, radii, material, segments=8):
    """A round bar through points with a dome at either end, for fingers."""
    ways = [normalized(subtract(b, a)) for a, b in zip(points, points[1:])]
    rings = []
    stations = [(points[0], ways[0], radii[0], -0.75), (points[0], ways[0], radii[0], 0)]
    for i in range(1, len(points) - 1):
        way = normalized(tuple(a + b for a, b in zip(ways[i - 1], ways[i])))
        stations.append((points[i], way, radii[i], 0))
    stations += [(points[-1], ways[-1], radii[-1], 0), (points[-1], ways[-1], radii[-1], 0.75)]
    for centre, way, radius, along in stations:
        across = normalized(cross(way, (0, 1, 0)))
        third = cross(way, across)
        inner = radius * math.sqrt(1 - along * along)
        rings.append([tuple(o + along * radius * w + inner * (math.cos(turn) * u + math.sin(turn) * v)
                            for o, w, u, v in zip(centre, way, across, third))
                      for turn in (2 * math.pi * i / segments for i in range(segments))])
    tip = [tuple(o + s * r * w for o, w in zip(p, way))
           for p, way, r, s in ((points[0], ways[0], radii[0], -1), (points[-1], ways[-1], radii[-1], 1))]
    return skin(rings, [material] * (len(rings) - 1), *tip)


class Tube:
    """A smooth shell around an axis of the frame: superellipses, interpolated, with domed ends.

    A station is (along, centre_u, centre_v, plus_u, minus_u, plus_v, minus_v, exponent): where it
    stands on the axis, its centre across, how far it reaches from there, and how square it is (2 is
    an ellipse). Across the z axis u is x and v is y; across x they are y and z; across y, z and x.
    """

    def __init__(self, axis, stations, start_dome=0.0, end_dome=0.0):
        self.axis = "xyz".index(axis)
        self.stations = [tuple(map(float, station)) for station in stations]
        self.start_dome = start_dome
        self.end_dome = end_dome
        self.slopes = list(zip(*[self._slopes(column) for column in zip(*self.stations)]))

    @staticmethod
    def _slopes(values):
        """Slopes of the cubic between equally spaced values that adds no bump (Fritsch-Carlson)."""
        steps = [b - a for a, b in zip(values, values[1:])]
        slopes = [steps[0]]
        for before, after in zip(steps, steps[1:]):
            slopes.append(0 if before * after <= 0 else 2 * before * after / (before + after))
        return slopes + [steps[-1]]

    def station(self, at):
        """Interpolated station; `at` counts them from 0."""
        i = min(int(at), len(self.stations) - 2)
        s = at - i
        h00, h10 = (1 + 2 * s) * (1 - s) ** 2, s * (1 - s) ** 2
        h01, h11 = s * s * (3 - 2 * s), s * s * (s - 1)
        return [h00 * a + h10 * da + h01 * b + h11 * db
                for a, b, da, db in zip(self.stations[i], self.stations[i + 1],
                                        self.slopes[i], self.slopes[i + 1])]

    @staticmethod
    def _radius(station, turn):
        _, _, _, plus_u, minus_u, plus_v, minus_v, exponent = station
        c, s = math.cos(turn), math.sin(turn)
        u = abs(c) / (plus_u if c > 0 else minus_u)
        v = abs(s) / (plus_v if s > 0 else minus_v)
        return (u ** exponent + v ** exponent) ** (-1 / exponent)

    def _ring(self, station, segments, scale=1.0, shift=0.0):
        along, centre_u, centre_v = station[:3]
        ring = []
        plus_u, minus_u, plus_v, minus_v, exponent = station[3:]
        for i in range(segments):
            # Denser where the section turns, in the corners.
            c, s = (math.cos(2 * math.pi * i / segments), math.sin(2 * math.pi * i / segments))
            u = math.copysign(abs(c) ** (2 / exponent), c) * (plus_u if c > 0 else minus_u)
            v = math.copysign(abs(s) ** (2 / exponent), s) * (plus_v if s > 0 else minus_v)
            ring.append(self._point(along + shift, centre_u + scale * u, centre_v + scale * v))
        return ring

    def _point(self, along, u, v):
        point = [0, 0, 0]
        point[self.axis] = along
        point[(self.axis + 1) % 3] = u
        point[(self.axis + 2) % 3] = v
        return tuple(point)

    def solid(self, material, segments=20, steps=1, dome_steps=2, spans=None):
        """Triangles: `steps` rings for each gap between stations, `dome_steps` for each dome.

        `spans` gives single gaps between stations another material: {gap: material}, where
        "start" and "end" are the ends.
        """
        spans = spans or {}
        first, last = self.stations[0], self.stations[-1]
        rings, materials = [], []
        for i in reversed(range(1, dome_steps) if self.start_dome else ()):
            angle = math.pi / 2 * i / dome_steps
            rings.append(self._ring(first, segments, math.cos(angle),
                                    -self.start_dome * math.sin(angle)))
            materials.append(spans.get("start", material))
        for gap in range(len(self.stations) - 1):
            for i in range(steps):
                rings.append(self._ring(self.station(gap + i / steps), segments))
                materials.append(spans.get(gap, material))
        rings.append(self._ring(last, segments))
        for i in range(1, dome_steps) if self.end_dome else ():
            angle = math.pi / 2 * i / dome_steps
            rings.append(self._ring(last, segments, math.cos(angle),
                                    self.end_dome * math.sin(angle)))
            materials.append(spans.get("end", material))
        start = self._point(first[0] - self.start_dome, *first[1:3])
        end = self._point(last[0] + self.end_dome, *last[1:3])
        solid = skin(rings, materials, start, end)
        for point, key in ((start, "start"), (end, "end")):
            solid = [(spans.get(key, material), *t[1:]) if point in t[1:] else t for t in solid]
        return solid

    def contains(self, point):
        along = point[self.axis]
        u, v = point[(self.axis + 1) % 3], point[(self.axis + 2) % 3]
        first, last = self.stations[0], self.stations[-1]
        scale = 1.0
        if along < first[0] or along > last[0]:
            beyond, dome = ((first[0] - along, self.start_dome) if along < first[0]
                            else (along - last[0], self.end_dome))
            if beyond >= dome:
                return False
            scale = math.sqrt(1 - (beyond / dome) ** 2)
            station = first if along < first[0] else last
        else:
            low, high = 0.0, float(len(self.stations) - 1)
            for _ in range(30):
                middle = (low + high) / 2
                low, high = (middle, high) if self.station(middle)[0] < along else (low, middle)
            station = self.station(low)
        u, v = u - station[1], v - station[2]
        return math.hypot(u, v) <= scale * self._radius(station, math.atan2(v, u))


def patch(shell, centre, look, up, size, rings, segments=20, exponent=2.0, taper=0.0):
    """Something flat laid on a shell: an eye, a button, a coloured panel.

    Its outline is a superellipse of half width and half height `size` about `centre`, which lies
    outside, seen along `look` with `up` upwards, and is projected onto the shell along `look`. `taper` widens its upper
    end by that fraction and narrows the lower one. `rings` go from the middle to the rim: (fraction
    of the outline, height over the shell, material from the ring before to this one).
    """
    look, up = normalized(look), normalized(up)
    # To the right of one who looks along `look`.
    right = cross(look, up)

    def on_shell(across, upwards, height):
        def at(depth):
            return [c + across * r + upwards * u + depth * l
                    for c, r, u, l in zip(centre, right, up, look)]

        step = 0.01
        outside = 0.0
        while not shell.contains(at(outside + step)):
            outside += step
            if outside > 0.5:
                raise ValueError(f"the patch at {centre} hangs over the shell's edge")
        inside = outside + step
        for _ in range(20):
            middle = (outside + inside) / 2
            outside, inside = ((outside, middle) if shell.contains(at(middle))
                               else (middle, inside))
        return tuple(at(inside - height))

    def ring_at(fraction, height):
        ring = []
        for i in range(segments):
            turn = 2 * math.pi * (i + 0.5) / segments
            c, s = math.cos(turn), math.sin(turn)
            radius = fraction * (abs(c) ** exponent + abs(s) ** exponent) ** (-1 / exponent)
            upwards = radius * s
            ring.append(on_shell(radius * c * size[0] * (1 + taper * upwards),
                                 upwards * size[1], height))
        return ring

    middle = on_shell(0, 0, rings[0][1])
    outline = [ring_at(fraction, height) for fraction, height, _ in rings]
    solid = []
    for i in range(segments):
        j = (i + 1) % segments
        solid.append((rings[0][2], middle, outline[0][i], outline[0][j]))
        for inner, outer, (_, _, material) in zip(outline, outline[1:], rings[1:]):
            solid.append((material, inner[i], outer[i], outer[j]))
            solid.append((material, inner[i], outer[j], inner[j]))
    return solid
