// SPDX-License-Identifier: BSD-3-Clause
#include "observed_outline.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

constexpr double kFarthest = 48.0;      // pixels that an outline is sought along its normal
constexpr int kMostUnknown = 1;         // pixels without depth beside it: a shadow is wider
constexpr double kSurelyInside = 0.75;  // of the way that it is sought

/// The pixels along the normal of an outline, numbered outwards; 0 is the one that it passes.
class Walk {
 public:
  Walk(const OutlinePoint& point, const Eigen::Isometry3d& T_camera_body, const TiledCloud& cloud)
      : cloud_(cloud),
        slope_(point.slope),
        p_(T_camera_body * point.p_body),
        normal_(T_camera_body.linear() * point.normal_body),
        start_(cloud.camera().project(p_)),
        corner_(start_ + Eigen::Vector2d(0.5, 0.5)),
        direction_(
            Eigen::Vector2d(cloud.camera().fx * (normal_.x() - normal_.z() * p_.x() / p_.z()),
                            cloud.camera().fy * (normal_.y() - normal_.z() * p_.y() / p_.z())) /
            p_.z()),
        pixel_size_(1.0 / direction_.norm()) {
    direction_ *= pixel_size_;
  }

  const Eigen::Vector3d& p() const { return p_; }
  const Eigen::Vector3d& normal() const { return normal_; }
  double pixel_size() const { return pixel_size_; }  ///< metres along the normal

  /// How far behind the surface, were it to go on there, the measurement in a pixel lies (metres):
  /// kUnknown where nothing was measured, nothing beyond the image.
  std::optional<double> behind(int k) const {
    const Eigen::Vector2d at = corner_ + k * direction_;
    const PinholeCamera& camera = cloud_.camera();
    if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() < camera.width && at.y() < camera.height)) {
      return std::nullopt;
    }
    const Eigen::Vector2i pixel = at.cast<int>();
    const auto index =
        static_cast<std::size_t>(pixel.y()) * static_cast<std::size_t>(camera.width) +
        static_cast<std::size_t>(pixel.x());
    const auto measured = static_cast<double>(cloud_.depth()[index]);
    const double expected = p_.z() / std::max(kHorizon, 1.0 + slope_ * k * pixel_size_);
    return measured > 0.0 ? measured - expected : kUnknown;
  }

  /// Of the centre of a pixel in the image, metres outwards from the model's outline.
  double position(int k) const {
    const Eigen::Vector2i pixel = (corner_ + k * direction_).cast<int>();
    return (pixel.cast<double>() - start_).dot(direction_) * pixel_size_;
  }

  static constexpr double kUnknown = -1e9;

 private:
  static constexpr double kHorizon = 0.1;

  const TiledCloud& cloud_;
  double slope_;
  Eigen::Vector3d p_;
  Eigen::Vector3d normal_;
  Eigen::Vector2d start_;   ///< where the outline passes
  Eigen::Vector2d corner_;  ///< the same from the image's corner: whole numbers are pixels
  Eigen::Vector2d direction_;
  double pixel_size_;
};

enum class Shown { surface, beyond, nearer, unknown };

/// What a pixel shows of an outline: the surface that ends there, something more than `beyond`
/// behind it, or something more than `nearer` before it.
Shown shown(double behind, double beyond, double nearer) {
  if (behind == Walk::kUnknown) return Shown::unknown;
  if (behind < -nearer) return Shown::nearer;
  return behind > beyond ? Shown::beyond : Shown::surface;
}

struct WalkEnd {
  int k;
  bool is_wanted;  ///< what pixel k shows; otherwise the walk ended there without it
};

/// Walks from pixel k to `last` until one shows what is wanted; nothing where the image ends or
/// where something nearer, or too little that is known, is in between.
std::optional<WalkEnd> seek(const Walk& walk, int k, int last, Shown wanted, double beyond,
                            double nearer) {
  const int step = last < k ? -1 : 1;
  int unknown = 0;
  for (;; k += step) {
    const auto behind = walk.behind(k);
    const Shown here = behind ? shown(*behind, beyond, nearer) : Shown::nearer;
    if (here == wanted) return WalkEnd{k, true};
    unknown = here == Shown::unknown ? unknown + 1 : 0;
    if (here == Shown::nearer || unknown > kMostUnknown) return std::nullopt;
    if (k == last) return WalkEnd{k, false};
  }
}

}  // namespace

std::optional<OutlineSighting> ObservedOutline::find(const OutlinePoint& point,
                                                     const Eigen::Isometry3d& T_camera_body) const {
  const Walk walk(point, T_camera_body, cloud_);
  const double depth = walk.p().z();
  const SensorNoise& noise = options_.noise;
  const double lateral = noise.sigma_lateral(depth, cloud_.camera().fx);
  const double reach = options_.cut * std::sqrt(lateral * lateral + spread_ * spread_);
  const int last = static_cast<int>(std::ceil(std::min(reach / walk.pixel_size(), kFarthest)));
  const double zone = options_.free_space_dead_zone *
                      std::sqrt(std::pow(noise.sigma_z(depth), 2) +
                                std::pow(noise.lateral_pixels * point.steepness * depth, 2));
  const double nearer = zone + point.rise;
  const auto beyond = seek(walk, 0, last, Shown::beyond, zone, nearer);
  if (!beyond || !beyond->is_wanted) {
    return std::nullopt;
  }
  // Halfway to what is seen there, lest noise speaks for one side only.
  const double halfway = std::min(zone, 0.5 * *walk.behind(beyond->k));
  const auto surface = seek(walk, beyond->k, -last, Shown::surface, halfway, nearer);
  if (!surface) {
    return std::nullopt;
  }
  if (!surface->is_wanted) {
    return OutlineSighting{walk.p(), walk.normal(), -kSurelyInside * reach, lateral * lateral};
  }
  int outside = surface->k + 1;
  while (*walk.behind(outside) == Walk::kUnknown) ++outside;
  const double from = walk.position(surface->k);
  const double to = walk.position(outside);
  const double gap = std::max(0.0, to - from - walk.pixel_size());
  return OutlineSighting{walk.p(), walk.normal(), 0.5 * (from + to),
                         lateral * lateral + gap * gap / 12.0};
}

}  // namespace lockbox
