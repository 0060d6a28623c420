// SPDX-License-Identifier: BSD-3-Clause
// Models with any number of links and joints that look alike.
#pragma once

#include "registration_scene.hpp"

namespace lockbox {

/// A wall of 8 x 8 equal boxes, 0.64 m wide, each with a step in its front, hairline gaps between
/// them: however many links share them, it looks the same. All links but the first slide towards
/// the camera, by joints of their own up to that number of variables; the rest mimic the last of
/// these. links: 1, 8 or 64.
ArticulatedModel box_wall(int links, int variables);

/// The wall seen by a PrimeSense from 0.9 m, some boxes drawn out.
RegistrationScene box_wall_scene(int links, int variables);

}  // namespace lockbox
