// SPDX-License-Identifier: BSD-3-Clause
// The scene of `lockbox experiment peers`: a board before a wall, its door opening while its block
// slides, on which another tracker (M3T) was measured.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lockbox/evaluation/recording.hpp"
#include "lockbox/model/articulated_model.hpp"

namespace lockbox::app {

inline constexpr int kPeerFrames = 60;  ///< of a whole sequence, 30 a second

struct PeerSequence {
  std::string name;
  std::string sensor;
  bool moves = false;    ///< the board, by up to 10.3 mm and 0.81 degrees a frame
  bool has_arm = false;  ///< an arm sweeps over the board in the middle third
};

/// Returns the sequences with the sensors of white noise and of structured light: still, moving,
/// and under an arm.
const std::vector<PeerSequence>& peer_sequences();

/// The door from 0 to 60 degrees and the slide from 0 to 0.2 m over kPeerFrames, of which the first
/// so many. The board starts in the model's initial pose. Throws InputError if the model has no
/// joints `door` and `slide`.
std::vector<State> peer_truth(const ArticulatedModel& model, bool moves, int frames);

/// What the sensor (640x480, focal length 570 pixels) sees of these states.
Recording simulate_peer_sequence(const ArticulatedModel& model, const std::vector<State>& truth,
                                 const PeerSequence& sequence, std::uint64_t seed);

/// Every k-th state with its frame, from the first on.
Recording every_kth(const Recording& recording, int k);

}  // namespace lockbox::app
