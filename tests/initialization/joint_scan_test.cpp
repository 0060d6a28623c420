// SPDX-License-Identifier: BSD-3-Clause
// Joints that are tried over their whole ranges, in a view and in the image itself.
#include "joint_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "image_scan.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/model/moved_bodies.hpp"
#include "search_image.hpp"
#include "seen_model.hpp"

namespace lockbox {
namespace {

constexpr double kScanNoise = 6e-4;  // 1/metre: of the median of 2 x 2 pixels of a PrimeSense
constexpr double kScanSlack = 0.003;

/// The lockbox with its lower left door open, the latch on the door turned, and the slider up.
class JointScanTest : public ::testing::Test {
 protected:
  JointScanTest() { score_.set_view(view_, true); }

  int variable(const std::string& joint) const {
    const int index = joint_index(model_.tree, joint);
    return model_.tree.joints[static_cast<std::size_t>(index)].variable;
  }
  std::vector<double> scan(const std::vector<int>& variables, Configuration& configuration,
                           const ScanSteps& steps = kScan) {
    return scan_joints(model_.tree, extent_, score_, variables, kScanSlack, steps, configuration)
        .margins;
  }
  /// Base and slider as they are, all else shut.
  Configuration shut() const {
    Configuration configuration = truth_;
    configuration.q[door_] = configuration.q[latch_] = 0.0;
    return configuration;
  }

  const ArticulatedModel& model_ = shipped("lockbox");
  const int door_ = variable("door_bottom_left");
  const int latch_ = variable("latch");
  const int slider_ = variable("slider");
  const Configuration truth_ = [this] {
    Configuration configuration = facing(model_, 1.3, 0.1, 0.0);
    configuration.q[door_] = 1.5;
    configuration.q[latch_] = -1.3;
    configuration.q[slider_] = 0.2;
    return configuration;
  }();
  const TiledCloud cloud_ = seen(model_, truth_, wall_behind(0.6));
  const CoarseView view_{cloud_, kFineColumns, Executor(1)};
  const ModelExtent extent_ = model_extent(model_.tree);
  ViewScore score_{model_.tree, kScanNoise};
};

/// To an eighth of a step of 12 mm at its edge, 0.3 m from the hinge: it is seen in 320 columns.
TEST_F(JointScanTest, FindsADoorAnywhereInItsRange) {
  Configuration configuration = truth_;
  for (const double start : {0.0, 0.8, 1.9}) {
    configuration.q[door_] = start;
    const auto margins = scan({door_}, configuration);
    EXPECT_NEAR(configuration.q[door_], 1.5, 0.02) << start;
    EXPECT_GT(margins[static_cast<std::size_t>(door_)], 50.0) << start;
    EXPECT_TRUE(std::isfinite(margins[static_cast<std::size_t>(door_)])) << start;
  }
}

/// As models have them of joints without an end: radians that no integer counts in steps. Each of
/// the most steps that there are turns the door by a 63rd more than whole turns.
TEST_F(JointScanTest, FindsADoorWhoseLimitsAreAsFarApartAsNumbersGo) {
  constexpr double kMostSteps = 63.0;
  constexpr double kTurns = 1e8;
  constexpr double kWholeTurn = 2.0 * std::numbers::pi;
  KinematicTree endless = model_.tree;
  Joint& door = endless.joints[static_cast<std::size_t>(joint_index(endless, "door_bottom_left"))];
  door.lower = 0.0;
  door.upper = kWholeTurn * (kTurns * kMostSteps + 1.0);
  Configuration configuration = truth_;
  configuration.q[door_] = 0.0;
  scan_joints(endless, extent_, score_, {door_}, kScanSlack, kScan, configuration);
  EXPECT_NEAR(std::remainder(configuration.q[door_] - 1.5, kWholeTurn), 0.0, 0.03);
}

TEST_F(JointScanTest, AGlanceComesAsNearAsItsSteps) {
  Configuration configuration = truth_;
  configuration.q[door_] = 0.0;
  scan({door_}, configuration, kGlance);
  EXPECT_NEAR(configuration.q[door_], 1.5, kGlance.metres / extent_.variables[door_]);
  EXPECT_NE(configuration.q[door_], 1.5);
}

TEST_F(JointScanTest, HalvesItsStepsAroundTheBest) {
  Configuration glanced = truth_;
  glanced.q[door_] = 0.0;
  Configuration halved = glanced;
  scan({door_}, glanced, kGlance);
  scan({door_}, halved, {kGlance.metres, 4});
  EXPECT_LT(std::abs(halved.q[door_] - 1.5), 0.5 * std::abs(glanced.q[door_] - 1.5));
}

TEST_F(JointScanTest, MovesNothingButWhatIsListed) {
  Configuration configuration = shut();
  const auto margins = scan({latch_}, configuration);
  EXPECT_EQ(configuration.q[door_], 0.0);
  EXPECT_EQ(configuration.q[slider_], 0.2);
  EXPECT_EQ(configuration.T_camera_base.matrix(), truth_.T_camera_base.matrix());
  for (int v = 0; v < model_.tree.variables(); ++v) {
    if (v == latch_) continue;
    EXPECT_TRUE(std::isinf(margins[static_cast<std::size_t>(v)])) << v;
  }
}

/// The latch alone cannot be where it is seen: the door that carries it is elsewhere.
TEST_F(JointScanTest, FindsWhatCarriesTogetherWithWhatIsCarried) {
  for (const bool is_carried_first : {false, true}) {
    Configuration configuration = shut();
    scan(is_carried_first ? std::vector{latch_, door_} : std::vector{door_, latch_}, configuration);
    EXPECT_NEAR(configuration.q[door_], 1.5, 0.03) << is_carried_first;
    EXPECT_NEAR(configuration.q[latch_], -1.3, 0.1) << is_carried_first;
  }
}

TEST_F(JointScanTest, AJointOutOfViewStaysAndHasNoRival) {
  Configuration configuration = truth_;
  configuration.T_camera_base.pretranslate(Eigen::Vector3d(5.0, 0.0, 0.0));
  configuration.q[door_] = 0.7;
  const auto margins = scan({door_}, configuration);
  EXPECT_EQ(configuration.q[door_], 0.7);
  EXPECT_TRUE(std::isinf(margins[static_cast<std::size_t>(door_)]));
}

class ImageScanTest : public JointScanTest {
 protected:
  std::vector<double> scan_image(const std::vector<int>& variables, double margin,
                                 Configuration& configuration) {
    std::vector<double> margins(static_cast<std::size_t>(model_.tree.variables()), margin);
    scan_by_image(low_prominence_, cloud_, variables, margins, nullptr, configuration);
    return margins;
  }

