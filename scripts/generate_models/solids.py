# SPDX-License-Identifier: BSD-3-Clause
"""Boxes and cylinders, in millimetres, and the closed triangle meshes of them."""

import math
from dataclasses import dataclass

FACETS = 128  # of a cylinder: the chord error is radius * 3e-4


@dataclass(frozen=True)
class Box:
    x: tuple  # (low, high)
    y: tuple
    z: tuple

    def centre(self):
        return [(low + high) / 2 for low, high in (self.x, self.y, self.z)]

    def half_size(self):
        return [(high - low) / 2 for low, high in (self.x, self.y, self.z)]

    def mesh(self):
        """Vertices and outward (counter-clockwise) triangles."""
        vertices = [(x, y, z) for z in self.z for y in self.y for x in self.x]
        quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
        return vertices, triangles


@dataclass(frozen=True)
class Cylinder:
    """A prism of FACETS sides inscribed in the round cylinder, so that it touches what the round
    one touches (there are vertices in the directions of the coordinate axes) and nothing more."""

    axis: int  # 0, 1, 2: along x, y, z
    centre: tuple  # of the cross-section: the two other coordinates, in the order of (axis+1, axis+2)
    radius: float
    span: tuple  # (low, high) along the axis

    def point(self, along, across, up):
        p = [0.0, 0.0, 0.0]
        p[self.axis], p[(self.axis + 1) % 3], p[(self.axis + 2) % 3] = along, across, up
        return tuple(p)

    def middle(self):
        return self.point(sum(self.span) / 2, *self.centre)

    def half_length(self):
        return (self.span[1] - self.span[0]) / 2

    def mesh(self):
        """Vertices and outward (counter-clockwise) triangles."""
        vertices = [self.point(along, *self.centre) for along in self.span]
        for i in range(FACETS):
            angle = 2 * math.pi * i / FACETS
            across = self.centre[0] + self.radius * math.cos(angle)
            up = self.centre[1] + self.radius * math.sin(angle)
            vertices += [self.point(along, across, up) for along in self.span]
        triangles = []
        for i in range(FACETS):
            low, next_low = 2 + 2 * i, 2 + 2 * ((i + 1) % FACETS)
            high, next_high = low + 1, next_low + 1
            triangles += [(0, next_low, low), (1, high, next_high)]
            triangles += [(low, next_low, next_high), (low, next_high, high)]
        return vertices, triangles
