// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "hypothesis.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/look_alikes.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/verification/evidence_options.hpp"
#include "model_extent.hpp"

namespace lockbox {

/// What is known of the object before any image. The model has to outlive it.
struct SoughtModel {
  /// known: its look-alikes; null: they are found here.
  SoughtModel(const ArticulatedModel& articulated_model, const RegistrationOptions& options,
              const EvidenceOptions& of_evidence = {},
              std::shared_ptr<const LookAlikes> known = nullptr);

  const ArticulatedModel& model;
  EvidenceOptions evidence;
  KinematicTree from_afar;  ///< the model in fewer triangles, for views of few pixels
  bool is_flat;             ///< most of its surface
  ModelExtent extent;
  std::vector<Eigen::Isometry3d> symmetries;  ///< of the model, wherever its joints stand
  std::vector<Eigen::Isometry3d> turns;       ///< of its box, or its base, that are none of it
  /// Of what is mostly round: those that leave most of its base where it is, and some by little.
  std::vector<Eigen::Isometry3d> round_turns;
  std::shared_ptr<const LookAlikes> look_alikes;
  std::vector<int> variables;            ///< of joints that are not locked
  std::vector<std::uint8_t> all_bodies;  ///< 1 for each, as drawings take them
};

/// The configurations in which that body is there; of one that a free joint moves, that many along
/// its range. All else is as in `held`, and only base and body are said to be known.
std::vector<Hypothesis> with_body_at(const SoughtModel& sought, const Configuration& held,
                                     std::size_t body, const Eigen::Isometry3d& T_camera_body,
                                     int steps);

/// The configuration in which that body is there, all joints as in `held`. The body alone is said
/// to be known, and stays where it is while joints are sought.
Hypothesis with_body_held(const SoughtModel& sought, const Configuration& held, std::size_t body,
                          const Eigen::Isometry3d& T_camera_body);

}  // namespace lockbox
