// SPDX-License-Identifier: BSD-3-Clause
// Property "exact derivatives": the derivative of what pixels at edges are expected to measure
// against two-sided differences of that, for every joint type, in a chain of three, with a mimic
// joint.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/terms/edge_patch.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

/// Thin plates before each other, each reaching into the view with one edge. Of a steep side the
/// outermost sample would lie up to a sample inside of the edge, where the surface is farther away,
/// and moves less.
std::vector<std::string> plates() {
  const auto plate = [](const std::string& name, const std::string& centre,
                        const std::string& size) {
    return "<link name=\"" + name + "\"><visual><origin xyz=\"" + centre +
           " 0\"/><geometry><box size=\"" + size + " 0.0002\"/></geometry></visual></link>";
  };
  return {plate("board", "0 0", "1 1"),
          plate("block", "-0.2 0", "0.4 0.8"),
          plate("arm", "0 0.2", "0.9 0.4"),
          plate("wheel", "0.2 0.2", "0.4 0.9"),
          plate("twin", "0 -0.2", "0.9 0.4"),
          R"(<joint name="slide" type="prismatic"><parent link="board"/><child link="block"/>
         <origin xyz="-0.04 0 0.03" rpy="0 0 0.15"/><axis xyz="1 0.2 0"/>
         <limit lower="-0.1" upper="0.1" effort="1" velocity="1"/></joint>)",
          R"(<joint name="turn" type="revolute"><parent link="block"/><child link="arm"/>
         <origin xyz="0.24 0.05 0.02" rpy="0 0 -0.25"/><axis xyz="0 0 1"/>
         <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>)",
          R"(<joint name="spin" type="continuous"><parent link="arm"/><child link="wheel"/>
         <origin xyz="-0.1 -0.25 0.02"/><axis xyz="0 0.04 1"/></joint>)",
          R"(<joint name="follow" type="prismatic"><parent link="board"/><child link="twin"/>
         <origin xyz="0 -0.06 0.04" rpy="0 0 0.12"/><axis xyz="0 1 0"/>
         <limit lower="-0.2" upper="0.2" effort="1" velocity="1"/>
         <mimic joint="slide" multiplier="0.9" offset="0.002"/></joint>)"};
}

/// What the pixels of an image are expected to measure (1/metre).
struct ExpectedImage {
  Eigen::ArrayXd means;
  Eigen::ArrayXd derivatives;  ///< of the means, by one unknown
  Eigen::ArrayXd bodies;       ///< that are within reach of the pixel
};

class ExactImageDerivatives : public ::testing::Test {
 protected:
  /// How many bodies are in the samples that a pixel looks at.
  std::size_t bodies_in_reach(int left, int top) const {
    constexpr int kSide = 2 * EdgePatch::kReach + 2;
    std::set<std::int16_t> bodies;
    for (int row = top; row < top + kSide; ++row) {
      const auto first = samples.id.begin() + row * samples.width + left;
      bodies.insert(first, first + kSide);
    }
    return bodies.size();
  }

  ExpectedImage expected_image(const Configuration& at, Eigen::Index unknown) {
    BodyPoses poses;
    forward_kinematics(tree, at, poses);
    std::vector<BodyJacobian> jacobians;
    body_jacobians(tree, poses, jacobians);
    std::vector<RenderItem> items;
    std::vector<Twist> twists;
    for (std::size_t b = 0; b < poses.size(); ++b) {
      items.push_back(body_item(tree, b, poses[b]));
      twists.emplace_back(adjoint(poses[b]) * jacobians[b].col(unknown));
    }
    renderer.prepare(items);
    renderer.draw({0, 0, renderer.camera().width, renderer.camera().height}, samples);
    const Eigen::Index pixels = kCamera.width * kCamera.height;
    ExpectedImage image{Eigen::ArrayXd::Zero(pixels), Eigen::ArrayXd::Zero(pixels),
                        Eigen::ArrayXd::Zero(pixels)};
    for (int top = kMargin; top + kMargin + EdgePatch::kSide <= kCamera.height;
         top += EdgePatch::kSide) {
      for (int left = kMargin; left + kMargin + EdgePatch::kSide <= kCamera.width;
           left += EdgePatch::kSide) {
        read_patch(left, top, twists, image);
      }
    }
    return image;
  }

