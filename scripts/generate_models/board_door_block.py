# SPDX-License-Identifier: BSD-3-Clause
"""A board with a door and a sliding block: the object on which M3T was measured (docs/experiments.md).

Origin at the centre of the board; x right, y up, z out of the board (millimetres).
"""

from models import Joint, Link, Model
from solids import Box

HINGE = (-380, 200, 15)  # in the board's front face
BLOCK = (50, -200, 55)  # its centre


def board_door_block():
    x, y, z = HINGE
    bx, by, bz = BLOCK
    links = [
        Link("board", (0.76, 0.66, 0.50), [Box((-475, 475), (-475, 475), (-15, 15))]),
        Link("door_panel", (0.25, 0.45, 0.70), [Box((x, x + 300), (y - 150, y + 150), (z, z + 20))],
             HINGE),
        Link("block", (0.80, 0.35, 0.25),
             [Box((bx - 60, bx + 60), (by - 60, by + 60), (bz - 40, bz + 40))], BLOCK)]
    joints = [
        Joint("door", "revolute", "board", "door_panel", (0, -1, 0), 0, 90),
        Joint("slide", "prismatic", "board", "block", (1, 0, 0), -20, 220)]
    return Model("board_door_block", "A board with a door and a sliding block: few shapes, flush.",
                 links, joints, position=(0, 0, 1200), tilt=(10, 15, 3))
