// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/free_space_term.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "image_tile.hpp"
#include "lockbox/sdf/rigid_motion.hpp"
#include "lockbox/view/outline.hpp"
#include "observed_surface.hpp"

namespace lockbox {
namespace {

constexpr double kLeastWeight = 1e-3;  // below it a sample is not worth keeping
constexpr double kSurely = 0.99;       // of the tolerance
/// Samples seen through that are looked at: near the solution all of them, for there each counts.
/// From far off there are more, which all say the same: then each of those stands for several.
constexpr std::size_t kMostSamples = 6000;

/// In the mixture of kernels::associate for a single body: 1 for small residuals, 0 for outliers,
/// whose density beside the largest of a residual is given.
double gaussian_share(double residual, double inverse_variance, double outliers) {
  const double gaussian = std::exp(-0.5 * residual * residual * inverse_variance);
  return gaussian / (gaussian + outliers);
}

double density_of_outliers(double cut) {
  return std::exp(-0.5 * cut * cut);
}

constexpr double kAnyDirection = 1.0 / 3.0;  // of a random unit vector's square, along each axis

/// Selects and aims the correspondences of samples away from outlines.
class CorrespondenceFinder {
 public:
  CorrespondenceFinder(const FreeSpaceTerm::Scene& scene, const BodyPoses& T_body_camera,
                       double spread)
      : surface_(scene.surface),
        continued_(scene.continued),
        camera_(scene.cloud.camera()),
        observed_(scene.model, scene.surface, T_body_camera, scene.cloud, scene.options, spread),
        options_(scene.options),
        outliers_(density_of_outliers(scene.options.cut)),
        spread_(spread) {}

  /// weight: how many samples this one stands for.
  std::optional<FreeSpaceCorrespondence> find(const ViewSample& sample, double weight,
                                              const Eigen::Isometry3d& T_camera_body) const {
    const Eigen::Vector3d p = T_camera_body * sample.p_body.cast<double>();
    const auto pixel = camera_.pixel_of(p);
    if (!pixel || !observed_.sees_through(*pixel, p.z(), 0.0)) {
      return std::nullopt;
    }
    const TangentPlane plane(surface_.view(), sample.pixel.u, sample.pixel.v);
    if (!observed_.sees_through(*pixel, p.z(), plane.steepness() / surface_.reduction())) {
      return std::nullopt;
    }
    if (observed_.shows_object(*pixel, sample.body)) {
      return std::nullopt;  // the tail of the noise: this point has its say in the model term
    }
    if (is_beside_outline(sample, plane) ||
        continued_.covers(surface_.view().index(sample.pixel.u, sample.pixel.v))) {
      return std::nullopt;
    }
    return aim(sample, weight, p, *pixel);
  }

 private:
  /// What is seen beside an outline says where the outline is: that has correspondences of its own.
  /// The nearest observed pixel lies in a direction that the grid decides, and would hold the body
  /// against sliding along its own outline.
  bool is_beside_outline(const ViewSample& sample, const TangentPlane& plane) const {
    return !outline_normal(surface_.view(), plane, sample.pixel.u, sample.pixel.v,
                           static_cast<double>(surface_.reduction()) / camera_.fx)
                .isZero();
  }

  /// From p to the nearest observed point of the object.
  std::optional<FreeSpaceCorrespondence> aim(const ViewSample& sample, double weight,
                                             const Eigen::Vector3d& p, const Pixel& pixel) const {
    const auto nearest = observed_.nearest(p, pixel, sample.body, farthest(p));
    if (!nearest) {
      return std::nullopt;
    }
    const double way = (p - *nearest).norm();
    // Metres: the point is where it should be, and no direction is told.
    if (way < 1e-9) {
      return std::nullopt;
    }
    const Eigen::Vector3d direction = (p - *nearest) / way;
    const double variance = variance_of(p, direction);
    if (gaussian_share(way, 1.0 / (variance + spread_ * spread_), outliers_) <= kLeastWeight) {
      return std::nullopt;
    }
    // Noise at either end turns a short correspondence.
    const double direction_variance =
        std::clamp(variance / (way * way), kNormalVariance, kAnyDirection);
    return FreeSpaceCorrespondence{sample.p_body,
                                   nearest->cast<float>(),
                                   direction.cast<float>(),
                                   static_cast<float>(variance),
                                   static_cast<float>(direction_variance),
                                   static_cast<float>(sample.pixels * weight),
                                   sample.body,
                                   tile_of(pixel, camera_)};
  }

  /// Metres from p to what would still weigh more than kLeastWeight.
  double farthest(const Eigen::Vector3d& p) const {
    const double along = p.norm() / p.z() * observed_.sigma_z(p.z());
    const double across = observed_.sigma_lateral(p.z());
    const double variance = along * along + across * across + spread_ * spread_;
    return std::sqrt(variance * (options_.cut * options_.cut - 2.0 * std::log(kLeastWeight)));
  }

