// SPDX-License-Identifier: BSD-3-Clause
// What a profile tells an estimate of the noise is what the simulator makes of the same profile.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "lockbox/sensor/noise_record.hpp"
#include "lockbox/sensor/sensor_profile.hpp"
#include "lockbox/simulation/sensor_simulator.hpp"

namespace lockbox {
namespace {

/// A wall that faces the sensor, slightly turned so that rounding differs from pixel to pixel.
double wall_depth(const PinholeCamera& camera, double z, double u, double v) {
  return z / (1.0 - 0.05 * (u - camera.cx) / camera.fx - 0.03 * (v - camera.cy) / camera.fy);
}

/// Errors of a block of pixels in the image's middle, 0 where nothing was measured.
struct MeasuredWall {
  static constexpr int kSide = 192;  // pixels
  std::vector<double> errors;

  /// Standard deviation of the means of blocks of that many pixels along each side.
  double deviation(int block) const {
    std::vector<double> means;
    for (int v = 0; v + block <= kSide; v += block) {
      for (int u = 0; u + block <= kSide; u += block) {
        double sum = 0.0;
        int count = 0;
        for (int i = 0; i < block * block; ++i) {
          const double error =
              errors[static_cast<std::size_t>((v + i / block) * kSide + u + i % block)];
          sum += error;
          count += error != 0.0 ? 1 : 0;
        }
        if (2 * count > block * block) means.push_back(sum / count);
      }
    }
    double squares = 0.0;
    for (const double mean : means) squares += mean * mean;
    return std::sqrt(squares / static_cast<double>(means.size()));
  }
};

/// depth: true one of pixel (u, v), metres.
DepthFrame measured_frame(const SensorModel& sensor,
                          const std::function<double(double, double)>& depth) {
  const PinholeCamera& camera = sensor.camera;
  SensorSimulator simulator(sensor, camera, 1, Executor(2));
  const PinholeCamera& samples = simulator.sample_camera();
  RenderedDepth clean{samples.width, samples.height, {}, {}, {0, 0, samples.width, samples.height}};
  const double step = camera.fx / samples.fx;
  for (int v = 0; v < samples.height; ++v) {
    for (int u = 0; u < samples.width; ++u) {
      clean.depth.push_back(static_cast<float>(depth(u * step, v * step)));
    }
  }
  clean.id.assign(clean.depth.size(), 0);
  DepthFrame frame;
  simulator.measure(clean, 0, frame);
  return frame;
}

MeasuredWall measured_wall(const SensorModel& sensor, double z) {
  const PinholeCamera& camera = sensor.camera;
  const DepthFrame frame =
      measured_frame(sensor, [&](double u, double v) { return wall_depth(camera, z, u, v); });
  MeasuredWall wall;
  const int left = (camera.width - MeasuredWall::kSide) / 2;
  const int top = (camera.height - MeasuredWall::kSide) / 2;
  for (int v = top; v < top + MeasuredWall::kSide; ++v) {
    for (int u = left; u < left + MeasuredWall::kSide; ++u) {
      const double depth = frame.metres(u, v);
      wall.errors.push_back(depth > 0.0 ? depth - wall_depth(camera, z, u, v) : 0.0);
    }
  }
  return wall;
}

class SimulatedProfile : public ::testing::TestWithParam<std::string> {
 protected:
  SimulatedProfile() { profile_.simulated->slant_bias = 0.0; }  // no noise

  SensorProfile profile_ = find_sensor_profile(GetParam());
};

TEST_P(SimulatedProfile, ErrsAsItSays) {
  for (const double share : {0.1, 0.3, 0.6}) {
    const double nearest = std::max(profile_.min_range, 0.25);
    const double z = nearest + share * (std::min(profile_.max_range, 4.0) - nearest);
    const double measured = measured_wall(*profile_.simulated, z).deviation(1);
    const double ratio = measured / profile_.noise.sigma_z(z);
    EXPECT_GT(ratio, 0.75) << z << " m: " << measured;
    EXPECT_LT(ratio, 1.3) << z << " m: " << measured;
  }
}

TEST_P(SimulatedProfile, ErrsAsAlikeAsItSays) {
  constexpr int kBlock = 16;
  const double z = std::min(1.2, 0.5 * (profile_.min_range + profile_.max_range));
  const MeasuredWall wall = measured_wall(*profile_.simulated, z);
  const double alike = std::pow(kBlock * wall.deviation(kBlock) / wall.deviation(1), 2);
  // Of errors that are alike over more than a block only as much as goes into one.
  const double told = std::min(profile_.noise.correlation_area(), 0.6 * kBlock * kBlock);
  if (told > 1.5) {  // rounding may err even less alike than chance
    EXPECT_GT(alike, told / 2.0);
  }
  EXPECT_LT(alike, 2.0 * told);
}

/// Boards before a wall, at three distances within the sensor's range.
double scene_depth(const SensorProfile& profile, double u, double v) {
  const PinholeCamera& camera = profile.simulated->camera;
  const double nearest = std::max(profile.min_range, 0.3);
  const double step = (std::min(profile.max_range, 3.3) - nearest) / 4.0;
  const int column = static_cast<int>(4.0 * u / camera.width);
  return wall_depth(camera, nearest + step * (1 + (column + (v > 0.5 * camera.height ? 1 : 0)) % 3),
                    u, v);
}

TEST_P(SimulatedProfile, NoiseIsEstimatedFromAnImage) {
  const auto noise = estimate_noise(measured_frame(
      *profile_.simulated, [this](double u, double v) { return scene_depth(profile_, u, v); }));
  ASSERT_TRUE(noise);
  // Rounding alone makes steps along faces, which do not bend by chance.
  const bool is_rounding =
      profile_.simulated->depth_noise + profile_.simulated->disparity_noise == 0.0;
  const double most = is_rounding ? 2.0 : 1.25;
  for (const double share : {0.3, 0.5, 0.7}) {
    const double nearest = std::max(profile_.min_range, 0.3);
    const double z = nearest + share * (std::min(profile_.max_range, 3.3) - nearest);
    const double ratio = noise->sigma_z(z) / measured_wall(*profile_.simulated, z).deviation(1);
    EXPECT_GT(ratio, 0.8) << z;
    EXPECT_LT(ratio, most) << z;
  }
  if (is_rounding) return;
  EXPECT_GT(noise->correlation_area(), profile_.noise.correlation_area() / 3.0);
  EXPECT_LT(noise->correlation_area(), profile_.noise.correlation_area() * 3.0);
}

INSTANTIATE_TEST_SUITE_P(Shipped, SimulatedProfile, ::testing::ValuesIn(shipped_sensor_names()),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace lockbox
