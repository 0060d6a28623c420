// SPDX-License-Identifier: BSD-3-Clause
// Scenes are written for one model; others stand otherwise and reach farther.
#pragma once

#include "lockbox/model/states_file.hpp"
#include "lockbox/simulation/scene.hpp"

namespace lockbox {

/// The scene around that model, as it is seen in that state, if the scene says how much room it
/// leaves (Scene::room); else the scene as it is. Its base frame is turned so that its y axis is
/// the model's y or z axis, whichever points up in the image (or down, then it is the opposite
/// direction), and its z axis the one of the model's axes that points to the camera. What lies
/// beyond a face of the room, by its centre, moves out by as much as the model reaches beyond it.
/// Where neither is needed, the scene comes back unchanged.
Scene fitted(const Scene& scene, const KinematicTree& tree, const State& first);

}  // namespace lockbox
