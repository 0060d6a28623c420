# SPDX-License-Identifier: BSD-3-Clause
"""Tracks articulated objects with a depth camera.

Metres, radians, seconds. Poses are those of the base link in the depth camera's optical frame
(x right, y down, z forward).
"""

import numpy as _numpy  # noqa: F401  # whose absence is said here, not at the first array

from lockbox._lockbox import (
    Alternative,
    ApparentSize,
    DeviceError,
    Frame,
    InputError,
    Joint,
    Model,
    Result,
    Source,
    State,
    Tracker,
    __version__,
    evaluate,
    load_model,
    open_source,
)

__all__ = [
    "Alternative",
    "ApparentSize",
    "DeviceError",
    "Frame",
    "InputError",
    "Joint",
    "Model",
    "Result",
    "Source",
    "State",
    "Tracker",
    "evaluate",
    "load_model",
    "open_source",
]

for _name in __all__:
    globals()[_name].__module__ = "lockbox"  # where users find it
del _name
