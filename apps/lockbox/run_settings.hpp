// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace lockbox::app {

/// Where the results of a run go, and when it ends.
struct RunSettings {
  std::filesystem::path output;     ///< folder; empty: nothing is written
  bool covariance = false;          ///< write covariance.csv too
  std::filesystem::path recording;  ///< .oni file that receives the frames; empty: none
  std::filesystem::path snapshots;  ///< folder of pictures; empty: none
  std::size_t snapshot_interval = 10;
  std::size_t max_frames = 0;  ///< 0: until the source ends
  bool overwrite = false;      ///< what an earlier run has left there
  bool view = false;           ///< show every frame in a window
  bool quiet = false;
  std::vector<std::string> publish;  ///< targets, see lockbox/publishing/publish_target.hpp
};

}  // namespace lockbox::app
