// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiment.hpp"

namespace lockbox::app {

struct ExperimentEntry {
  std::string name;
  std::string summary;
  std::unique_ptr<Experiment> (*make)();
};

const std::vector<ExperimentEntry>& experiments();

// One source each: <name>_experiment.cpp; furniture, boards and household:
// foreign_experiment.cpp.
std::unique_ptr<Experiment> make_absent_experiment();
std::unique_ptr<Experiment> make_accuracy_experiment();
std::unique_ptr<Experiment> make_boards_experiment();
std::unique_ptr<Experiment> make_convergence_experiment();
std::unique_ptr<Experiment> make_creep_experiment();
std::unique_ptr<Experiment> make_furniture_experiment();
std::unique_ptr<Experiment> make_global_experiment();
std::unique_ptr<Experiment> make_household_experiment();
std::unique_ptr<Experiment> make_intersection_experiment();
std::unique_ptr<Experiment> make_kidnap_experiment();
std::unique_ptr<Experiment> make_mismatch_experiment();
std::unique_ptr<Experiment> make_occlusion_experiment();
std::unique_ptr<Experiment> make_order_experiment();
std::unique_ptr<Experiment> make_peers_experiment();
std::unique_ptr<Experiment> make_reliability_experiment();
std::unique_ptr<Experiment> make_rigid_experiment();
std::unique_ptr<Experiment> make_shapes_experiment();
std::unique_ptr<Experiment> make_speed_experiment();

}  // namespace lockbox::app
