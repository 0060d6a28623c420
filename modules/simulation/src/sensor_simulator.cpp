// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/sensor_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <vector>

#include "correlated_noise.hpp"
#include "projector_shadow.hpp"
#include "random.hpp"
#include "rows_at_once.hpp"
#include "stereo_matching.hpp"
#include "surface.hpp"

namespace lockbox {
namespace {

using simulation::CorrelatedNoise;
using simulation::kRowsAtOnce;
using simulation::NormalTable;
using simulation::ProjectorShadow;
using simulation::RandomStream;
using simulation::StereoMatching;
using simulation::Surface;

constexpr float kUnit = 0.001F;             ///< metres a unit of the output
constexpr double kFarthest = 65.535;        ///< metres that its 16 bits hold
constexpr int kFineRefinement = 2;          ///< samples a pixel and axis, where it looks at several
constexpr float kLeastCosine = 0.05F;       ///< of an incidence of 87 degrees: beyond, all is lost
constexpr std::uint64_t kPixelPurpose = 2;  ///< tells this use of the seed from others

/// Standard deviation, in samples, of the Gaussian that has to be rounded to whole samples to get
/// the sensor's jitter: rounding adds 1/12 to the variance.
float jitter_before_rounding(const SensorModel& sensor, int refinement) {
  const double wanted = sensor.lateral_jitter * refinement;
  return static_cast<float>(std::sqrt(std::max(0.0, wanted * wanted - 1.0 / 12.0)));
}

/// What comes back to a pixel from around that sample: a footprint one pixel wide at half its
/// height, in which near surfaces are brighter. That sample itself sees something.
float mixed_depth(const Surface& surface, int sample_u, int sample_v) {
  float sum = 0.0F;
  float weights = 0.0F;
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      const float z = surface.depth(sample_u + du, sample_v + dv);
      if (!std::isfinite(z)) continue;
      const float weight = static_cast<float>((2 - std::abs(du)) * (2 - std::abs(dv))) / (z * z);
      sum += weight * z;
      weights += weight;
    }
  }
  return sum / weights;
}

/// Rounded; of any size.
float whole(float x) {
  return std::trunc(x + (x < 0.0F ? -0.5F : 0.5F));
}

int rounded(float x) {
  return static_cast<int>(whole(x));
}

/// The sensor model in the numbers and types that a pixel needs.
class PixelModel {
 public:
  PixelModel(const SensorModel& sensor, const PinholeCamera& camera, int refinement)
      : refinement_(refinement),
        unit_disparity_depth_(static_cast<float>(camera.fx * sensor.baseline)),
        has_disparity_(sensor.disparity_noise > 0.0 || sensor.disparity_step > 0.0),
        disparity_noise_(static_cast<float>(sensor.disparity_noise)),
        disparity_step_(static_cast<float>(sensor.disparity_step)),
        depth_noise_(static_cast<float>(sensor.depth_noise)),
        depth_noise_growth_(static_cast<float>(sensor.depth_noise_growth)),
        depth_noise_reference_(static_cast<float>(sensor.depth_noise_reference)),
        is_weaker_when_slanted_(sensor.is_weaker_when_slanted),
        slant_bias_(static_cast<float>(sensor.slant_bias)),
        measured_share_(static_cast<float>(1.0 - sensor.dropout_rate)),
        has_edge_dropouts_(sensor.edge_dropout_rate > 0.0),
        measured_share_at_edges_(static_cast<float>(1.0 - sensor.edge_dropout_rate)),
        squared_cosine_of_grazing_(static_cast<float>(std::pow(std::cos(sensor.grazing_angle), 2))),
        min_range_(static_cast<float>(sensor.min_range)),
        max_range_(static_cast<float>(std::min(sensor.max_range, kFarthest))) {}

  /// Probability that pixel (u, v) is measured when it looks through that sample.
  float measured_share(const Surface& surface, int u, int v, int sample_u, int sample_v) const {
    float share = measured_share_;
    if (has_edge_dropouts_ &&
        surface.beside_jump(u * refinement_, v * refinement_, refinement_, unit_disparity_depth_)) {
      share *= measured_share_at_edges_;
    }
    if (squared_cosine_of_grazing_ > 1e-9F) {
      const float squared_cosine = surface.squared_cosine(sample_u, sample_v);
      if (squared_cosine < squared_cosine_of_grazing_) {
        share *= std::sqrt(squared_cosine / squared_cosine_of_grazing_);
      }
    }
    return share;
  }

  bool depends_on_incidence() const { return is_weaker_when_slanted_ || slant_bias_ != 0.0F; }

