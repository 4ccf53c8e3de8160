"""Parts of which the links are built. Each is a list of triangles (material, a, b, c) with the corners
counter-clockwise, seen from outside.

All lengths are in meters, in the frame of the link, all angles in radians. The dimensions that callers pass
were chosen to resemble the robot; see generate_meshes.py for their sources."""

import math

from mesh import cross, normalized, subtract


def skin(rings, materials, start=None, end=None):
    """Triangles between consecutive rings, which have the same number of points.

    The points of a ring run counter-clockwise about the direction from the first ring to the last.
    `materials` has one entry for each gap between rings. `start` and `end` are points that close the
    first and the last ring; None leaves it open.
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


def revolve(center, axis, profile, materials, segments=20):
    """Solid of revolution of a profile of points (radius, along) about an axis through `center`.

    `along`, the position on the axis, increases; a radius of 0 at either end closes the solid there.
    `materials` as in skin(), or one name for all gaps. `segments` is the number of corners of a circle.
    """
    axis = normalized(axis)
    across = normalized(cross(axis, (0, 0, 1) if abs(axis[2]) < 0.9 else (1, 0, 0)))
    third = cross(axis, across)

    def point(radius, along, angle):
        c, s = radius * math.cos(angle), radius * math.sin(angle)
        return tuple(o + along * a + c * u + s * v
                     for o, a, u, v in zip(center, axis, across, third))

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


def puck(center, axis, radius, half_width, chamfer, material, segments=20):
    """A cylinder with chamfered edges; `half_width` is half its length along the axis."""
    profile = [(0, -half_width), (radius - chamfer, -half_width), (radius, chamfer - half_width),
               (radius, half_width - chamfer), (radius - chamfer, half_width), (0, half_width)]
    return revolve(center, axis, profile, material, segments)


def ball(center, radius, material, segments=16, rings=8):
    """A sphere of `rings` bands of latitude."""
    profile = [(radius * math.sin(math.pi * i / rings), -radius * math.cos(math.pi * i / rings))
               for i in range(rings + 1)]
    profile[0] = (0, -radius)
    profile[-1] = (0, radius)
    return revolve(center, (0, 0, 1), profile, material, segments)


def limb(points, radii, material, segments=8):
    """A round bar through points, with a radius at each point and a dome at either end, for fingers."""
    directions = [normalized(subtract(b, a)) for a, b in zip(points, points[1:])]
    rings = []
    stations = [(points[0], directions[0], radii[0], -0.75), (points[0], directions[0], radii[0], 0)]
    for i in range(1, len(points) - 1):
        direction = normalized(tuple(a + b for a, b in zip(directions[i - 1], directions[i])))
        stations.append((points[i], direction, radii[i], 0))
    stations += [(points[-1], directions[-1], radii[-1], 0), (points[-1], directions[-1], radii[-1], 0.75)]
    for center, direction, radius, along in stations:
        across = normalized(cross(direction, (0, 1, 0)))
        third = cross(direction, across)
        inner = radius * math.sqrt(1 - along * along)
        rings.append([tuple(o + along * radius * w + inner * (math.cos(angle) * u + math.sin(angle) * v)
                            for o, w, u, v in zip(center, direction, across, third))
                      for angle in (2 * math.pi * i / segments for i in range(segments))])
    ends = ((points[0], directions[0], radii[0], -1), (points[-1], directions[-1], radii[-1], 1))
    tips = [tuple(o + side * radius * w for o, w in zip(point, direction))
            for point, direction, radius, side in ends]
    return skin(rings, [material] * (len(rings) - 1), *tips)


class Tube:
    """A smooth shell around an axis of the frame: interpolated cross sections with domed ends.

    A cross section is a superellipse (Lame curve) |u/a|^n + |v/b|^n = 1 with its own semi-axes in each
    quadrant. A station is (along, center_u, center_v, plus_u, minus_u, plus_v, minus_v, exponent): position
    on the axis, center of the cross section, semi-axes in the directions +u, -u, +v, -v, and n; n = 2 is an
    ellipse, larger values are squarer. For the axis z, u is x and v is y; for x, u is y and v is z; for y, u
    is z and v is x. `start_dome` and `end_dome` are the lengths of the domes beyond the first and the last
    station.
    """

    def __init__(self, axis, stations, start_dome=0.0, end_dome=0.0):
        self.axis = "xyz".index(axis)
        self.stations = [tuple(map(float, station)) for station in stations]
        self.start_dome = start_dome
        self.end_dome = end_dome
        self.slopes = list(zip(*[self._slopes(column) for column in zip(*self.stations)]))

    @staticmethod
    def _slopes(values):
        """Slopes of the monotone cubic interpolation of equally spaced values: harmonic means of
        neighboring differences (Fritsch and Butland, 1984), 0 at extrema."""
        steps = [b - a for a, b in zip(values, values[1:])]
        slopes = [steps[0]]
        for before, after in zip(steps, steps[1:]):
            slopes.append(0 if before * after <= 0 else 2 * before * after / (before + after))
        return slopes + [steps[-1]]

    def station(self, at):
        """Station at a fractional index, by cubic Hermite interpolation."""
        i = min(int(at), len(self.stations) - 2)
        s = at - i
        h00, h10 = (1 + 2 * s) * (1 - s) ** 2, s * (1 - s) ** 2
        h01, h11 = s * s * (3 - 2 * s), s * s * (s - 1)
        return [h00 * a + h10 * da + h01 * b + h11 * db
                for a, b, da, db in zip(self.stations[i], self.stations[i + 1],
                                        self.slopes[i], self.slopes[i + 1])]

    @staticmethod
    def _radius(station, angle):
        """Distance of the cross section's outline from its center in a direction."""
        _, _, _, plus_u, minus_u, plus_v, minus_v, exponent = station
        c, s = math.cos(angle), math.sin(angle)
        u = abs(c) / (plus_u if c > 0 else minus_u)
        v = abs(s) / (plus_v if s > 0 else minus_v)
        return (u ** exponent + v ** exponent) ** (-1 / exponent)

    def _ring(self, station, segments, scale=1.0, shift=0.0):
        """Points of a cross section, scaled about its center and shifted along the axis."""
        along, center_u, center_v = station[:3]
        ring = []
        plus_u, minus_u, plus_v, minus_v, exponent = station[3:]
        for i in range(segments):
            # This parametrization has more points in the corners, where the curvature is high.
            c, s = (math.cos(2 * math.pi * i / segments), math.sin(2 * math.pi * i / segments))
            u = math.copysign(abs(c) ** (2 / exponent), c) * (plus_u if c > 0 else minus_u)
            v = math.copysign(abs(s) ** (2 / exponent), s) * (plus_v if s > 0 else minus_v)
            ring.append(self._point(along + shift, center_u + scale * u, center_v + scale * v))
        return ring

    def _point(self, along, u, v):
        point = [0, 0, 0]
        point[self.axis] = along
        point[(self.axis + 1) % 3] = u
        point[(self.axis + 2) % 3] = v
        return tuple(point)

    def solid(self, material, segments=20, steps=1, dome_steps=2, spans=None):
        """Triangles of the shell: `steps` rings for each gap between stations, `dome_steps` for each dome.

        `spans` gives some gaps between stations another material: {index of the gap: material}; "start" and
        "end" are the domes.
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
        """Whether a point is inside of the shell, domes included."""
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
            # Bisection for the station at this position on the axis.
            low, high = 0.0, float(len(self.stations) - 1)
            for _ in range(30):
                middle = (low + high) / 2
                low, high = (middle, high) if self.station(middle)[0] < along else (low, middle)
            station = self.station(low)
        u, v = u - station[1], v - station[2]
        return math.hypot(u, v) <= scale * self._radius(station, math.atan2(v, u))


def patch(shell, center, view, up, size, rings, segments=20, exponent=2.0, taper=0.0):
    """A raised piece of surface on a shell: an eye, a button, a colored panel.

    Its outline is a superellipse with the half width and half height `size` about `center`, a point outside
    of the shell. It is projected onto the shell along the direction `view`; `up` is its upper side. `taper`
    widens the upper end by this fraction and narrows the lower one. `rings` go from the middle to the rim:
    (fraction of the outline, height above the shell, material between the previous ring and this one).
    """
    view, up = normalized(view), normalized(up)
    # To the right, seen along `view`.
    right = cross(view, up)

    def on_shell(across, upwards, height):
        # Follows the ray along `view` in steps of 1 cm to the inside, then bisects.
        def at(depth):
            return [c + across * r + upwards * u + depth * l
                    for c, r, u, l in zip(center, right, up, view)]

        step = 0.01
        outside = 0.0
        while not shell.contains(at(outside + step)):
            outside += step
            if outside > 0.5:
                raise ValueError(f"the patch at {center} extends beyond the edge of the shell")
        inside = outside + step
        for _ in range(20):
            middle = (outside + inside) / 2
            outside, inside = ((outside, middle) if shell.contains(at(middle))
                               else (middle, inside))
        return tuple(at(inside - height))

    def ring_at(fraction, height):
        ring = []
        for i in range(segments):
            angle = 2 * math.pi * (i + 0.5) / segments
            c, s = math.cos(angle), math.sin(angle)
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
