// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/outline_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "lockbox/kernels/ray_touch.hpp"
#include "outline_finder.hpp"

namespace lockbox {
namespace {

constexpr int kRowsInBand = 16;
constexpr int kColumnsTogether = 8;

/// Rays that pass beside one body, and where they touch it; body frame.
class TouchingRays {
 public:
  /// beside: where each of them passes the outline closely.
  template <typename Beside>
  void pass(std::size_t count, const Beside& beside) {
    for (auto* vectors : {&direction_, &p_, &normal_}) {
      for (auto& axis : *vectors) axis.resize(kernels::padded(count));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f p = beside(i).template cast<float>();
      for (std::size_t axis = 0; axis < 3; ++axis) p_[axis][i] = p[static_cast<Eigen::Index>(axis)];
    }
    // What is left of the last lanes repeats the last ray.
    for (auto& axis : p_) {
      std::fill(axis.begin() + static_cast<std::ptrdiff_t>(count), axis.end(), axis[count - 1]);
    }
  }

  void touch(const SignedDistanceField& field, const Eigen::Vector3d& origin) {
    aim(origin);
    kernels::touch(field.view(),
                   {origin_.data(),
                    {direction_[0].data(), direction_[1].data(), direction_[2].data()},
                    p_[0].size()},
                   {{p_[0].data(), p_[1].data(), p_[2].data()},
                    {normal_[0].data(), normal_[1].data(), normal_[2].data()}});
  }

  /// Only the normals, of the surface nearest to where the rays pass.
  void find_normals(const SignedDistanceField& field) {
    float* const normals[3] = {normal_[0].data(), normal_[1].data(), normal_[2].data()};
    kernels::surface_normals(field.view(), {p_[0].data(), p_[1].data(), p_[2].data(), p_[0].size()},
                             normals);
  }

  Eigen::Vector3d p(std::size_t i) const { return vector(p_, i); }
  Eigen::Vector3d normal(std::size_t i) const { return vector(normal_, i); }

 private:
  using ByAxis = std::array<std::vector<float>, 3>;

  void aim(const Eigen::Vector3d& origin) {
    origin_ = origin.cast<float>();
    for (std::size_t i = 0; i < p_[0].size(); ++i) {
      const float x = p_[0][i] - origin_[0];
      const float y = p_[1][i] - origin_[1];
      const float z = p_[2][i] - origin_[2];
      const float scale = 1.0F / std::sqrt(x * x + y * y + z * z);
      direction_[0][i] = scale * x;
      direction_[1][i] = scale * y;
      direction_[2][i] = scale * z;
    }
  }

  static Eigen::Vector3d vector(const ByAxis& axes, std::size_t i) {
    return Eigen::Vector3f(axes[0][i], axes[1][i], axes[2][i]).cast<double>();
  }

  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  ByAxis direction_;
  ByAxis p_;
  ByAxis normal_;
};

/// Some rows of the view.
class Band {
 public:
  const std::vector<OutlinePoint>& points() const { return points_; }

  /// Pixels beside which outlines pass, body by body, in a part of the view.
  void find_pixels(const OutlineFinder& finder, std::size_t bodies, const ImageWindow& rows) {
    jumps_.clear();
    for (int v = rows.top; v < rows.bottom(); ++v) finder.append_jumps(v, jumps_);
    bring_together(finder, bodies, rows.right());
    pixels_.clear();
    for (const Pixel& jump : sorted_jumps_) {
      if (const auto pixel = finder.look_beside(jump.u, jump.v)) pixels_.push_back(*pixel);
    }
  }

  void find_points(const OutlineFinder& finder, const ArticulatedModel& model,
                   const BodyPoses& T_body_camera) {
    points_.clear();
    for (std::size_t first = 0; first < pixels_.size();) {
      const auto body = static_cast<std::size_t>(pixels_[first].body);
      std::size_t last = first;
      while (last < pixels_.size() && pixels_[last].body == pixels_[first].body) ++last;
      find_points_of_body(finder, {&pixels_[first], last - first}, *model.fields[body],
                          T_body_camera[body].translation());
      first = last;
    }
  }

 private:
  /// Sorts by body, then by groups of columns, within which the order stays.
  void bring_together(const OutlineFinder& finder, std::size_t bodies, int columns) {
    const auto groups = static_cast<std::size_t>(columns / kColumnsTogether + 1);
    const auto group_of = [&](const Pixel& jump) {
      return static_cast<std::size_t>(finder.body(jump.u, jump.v)) * groups +
             static_cast<std::size_t>(jump.u / kColumnsTogether);
    };
    next_.assign(bodies * groups + 1, 0);
    for (const Pixel& jump : jumps_) ++next_[group_of(jump) + 1];
    std::partial_sum(next_.begin(), next_.end(), next_.begin());
    sorted_jumps_.resize(jumps_.size());
    for (const Pixel& jump : jumps_) sorted_jumps_[next_[group_of(jump)]++] = jump;
  }

  /// First the normals are told by the field, then the points: rays that were aimed along the
  /// normals of whole pixels would pass the outline at some places more often than at others, and
  /// these depend on how pixels lie.
  void find_points_of_body(const OutlineFinder& finder, std::span<const OutlinePixel> own,
                           const SignedDistanceField& field, const Eigen::Vector3d& camera) {
    rays_.pass(own.size(), [&](std::size_t i) { return finder.beside(own[i]); });
    rays_.find_normals(field);
    rays_.pass(own.size(), [&](std::size_t i) { return finder.beside(own[i], rays_.normal(i)); });
    rays_.touch(field, camera);
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto point = finder.point(own[i], rays_.p(i), rays_.normal(i));
      if (point) finder.spread(*point, points_);
    }
  }

  std::vector<Pixel> jumps_;         ///< row by row
  std::vector<Pixel> sorted_jumps_;  ///< body by body
  std::vector<std::size_t> next_;    ///< of them, by body and group of columns
  std::vector<OutlinePixel> pixels_;
  TouchingRays rays_;
  std::vector<OutlinePoint> points_;
};

}  // namespace

struct OutlinePoints::Workspace {
  std::vector<Band> bands;
};

OutlinePoints::OutlinePoints() : workspace_(std::make_unique<Workspace>()) {}
OutlinePoints::~OutlinePoints() = default;
OutlinePoints::OutlinePoints(OutlinePoints&&) noexcept = default;
OutlinePoints& OutlinePoints::operator=(OutlinePoints&&) noexcept = default;

void OutlinePoints::collect(const ArticulatedModel& model, const VisibleSurface& surface,
                            const ViewEdges& edges, int spacing, const RegistrationOptions& options,
                            const Executor& executor) {
  const RenderedDepth& view = surface.view();
  const OutlineFinder finder(model, surface, edges, spacing, options);
  std::vector<Band>& bands = workspace_->bands;
  bands.resize(static_cast<std::size_t>((view.height + kRowsInBand - 1) / kRowsInBand));
  executor.for_each(bands.size(), [&](std::size_t i) {
    const int band = static_cast<int>(i) * kRowsInBand;
    ImageWindow rows = view.drawn;
    rows.top = std::max({band, 1, view.drawn.top});
    rows.height = std::min({band + kRowsInBand, view.height - 1, view.drawn.bottom()}) - rows.top;
    bands[i].find_pixels(finder, model.fields.size(), rows);
    bands[i].find_points(finder, model, surface.T_body_camera());
  });
}

std::size_t OutlinePoints::bands() const {
  return workspace_->bands.size();
}

const std::vector<OutlinePoint>& OutlinePoints::band(std::size_t i) const {
  return workspace_->bands[i].points();
}

}  // namespace lockbox
