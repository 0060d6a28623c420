# SPDX-License-Identifier: BSD-3-Clause
"""The lockbox: a backboard with doors, a latch, a disk, bolts and blocks on its front.

Origin at the centre of the board's front face; x right, y up, z out of the board (millimetres).
"""

from models import Joint, Link, Model
from solids import Box, Cylinder

BOARD = 475  # half its width and height
BOARD_THICKNESS = 18
SINK = 1  # how far solids of one link run into each other, so that they are one body

DOOR_LEFT, DOOR_HINGE = -430, -160  # bottom-left door, along x
DOOR_BOTTOM, DOOR_TOP = -440, -160
DOOR_FRONT = 20
LATCH = (-320, -320)  # pivot
LATCH_ARM, LATCH_TAIL, LATCH_HALF_WIDTH = 135, 65, 15

BLUE_X, BLUE_BOTTOM, BLUE_HINGE, BLUE_FRONT = (80, 440), 150, 420, 24

DISK, DISK_RADIUS, DISK_FRONT = (-290, 220), 130, 30

BOLT_RADIUS, BOLT_TRAVEL = 25, 120
HORIZONTAL_Y, HORIZONTAL_X = -395, (40, 320)
VERTICAL_X, VERTICAL_Y = -105, (-440, -120)

BLOCK_X, BLOCK_Y, BLOCK_FRONT, BLOCK_TRAVEL = (-40, 100), (-150, -30), 45, 200
SLIDER_X, SLIDER_Y, SLIDER_FRONT, SLIDER_TRAVEL = (370, 440), (-280, -160), 12, 250


def board(overlap):
    """overlap: how far its fixtures reach into the parts that they touch sideways."""

    def fixture(x, y, height):
        return Box(x, y, (-SINK, height))

    solids = [Box((-BOARD, BOARD), (-BOARD, BOARD), (-BOARD_THICKNESS, 0))]
    # Hinge posts. The one of the bottom-left door carries the vertical bolt's guide, too.
    solids += [fixture((DOOR_HINGE - overlap, -145), (-420, -180), DOOR_FRONT),
               fixture((100, 420), (BLUE_HINGE - overlap, 440), BLUE_FRONT)]
    # The keeper under the latch's end: free of the door's edge as that swings out.
    solids += [fixture((-460, -432), (-345, -285), DOOR_FRONT)]
    # The cuboid that the disk touches.
    edge = DISK[0] + DISK_RADIUS
    solids += [fixture((edge - overlap, edge + 70), (160, 320), 50)]
    # Guides and end stops of the bolts.
    left, right = VERTICAL_X - BOLT_RADIUS, VERTICAL_X + BOLT_RADIUS
    for y in ((-310, -260), (-180, -140)):
        solids += [fixture((-146, left + overlap), y, BOLT_RADIUS),
                   fixture((right - overlap, right + 18), y, BOLT_RADIUS)]
    solids += [fixture((left + 5, right + 5), (-465, VERTICAL_Y[0] + overlap), 30)]
    bottom, top = HORIZONTAL_Y - BOLT_RADIUS, HORIZONTAL_Y + BOLT_RADIUS
    for x in ((170, 200), (270, 310)):
        solids += [fixture(x, (bottom - 20, bottom + overlap), BOLT_RADIUS),
                   fixture(x, (top - overlap, top + 20), BOLT_RADIUS)]
    solids += [fixture((15, HORIZONTAL_X[0] + overlap), (bottom - 5, top + 10), 35)]
    # Rails.
    solids += [fixture((-50, 330), (BLOCK_Y[0] - 20, BLOCK_Y[0] + overlap), 25),
               fixture((-50, 310), (BLOCK_Y[1] - overlap, BLOCK_Y[1] + 24), 30)]
    solids += [fixture((SLIDER_X[0] - 20, SLIDER_X[0] + overlap), (-300, 120), 8),
               fixture((SLIDER_X[1] - overlap, SLIDER_X[1] + 16), (-300, 100), 8)]
    return Link("board", (0.82, 0.71, 0.55), solids)


