// SPDX-License-Identifier: BSD-3-Clause
// Poses, cameras and configurations as numpy arrays and dicts.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/configuration.hpp"

namespace lockbox::python {

namespace py = pybind11;

/// Throws InputError for what is no pose.
Eigen::Isometry3d to_pose(const Eigen::Matrix4d& matrix);

/// By name, in the order in which Python shows them.
using JointValues = std::vector<std::pair<std::string, double>>;

/// What is estimated, or given as a start.
struct State {
  Eigen::Matrix4d base = Eigen::Matrix4d::Identity();
  JointValues joints;
};

/// Joints that are not named are at rest. Throws InputError for what is no pose, and for names that
/// the tree has not.
Configuration to_configuration(const KinematicTree& tree, const State& state);
/// Joints in the order of the file.
State to_state(const KinematicTree& tree, const Configuration& configuration);

/// The variables of joints that mimic none, in the order of the file.
std::vector<int> variables_of_file(const KinematicTree& tree);

py::dict to_dict(const JointValues& values);

/// K: 3x3. Throws InputError for what is no camera without skew.
void require_camera(const Eigen::Matrix3d& intrinsics);

/// Throws InputError, too, for what is no camera of images of this size.
PinholeCamera to_camera(const Eigen::Matrix3d& intrinsics, int width, int height);
Eigen::Matrix3d to_matrix(const PinholeCamera& camera);

}  // namespace lockbox::python
