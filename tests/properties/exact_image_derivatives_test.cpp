// SPDX-License-Identifier: BSD-3-Clause
// Property "exact derivatives": the derivative of what pixels at edges are expected to measure
// against differences of drawings, as closely as samples tell, three by three a pixel.
#include <gtest/gtest.h>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/motion_scales.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/terms/edge_patch.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

/// What the pixels around the model's edges are expected to measure (1/metre), with the derivative
/// by all unknowns; of pixels that may show nothing: zero.
struct ExpectedImage {
  Eigen::VectorXd means;
  Eigen::MatrixXd derivatives;
};

ExpectedImage expected_image(const ArticulatedModel& model, const Configuration& at) {
  const PinholeCamera camera{320, 240, 290.0, 290.0, 159.5, 119.5};
  constexpr int kMargin = 2;
  BodyPoses poses;
  forward_kinematics(model.tree, at, poses);
  std::vector<BodyJacobian> jacobians;
  body_jacobians(model.tree, poses, jacobians);
  std::vector<RenderItem> items;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    items.push_back(body_item(model.tree, b, poses[b]));
    jacobians[b] = adjoint(poses[b]) * jacobians[b];
  }
  DepthRenderer renderer(refined(camera, EdgePatch::kSamples), Executor(1));
  renderer.prepare(items);
  RenderedInverseDepth samples;
  renderer.draw({0, 0, renderer.camera().width, renderer.camera().height}, samples);
  ExpectedImage image;
  image.means.setZero(camera.width * camera.height);
  image.derivatives.setZero(image.means.size(), 6 + model.tree.variables());
  EdgePatch patch(0.5);
  const int last_left = camera.width - kMargin - EdgePatch::kSide;
  const int last_top = camera.height - kMargin - EdgePatch::kSide;
  for (int top = kMargin; top <= last_top; top += EdgePatch::kSide) {
    for (int left = kMargin; left <= last_left; left += EdgePatch::kSide) {
      if (!patch.read(samples, EdgePatch::kSamples * left - EdgePatch::kReach,
                      EdgePatch::kSamples * top - EdgePatch::kReach)) {
        continue;
      }
      for (int row = 0; row < EdgePatch::kSide; ++row) {
        patch.begin_row(row, 0, EdgePatch::kSide);
        for (int column = 0; column < EdgePatch::kSide; ++column) {
          if (patch.may_show_nothing(column, row)) continue;
          patch.look_at(column);
          const Eigen::Index pixel = (top + row) * camera.width + left + column;
          const Eigen::Vector3f ray =
              camera.back_project(left + column, top + row, 1.0).cast<float>();
          image.means[pixel] = static_cast<double>(patch.mean());
          for (std::size_t b = 0; b < patch.bodies().size(); ++b) {
            image.derivatives.row(pixel) +=
                patch.derivative(b, ray.x(), ray.y(), camera).cast<double>().transpose() *
                jacobians[static_cast<std::size_t>(patch.bodies()[b])];
          }
        }
      }
    }
  }
  return image;
}

// Samples change at edges one after the other, so that differences of single pixels are coarse; and
// over half a pixel to both sides they round off the density of the jitter, half a pixel wide.
TEST(ExactImageDerivatives, ExpectedImageAgreesWithNumericalDifferentiation) {
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  const Eigen::VectorXd scales = motion_scales(model.tree);
  const ExpectedImage here = expected_image(model, truth);
  for (Eigen::Index i = 0; i < scales.size(); ++i) {
    const double h = 0.0006 / scales[i];  // half a pixel
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(scales.size(), i);
    const ExpectedImage after = expected_image(model, stepped(truth, step));
    const ExpectedImage before = expected_image(model, stepped(truth, -step));
    const auto is_seen =
        here.means.array() > 0.0 && after.means.array() > 0.0 && before.means.array() > 0.0;
    const Eigen::VectorXd numeric =
        is_seen.select((after.means - before.means).array() / (2.0 * h), 0.0);
    const Eigen::VectorXd analytic = is_seen.select(here.derivatives.col(i).array(), 0.0);
    ASSERT_GT(analytic.norm(), 0.0);
    EXPECT_NEAR(numeric.dot(analytic) / analytic.squaredNorm(), 1.0, 0.05) << "unknown " << i;
    EXPECT_LT((numeric - analytic).norm(), 0.25 * analytic.norm()) << "unknown " << i;
  }
}

}  // namespace
}  // namespace lockbox
