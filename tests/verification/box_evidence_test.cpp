// SPDX-License-Identifier: BSD-3-Clause
// A box has twelve edges, and tells no more than three sizes.
#include <gtest/gtest.h>

#include "initialization/seen_model.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/verification/belief.hpp"
#include "lockbox/verification/verifier.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

class BoxEvidence : public ::testing::TestWithParam<double> {
 protected:
  static ArticulatedModel box(const std::string& size) {
    const TemporaryFolder folder;
    LoadOptions options;
    options.cache_directory = std::filesystem::path();
    return load_model(folder.write("box.urdf", R"(<robot name="box"><link name="box">
      <visual><geometry><box size=")" + size + R"("/></geometry></visual></link></robot>)"),
                      options);
  }

  /// Three of its faces are in view.
  Configuration turned() const {
    Configuration configuration = rest_configuration(model_.tree);
    configuration.T_camera_base = Eigen::Translation3d(0.02, -0.03, 1.3) *
                                  Eigen::AngleAxisd(M_PI + 0.5, Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(GetParam(), Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ());
    return configuration;
  }

  Evidence evidence_in(const ArticulatedModel& shown, const Configuration& there) {
    verifier_.look_at(seen(shown, there, wall_behind(1.0)), SensorNoise{}.sigma_inverse_depth(),
                      Executor(2));
    return verifier_.evidence(turned());
  }

  ArticulatedModel model_ = box("0.4 0.3 0.25");
  Verifier verifier_{model_.tree};
};

/// Twelve lines bound three faces. They lie in six planes, each of which tells up to 10 nats; of
/// one, two may be made, whose lines end too far from it.
TEST_P(BoxEvidence, IsThatOfItsPlanes) {
  const Evidence evidence = evidence_in(model_, turned());
  EXPECT_GT(evidence.matched, 45.0);
  EXPECT_LT(evidence.matched, 70.0);
  EXPECT_GT(evidence.total(), least_evidence());
}

TEST_P(BoxEvidence, IsTooLittleInTheCornerOfALargerOne) {
  const ArticulatedModel larger = box("0.6 0.5 0.4");
  Configuration there = turned();
  Eigen::Vector3d corner(0.5, 0.5, 0.5);  // that which is next to the camera, in halves of sizes
  const Eigen::Vector3d sight = there.T_camera_base.inverse() * Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) corner[i] = sight[i] > 0.0 ? 0.5 : -0.5;
  const Eigen::Vector3d by = Eigen::Vector3d(0.4 - 0.6, 0.3 - 0.5, 0.25 - 0.4).cwiseProduct(corner);
  there.T_camera_base = there.T_camera_base * Eigen::Translation3d(by);
  EXPECT_LT(evidence_in(larger, there).total(), least_evidence());
}

INSTANTIATE_TEST_SUITE_P(Turned, BoxEvidence, ::testing::Values(0.5, 0.8));

}  // namespace
}  // namespace lockbox
