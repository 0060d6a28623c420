// SPDX-License-Identifier: BSD-3-Clause
// Property "honest covariance": over independent frames, converged without a prior, errors are as
// large as their reported standard deviations, whatever the noise; what the view does not determine
// is said to be unobservable. From far away squared errors are those that are reported, neither
// smaller nor larger. Near by what is reported is mostly the systematic floor, which no amount of
// data averages away and a simulated sensor hardly has: there they are what is left of the reported
// variance without the floor.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "initialization/seen_model.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/simulation/sensor_model.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/solver/motion_metric.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

const PinholeCamera kCamera{640, 480, 575.8, 575.8, 319.5, 239.5};

struct Subject {
  std::string name;
  std::string sensor;
  int frames;
  double distance = 1.0;      ///< times the usual one
  bool has_steps = true;      ///< whether disparities are rounded, if the sensor does that
  double most_squared = 2.0;  ///< error, of the reported variance, in the mean
};

void PrintTo(const Subject& subject, std::ostream* stream) {
  *stream << subject.name << " seen by " << subject.sensor;
}

SensorModel sensor_of(const Subject& subject) {
  SensorModel sensor = sensor_model(subject.sensor);
  if (!subject.has_steps) sensor.disparity_step = 0.0;
  return sensor;
}

const ArticulatedModel& model_of(const std::string& name) {
  return name == "mechanism" ? mechanism() : shipped(name);
}

Configuration usual_view(const ArticulatedModel& model) {
  if (!model.parameters.initial_configuration) {
    return mechanism_start(model);
  }
  Configuration configuration = *model.parameters.initial_configuration;
  for (int v = 0; v < model.tree.variables(); ++v) {
    const VariableLimits limits = variable_limits(model.tree, v);
    const bool limited = std::isfinite(limits.upper - limits.lower);
    // A third of the way: an open door shows its latch still from the front.
    configuration.q[v] = limited ? limits.lower + (limits.upper - limits.lower) / 3.0 : 0.7;
  }
  return configuration;
}

State state(const Configuration& configuration) {
  State result;
  result.configuration = configuration;
  return result;
}

/// Squared normalised errors by unknown, over the frames that report it observable.
struct Calibration {
  Eigen::VectorXd sum;
  Eigen::VectorXd of_noise;  ///< shares of the reported variances that are not floor, summed
  Eigen::VectorXd count;
  int beyond_four_sigma = 0;
};

class HonestCovariance : public ::testing::TestWithParam<Subject> {
 protected:
  const ArticulatedModel& model_ = model_of(GetParam().name);
  const Configuration view_ = [this] {
    Configuration view = usual_view(model_);
    view.T_camera_base.translation() *= GetParam().distance;
    return view;
  }();
  const Eigen::Index unknowns_ = model_.tree.unknowns();
  std::mt19937 random_{5};

  Eigen::VectorXd random_step(double metres, double radians) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Eigen::VectorXd step(unknowns_);
    for (Eigen::Index i = 0; i < unknowns_; ++i) {
      step[i] = (is_length(i) ? metres : radians) * uniform(random_);
    }
    return step;
  }

  bool is_length(Eigen::Index unknown) const {
    if (unknown < kBaseUnknowns) {
      return unknown < 3;
    }
    const int joint = model_.tree.variable_joint[static_cast<std::size_t>(unknown - kBaseUnknowns)];
    return model_.tree.joints[static_cast<std::size_t>(joint)].type == JointType::prismatic;
  }

  Eigen::VectorXd error(const Configuration& found, const Configuration& truth) const {
    Eigen::VectorXd difference(unknowns_);
    difference.head<6>() = log_se3(truth.T_camera_base.inverse() * found.T_camera_base);
    difference.tail(model_.tree.variables()) = found.q - truth.q;
    return difference;
  }

  /// What the covariance adds for itself (docs/mathematics-uncertainty.md): metres or radians.
  double floor_of(Eigen::Index unknown) const {
    if (unknown < 3) return 0.05e-3;
    if (unknown < kBaseUnknowns) return 0.005 * kRadians;
    return 0.15e-3 / moves_.scales()[unknown];
  }

  Calibration calibrate();

  const MotionMetric moves_{model_.tree};
};

Calibration HonestCovariance::calibrate() {
  Scene scene;
  const double wall = view_.T_camera_base.translation().z() + 0.6;
  scene.planes.push_back({SceneFrame::world, {0.0, 0.0, wall}, {0.0, 0.0, -1.0}, {8.0, 8.0}});
  Simulator simulator(model_.tree, kCamera, PlacedScene(scene, {state(view_)}),
                      sensor_of(GetParam()), 7, Executor());
  ArticulatedRegistration registration(model_, {}, Executor());
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(unknowns_);
  Calibration calibration{zero, zero, zero};
  TiledCloud cloud;
  DepthFrame frame;
  for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(GetParam().frames); ++k) {
    const Configuration truth = stepped(view_, random_step(0.01, 0.03));
    simulator.simulate(state(truth), k, frame);
    cloud.assign(frame, {}, Executor());
    const Configuration start = stepped(truth, random_step(0.003, 0.01));
    const RegistrationResult& found = registration.align(cloud, start, {0.005, 12, false, 6});
    const Eigen::VectorXd normalised =
        error(found.configuration, truth).cwiseQuotient(found.sigma_of_noise);
    for (Eigen::Index i = 0; i < unknowns_; ++i) {
      if (found.observable[static_cast<std::size_t>(i)]) {
        calibration.sum[i] += normalised[i] * normalised[i];
        calibration.of_noise[i] += 1.0 - std::pow(floor_of(i) / found.sigma_of_noise[i], 2);
        calibration.count[i] += 1.0;
        calibration.beyond_four_sigma += std::abs(normalised[i]) > 4.0 ? 1 : 0;
      }
    }
  }
  return calibration;
}

