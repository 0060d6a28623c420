// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/articulated_model.hpp"

namespace lockbox::python {

/// Everything that refers to it shares it.
using ModelPointer = std::shared_ptr<const ArticulatedModel>;

struct Model {
  ModelPointer model;
};

/// A frame of an array (rows x columns; u2 in units_per_metre, or floats in metres). Throws
/// InputError for arrays that are no depth image.
DepthFrame to_frame(const pybind11::array& depth, const Eigen::Matrix3d& intrinsics,
                    double units_per_metre);

// One source each; later ones need the classes of earlier ones.
void bind_model(pybind11::module_& module);
void bind_frames(pybind11::module_& module);
void bind_tracker(pybind11::module_& module);
void bind_evaluation(pybind11::module_& module);

}  // namespace lockbox::python
