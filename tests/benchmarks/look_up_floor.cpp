// SPDX-License-Identifier: BSD-3-Clause
#include "look_up_floor.hpp"

#include <algorithm>
#include <cmath>

#include "bare_sums.hpp"
#include "lockbox/cloud/image_points.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/sdf/rigid_motion.hpp"

namespace lockbox {
namespace {

constexpr double kNear = 0.015;  // metres from the surface: four deviations of the sensor
constexpr std::size_t kChunkPoints = 4096;

/// Of a view, by body: those that lie nearest to it, in the camera's frame.
std::vector<std::vector<Eigen::Vector3f>> points_at_bodies(const View& view,
                                                           const ArticulatedModel& model,
                                                           const BodyPoses& poses) {
  const auto& fields = model.fields;
  std::vector<std::vector<Eigen::Vector3f>> by_body(fields.size());
  ImagePoints points;
  points.assign(view.cloud, Executor(1));
  for (const Tile& tile : points.tiles()) {
    for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
      const Eigen::Vector3f p(points.x()[i], points.y()[i], points.z()[i]);
      std::size_t nearest = fields.size();
      double least = kNear;
      for (std::size_t b = 0; b < fields.size(); ++b) {
        if (!fields[b]) continue;
        const Eigen::Vector3d p_body = poses[b].inverse() * p.cast<double>();
        const double distance =
            std::abs(static_cast<double>(fields[b]->sample(p_body.cast<float>()).distance));
        if (distance < least) {
          least = distance;
          nearest = b;
        }
      }
      if (nearest < fields.size()) by_body[nearest].push_back(p);
    }
  }
  return by_body;
}

}  // namespace

LookUpFloor::LookUpFloor(const RegistrationScene& scene, std::size_t points) : scene_(scene) {
  const View& view = scene.views.front();
  BodyPoses poses;
  forward_kinematics(scene.model.tree, view.truth, poses);
  const auto by_body = points_at_bodies(view, scene.model, poses);
  std::size_t found = 0;
  for (const auto& own : by_body) found += own.size();
  points = std::min(points, found);
  std::size_t seen = 0;
  for (std::size_t b = 0; b < by_body.size(); ++b) {
    body_from_camera_.push_back(to_rigid_motion(poses[b].inverse()));
    const std::size_t first = x_.size();
    for (const Eigen::Vector3f& p : by_body[b]) {
      ++seen;
      if (seen * points / found == (seen - 1) * points / found) continue;
      x_.push_back(p.x());
      y_.push_back(p.y());
      z_.push_back(p.z());
    }
    points_ += x_.size() - first;
    const std::size_t end = first + kernels::padded(x_.size() - first);
    for (std::vector<float>* axis : {&x_, &y_, &z_}) {
      axis->resize(end, kernels::kPadding);
    }
    for (std::size_t begin = first; begin < end; begin += kChunkPoints) {
      chunks_.push_back({b, begin, std::min(kChunkPoints, end - begin)});
    }
  }
  sums_.resize(chunks_.size());
}

double LookUpFloor::pass(const Executor& executor) {
  executor.for_each(chunks_.size(), [&](std::size_t i) {
    const Chunk& chunk = chunks_[i];
    sums_[i] = kernels::bare_sums(
        scene_.model.fields[chunk.body]->view(), body_from_camera_[chunk.body],
        {x_.data() + chunk.first, y_.data() + chunk.first, z_.data() + chunk.first, chunk.size});
  });
  double squares = 0.0;
  for (const kernels::NormalSums& sums : sums_) {
    squares += sums.weighted_squares;
  }
  return squares;
}

}  // namespace lockbox
