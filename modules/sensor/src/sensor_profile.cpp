// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sensor/sensor_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lockbox/core/error.hpp"
#include "lockbox/core/yaml_map.hpp"
#include "shipped_profiles.hpp"

namespace lockbox {
namespace {

// What no depth sensor exceeds; figures beyond are in another unit, or in another place.
constexpr NumberRange kConstant{-0.1, 0.1, "must be from -0.1 to 0.1 (metres)"};
constexpr NumberRange kLinear{-0.1, 0.1, "must be from -0.1 to 0.1 (metres a metre)"};
constexpr NumberRange kQuadratic{1e-6, 0.1, "must be from 0.000001 to 0.1 (1/metre)"};
constexpr NumberRange kPixels{0.0, 20.0, "must be from 0 to 20 (pixels)"};
constexpr NumberRange kShare{0.0, 1.0, "must be a share from 0 to 1"};
constexpr NumberRange kLength{0.0, 1.0, "must be from 0 to 1 (metres)"};
constexpr NumberRange kBaseline{0.001, 1.0, "must be from 0.001 to 1 (metres)"};
constexpr NumberRange kAngle{0.0, 90.0, "must be from 0 to 90 (degrees)"};
constexpr NumberRange kWindow{1.0, 31.0, "must be an odd number from 1 to 31 (pixels)"};
constexpr NumberRange kImageSide{16.0, 8192.0, "must be a whole number from 16 to 8192 (pixels)"};
constexpr NumberRange kFocalLength{1.0, 100000.0, "must be from 1 to 100000 (pixels)"};
constexpr NumberRange kCentre{-8192.0, 16384.0, "must be from -8192 to 16384 (pixels)"};
constexpr NumberRange kScale{0.5, 2.0, "must be a factor from 0.5 to 2"};
constexpr NumberRange kOffset{-0.5, 0.5, "must be from -0.5 to 0.5 (metres)"};
constexpr NumberRange kBend{-0.2, 0.2, "must be from -0.2 to 0.2 (1/metre)"};
constexpr NumberRange kRadial{-0.5, 0.5, "must be from -0.5 to 0.5"};
constexpr double kFarthest = 100.0;  // metres
constexpr std::size_t kMostLikes = 4;

void read_whole(const YamlMap& map, const char* key, const NumberRange& range, int& value) {
  double number = value;
  map.read(key, range, number);
  if (number != std::floor(number)) map.refuse(key, range.demand);
  value = static_cast<int>(number);
}

void read_camera(const YamlValue& value, PinholeCamera& camera) {
  const YamlMap map(value, {"width", "height", "fx", "fy", "cx", "cy"});
  for (const char* key : {"width", "height", "fx", "fy", "cx", "cy"}) map.require(key);
  read_whole(map, "width", kImageSide, camera.width);
  read_whole(map, "height", kImageSide, camera.height);
  map.read("fx", kFocalLength, camera.fx);
  map.read("fy", kFocalLength, camera.fy);
  map.read("cx", kCentre, camera.cx);
  map.read("cy", kCentre, camera.cy);
}

void read_range(const YamlMap& map, SensorProfile& profile) {
  Eigen::Vector2d range(profile.min_range, profile.max_range);
  map.read("range", range);
  if (!(range[0] >= 0.0 && range[0] < range[1] && range[1] <= kFarthest)) {
    map.refuse("range", "must be [nearest, farthest], from 0 to 100 (metres)");
  }
  profile.min_range = range[0];
  profile.max_range = range[1];
}

/// A polynomial may fall and rise again, but not to nothing.
void require_positive(const YamlMap& noise, const SensorProfile& profile) {
  constexpr int kSteps = 100;
  for (int i = 0; i <= kSteps; ++i) {
    const double z =
        profile.min_range + (profile.max_range - profile.min_range) * i / double{kSteps};
    if (!(profile.noise.sigma_z(z) > 0.0)) {
      noise.refuse("along_ray",
                   "must be more than 0 within the range, but constant + linear z + "
                   "quadratic z^2 is not at z = " +
                       std::to_string(z) + " (metres)");
    }
  }
}

void read_noise(const YamlValue& value, SensorProfile& profile) {
  const YamlMap map(value, {"along_ray", "across_ray", "own_share", "correlation_length"});
  SensorNoise& noise = profile.noise;
  if (map.has("along_ray")) {
    const YamlMap along(map.value("along_ray"), {"constant", "linear", "quadratic"});
    along.require("quadratic");
    noise.depth_floor = noise.depth_linear = 0.0;
    along.read("constant", kConstant, noise.depth_floor);
    along.read("linear", kLinear, noise.depth_linear);
    along.read("quadratic", kQuadratic, noise.depth_quadratic);
  }
  map.read("across_ray", kPixels, noise.lateral_pixels);
  map.read("own_share", kShare, noise.own_share);
  map.read("correlation_length", kPixels, noise.correlation_pixels);
  require_positive(map, profile);
}

/// What is farther must stay farther, wherever the sensor measures.
void read_correction(const YamlValue& value, SensorProfile& profile) {
  const YamlMap map(value, {"scale", "offset", "quadratic", "radial"});
  DepthCorrection correction;
  map.read("scale", kScale, correction.scale);
  map.read("offset", kOffset, correction.offset);
  map.read("quadratic", kBend, correction.quadratic);
  map.read("radial", kRadial, correction.radial);
  const double least_slope =
      correction.scale + 2.0 * std::min(correction.quadratic * profile.min_range,
                                        correction.quadratic * profile.max_range);
  if (!(least_slope > 0.0)) {
    map.refuse("quadratic", "makes what is farther nearer within the range");
  }
  profile.depth_correction = correction;
}

void read_simulation(const YamlValue& value, SensorModel& sensor) {
  const YamlMap map(
      value,
      {"baseline", "disparity_noise", "disparity_step", "correlation_length", "lateral_jitter",
       "depth_noise", "depth_noise_growth", "depth_noise_reference", "grows_with_incidence",
       "slant_bias", "mixes_depths", "matching_window", "least_fattening", "most_fattening",
       "hole_share", "dropout_rate", "edge_dropout_rate", "grazing_angle", "projector_shadow"});
  map.read("baseline", kBaseline, sensor.baseline);
  map.read("disparity_noise", kPixels, sensor.disparity_noise);
  map.read("disparity_step", kPixels, sensor.disparity_step);
  map.read("correlation_length", kPixels, sensor.correlation_length);
  map.read("lateral_jitter", kPixels, sensor.lateral_jitter);
  map.read("depth_noise", kLength, sensor.depth_noise);
  map.read("depth_noise_growth", kLength, sensor.depth_noise_growth);
  map.read("depth_noise_reference", kLength, sensor.depth_noise_reference);
  map.read("grows_with_incidence", sensor.is_weaker_when_slanted);
  map.read("slant_bias", kLength, sensor.slant_bias);
  map.read("mixes_depths", sensor.mixes_depths);
  read_whole(map, "matching_window", kWindow, sensor.matching_window);
  if (sensor.matching_window % 2 == 0) map.refuse("matching_window", kWindow.demand);
  map.read("least_fattening", kPixels, sensor.least_fattening);
  map.read("most_fattening", kPixels, sensor.most_fattening);
  if (sensor.most_fattening < sensor.least_fattening) {
    map.refuse("most_fattening", "must not be less than least_fattening");
  }
  map.read("hole_share", kShare, sensor.hole_share);
  map.read("dropout_rate", kShare, sensor.dropout_rate);
  map.read("edge_dropout_rate", kShare, sensor.edge_dropout_rate);
  if (map.has("grazing_angle")) {
    double degrees = 0.0;
    map.read("grazing_angle", kAngle, degrees);
    sensor.grazing_angle = degrees / 180.0 * std::numbers::pi;
  }
  map.read("projector_shadow", sensor.has_projector_shadow);
}

SensorProfile read_profile(const std::filesystem::path& path, std::size_t likes) {
  const YamlMap map(
      YamlValue::load(path, "sensor profile"),
      {"description", "like", "camera", "range", "noise", "depth_correction", "simulation"});
  SensorProfile profile;
  if (map.has("like")) {
    std::string other;
    map.read("like", other);
    const auto shipped = shipped_profile(other);
    if (!shipped) map.refuse("like", "must be a shipped profile: " + sensor_names());
    if (likes == kMostLikes) map.refuse("like", "leads on and on; give the figures themselves");
    profile = read_profile(*shipped, likes + 1);
  } else {
    map.require("noise");
  }
  profile.name = path.stem().string();
  profile.file = path;
  map.read("description", profile.description);
  read_range(map, profile);
  if (map.has("noise")) read_noise(map.value("noise"), profile);
  if (map.has("depth_correction")) read_correction(map.value("depth_correction"), profile);
  if (map.has("simulation") && !profile.simulated) profile.simulated.emplace();
  if (map.has("simulation")) read_simulation(map.value("simulation"), *profile.simulated);
  if (!profile.simulated) return profile;
  SensorModel& simulated = *profile.simulated;
  simulated.name = profile.name;
  simulated.min_range = profile.min_range;
  simulated.max_range = profile.max_range;
  if (map.has("camera")) read_camera(map.value("camera"), simulated.camera);
  return profile;
}

}  // namespace

SensorProfile read_sensor_profile(const std::filesystem::path& file) {
  return read_profile(file, 0);
}

}  // namespace lockbox