def doors(overlap):
    bottom_left = Link(
        "door_bottom_left", (0.85, 0.33, 0.25),
        [Box((DOOR_LEFT, DOOR_HINGE), (DOOR_BOTTOM, DOOR_TOP), (-overlap, DOOR_FRONT)),
         Cylinder(2, (-405, -185), 16, (DOOR_FRONT - SINK, DOOR_FRONT + 35))],
        (DOOR_HINGE, -300, DOOR_FRONT))
    blue = Link(
        "door_light_blue", (0.55, 0.80, 0.95),
        [Box(BLUE_X, (BLUE_BOTTOM, BLUE_HINGE), (-overlap, BLUE_FRONT)),
         Box((120, 220), (172, 200), (BLUE_FRONT - SINK, BLUE_FRONT + 35))],
        (260, BLUE_HINGE, BLUE_FRONT))
    x, y = LATCH
    width = (y - LATCH_HALF_WIDTH, y + LATCH_HALF_WIDTH)
    end = x - LATCH_ARM
    latch = Link(
        "latch", (0.25, 0.25, 0.28),
        [Box((end, x + LATCH_TAIL), width, (DOOR_FRONT - overlap, DOOR_FRONT + 20)),
         Box((end, end + 50), width, (DOOR_FRONT + 20 - SINK, DOOR_FRONT + 35))],
        (x, y, DOOR_FRONT))
    return [bottom_left, blue, latch]


def disk(overlap):
    x, y = DISK
    return Link(
        "disk", (0.95, 0.77, 0.20),
        [Cylinder(2, DISK, DISK_RADIUS, (-overlap, DISK_FRONT)),
         Box((x + 35, x + 105), (y - 30, y + 30), (DISK_FRONT - SINK, DISK_FRONT + 45))],
        (x, y, 0))


def bolts():
    y, x = HORIZONTAL_Y, HORIZONTAL_X
    horizontal = Link(
        "cylinder_horizontal", (0.35, 0.62, 0.35),
        [Cylinder(0, (y, BOLT_RADIUS), BOLT_RADIUS, x),
         Box((x[0] + 20, x[0] + 85), (y - 20, y + 20), (40, 80))],
        (x[0], y, BOLT_RADIUS))
    x, y = VERTICAL_X, VERTICAL_Y
    vertical = Link(
        "cylinder_vertical", (0.55, 0.40, 0.70),
        [Cylinder(1, (BOLT_RADIUS, x), BOLT_RADIUS, y),
         Box((x - 20, x + 20), (y[0] + 25, y[0] + 90), (40, 80))],
        (x, y[0], BOLT_RADIUS))
    return [horizontal, vertical]


def blocks(overlap):
    block = Link(
        "block", (0.30, 0.45, 0.80),
        [Box(BLOCK_X, BLOCK_Y, (-overlap, BLOCK_FRONT)),
         Box((-25, 25), (-135, -65), (BLOCK_FRONT - SINK, BLOCK_FRONT + 25))],
        (BLOCK_X[0], sum(BLOCK_Y) // 2, 0))
    slider = Link(
        "slider", (0.75, 0.25, 0.50),
        [Box(SLIDER_X, SLIDER_Y, (-overlap, SLIDER_FRONT))],
        (sum(SLIDER_X) // 2, SLIDER_Y[0], 0))
    return [block, slider]


def lockbox(name="lockbox", overlap=0):
    """overlap: millimetres by which faces that should touch run into each other."""
    about = "The lockbox: parts in flush contact over large areas."
    if overlap:
        about = f"The lockbox with a CAD error: contact faces overlap by {overlap} mm."
    return Model(
        name, about,
        [board(overlap)] + doors(overlap) + [disk(overlap)] + bolts() + blocks(overlap),
        [Joint("door_bottom_left", "revolute", "board", "door_bottom_left", (0, 1, 0), 0, 110),
         Joint("door_light_blue", "revolute", "board", "door_light_blue", (-1, 0, 0), 0, 110),
         Joint("latch", "revolute", "door_bottom_left", "latch", (0, 0, 1), -90, 90),
         Joint("disk", "continuous", "board", "disk", (0, 0, 1)),
         Joint("cylinder_horizontal", "prismatic", "board", "cylinder_horizontal", (1, 0, 0), 0,
               BOLT_TRAVEL),
         Joint("cylinder_vertical", "prismatic", "board", "cylinder_vertical", (0, 1, 0), 0,
               BOLT_TRAVEL),
         Joint("block", "prismatic", "board", "block", (1, 0, 0), 0, BLOCK_TRAVEL),
         Joint("slider", "prismatic", "board", "slider", (0, 1, 0), 0, SLIDER_TRAVEL)])
