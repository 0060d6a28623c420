# SPDX-License-Identifier: BSD-3-Clause
"""What every shipped model must satisfy, proved before it is written.

Two convex solids are disjoint if there is an axis on which their shadows do not overlap. Not all
axes are tried for cylinders, so that a gap found is a proof, and a gap missed an alarm to look at.
"""

import itertools
import math
import random

from solids import Box

TOLERANCE = 1e-7  # mm


def subtract(a, b):
    return [i - j for i, j in zip(a, b)]


def dot(a, b):
    return sum(i * j for i, j in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def rotate(R, v):
    return [dot(row, v) for row in R]


def rotation(axis, angle):
    c, s, (x, y, z) = math.cos(angle), math.sin(angle), axis
    return [[c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s],
            [y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s],
            [z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)]]


class Placed:
    """A solid at its place: centre, unit axes, half lengths; a cylinder has one axis, a radius."""

    def __init__(self, solid, T):
        R, t = T
        columns = list(zip(*R))
        if isinstance(solid, Box):
            middle, self.radius = solid.centre(), 0
            self.axes, self.half = columns, solid.half_size()
        else:
            middle, self.radius = solid.middle(), solid.radius
            self.axes, self.half = [columns[solid.axis]], [solid.half_length()]
        self.centre = [a + b for a, b in zip(rotate(R, middle), t)]
        self.reach = math.hypot(*self.half, self.radius)

    def extent(self, direction):
        """Half the length of the shadow on a unit direction."""
        lengths = sum(half * abs(dot(axis, direction)) for half, axis in zip(self.half, self.axes))
        return lengths + self.radius * math.hypot(*cross(self.axes[0], direction))

    def corners(self):
        for signs in itertools.product((-1, 1), repeat=len(self.axes)):
            offsets = [[s * h * a for a in axis]
                       for s, h, axis in zip(signs, self.half, self.axes)]
            yield [sum(parts) for parts in zip(self.centre, *offsets)]


def directions(a, b):
    yield from a.axes
    yield from b.axes
    yield from (cross(u, v) for u in a.axes for v in b.axes)
    for one, other in ((a, b), (b, a)):
        if one.radius:  # from the cylinder's axis to the corners of the other
            axis = one.axes[0]
            for corner in other.corners():
                offset = subtract(corner, one.centre)
                along = dot(offset, axis)
                yield [o - along * x for o, x in zip(offset, axis)]


def gap(a, b):
    """Distance between two solids along the best axis; negative: no gap was found."""
    between = subtract(b.centre, a.centre)
    distance = math.hypot(*between)
    if distance > a.reach + b.reach + 1:
        return distance - a.reach - b.reach
    best = -math.inf
    for direction in directions(a, b):
        length = math.hypot(*direction)
        if length > 1e-9:
            unit = [d / length for d in direction]
            best = max(best, abs(dot(between, unit)) - a.extent(unit) - b.extent(unit))
    return best


def place(model, positions):
    """Pose (R, t) of each link relative to its place at rest, positions in degrees or mm."""
    identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    poses = {model.links[0].name: (identity, [0, 0, 0])}
    for joint in model.joints:  # parents come before their children
        R, t = poses[joint.parent]
        q = positions[joint.name]
        if joint.type == "prismatic":
            moved = rotate(R, [q * a for a in joint.axis])
            poses[joint.child] = (R, [a + b for a, b in zip(t, moved)])
            continue
        turn = rotation(joint.axis, math.radians(q))
        origin = model.link(joint.child).origin
        shift = rotate(R, subtract(origin, rotate(turn, origin)))
        turned = [list(rotate(list(zip(*turn)), row)) for row in R]
        poses[joint.child] = (turned, [a + b for a, b in zip(t, shift)])
    return {link.name: [Placed(solid, poses[link.name]) for solid in link.solids]
            for link in model.links}


def gaps(model, positions):
    """The smallest gap between the solids of each pair of links."""
    placed = place(model, positions)
    return {(a, b): min(gap(s, t) for s in placed[a] for t in placed[b])
            for a, b in itertools.combinations(placed, 2)}


def random_positions(model, draw):
    """Within the limits; each joint is at one of them in every third draw."""
    while True:
        positions = {}
        for joint in model.joints:
            low, high = (0, 360) if joint.type == "continuous" else (joint.lower, joint.upper)
            positions[joint.name] = draw.choice(
                [low, high, draw.uniform(low, high), draw.uniform(low, high),
                 draw.uniform(low, high), draw.uniform(low, high)])
        if not model.impossible(positions):
            return positions


def check_contacts(model, overlap):
    """At rest every movable link touches something, and nothing overlaps further than overlap."""
    rest = gaps(model, {joint.name: 0 for joint in model.joints})
    for joint in model.joints:
        touching = [value for pair, value in rest.items() if joint.child in pair]
        if not any(abs(value + overlap) < TOLERANCE for value in touching):
            raise SystemExit(f"{model.name}: {joint.child} touches nothing at rest")
    for pair, value in rest.items():
        if value < -overlap - TOLERANCE:
            raise SystemExit(f"{model.name}: {pair} overlap by {-value} mm at rest")


def check_free_motion(model, overlap, count, seed=1):
    """No two links overlap further than overlap anywhere within the joints' limits."""
    draw = random.Random(seed)
    for _ in range(count):
        positions = random_positions(model, draw)
        for pair, value in gaps(model, positions).items():
            if value < -overlap - TOLERANCE:
                raise SystemExit(f"{model.name}: {pair} overlap by {-value} mm at {positions}")


def check_meshes(model):
    """Every solid's mesh is closed and faces outwards."""
    for link in model.links:
        for solid in link.solids:
            vertices, triangles = solid.mesh()
            edges = [(t[i], t[(i + 1) % 3]) for t in triangles for i in range(3)]
            closed = len(set(edges)) == len(edges) and {(b, a) for a, b in edges} == set(edges)
            volume = sum(dot(vertices[a], cross(vertices[b], vertices[c]))
                         for a, b, c in triangles) / 6
            if not closed or volume <= 0:
                raise SystemExit(f"{model.name}: {link.name} has a mesh that is open or inside out")
