// SPDX-License-Identifier: BSD-3-Clause
// An evaluation as files: summary.json, errors.csv, and plots of the errors over time.
#pragma once

#include <filesystem>
#include <string>

#include "lockbox/evaluation/metrics.hpp"

namespace lockbox {

/// Totals as JSON: metres, radians, seconds; null where there is nothing to sum.
std::string summary_text(const KinematicTree& tree, const Evaluation& evaluation);

/// Writes the summary into a file. Throws InputError if it cannot be written, as do the functions
/// below.
void write_summary(const std::filesystem::path& file, const KinematicTree& tree,
                   const Evaluation& evaluation);

/// One row a reference state: `timestamp,status,translation,rotation,<joint>...`, nan where
/// unknown.
void write_errors(const std::filesystem::path& file, const KinematicTree& tree,
                  const Evaluation& evaluation);

/// base.png, base.svg, and joints.png, joints.svg if there are joints, in the folder.
/// Returns what prevented it (no gnuplot), or nothing.
std::string write_error_plots(const std::filesystem::path& folder, const KinematicTree& tree,
                              const Evaluation& evaluation);

}  // namespace lockbox
