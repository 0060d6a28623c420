# SPDX-License-Identifier: BSD-3-Clause
"""One rigid body without symmetry. Origin at the centre of the large box's back (millimetres)."""

from models import Link, Model
from solids import Box, Cylinder

SINK = 1  # how far solids of one link run into each other, so that they are one body


def rigid_block():
    body = Link(
        "block", (0.80, 0.45, 0.25),
        [Box((-180, 180), (-120, 120), (0, 90)),
         Box((-180, -60), (-120, 40), (90 - SINK, 170)),
         Box((180 - SINK, 240), (20, 120), (0, 50)),
         Cylinder(2, (90, -40), 45, (90 - SINK, 130))])
    return Model("rigid_block", "One rigid body without symmetry and without joints.", [body], [],
                 position=(0, 0, 1000), tilt=(20, 25, 0))