/// Of the squares that noise makes by itself: means of 30 frames scatter by a quarter. The smallest
/// ratio measured is 0.49.
constexpr double kLeastOfNoise = 0.25;

TEST_P(HonestCovariance, ErrorsAreNeitherSmallerThanNoiseMakesThemNorLargerThanReported) {
  const Calibration calibration = calibrate();
  EXPECT_GT(calibration.count.minCoeff(), 0.8 * GetParam().frames) << "all are in sight";
  EXPECT_LE(calibration.beyond_four_sigma, 0.01 * calibration.count.sum());
  for (Eigen::Index i = 0; i < unknowns_; ++i) {
    EXPECT_GT(calibration.sum[i], kLeastOfNoise * calibration.of_noise[i]) << "unknown " << i;
    EXPECT_LT(calibration.sum[i], GetParam().most_squared * calibration.count[i])
        << "unknown " << i;
  }
}

/// From where noise decides how exact an estimate is.
class HonestCovarianceFromAfar : public HonestCovariance {};

TEST_P(HonestCovarianceFromAfar, ErrorsOfEachUnknownAreAsLargeAsItsSigma) {
  const Calibration calibration = calibrate();
  EXPECT_GT(calibration.count.minCoeff(), 0.8 * GetParam().frames) << "all are in sight";
  const Eigen::VectorXd squares = calibration.sum.cwiseQuotient(calibration.count);
  for (Eigen::Index i = 0; i < unknowns_; ++i) {
    EXPECT_GT(squares[i], 0.5) << "unknown " << i;
    EXPECT_LT(squares[i], GetParam().most_squared) << "unknown " << i;
  }
}

// Mean squares of 40 frames scatter by a quarter.
INSTANTIATE_TEST_SUITE_P(Seen, HonestCovarianceFromAfar,
                         ::testing::Values(Subject{"mechanism", "primesense", 60, 2.0},
                                           Subject{"lockbox", "white", 40, 2.0},
                                           Subject{"lockbox", "primesense", 40, 2.0}),
                         [](const ::testing::TestParamInfo<Subject>& subject) {
                           return subject.param.name + "_by_" + subject.param.sensor;
                         });

// A PrimeSense's depth is one whole millimetre for each step of disparity, 4.5 mm apart at 1.25 m.
// What an entry of that table is rounded by is the same in all pixels and frames, so no mean is
// rid of it: it turns the lockbox by 0.013 degrees about its y axis, 2.6 times the variance.
// Without steps noise spreads over millimetres, and no unknown errs by more than twice its
// variance.
INSTANTIATE_TEST_SUITE_P(Seen, HonestCovariance,
                         ::testing::Values(Subject{"mechanism", "white", 30},
                                           Subject{"mechanism", "primesense", 30},
                                           Subject{"lockbox", "white", 40},
                                           Subject{"lockbox", "primesense", 40, 1.0, false},
                                           Subject{"lockbox", "primesense", 40, 1.0, true, 3.0}),
                         [](const ::testing::TestParamInfo<Subject>& subject) {
                           return subject.param.name + "_by_" + subject.param.sensor +
                                  (subject.param.has_steps ? "" : "_without_steps");
                         });

TEST(Observability, AHiddenSliderIsSaidToBeUnobservableAndAVisibleOneIsNot) {
  const ArticulatedModel& model = shipped("lockbox");
  const Configuration truth = usual_view(model);
  const int joint = joint_index(model.tree, "block");
  const auto& slide = model.tree.joints[static_cast<std::size_t>(joint)];
  const auto unknown = static_cast<std::size_t>(unknown_of(slide.variable));
  BodyPoses poses;
  forward_kinematics(model.tree, truth, poses);
  SceneBox cover;  // 10 cm before all of the block's way
  cover.size = {0.5, 0.4, 0.05};
  cover.pose.translation() = 0.85 * poses[static_cast<std::size_t>(slide.child_body)].translation();
  Scene covered = wall_behind(0.6);
  covered.boxes.push_back(cover);
  ArticulatedRegistration registration(model, {}, Executor());
  const AlignOptions align_options{0.003, 6};
  EXPECT_TRUE(registration.align(seen(model, truth, wall_behind(0.6)), truth, align_options)
                  .observable[unknown]);
  const RegistrationResult& hidden =
      registration.align(seen(model, truth, covered), truth, align_options);
  EXPECT_FALSE(hidden.observable[unknown]);
  EXPECT_GE(hidden.sigma[static_cast<Eigen::Index>(unknown)], 0.25 * (slide.upper - slide.lower));
  EXPECT_TRUE(hidden.observable[0]);
}

}  // namespace
}  // namespace lockbox
