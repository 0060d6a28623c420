# SPDX-License-Identifier: BSD-3-Clause
"""A small cabinet: a drawer above, a hinged door below, and behind it a drawer with a knob.

Origin at the centre of the front of the carcass; x right, y up, z to the front (millimetres).
"""

from models import Joint, Link, Model
from solids import Box, Cylinder

HALF_WIDTH, HALF_HEIGHT, DEPTH = 200, 250, 320
PANEL = 18  # thickness of the carcass, the door and the drawers' fronts
INSIDE = HALF_WIDTH - PANEL
FLOOR = -HALF_HEIGHT + PANEL
SHELF = (92, 92 + PANEL)
RECESS = 60  # of the inner drawer behind the door
SINK = 1  # how far solids of one link run into each other, so that they are one body
TRAVEL = 200


def carcass():
    back = (-DEPTH, -DEPTH + 10)
    inside = (-INSIDE - SINK, INSIDE + SINK)
    behind = (-DEPTH, 0)
    return Link("carcass", (0.72, 0.58, 0.42), [
        Box((-HALF_WIDTH, -INSIDE), (-HALF_HEIGHT, HALF_HEIGHT), behind),
        Box((INSIDE, HALF_WIDTH), (-HALF_HEIGHT, HALF_HEIGHT), behind),
        Box(inside, (-HALF_HEIGHT, FLOOR), behind),
        Box(inside, (HALF_HEIGHT - PANEL, HALF_HEIGHT), behind),
        Box(inside, SHELF, behind),
        Box(inside, (FLOOR - SINK, HALF_HEIGHT - PANEL + SINK), back),
        # Something on its top and one side, so that no two views of it look alike.
        Box((-150, -30), (HALF_HEIGHT - SINK, HALF_HEIGHT + 40), (-260, -120)),
        Box((HALF_WIDTH - SINK, HALF_WIDTH + 25), (-60, 160), (-90, -50))])


def tray(x, y, z):
    """An open box with walls of 12 mm; its front wall is the highest z."""
    (left, right), (bottom, top), (back, front) = x, y, z
    wall = 12
    return [Box(x, (bottom, bottom + wall), z),
            Box((left, left + wall), (bottom + wall - SINK, top), z),
            Box((right - wall, right), (bottom + wall - SINK, top), z),
            Box((left + wall - SINK, right - wall + SINK), (bottom + wall - SINK, top),
                (back, back + wall)),
            Box((left + wall - SINK, right - wall + SINK), (bottom + wall - SINK, top),
                (front - wall, front))]


def upper_drawer():
    return Link("drawer", (0.30, 0.50, 0.75), tray((-INSIDE, INSIDE), (SHELF[1], 200), (-290, SINK)) + [
        Box((-HALF_WIDTH, HALF_WIDTH), (SHELF[0] + 10, HALF_HEIGHT), (0, PANEL)),
        Box((-90, 40), (165, 185), (PANEL - SINK, PANEL + 32))],
                (0, SHELF[1], 0))


def door():
    front = PANEL
    return Link("door", (0.80, 0.35, 0.30), [
        Box((-HALF_WIDTH, HALF_WIDTH), (-HALF_HEIGHT, SHELF[0] + 8), (0, front)),
        Box((140, 165), (-40, 50), (front - SINK, front + 32))],
                (-HALF_WIDTH, 0, front))


def inner_drawer():
    return Link("inner_drawer", (0.45, 0.65, 0.35),
                tray((-INSIDE, INSIDE), (FLOOR, -90), (-300, -RECESS)), (0, FLOOR, -RECESS))


def knob():
    centre = (30, -165)
    return Link("knob", (0.90, 0.80, 0.30), [
        Cylinder(2, centre, 18, (-RECESS, -RECESS + 25)),
        Box((centre[0] - 25, centre[0] + 62), (centre[1] - 12, centre[1] + 12),
            (-RECESS + 25 - SINK, -RECESS + 50))],
                (*centre, -RECESS))


def inner_drawer_through_door(positions):
    """The inner drawer comes out only while the door is out of its way."""
    return positions["inner_drawer"] > 0 and positions["door"] < 90


def cabinet():
    return Model(
        "cabinet", "A cabinet with a drawer, a door, and a drawer with a knob behind the door.",
        [carcass(), upper_drawer(), door(), inner_drawer(), knob()],
        [Joint("drawer", "prismatic", "carcass", "drawer", (0, 0, 1), 0, TRAVEL),
         Joint("door", "revolute", "carcass", "door", (0, -1, 0), 0, 120),
         Joint("inner_drawer", "prismatic", "carcass", "inner_drawer", (0, 0, 1), 0, TRAVEL),
         Joint("knob", "revolute", "inner_drawer", "knob", (0, 0, 1), -90, 90)],
        position=(0, 50, 1100), tilt=(18, 25, 0), impossible=inner_drawer_through_door)