  void read_patch(int left, int top, const std::vector<Twist>& twists, ExpectedImage& image) {
    const int left_sample = EdgePatch::kSamples * left - EdgePatch::kReach;
    const int top_sample = EdgePatch::kSamples * top - EdgePatch::kReach;
    ASSERT_TRUE(patch.read(samples, left_sample, top_sample));
    for (int row = 0; row < EdgePatch::kSide; ++row) {
      patch.begin_row(row, 0, EdgePatch::kSide);
      for (int column = 0; column < EdgePatch::kSide; ++column) {
        ASSERT_FALSE(patch.may_show_nothing(column, row));
        patch.look_at(column);
        const Eigen::Index pixel = (top + row) * kCamera.width + left + column;
        image.means[pixel] = static_cast<double>(patch.mean());
        image.bodies[pixel] = static_cast<double>(bodies_in_reach(
            left_sample + EdgePatch::kSamples * column, top_sample + EdgePatch::kSamples * row));
        const Eigen::Vector3f ray =
            kCamera.back_project(left + column, top + row, 1.0).cast<float>();
        for (std::size_t b = 0; b < patch.bodies().size(); ++b) {
          image.derivatives[pixel] += patch.derivative(b, ray.x(), ray.y(), kCamera)
                                          .cast<double>()
                                          .dot(twists[static_cast<std::size_t>(patch.bodies()[b])]);
        }
      }
    }
  }

  static constexpr int kMargin = 2;  // pixels, beyond which a patch may look
  static inline const PinholeCamera kCamera{52, 44, 145.0, 145.0, 20.0, 22.0};
  const KinematicTree tree = load_mechanism_tree(plates());
  const Configuration middle = [this] {
    Configuration configuration = rest_configuration(tree);
    configuration.T_camera_base.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
    configuration.T_camera_base.translation() = Eigen::Vector3d(0.0, 0.0, 0.7);
    Twist tilt;
    tilt << 0.0, 0.0, 0.0, 0.04, -0.02, 0.0;
    configuration.T_camera_base = configuration.T_camera_base * exp_se3(tilt);
    return configuration;
  }();
  DepthRenderer renderer{refined(kCamera, EdgePatch::kSamples), Executor(1)};
  RenderedInverseDepth samples;
  EdgePatch patch{0.5};
};

/// What a pixel measures is the mean of samples, which change one after the other as an edge
/// passes: a staircase, of which the derivative is the slope. So it is summed up over ways on which
/// an edge passes all that a pixel looks at: that is the difference between their ends. A way has
/// few parts, so that of single pixels the sum is off by a hundredth, but not of all of them.
///
/// All of them are off by up to 1e-3. Eight times as many parts leave 2 to 5e-4 of it, which is the
/// term's own: an edge lies anywhere between two samples, and its step is taken for the difference
/// of these, into which goes how slanted surfaces change from one sample to the next. Of the slide
/// that is 0.5, 3.0, 5.5 and 10.1e-4 with no, half, this and twice the tilt, and 5.5, 3.2 and
/// 2.2e-4 with a focal length of once, twice and three times as many pixels.
TEST_F(ExactImageDerivatives, SumUpToDifferencesOfTheImage) {
  constexpr int kParts = 130;
  constexpr std::array<double, 9> kHalfWays = {0.03, 0.03, 0.03,   // the base, metres
                                               0.15, 0.15, 0.15,   // radians
                                               0.03, 0.25, 0.15};  // slide, turn, spin
  constexpr double kPassed = 0.02;  // 1/metre: less than between any two plates
  constexpr auto kUnknowns = static_cast<Eigen::Index>(kHalfWays.size());
  ASSERT_EQ(kUnknowns, tree.unknowns());
  for (Eigen::Index i = 0; i < kUnknowns; ++i) {
    const double half = kHalfWays[static_cast<std::size_t>(i)];
    const auto at = [&](double share) {
      const Eigen::VectorXd step = share * half * Eigen::VectorXd::Unit(kUnknowns, i);
      return expected_image(stepped(middle, step), i);
    };
    const ExpectedImage before = at(-1.0);
    const ExpectedImage after = at(1.0);
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(before.means.size());
    Eigen::ArrayXd is_compared = (before.bodies == 1.0 && after.bodies == 1.0).cast<double>();
    for (int part = 0; part < kParts; ++part) {
      const ExpectedImage here = at((2.0 * part + 1.0) / kParts - 1.0);
      sum += here.derivatives * 2.0 * half / kParts;
      is_compared *= (here.bodies <= 2.0).cast<double>();
    }
    const Eigen::ArrayXd change = is_compared * (after.means - before.means);
    const Eigen::ArrayXd error = is_compared * sum - change;
    EXPECT_GE((change.abs() > kPassed).count(), 10) << "unknown " << i;
    EXPECT_LT(std::abs(error.sum()), 1e-3 * change.abs().sum()) << "unknown " << i;
    EXPECT_LT(error.matrix().norm(), 0.02 * change.matrix().norm()) << "unknown " << i;
  }
}

}  // namespace
}  // namespace lockbox
