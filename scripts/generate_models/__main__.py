# SPDX-License-Identifier: BSD-3-Clause
"""Checks and writes the shipped models: python3 scripts/generate_models share/models"""

import sys

from board_door_block import board_door_block
from cabinet import cabinet
from checks import check_contacts, check_free_motion, check_meshes
from lockbox import lockbox
from models import write_model
from rigid_block import rigid_block


def main(folder):
    overlap = 0.5  # mm
    for model, depth in ((lockbox(), 0), (lockbox("lockbox_overlapping", overlap), overlap),
                         (cabinet(), 0), (rigid_block(), 0), (board_door_block(), 0)):
        check_meshes(model)
        check_contacts(model, depth)
        check_free_motion(model, depth, count=300)
        write_model(folder, model)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