  /// The measured depth in units of the output, 0 beyond the range. z: true, finite, metres.
  /// cosine: of the incidence, asked for if it depends_on_incidence().
  std::uint16_t measured(float z, float cosine, float correlated, float white) const {
    if (has_disparity_) {
      float disparity = unit_disparity_depth_ / z + disparity_noise_ * correlated;
      if (disparity_step_ > 0.0F) {
        disparity = disparity_step_ * whole(disparity / disparity_step_);
      }
      z = disparity > 0.0F ? unit_disparity_depth_ / disparity : 0.0F;
    }
    const float beyond = z - depth_noise_reference_;
    const float weakness = is_weaker_when_slanted_ ? 1.0F / std::max(cosine, kLeastCosine) : 1.0F;
    z += white * weakness * (depth_noise_ + depth_noise_growth_ * beyond * beyond) +
         slant_bias_ * (1.0F - cosine);
    const bool in_range = z >= min_range_ && z <= max_range_;
    return in_range ? static_cast<std::uint16_t>(rounded(z / kUnit)) : std::uint16_t{0};
  }

 private:
  int refinement_;
  float unit_disparity_depth_;
  bool has_disparity_;
  float disparity_noise_;
  float disparity_step_;
  float depth_noise_;
  float depth_noise_growth_;
  float depth_noise_reference_;
  bool is_weaker_when_slanted_;
  float slant_bias_;
  float measured_share_;
  bool has_edge_dropouts_;
  float measured_share_at_edges_;
  float squared_cosine_of_grazing_;
  float min_range_;
  float max_range_;
};

}  // namespace

struct SensorSimulator::Workspace {
  SensorModel sensor;
  PinholeCamera camera;
  std::uint64_t seed;
  Executor executor;
  int refinement = !sensor.is_stereo() && (sensor.lateral_jitter > 0.0 || sensor.mixes_depths)
                       ? kFineRefinement
                       : 1;
  PinholeCamera sample_camera = refined(camera, refinement);
  float jitter = jitter_before_rounding(sensor, refinement);
  PixelModel pixel{sensor, camera, refinement};
  NormalTable normal{};
  CorrelatedNoise noise{correlation_kernel(sensor), camera.width, camera.height, seed};
  ProjectorShadow shadow{};
  std::optional<StereoMatching> stereo =
      sensor.is_stereo() ? std::optional<StereoMatching>(std::in_place, sensor, camera, seed)
                         : std::nullopt;

  bool is_lit(int sample_u, int sample_v) const;
  void measure_row(const Surface& surface, std::uint64_t index, int v,
                   const std::vector<float>& correlated, std::uint16_t* out) const;
};

bool SensorSimulator::Workspace::is_lit(int sample_u, int sample_v) const {
  const auto row =
      static_cast<std::size_t>(sample_v) * static_cast<std::size_t>(sample_camera.width);
  return !sensor.has_projector_shadow || !shadow.covers(row + static_cast<std::size_t>(sample_u));
}

void SensorSimulator::Workspace::measure_row(const Surface& surface, std::uint64_t index, int v,
                                             const std::vector<float>& correlated,
                                             std::uint16_t* out) const {
  RandomStream random(seed, index, static_cast<std::uint64_t>(v), kPixelPurpose);
  for (int u = 0; u < camera.width; ++u) {
    // 12 + 12 bits for the jitter, 24 for white noise, 16 for drop-outs.
    const std::uint64_t bits = random.next();
    const int sample_u =
        std::clamp(u * refinement + rounded(jitter * normal(bits)), 0, sample_camera.width - 1);
    const int sample_v = std::clamp(v * refinement + rounded(jitter * normal(bits >> 12U)), 0,
                                    sample_camera.height - 1);
    const float white = normal.long_tailed(bits >> 24U);
    const float uniform = static_cast<float>(bits >> 48U) * 0x1p-16F;
    const float z = surface.depth(sample_u, sample_v);
    const bool seen = std::isfinite(z) && is_lit(sample_u, sample_v) &&
                      uniform < pixel.measured_share(surface, u, v, sample_u, sample_v);
    const auto i = static_cast<std::size_t>(u);
    out[i] = std::uint16_t{0};
    if (!seen) continue;
    const float cosine =
        pixel.depends_on_incidence() ? std::sqrt(surface.squared_cosine(sample_u, sample_v)) : 1.0F;
    const float mean = sensor.mixes_depths ? mixed_depth(surface, sample_u, sample_v) : z;
    out[i] = pixel.measured(mean, cosine, correlated[i], white);
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
  const Surface surface(w.stereo ? w.stereo->match(clean, index, w.normal, w.executor) : clean,
                        w.sample_camera);
  w.noise.generate(index, w.normal, w.executor);
  if (w.sensor.has_projector_shadow) {
    w.shadow.cast(clean, w.sample_camera, w.sensor.baseline, w.executor);
  }
  w.executor.for_each_chunk(
      height, kRowsAtOnce, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::vector<float> correlated;
        for (std::size_t v = begin; v < end; ++v) {
          w.noise.row(static_cast<int>(v), correlated);
          w.measure_row(surface, index, static_cast<int>(v), correlated, &frame.depth[v * width]);
        }
      });
}

}  // namespace lockbox
