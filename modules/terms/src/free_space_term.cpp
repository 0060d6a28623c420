// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/free_space_term.hpp"

#include <algorithm>
#include <array>

#include "contour_correspondences.hpp"
#include "correspondence_finder.hpp"
#include "lockbox/sdf/rigid_motion.hpp"

namespace lockbox {
namespace {

constexpr double kSurely = 0.99;  // of the tolerance
/// Samples seen through that are looked at: near the solution all of them, for there each counts.
/// From far off there are more, which all say the same: then each of those stands for several.
constexpr std::size_t kMostSamples = 6000;

}  // namespace

void FreeSpaceTerm::select(const Scene& scene, const BodyPoses& T_camera_body,
                           double annealing_sigma) {
  lambda_ = scene.options.lambda_free;
  gate_ = scene.options.gate;
  const std::size_t bands = scene.contours.bands();
  const std::size_t chunks = scene.samples.chunks().size();
  contours_.begin(bands);
  observed_contours_.resize(static_cast<std::size_t>(scene.executor.threads()) + 1);
  landings_.reserve(scene.executor);
  chunk_violations_.resize(std::max(chunk_violations_.size(), chunks));
  const auto aim_contours = [&](std::size_t band) {
    append_contour_correspondences(scene.contours.band(band), T_camera_body, scene.cloud,
                                   scene.options, annealing_sigma,
                                   observed_contours_[Executor::worker()], contours_.chunk(band));
  };
  scene.executor.for_each({{bands, aim_contours}, {chunks, [&](std::size_t i) {
                                                     find_violations(scene, T_camera_body, i);
                                                   }}});
  count_violations(chunks);
  aim_violations(scene, T_camera_body, annealing_sigma);
}

/// Aims violations at what the camera saw around them. Meanwhile one thread lays out the
/// correspondences of contours.
void FreeSpaceTerm::aim_violations(const Scene& scene, const BodyPoses& T_camera_body,
                                   double annealing_sigma) {
  const std::size_t seen = chunk_begins_.back();
  const std::size_t stride = std::max<std::size_t>(1, (seen + kMostSamples - 1) / kMostSamples);
  T_body_camera_.resize(T_camera_body.size());
  for (std::size_t b = 0; b < T_camera_body.size(); ++b) {
    T_body_camera_[b] = T_camera_body[b].inverse();
  }
  const CorrespondenceFinder finder(scene, T_body_camera_, annealing_sigma);
  const std::size_t chunks = scene.samples.chunks().size();
  violations_.begin(chunks);
  const auto aim_chunk = [&](std::size_t i) {
    const ViewSamples::Chunk& chunk = scene.samples.chunks()[i];
    const Eigen::Isometry3d& T = T_camera_body[static_cast<std::size_t>(chunk.body)];
    const std::size_t skipped = (stride - chunk_begins_[i] % stride) % stride;
    for (std::size_t k = skipped; k < chunk_violations_[i].size(); k += stride) {
      const ViewSample sample =
          scene.samples.sample(chunk.body, chunk.first + chunk_violations_[i][k]);
      if (const auto correspondence = finder.find(sample, static_cast<double>(stride), T)) {
        violations_.chunk(i).push_back(*correspondence);
      }
    }
  };
  scene.executor.for_each(
      {{1, [&](std::size_t) { contours_.finish(T_camera_body.size()); }}, {chunks, aim_chunk}});
  violations_.finish(T_camera_body.size());
}

/// Which samples of a chunk the camera sees through.
void FreeSpaceTerm::find_violations(const Scene& scene, const BodyPoses& T_camera_body,
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
  std::vector<std::uint32_t>& seen = chunk_violations_[chunk_index];
  seen.resize(chunk.count);
  seen.resize(
      kernels::free_space_violations(landings, chunk.count, along_ray, tolerance, seen.data()));
}

void FreeSpaceTerm::count_violations(std::size_t chunks) {
  chunk_begins_.assign(1, 0);
  for (std::size_t i = 0; i < chunks; ++i) {
    chunk_begins_.push_back(chunk_begins_.back() + chunk_violations_[i].size());
  }
}

double FreeSpaceTerm::linearize(const BodyPoses& T_camera_body, double annealing_sigma,
                                std::vector<BodySystem>& systems) {
  annealing_variance_ = annealing_sigma * annealing_sigma;
  double cost = 0.0;
  add_systems(violations_, T_camera_body, lambda_, systems, cost);
  contour_systems_.assign(systems.size(), BodySystem{});
  add_systems(contours_, T_camera_body, 1.0, contour_systems_, cost);
  add_contours(lambda_, systems);
  return lambda_ * cost;
}

void FreeSpaceTerm::add_contours(double weight, std::vector<BodySystem>& systems) const {
  for (std::size_t b = 0; b < systems.size(); ++b) systems[b] += weight * contour_systems_[b];
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
  for (const CorrespondenceSet* correspondences : {&violations_, &contours_}) {
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
  return {static_cast<float>(annealing_variance_), static_cast<float>(gate_)};
}

void FreeSpaceTerm::append_tile_systems(const BodyPoses& T_camera_body, std::size_t first_tile,
                                        double contour_weight, const Executor& executor,
                                        std::vector<TileSystem>& systems) const {
  const std::size_t of_samples = violations_.blocks().size();
  const std::size_t blocks = of_samples + contours_.blocks().size();
  block_systems_.resize(std::max(block_systems_.size(), blocks));
  executor.for_each(blocks, [&](std::size_t i) {
    if (i < of_samples) {
      find_tile_systems(violations_, i, T_camera_body, first_tile, lambda_, block_systems_[i]);
    } else {
      find_tile_systems(contours_, i - of_samples, T_camera_body, first_tile, contour_weight,
                        block_systems_[i]);
    }
  });
  for (const auto& block : std::span(block_systems_.data(), blocks)) {
    systems.insert(systems.end(), block.begin(), block.end());
  }
}

/// Finds the systems of a block, run by run.
void FreeSpaceTerm::find_tile_systems(const CorrespondenceSet& correspondences,
                                      std::size_t block_index, const BodyPoses& T_camera_body,
                                      std::size_t first_tile, double weight,
                                      std::vector<TileSystem>& systems) const {
  const CorrespondenceSet::Block& block = correspondences.blocks()[block_index];
  const Eigen::Isometry3d& pose = T_camera_body[static_cast<std::size_t>(block.body)];
  const kernels::RigidMotion motion = to_rigid_motion(pose);
  const Eigen::Vector3d camera = pose.inverse().translation();
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
                       static_cast<double>(correspondences.pixels_of(last)),
                       (correspondences.point(last).cast<double>() - camera).normalized(),
                       Matrix6::Zero(), Twist::Zero()});
    using Rows = Eigen::Matrix<float, 7, 8, Eigen::RowMajor>;
    const auto rows = Eigen::Map<const Rows>(&products[run].rows[0][0]).cast<double>();
    systems.back().hessian = weight * rows.topLeftCorner<6, 6>();
    systems.back().gradient = weight * rows.row(6).head<6>();
  }
}

}  // namespace lockbox
