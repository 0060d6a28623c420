// SPDX-License-Identifier: BSD-3-Clause
// The rows of `lockbox experiment convergence`, and what they say.
#pragma once

#include <string>
#include <vector>

#include "lockbox/evaluation/figure.hpp"
#include "lockbox/evaluation/status_count.hpp"
#include "lockbox/evaluation/table.hpp"
#include "lockbox/evaluation/tolerances.hpp"

namespace lockbox::app {

/// Who tracks: the whole tracker, or the registration without searching anywhere.
struct Variant {
  std::string tracker;  ///< "whole" or "registration"
  std::string joints;   ///< "held" or "free"

  std::string text() const;
};

/// One start, followed to its end.
struct ConvergenceRun {
  Variant variant;
  double start_translation = 0.0;  ///< error of the start, centimetres
  double start_rotation = 0.0;     ///< degrees
  int sample = 0;
  std::string status;  ///< of the last frame
  int searches = 0;
  int frames = 0;            ///< that it took to settle
  double translation = 0.0;  ///< error at the end, metres; NaN while nothing is known
  double rotation = 0.0;     ///< radians
  double joints = 0.0;       ///< of FrameOutcome, as worst_joint
  std::string worst_joint;
  StatusCount statuses;  ///< of all its frames
};

const std::vector<std::string>& convergence_columns();
Row to_row(const ConvergenceRun& run);
ConvergenceRun from_row(const Table& table, const Row& row);

/// What identifies a run.
std::string key(const ConvergenceRun& run);

void print_convergence(const std::vector<ConvergenceRun>& runs, const Tolerances& success);

/// One heat map a variant: how many of a cell's runs succeed, and where half of them do.
Figure convergence_figure(const std::string& name, const std::vector<ConvergenceRun>& runs,
                          const Tolerances& success);

}  // namespace lockbox::app
