// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "lockbox/evaluation/metrics.hpp"
#include "lockbox/model/articulated_model.hpp"

namespace lockbox::app {

/// An estimate and its reference as `evaluate` compares them.
struct ComparedFiles {
  KinematicTree tree;  ///< of the model; where it is not known, of the columns
  StatesFile estimate;
  StatesFile reference;
  EqualPoses equal;  ///< those that count as the true one
};

/// Takes sentences for people: what is probably wrong, and what was done.
struct Remarks {
  std::function<void(const std::string&)> warn;
  std::function<void(const std::string&)> note;
};

/// Throws InputError if a file is missing, and if the estimate is a TUM trajectory, which tells of
/// no joints.
void require_comparable(const std::string& estimate, const std::string& reference);

/// Reads both, with times in seconds. model: null if it is not known. Of a reference that is a TUM
/// trajectory only the base is compared. Throws InputError, also if the reference belongs to
/// another model or recording.
ComparedFiles read_compared_files(const std::string& estimate, const std::string& reference,
                                  const ArticulatedModel* model, const Remarks& remarks);

}  // namespace lockbox::app
