// SPDX-License-Identifier: BSD-3-Clause
// What one thread needs to compare patches, and the sums that come of one.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/terms/edge_patch.hpp"
#include "lockbox/terms/edge_term.hpp"
#include "lockbox/terms/patch_noise.hpp"

namespace lockbox {

/// The memory of one thread.
struct EdgeTerm::Worker {
  using Index = Eigen::Index;
  static constexpr int kSide = EdgePatch::kSide;
  /// A patch whose chi^2 is larger than its pixels by this factor shows something else, too.
  static constexpr double kFit = 2.0;

  Worker(const SensorNoise& sensor, Index unknowns)
      : samples(), patch(sensor.lateral_pixels), noise(sensor, kSide) {
    variables.reserve(static_cast<std::size_t>(unknowns));
    for (auto& screw : screws) screw.setZero(6, unknowns - kBaseUnknowns);
    columns.reserve(kSide);
  }

  /// Returns where the residual stands among a pixel's values: after the derivative of its mean by
  /// the base's twist in the camera's frame and by the variables.
  Index residual_column() const { return kBaseUnknowns + static_cast<Index>(variables.size()); }

  void find_variables(const std::vector<std::vector<int>>& by_body,
                      const std::vector<BodyJacobian>& by_unknowns) {
    variables.clear();
    for (const std::int16_t body : patch.bodies()) {
      for (const int v : by_body[static_cast<std::size_t>(body)]) {
        if (std::find(variables.begin(), variables.end(), v) == variables.end()) {
          variables.push_back(v);
        }
      }
    }
    for (std::size_t b = 0; b < patch.bodies().size(); ++b) {
      const BodyJacobian& screw = by_unknowns[static_cast<std::size_t>(patch.bodies()[b])];
      for (std::size_t k = 0; k < variables.size(); ++k) {
        screws[b].col(static_cast<Index>(k)) = screw.col(unknown_of(variables[k])).cast<float>();
      }
    }
  }

  /// Differentiates the pixel that was looked at last. values: zero at first.
  void differentiate(const Pixel& pixel, const PinholeCamera& camera,
                     std::span<float> values) const {
    const Eigen::Vector3f ray = camera.back_project(pixel.u, pixel.v, 1.0).cast<float>();
    Eigen::Map<Eigen::VectorXf> derivative(values.data(), residual_column());
    for (std::size_t b = 0; b < patch.bodies().size(); ++b) {
      const Eigen::Matrix<float, 6, 1> by_twist = patch.derivative(b, ray.x(), ray.y(), camera);
      derivative.head<6>() += by_twist;
      for (std::size_t k = 0; k < variables.size(); ++k) {
        derivative[kBaseUnknowns + static_cast<Index>(k)] +=
            by_twist.dot(screws[b].col(static_cast<Index>(k)));
      }
    }
  }

  /// Adds the products of the values, whitened, to those of all unknowns and the residual.
  void add_whitened(Eigen::MatrixXd& sums) {
    noise.whiten();
    kernels::PaddedRows& products = noise.products();
    const Index size = residual_column() + 1;
    const auto product = [&](Index i, Index j) {
      return static_cast<double>(
          products.row(static_cast<std::size_t>(i))[static_cast<std::size_t>(j)]);
    };
    const double chi_squared = product(size - 1, size - 1);
    const double weight = std::min(1.0, kFit * static_cast<double>(noise.count()) / chi_squared);
    for (Index j = 0; j < size; ++j) {
      for (Index i = 0; i < size; ++i) {
        sums(unknown(i, sums), unknown(j, sums)) += weight * product(j, i);
      }
    }
  }

  /// That of a column.
  Index unknown(Index column, const Eigen::MatrixXd& sums) const {
    if (column < kBaseUnknowns) return column;
    if (column == residual_column()) return sums.cols() - 1;
    return unknown_of(variables[static_cast<std::size_t>(column - kBaseUnknowns)]);
  }

  RenderedInverseDepth samples;  ///< of neighbouring patches in a row
  EdgePatch patch;
  PatchNoise noise;
  std::vector<int> variables;  ///< that move anything in the patch
  /// By body of the patch: from these variables to its twist in the camera's frame.
  std::array<Eigen::Matrix<float, 6, Eigen::Dynamic>, EdgePatch::kMostBodies> screws;
  std::vector<int> columns;  ///< of the row in hand: pixels that measure an edge
};

}  // namespace lockbox