  /// Of a point at p along a direction, by the sensor's noise.
  double variance_of(const Eigen::Vector3d& p, const Eigen::Vector3d& direction) const {
    const double along = direction.dot(p);
    const double across2 = std::max(0.0, 1.0 - along * along / p.squaredNorm());
    return std::pow(along / p.z() * observed_.sigma_z(p.z()), 2) +
           across2 * std::pow(observed_.sigma_lateral(p.z()), 2);
  }

  const VisibleSurface& surface_;
  const ContinuedEdges& continued_;
  const PinholeCamera& camera_;
  const ObservedSurface observed_;
  const TermOptions& options_;
  double outliers_;
  double spread_;
};

}  // namespace

void FreeSpaceTerm::select(const Scene& scene, const BodyPoses& T_camera_body, double spread) {
  lambda_ = scene.options.lambda_free;
  cut_ = scene.options.cut;
  const std::size_t bands = scene.outlines.bands();
  const std::size_t chunks = scene.samples.chunks().size();
  outlines_.begin(bands);
  observed_outlines_.resize(static_cast<std::size_t>(scene.executor.threads()) + 1);
  landings_.reserve(scene.executor);
  chunk_seen_.resize(std::max(chunk_seen_.size(), chunks));
  scene.executor.for_each(
      {{bands, [&](std::size_t i) { aim_outlines(scene, T_camera_body, spread, i); }},
       {chunks, [&](std::size_t i) { find_seen_through(scene, T_camera_body, i); }}});
  count_seen_through(chunks);
  aim_seen_through(scene, T_camera_body, spread);
}

/// Towards what the camera saw around them. Meanwhile one thread lays out the correspondences of
/// outlines.
void FreeSpaceTerm::aim_seen_through(const Scene& scene, const BodyPoses& T_camera_body,
                                     double spread) {
  const std::size_t seen = chunk_begins_.back();
  const std::size_t stride = std::max<std::size_t>(1, (seen + kMostSamples - 1) / kMostSamples);
  T_body_camera_.resize(T_camera_body.size());
  for (std::size_t b = 0; b < T_camera_body.size(); ++b) {
    T_body_camera_[b] = T_camera_body[b].inverse();
  }
  const CorrespondenceFinder finder(scene, T_body_camera_, spread);
  const std::size_t chunks = scene.samples.chunks().size();
  seen_through_.begin(chunks);
  const auto aim_chunk = [&](std::size_t i) {
    const ViewSamples::Chunk& chunk = scene.samples.chunks()[i];
    const Eigen::Isometry3d& T = T_camera_body[static_cast<std::size_t>(chunk.body)];
    const std::size_t skipped = (stride - chunk_begins_[i] % stride) % stride;
    for (std::size_t k = skipped; k < chunk_seen_[i].size(); k += stride) {
      const ViewSample sample = scene.samples.sample(chunk.body, chunk.first + chunk_seen_[i][k]);
      if (const auto correspondence = finder.find(sample, static_cast<double>(stride), T)) {
        seen_through_.chunk(i).push_back(*correspondence);
      }
    }
  };
  scene.executor.for_each(
      {{1, [&](std::size_t) { outlines_.finish(T_camera_body.size()); }}, {chunks, aim_chunk}});
  seen_through_.finish(T_camera_body.size());
}

/// Which samples of a chunk the camera sees through.
void FreeSpaceTerm::find_seen_through(const Scene& scene, const BodyPoses& T_camera_body,
                                      std::size_t chunk_index) {
  const SensorNoise& noise = scene.options.noise;
  const kernels::PointNoise along_ray{static_cast<float>(noise.depth_floor),
                                      static_cast<float>(noise.depth_quadratic), 0.0F, 0.0F,
                                      static_cast<float>(noise.depth_linear)};
  // Somewhat fewer deviations than the tolerance: single precision errs by less.
  const auto tolerance = static_cast<float>(kSurely * scene.options.free_space_tolerance);
  const ViewSamples::Chunk& chunk = scene.samples.chunks()[chunk_index];
  const kernels::Landings landings =
      landings_.land(scene.samples, chunk, T_camera_body, scene.cloud);
  std::vector<std::uint32_t>& seen = chunk_seen_[chunk_index];
  seen.resize(chunk.count);
  seen.resize(kernels::seen_through(landings, chunk.count, along_ray, tolerance, seen.data()));
}

void FreeSpaceTerm::count_seen_through(std::size_t chunks) {
  chunk_begins_.assign(1, 0);
  for (std::size_t i = 0; i < chunks; ++i) {
    chunk_begins_.push_back(chunk_begins_.back() + chunk_seen_[i].size());
  }
}

double FreeSpaceTerm::linearize(const BodyPoses& T_camera_body, double spread,
                                std::vector<BodySystem>& systems) {
  spread2_ = spread * spread;
  double cost = 0.0;
  add_systems(seen_through_, T_camera_body, lambda_, systems, cost);
  outline_systems_.assign(systems.size(), BodySystem{});
  add_systems(outlines_, T_camera_body, 1.0, outline_systems_, cost);
  add_outlines(lambda_, systems);
  return lambda_ * cost;
}

void FreeSpaceTerm::add_outlines(double weight, std::vector<BodySystem>& systems) const {
  for (std::size_t b = 0; b < systems.size(); ++b) systems[b] += weight * outline_systems_[b];
}

/// Adds the correspondences' cost, too, without the weight.
void FreeSpaceTerm::add_systems(const CorrespondenceSet& correspondences,
                                const BodyPoses& T_camera_body, double weight,
                                std::vector<BodySystem>& systems, double& cost) const {
  for (const CorrespondenceSet::Block& block : correspondences.blocks()) {
    const auto body = static_cast<std::size_t>(block.body);
    const kernels::CorrespondenceSums sums = kernels::accumulate_correspondences(
        correspondences.span(block), to_rigid_motion(T_camera_body[body]), correspondence_loss());
    systems[body] += to_system(sums.normal, weight, 1.0);
    cost += sums.cost;
  }
}

double FreeSpaceTerm::cost(const BodyPoses& T_camera_body) const {
  double total = 0.0;
  for (const CorrespondenceSet* correspondences : {&seen_through_, &outlines_}) {
    for (const CorrespondenceSet::Block& block : correspondences->blocks()) {
      const auto body = static_cast<std::size_t>(block.body);
      total +=
          kernels::correspondence_cost(correspondences->span(block),
                                       to_rigid_motion(T_camera_body[body]), correspondence_loss());
    }
  }
  return lambda_ * total;
}

kernels::CorrespondenceLoss FreeSpaceTerm::correspondence_loss() const {
  return {static_cast<float>(spread2_), static_cast<float>(cut_)};
}

void FreeSpaceTerm::append_tile_systems(const BodyPoses& T_camera_body, std::size_t first_tile,
                                        double outline_weight, const Executor& executor,
                                        std::vector<TileSystem>& systems) {
  const std::size_t of_samples = seen_through_.blocks().size();
  const std::size_t blocks = of_samples + outlines_.blocks().size();
  block_systems_.resize(std::max(block_systems_.size(), blocks));
  executor.for_each(blocks, [&](std::size_t i) {
    if (i < of_samples) {
      find_tile_systems(seen_through_, i, T_camera_body, first_tile, lambda_, block_systems_[i]);
    } else {
      find_tile_systems(outlines_, i - of_samples, T_camera_body, first_tile, outline_weight,
                        block_systems_[i]);
    }
  });
  for (const auto& block : std::span(block_systems_.data(), blocks)) {
    systems.insert(systems.end(), block.begin(), block.end());
  }
}

/// Of a block, run by run.
void FreeSpaceTerm::find_tile_systems(const CorrespondenceSet& correspondences,
                                      std::size_t block_index, const BodyPoses& T_camera_body,
                                      std::size_t first_tile, double weight,
                                      std::vector<TileSystem>& systems) const {
  const CorrespondenceSet::Block& block = correspondences.blocks()[block_index];
  const kernels::RigidMotion motion =
      to_rigid_motion(T_camera_body[static_cast<std::size_t>(block.body)]);
  std::array<std::size_t, kernels::kMostCorrespondences> ends;
  std::array<kernels::CorrespondenceProducts, kernels::kMostCorrespondences> products;
  std::size_t runs = 0;
  for (std::size_t done = 0; done < block.count;) {
    done = correspondences.end_of_run(block.first + done, block.first + block.count) - block.first;
    ends[runs++] = done;
  }
  kernels::multiply_runs(correspondences.span(block), motion, correspondence_loss(),
                         {ends.data(), runs}, products.data());
  systems.clear();
  for (std::size_t run = 0; run < runs; ++run) {
    const std::size_t last = block.first + ends[run] - 1;
    systems.push_back({first_tile + correspondences.tile(last), block.body,
                       static_cast<double>(correspondences.pixels_of(last)), Matrix6::Zero(),
                       Twist::Zero()});
    using Rows = Eigen::Matrix<float, 7, 8, Eigen::RowMajor>;
    const auto rows = Eigen::Map<const Rows>(&products[run].rows[0][0]).cast<double>();
    systems.back().hessian = weight * rows.topLeftCorner<6, 6>();
    systems.back().gradient = weight * rows.row(6).head<6>();
  }
}

}  // namespace lockbox
