// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/sensor_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "correlated_noise.hpp"
#include "random.hpp"
#include "surface.hpp"

namespace lockbox {
namespace {

using simulation::CorrelatedNoise;
using simulation::NormalTable;
using simulation::RandomStream;

constexpr float kUnit = 0.001F;          ///< metres a unit of the output
constexpr int kJitteredRefinement = 2;   ///< samples a pixel and axis, under lateral jitter
constexpr std::size_t kRowsAtOnce = 16;  ///< of the image, in parallel loops
constexpr std::uint64_t kPurpose = 2;    ///< tells this use of the seed from others

/// Standard deviation, in samples, of the Gaussian that has to be rounded to whole samples to get
/// the sensor's jitter: rounding adds 1/12 to the variance.
float jitter_before_rounding(const SensorModel& sensor, int refinement) {
  const double wanted = sensor.lateral_jitter * refinement;
  return static_cast<float>(std::sqrt(std::max(0.0, wanted * wanted - 1.0 / 12.0)));
}

int rounded(float x) {
  return static_cast<int>(x + (x < 0.0F ? -0.5F : 0.5F));
}

}  // namespace

struct SensorSimulator::Workspace {
  SensorModel sensor;
  PinholeCamera camera;
  std::uint64_t seed;
  Executor executor;
  int refinement = sensor.lateral_jitter > 0.0 ? kJitteredRefinement : 1;
  PinholeCamera sample_camera = refined(camera, refinement);
  float jitter = jitter_before_rounding(sensor, refinement);
  float unit_disparity_depth = static_cast<float>(camera.fx * sensor.baseline);
  float cosine_of_grazing = static_cast<float>(std::cos(sensor.grazing_angle));
  NormalTable normal{};
  CorrelatedNoise noise{correlation_kernel(sensor), camera.width, camera.height, seed};

  void measure_row(const RenderedDepth& clean, std::uint64_t index, int v,
                   const std::vector<float>& correlated, std::uint16_t* out) const;
  float dropout_probability(const RenderedDepth& clean, int u, int v, int sample_u,
                            int sample_v) const;
  float with_noise(float z, float correlated, float white) const;
  std::uint16_t in_units(float z) const;
};

/// Of a pixel (u, v) that looks through a sample.
float SensorSimulator::Workspace::dropout_probability(const RenderedDepth& clean, int u, int v,
                                                      int sample_u, int sample_v) const {
  float measured = 1.0F - static_cast<float>(sensor.dropout_rate);
  if (sensor.edge_dropout_rate > 0.0 &&
      simulation::beside_jump(clean, u * refinement, v * refinement, refinement,
                              unit_disparity_depth)) {
    measured *= 1.0F - static_cast<float>(sensor.edge_dropout_rate);
  }
  if (cosine_of_grazing > 1e-6F) {
    const float cosine = simulation::cosine_of_incidence(clean, sample_camera, sample_u, sample_v);
    measured *= std::min(1.0F, cosine / cosine_of_grazing);
  }
  return 1.0F - measured;
}

float SensorSimulator::Workspace::with_noise(float z, float correlated, float white) const {
  if (sensor.disparity_noise > 0.0 || sensor.disparity_step > 0.0) {
    float disparity =
        unit_disparity_depth / z + static_cast<float>(sensor.disparity_noise) * correlated;
    if (sensor.disparity_step > 0.0) {
      const auto step = static_cast<float>(sensor.disparity_step);
      disparity = step * static_cast<float>(rounded(disparity / step));
    }
    z = disparity > 0.0F ? unit_disparity_depth / disparity : 0.0F;
  }
  const float beyond = z - 0.4F;
  return z + white * static_cast<float>(sensor.depth_noise +
                                        sensor.depth_noise_growth * beyond * beyond);
}

std::uint16_t SensorSimulator::Workspace::in_units(float z) const {
  const bool in_range =
      z >= static_cast<float>(sensor.min_range) && z <= static_cast<float>(sensor.max_range);
  return in_range ? static_cast<std::uint16_t>(rounded(z / kUnit)) : std::uint16_t{0};
}

void SensorSimulator::Workspace::measure_row(const RenderedDepth& clean, std::uint64_t index, int v,
                                             const std::vector<float>& correlated,
                                             std::uint16_t* out) const {
  RandomStream random(seed, index, static_cast<std::uint64_t>(v), kPurpose);
  for (int u = 0; u < camera.width; ++u) {
    // 12 + 12 bits for the jitter, 24 for white noise, 16 for drop-outs.
    const std::uint64_t bits = random.next();
    const int sample_u =
        std::clamp(u * refinement + rounded(jitter * normal(bits)), 0, sample_camera.width - 1);
    const int sample_v = std::clamp(v * refinement + rounded(jitter * normal(bits >> 12U)), 0,
                                    sample_camera.height - 1);
    const float white = normal.long_tailed(bits >> 24U);
    const float uniform = static_cast<float>(bits >> 48U) * 0x1p-16F;
    const float z = simulation::depth_at(clean, sample_u, sample_v);
    const bool seen =
        std::isfinite(z) && uniform >= dropout_probability(clean, u, v, sample_u, sample_v);
    const auto i = static_cast<std::size_t>(u);
    out[i] = seen ? in_units(with_noise(z, correlated[i], white)) : std::uint16_t{0};
  }
}

SensorSimulator::SensorSimulator(const SensorModel& sensor, const PinholeCamera& camera,
                                 std::uint64_t seed, const Executor& executor)
    : workspace_(new Workspace{sensor, camera, seed, executor}) {}

SensorSimulator::~SensorSimulator() = default;
SensorSimulator::SensorSimulator(SensorSimulator&&) noexcept = default;
SensorSimulator& SensorSimulator::operator=(SensorSimulator&&) noexcept = default;

const PinholeCamera& SensorSimulator::sample_camera() const {
  return workspace_->sample_camera;
}

void SensorSimulator::measure(const RenderedDepth& clean, std::uint64_t index, DepthFrame& frame) {
  Workspace& w = *workspace_;
  const auto width = static_cast<std::size_t>(w.camera.width);
  const auto height = static_cast<std::size_t>(w.camera.height);
  frame.camera = w.camera;
  frame.depth.resize(width * height);
  frame.metres_per_unit = kUnit;
  frame.index = index;
  w.noise.generate(index, w.normal, w.executor);
  w.executor.for_each_chunk(
      height, kRowsAtOnce, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::vector<float> correlated;
        for (std::size_t v = begin; v < end; ++v) {
          w.noise.row(static_cast<int>(v), correlated);
          w.measure_row(clean, index, static_cast<int>(v), correlated, &frame.depth[v * width]);
        }
      });
}

}  // namespace lockbox
