// SPDX-License-Identifier: BSD-3-Clause
// The runs of `lockbox experiment peers`: sequences, sequences with frames left out, and single
// frames from wrong starts. All on one thread.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lockbox/evaluation/frame_outcome.hpp"
#include "lockbox/evaluation/recording.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox::app {

/// What was made of one frame. Errors are NaN while nothing is known.
struct PeerFrame {
  FrameOutcome outcome;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< error of the base in its frame, metres
  double door = 0.0;                                 ///< magnitude of the error, radians
  double slide = 0.0;                                ///< metres
  Elapsed cloud_time;
  Elapsed step_time;

  /// Whatever is reported as observable: base and all joints within the usual tolerances.
  bool is_right() const;
};

/// The whole tracker with so many points.
struct PeerSetting {
  std::string name;
  std::size_t point_budget;
};

/// The default, and a fast one; the first is used for all runs but `every == 1`.
const std::vector<PeerSetting>& peer_settings();

struct PeerRun {
  std::string tracker;  ///< PeerSetting::name
  std::string sequence;
  int every = 1;  ///< of the sequence's frames, every so many-th
  std::uint64_t seed = 1;
  double largest_step = 0.0;  ///< of the base from frame to frame, metres
  double largest_turn = 0.0;  ///< radians
  std::vector<PeerFrame> frames;
};

/// The whole tracker, started at the truth of the first frame.
PeerRun follow_sequence(const ArticulatedModel& model, const PeerSetting& setting,
                        const std::string& sequence, int every, std::uint64_t seed,
                        const Recording& recording);

/// How far a start is off.
struct CaptureKind {
  std::string name;
  double translation = 0.0;  ///< in a random direction, metres
  double rotation = 0.0;     ///< about a random axis, radians
  double door = 0.0;         ///< one way or the other, radians
  double slide = 0.0;        ///< metres
};

const std::vector<CaptureKind>& capture_kinds();

struct CaptureTrial {
  std::string kind;
  int number = 0;
  bool searches = false;  ///< whether the tracker may search the whole frame
  PeerFrame end;

  /// Base within 20 mm and 3 degrees, door within 5 degrees, slide within 20 mm.
  bool succeeds() const;
};

inline constexpr int kCaptureFrame = 30;  ///< of the sequence `static`
inline constexpr int kCaptureSteps = 10;  ///< of tracking, on that one frame

/// The start depends on kind, number and seed alone.
CaptureTrial capture(const ArticulatedModel& model, const CaptureKind& kind, int number,
                     std::uint64_t seed, bool searches, const State& truth,
                     const DepthFrame& frame);

}  // namespace lockbox::app
