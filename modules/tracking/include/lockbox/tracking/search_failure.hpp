// SPDX-License-Identifier: BSD-3-Clause
// Why a search of the whole frame has found nothing to believe in, as far as it is known.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

struct ArticulatedModel;
struct DepthFrame;
class Executor;
struct KinematicTree;
struct RegistrationResult;
struct TrackerOptions;

/// What the frame shows, and how the model compares with it.
struct SearchFailure {
  /// The most convincing place, which is not convincing enough.
  struct Place {
    double distance = 0.0;          ///< metres from the camera to the base
    double explained = 0.0;         ///< shares of the model's surface that would be visible there
    double contradicted = 0.0;      ///< share of the visible surface
    double occluded = 0.0;          ///< share of the visible surface
    double continued = 0.0;         ///< share of the contour beyond which the scene goes on
    std::string contradicted_body;  ///< which the camera sees through most; empty: none
  };

  double measured = 0.0;         ///< share of the pixels that have a depth
  double too_near = 0.0;         ///< share of these that is nearer than what is used
  double too_far = 0.0;          ///< likewise farther
  double median_depth = 0.0;     ///< metres, of all that have a depth; 0 if none has
  double min_depth = 0.0;        ///< metres, of CloudOptions
  double max_depth = 0.0;        ///< likewise
  double units_per_metre = 0.0;  ///< of the frame's depths
  double noise = 0.0;  ///< metres that depths err by at the median, by the image; 0: unknown
  double assumed_noise = 0.0;  ///< the same as the sensor's profile has it
  PinholeCamera camera;        ///< of the frame
  double field_of_view = 0.0;  ///< degrees, from the left edge of the image to the right one
  /// Metres that the longer side of the image spans at the farthest depth in use; 0: there is none.
  double view_size = 0.0;
  double model_size = 0.0;    ///< metres, the diagonal of the box around the model at rest
  double model_pixels = 0.0;  ///< so long the model would be at the nearest depth in use; 0: none
  bool is_mirrored = false;   ///< the model is found in the frame's mirror image
  double depth_factor = 1.0;  ///< the model is found if all depths are so many times as large
  /// Of other configurations the model looks the same in as in the best place (LookAlikes).
  std::size_t look_alikes = 0;
  std::optional<Place> best;  ///< none: nothing in view resembles the model
};

/// Returns what the frame alone tells, and the answer that was not believed; null: there was none.
SearchFailure search_failure(const DepthFrame& frame, const KinematicTree& tree,
                             const TrackerOptions& options, const RegistrationResult* best);

/// Returns whether the frame alone tells why the model cannot be found in it.
bool is_explained(const SearchFailure& failure);

/// Returns the reasons in whole sentences, the surest first, each with what to do about it; at
/// least one.
std::vector<std::string> reasons(const SearchFailure& failure);

/// Tries what recordings are often wrong by: mirrored images, and depths in fifths of the unit that
/// they are read in, or the other way round
/// (unless TrackerOptions::try_other_units says not). A reading is believed if it is convincing
/// (TrackerOptions::convincing_belief) beside the answer in the frame as it is, `best`; null: there
/// was none. Takes some seconds. Throws Stopped as a search does.
void try_other_readings(const DepthFrame& frame, const ArticulatedModel& model,
                        const TrackerOptions& options, const Executor& executor,
                        const RegistrationResult* best, SearchFailure& failure);

}  // namespace lockbox
