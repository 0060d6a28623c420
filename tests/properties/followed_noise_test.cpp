// SPDX-License-Identifier: BSD-3-Clause
// Property "followed noise": the noise is found out from the images while the camera comes near or
// goes away, so that whitened residuals stay 1, and the same for any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "initialization/seen_model.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {
namespace {

constexpr int kFramesOfWay = 24;
constexpr int kFramesBetween = 4;

/// Before a wall, past which the camera goes as it goes past the object.
Scene wall_of_way(double z) {
  Scene scene;
  scene.moving = Moving::camera;
  scene.planes.push_back({SceneFrame::world, {0.0, 0.0, z + 0.4}, {0.1, -0.1, -1.0}, {8.0, 8.0}});
  return scene;
}

struct Way {
  std::string sensor;
  double from;  ///< metres
  double to;    ///< metres
};

void PrintTo(const Way& way, std::ostream* stream) {
  *stream << way.sensor << " from " << way.from << " to " << way.to;
}

class FollowedNoiseProperty : public ::testing::TestWithParam<Way> {
 protected:
  static std::vector<double> residuals(const Way& way, int threads,
                                       int frames_between = kFramesBetween) {
    const ArticulatedModel& model = shipped("rigid_block");
    const PinholeCamera camera{640, 480, 575.8, 575.8, 319.5, 239.5};
    State state;
    state.configuration = *model.parameters.initial_configuration;
    Eigen::Vector3d ray = state.configuration.T_camera_base.translation();
    ray /= ray.z();
    state.configuration.T_camera_base.translation() = way.from * ray;
    Simulator simulator(model.tree, camera, PlacedScene(wall_of_way(way.from), {state}),
                        sensor_model(way.sensor), 7, Executor(threads));
    TrackerOptions options;
    options.threads = threads;
    options.frames_between_noises = frames_between;
    Tracker tracker(model, options);
    tracker.start(state.configuration);
    std::vector<double> result;
    DepthFrame frame;
    for (int i = 0; i < kFramesOfWay; ++i) {
      const double share = 0.5 - 0.5 * std::cos(i * std::acos(-1.0) / (kFramesOfWay - 1));
      const double z = way.from * std::pow(way.to / way.from, share);
      state.configuration.T_camera_base.translation() = z * ray;
      state.stamp = i / 30.0;
      simulator.simulate(state, static_cast<std::uint64_t>(i), frame);
      result.push_back(tracker.process(frame).residual_rms);
    }
    return result;
  }

  static double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  }

  static double median_of_last_third(const std::vector<double>& values) {
    return median({values.end() - static_cast<std::ptrdiff_t>(values.size() / 3), values.end()});
  }
};

TEST_P(FollowedNoiseProperty, ResidualsStayOne) {
  const std::vector<double> all = residuals(GetParam(), 1);
  const auto third = static_cast<std::ptrdiff_t>(all.size() / 3);
  for (const double found :
       {median({all.begin(), all.begin() + third}), median({all.end() - third, all.end()})}) {
    EXPECT_GT(found, 0.8);
    EXPECT_LT(found, 1.25);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, FollowedNoiseProperty,
                         ::testing::Values(Way{"primesense", 0.8, 2.0}, Way{"primesense", 2.0, 0.8},
                                           Way{"kinect-v2", 0.8, 2.0}, Way{"stereo", 0.8, 1.6},
                                           Way{"stereo", 1.6, 0.8}, Way{"white", 0.8, 2.0},
                                           Way{"white", 2.0, 0.8}));

using FollowedNoise = FollowedNoiseProperty;

TEST_F(FollowedNoise, IsRightWhereThatOfTheFirstFrameIsNot) {
  // What is seen at two metres does not tell that a time-of-flight camera errs as much at one.
  const Way way{"kinect-v2", 2.0, 0.8};
  EXPECT_GT(median_of_last_third(residuals(way, 1, 1000)), 1.5);
  const double followed = median_of_last_third(residuals(way, 1));
  EXPECT_GT(followed, 0.8);
  EXPECT_LT(followed, 1.25);
}

TEST_F(FollowedNoise, DoesNotDependOnThreads) {
  const Way way{"kinect-v2", 1.5, 0.7};
  EXPECT_EQ(residuals(way, 1), residuals(way, 2));
}

}  // namespace
}  // namespace lockbox
