// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/free_space_term.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace lockbox {
namespace {

constexpr std::size_t kSamplesPerChunk = 2048;

/// Pixels at which the neighbourhood is probed, along eight directions: dense near the sample,
/// where outlines are decided, sparse far from it, where a direction is all that is needed.
constexpr std::array<int, 13> kProbeRadii{1, 2, 3, 4, 5, 6, 8, 11, 15, 20, 27, 36, 48};
constexpr std::array<std::array<int, 2>, 8> kProbeDirections{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

/// The observed surface around one pixel.
class Neighbourhood {
 public:
  Neighbourhood(const TiledCloud& cloud, const std::vector<std::uint8_t>& object,
                const RegistrationOptions& options)
      : cloud_(cloud), object_(object), options_(options) {}

  double sigma_z(double z) const {
    return options_.noise.depth_floor + options_.noise.depth_quadratic * z * z;
  }
  double sigma_lateral(double z) const {
    return options_.noise.lateral_pixels / cloud_.camera().fx * z;
  }

  float depth(int u, int v) const { return cloud_.depth()[index(u, v)]; }

  /// The object's observed point that is nearest in units of the noise, and how far it is
  /// (squared).
  struct Nearest {
    Eigen::Vector3d p_camera;
    double distance2;
  };
  std::optional<Nearest> nearest(const Eigen::Vector3d& p_camera, int u, int v) const {
    Nearest best{{}, std::numeric_limits<double>::infinity()};
    const double inverse_lateral2 = 1.0 / std::pow(sigma_lateral(p_camera.z()), 2);
    const double inverse_depth2 = 1.0 / std::pow(sigma_z(p_camera.z()), 2);
    const double pixel = p_camera.z() / cloud_.camera().fx;
    const auto probe = [&](int pu, int pv) {
      if (pu < 0 || pv < 0 || pu >= cloud_.camera().width || pv >= cloud_.camera().height ||
          object_[index(pu, pv)] == 0) {
        return;
      }
      const Eigen::Vector3d q =
          cloud_.camera().back_project(pu, pv, static_cast<double>(depth(pu, pv)));
      const double along = q.z() - p_camera.z();
      const Eigen::Vector3d ray = p_camera / p_camera.z();
      const double across2 = (q - p_camera - along * ray).squaredNorm();
      const double distance2 = along * along * inverse_depth2 + across2 * inverse_lateral2;
      if (distance2 < best.distance2) {
        best = {q, distance2};
      }
    };
    probe(u, v);
    for (const int radius : kProbeRadii) {
      if (std::pow(radius * pixel, 2) * inverse_lateral2 > best.distance2) {
        break;  // whatever lies farther out in the image is farther away
      }
      for (const auto& direction : kProbeDirections) {
        probe(u + radius * direction[0], v + radius * direction[1]);
      }
    }
    return std::isfinite(best.distance2) ? std::optional(best) : std::nullopt;
  }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(cloud_.camera().width) +
           static_cast<std::size_t>(u);
  }

  const TiledCloud& cloud_;
  const std::vector<std::uint8_t>& object_;
  const RegistrationOptions& options_;
};

/// The mixture of kernels::associate for a single body: what is explained, and the weight.
struct Loss {
  double explained;  ///< c - E
  double weight;     ///< 1 for small residuals, 0 for outliers
};
Loss loss(double residual, double inverse_variance, double cut) {
  const double outlier_cost = 0.5 * cut * cut;
  const double gaussian = std::exp(-0.5 * residual * residual * inverse_variance);
  const double sum = gaussian + std::exp(-outlier_cost);
  return {std::log(sum) + outlier_cost, gaussian / sum};
}

constexpr double kLeastWeight = 1e-3;  // below it a sample is not worth keeping

}  // namespace

double FreeSpaceTerm::linearize(const VisibleSurface& surface, const BodyPoses& T_camera_body,
                                const TiledCloud& cloud, const std::vector<std::uint8_t>& object,
                                const RegistrationOptions& options, double spread,
                                const Executor& executor, std::vector<BodySystem>& systems) {
  weight_ = options.lambda_free * surface.pixels_per_sample();
  cut_ = options.cut;
  const Neighbourhood observed(cloud, object, options);
  const PinholeCamera& camera = cloud.camera();
  const auto& samples = surface.samples();
  const std::size_t chunks = chunk_count(samples.size(), kSamplesPerChunk);
  chunk_pulls_.resize(std::max(chunk_pulls_.size(), chunks));

  const auto select = [&](std::size_t begin, std::size_t end, std::size_t chunk) {
    std::vector<Pull>& pulls = chunk_pulls_[chunk];
    pulls.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p_body = samples[i].p_body.cast<double>();
      const Eigen::Vector3d p = T_camera_body[static_cast<std::size_t>(samples[i].body)] * p_body;
      if (p.z() <= 0.0) {
        continue;
      }
      const Eigen::Vector2d image = camera.project(p);
      const int u = static_cast<int>(std::lround(image.x()));
      const int v = static_cast<int>(std::lround(image.y()));
      if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) {
        continue;
      }
      const auto measured = static_cast<double>(observed.depth(u, v));
      const double sigma = observed.sigma_z(p.z());
      if (measured <= p.z() + options.free_space_dead_zone * sigma) {
        continue;  // also where nothing was measured
      }
      const auto nearest = observed.nearest(p, u, v);
      if (!nearest) {
        continue;
      }
      const Eigen::Vector3d offset = p - nearest->p_camera;
      const double length = offset.norm();
      if (length < 1e-9) {
        continue;
      }
      const Eigen::Vector3d direction = offset / length;
      const double along = direction.dot(p) / p.z();
      const double across2 = std::max(0.0, 1.0 - std::pow(direction.dot(p), 2) / p.squaredNorm());
      const double variance = along * along * sigma * sigma +
                              across2 * std::pow(observed.sigma_lateral(p.z()), 2) +
                              spread * spread;
      const double inverse_variance = 1.0 / variance;
      if (loss(length, inverse_variance, options.cut).weight > kLeastWeight) {
        pulls.push_back({p_body, nearest->p_camera, direction, inverse_variance, samples[i].body});
      }
    }
  };
  executor.for_each_chunk(samples.size(), kSamplesPerChunk, select);

  pulls_.clear();
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    pulls_.insert(pulls_.end(), chunk_pulls_[chunk].begin(), chunk_pulls_[chunk].end());
  }
  for (const Pull& pull : pulls_) {
    const Eigen::Isometry3d& T = T_camera_body[static_cast<std::size_t>(pull.body)];
    const double residual = pull.direction.dot(T * pull.p_body - pull.target);
    const double w =
        weight_ * loss(residual, pull.inverse_variance, cut_).weight * pull.inverse_variance;
    const Eigen::Vector3d n_body = T.linear().transpose() * pull.direction;
    Twist row;
    row << n_body, pull.p_body.cross(n_body);
    BodySystem& system = systems[static_cast<std::size_t>(pull.body)];
    system.hessian.noalias() += w * row * row.transpose();
    system.gradient += w * residual * row;
  }
  return cost(T_camera_body);
}

double FreeSpaceTerm::cost(const BodyPoses& T_camera_body) const {
  double total = 0.0;
  for (const Pull& pull : pulls_) {
    const Eigen::Isometry3d& T = T_camera_body[static_cast<std::size_t>(pull.body)];
    const double residual = pull.direction.dot(T * pull.p_body - pull.target);
    total -= weight_ * loss(residual, pull.inverse_variance, cut_).explained;
  }
  return total;
}

}  // namespace lockbox
