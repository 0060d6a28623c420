// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/search_failure.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "mechanism.hpp"

namespace lockbox {

inline std::string said(const SearchFailure& failure) {
  std::string all;
  for (const std::string& reason : reasons(failure)) all += reason + '\n';
  return all;
}

/// A frame in which a bracket is seen, to be spoiled.
class SearchFailureTest : public ::testing::Test {
 protected:
  static TrackerOptions options() {
    TrackerOptions options;
    options.threads = 1;
    return options;
  }

  SearchFailure failure(const RegistrationResult* best = nullptr) const {
    return search_failure(frame, model.tree, options(), best);
  }

  /// Sees nothing but a wall.
  void look_at_wall(std::uint16_t millimetres) {
    std::fill(frame.depth.begin(), frame.depth.end(), millimetres);
  }

  /// What the same camera sees in a mirror.
  void mirror() {
    frame.camera.cx = frame.camera.width - 1 - frame.camera.cx;
    for (auto row = frame.depth.begin(); row != frame.depth.end(); row += frame.camera.width) {
      std::reverse(row, row + frame.camera.width);
    }
  }

  /// As a camera with half as many columns and rows sees it: sought in a part of the time.
  static DepthFrame every_second_pixel(const DepthFrame& whole) {
    const PinholeCamera& camera = whole.camera;
    DepthFrame half = whole;
    half.camera = {camera.width / 2, camera.height / 2, 0.5 * camera.fx,
                   0.5 * camera.fy,  0.5 * camera.cx,   0.5 * camera.cy};
    half.depth.clear();
    for (std::size_t row = 0; row < static_cast<std::size_t>(camera.height); row += 2) {
      for (std::size_t column = 0; column < static_cast<std::size_t>(camera.width); column += 2) {
        half.depth.push_back(whole.depth[row * static_cast<std::size_t>(camera.width) + column]);
      }
    }
    return half;
  }

  void try_readings(SearchFailure& failure) const {
    try_other_readings(frame, model, options(), Executor(1), nullptr, failure);
  }

  /// A box, and what stands out of it.
  static ArticulatedModel box_with(const std::string& more) {
    LoadOptions without_cache;
    without_cache.cache_directory = std::filesystem::path();
    return load_mechanism(
        {R"(<link name="box"><visual><geometry><box size="0.24 0.16 0.09"/></geometry></visual>)" +
         more + "</link>"},
        without_cache);
  }

  bool looks_mirrored(const ArticulatedModel& sought,
                      const RegistrationResult* best = nullptr) const {
    SearchFailure found = search_failure(frame, sought.tree, options(), best);
    TrackerOptions stated = options();
    stated.try_other_units = false;
    try_other_readings(frame, sought, stated, Executor(1), best, found);
    return found.is_mirrored;
  }

  const ArticulatedModel& model = bracket();
  const Configuration truth = mechanism_start(model);
  DepthFrame frame = measured(model, truth, "primesense");
};

}  // namespace lockbox