  LowProminence low_prominence_{model_, ViewOptions{}, Executor(1)};
};

/// A slider of 12 mm, seen from 1.3 m.
TEST_F(ImageScanTest, FindsASliderOfLowProminenceAnywhereInItsRange) {
  for (const double start : {0.0, 0.1, 0.25}) {
    Configuration configuration = truth_;
    configuration.q[slider_] = start;
    const auto margins = scan_image({slider_}, 0.0, configuration);
    EXPECT_NEAR(configuration.q[slider_], 0.2, 0.003) << start;
    EXPECT_EQ(margins[static_cast<std::size_t>(slider_)], 0.0) << "told: as it was";
  }
}

/// From 4 m the slider's 12 mm are less than the noise of a depth.
TEST_F(ImageScanTest, SaysWhereTheImageDoesNotTell) {
  Configuration configuration = truth_;
  configuration.T_camera_base.pretranslate(Eigen::Vector3d(0.0, 0.0, 2.7));
  const TiledCloud far = seen(model_, configuration, wall_behind(0.6));
  std::vector<double> margins(static_cast<std::size_t>(model_.tree.variables()), 0.0);
  scan_by_image(low_prominence_, far, {slider_}, margins, nullptr, configuration);
  EXPECT_EQ(margins[static_cast<std::size_t>(slider_)], kNotTold);
}

TEST_F(ImageScanTest, LeavesWhatIsOutOfView) {
  Configuration configuration = truth_;
  configuration.T_camera_base.pretranslate(Eigen::Vector3d(5.0, 0.0, 0.0));
  const auto margins = scan_image({slider_}, 0.0, configuration);
  EXPECT_EQ(margins[static_cast<std::size_t>(slider_)], 0.0);
  EXPECT_EQ(configuration.q, truth_.q);
}

/// Of a sensor of less noise the slider stands out: then the scan tells, unless it had a rival.
TEST_F(ImageScanTest, LeavesWhatTheScanHasTold) {
  ViewOptions quiet;
  quiet.noise.depth_quadratic *= 0.1;
  LowProminence low_prominence(model_, quiet, Executor(1));
  ASSERT_GT(low_prominence.prominence(slider_, truth_), LowProminence::kSurelyStandsOut);
  for (const double margin : {1000.0, 1.0}) {
    Configuration configuration = truth_;
    configuration.q[slider_] = 0.1;
    std::vector<double> margins(static_cast<std::size_t>(model_.tree.variables()), margin);
    scan_by_image(low_prominence, cloud_, {slider_}, margins, nullptr, configuration);
    EXPECT_NEAR(configuration.q[slider_], margin > 10.0 ? 0.1 : 0.2, 0.003) << margin;
  }
}

TEST_F(ImageScanTest, StopsWhenAsked) {
  Configuration configuration = truth_;
  std::vector<double> margins(static_cast<std::size_t>(model_.tree.variables()), 0.0);
  const StopRequest at_once = [] { return true; };
  EXPECT_THROW(scan_by_image(low_prominence_, cloud_, {slider_}, margins, at_once, configuration),
               Stopped);
}

}  // namespace
}  // namespace lockbox
