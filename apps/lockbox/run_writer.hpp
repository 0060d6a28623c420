// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox::app {

/// Throws InputError if the folder holds the rows of a run, unless it is to be overwritten. True if
/// it holds a run without a row, which nobody misses.
bool require_no_rows(const std::filesystem::path& folder, bool overwrite);

/// kind:probability, separated by semicolons.
std::string alternatives_text(const std::vector<Alternative>& alternatives);

/// Writes what a run estimates, flushed frame by frame: a crash loses nothing computed before it.
///   states.csv      one row a frame (docs/run-files.md)
///   base.tum        the base's pose where it is known, as a TUM trajectory
///   alternatives.csv  where the object may be as well in a frame, a row each
///   covariance.csv  if asked for: the full matrix of each frame, row by row
class RunWriter {
 public:
  /// Makes the folder. The tree is referred to. Throws InputError if a file cannot be written.
  RunWriter(const std::filesystem::path& folder, const KinematicTree& tree, bool with_covariance);

  void write(const TrackingResult& result);

 private:
  void write_state(const TrackingResult& result);
  void write_base(const TrackingResult& result);
  void write_alternatives(const TrackingResult& result);
  void write_covariance(const TrackingResult& result);

  std::filesystem::path folder_;
  const KinematicTree& tree_;
  Configuration unknown_;  ///< in rows of frames of which nothing is known
  std::ofstream states_;
  std::ofstream base_;
  std::ofstream alternatives_;
  std::ofstream covariance_;
};

}  // namespace lockbox::app
