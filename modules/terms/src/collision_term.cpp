// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/collision_term.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "collision_pairs.hpp"
#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/sdf/distance_rounding.hpp"
#include "lockbox/sdf/rigid_motion.hpp"
#include "penetration.hpp"

namespace lockbox {

CollisionTerm::CollisionTerm(const ArticulatedModel& model, const CollisionOptions& options,
                             const Executor& executor)
    : executor_(executor),
      weight_(options.lambda_collision / (options.collision_sigma * options.collision_sigma)) {
  if (options.collision == CollisionMode::off) {
    return;
  }
  const std::size_t bodies = model.fields.size();
  std::vector<std::vector<SurfaceSample>> samples(bodies);
  std::vector<ErodedSurface> whole(bodies);
  executor.for_each(bodies, [&](std::size_t b) {
    if (!model.fields[b]) return;
    samples[b] = collision_samples(model.tree.bodies[b].mesh);
    whole[b] = erode(*model.fields[b], samples[b], 0.0);
  });
  pairs_ = find_collision_pairs(model, whole, options.erosion, executor);
  if (options.collision == CollisionMode::eroded) choose_erosions(model, options.erosion, pairs_);
  const std::vector<Erosion> erosions = list_erosions();
  surfaces_.resize(erosions.size());
  executor.for_each(erosions.size(), [&](std::size_t i) {
    const auto body = static_cast<std::size_t>(erosions[i].body);
    surfaces_[i] = erode(*model.fields[body], samples[body], erosions[i].depth);
  });
}

/// Each once, of all pairs.
std::vector<CollisionTerm::Erosion> CollisionTerm::list_erosions() {
  std::vector<Erosion> erosions;
  const auto place_of = [&](const Erosion& wanted) {
    const auto known = std::find(erosions.begin(), erosions.end(), wanted);
    const auto place = static_cast<std::size_t>(known - erosions.begin());
    if (known == erosions.end()) erosions.push_back(wanted);
    return place;
  };
  for (const CollisionPair& pair : pairs_) {
    const std::size_t of_a = place_of({pair.a, pair.erosion});
    pair_surfaces_.emplace_back(of_a, place_of({pair.b, pair.erosion}));
  }
  return erosions;
}

void CollisionTerm::compare(const ArticulatedModel& model, const ErodedSurface& surface, int other,
                            double erosion, const Eigen::Isometry3d& T_other_body, Half& half) {
  const SignedDistanceField& field = *model.fields[static_cast<std::size_t>(other)];
  half.cost = 0.0;
  half.system = {};
  half.clear_ways.resize(surface.groups.size());
  const Eigen::AlignedBox3f box = field.bounds().cast<float>();
  const Eigen::Isometry3f T = T_other_body.cast<float>();
  const auto eroded = static_cast<float>(erosion);
  const kernels::RigidMotion motion = to_rigid_motion(T_other_body);
  std::array<float, ErodedSurface::kSamplesInGroup> distance;
  for (std::size_t k = 0; k < surface.groups.size(); ++k) {
    const ErodedSurface::Group& group = surface.groups[k];
    ClearWay& clear_way = half.clear_ways[k];
    const double off = field.bounds().squaredExteriorDistance(T_other_body * group.centre);
    if (off > group.radius * group.radius ||
        clear_way.covers(T_other_body, group.centre, group.radius)) {
      continue;
    }
    kernels::look_up_distance(field.view(), motion,
                              {surface.x.data() + group.first, surface.y.data() + group.first,
                               surface.z.data() + group.first, group.size},
                              distance.data());
    clear_way = ClearWay(T_other_body, field);
    clear_way.note(*std::min_element(distance.begin(),
                                     distance.begin() + static_cast<std::ptrdiff_t>(group.size)) +
                   eroded);
    for (std::size_t i = 0; i < group.size; ++i) {
      if (distance[i] + eroded < kDistanceRounding) {
        add_sample(field, box, T, surface.samples[group.first + i], eroded, half);
      }
    }
  }
}

/// What may penetrate, if it does. box: the field's bounds.
void CollisionTerm::add_sample(const SignedDistanceField& field, const Eigen::AlignedBox3f& box,
                               const Eigen::Isometry3f& T_other_body,
                               const ErodedSurface::Sample& sample, float erosion,
                               Half& half) const {
  const Eigen::Vector3f p = T_other_body * sample.p_body;
  if (!box.contains(p)) {
    return;
  }
  const auto inside = penetration(field, p, T_other_body.linear() * sample.normal, erosion);
  if (!inside) {
    return;
  }
  const double w = weight_ * sample.share;
  half.cost += 0.5 * w * inside->depth * inside->depth;
  Twist row;
  row << inside->normal, inside->point.cross(inside->normal);
  half.system.hessian.noalias() += w * row * row.transpose();
  half.system.gradient += w * inside->depth * row;
}

double CollisionTerm::linearize(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                                NormalEquations& equations) {
  evaluate(model, T_camera_body);
  return sum_up(model, T_camera_body, &equations);
}

double CollisionTerm::cost(const ArticulatedModel& model, const BodyPoses& T_camera_body) {
  evaluate(model, T_camera_body);
  return sum_up(model, T_camera_body, nullptr);
}

void CollisionTerm::evaluate(const ArticulatedModel& model, const BodyPoses& T_camera_body) {
  executor_.for_each(begin(T_camera_body),
                     [&](std::size_t i) { evaluate_part(model, T_camera_body, i); });
}

/// A step that is taken was evaluated when it was tried.
std::size_t CollisionTerm::begin(const BodyPoses& T_camera_body) {
  if (stands_at(T_camera_body)) return 0;
  evaluated_.clear();
  halves_.resize(2 * pairs_.size());
  return halves_.size();
}

double CollisionTerm::sum_up(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                             NormalEquations* equations) {
  evaluated_ = T_camera_body;
  double cost = 0.0;
  for (std::size_t i = 0; i < halves_.size(); ++i) {
    const Half& half = halves_[i];
    cost += half.cost;
    if (equations != nullptr && half.cost > 0.0) {
      const CollisionPair& pair = pairs_[i / 2];
      const bool exchanged = i % 2 == 1;
      relative_jacobian(model.tree, T_camera_body, exchanged ? pair.b : pair.a,
                        exchanged ? pair.a : pair.b, jacobian_);
      equations->add(half.system, jacobian_);
    }
  }
  return cost;
}

double CollisionTerm::cost_between(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                                   const std::vector<std::uint8_t>& moved) {
  evaluated_.clear();
  halves_.resize(2 * pairs_.size());
  between_.clear();
  for (std::size_t i = 0; i < halves_.size(); ++i) {
    const CollisionPair& pair = pairs_[i / 2];
    if (moved[static_cast<std::size_t>(pair.a)] != moved[static_cast<std::size_t>(pair.b)]) {
      between_.push_back(i);
    }
  }
  executor_.for_each(between_.size(),
                     [&](std::size_t k) { evaluate_part(model, T_camera_body, between_[k]); });
  return std::accumulate(between_.begin(), between_.end(), 0.0,
                         [this](double sum, std::size_t i) { return sum + halves_[i].cost; });
}

bool CollisionTerm::stands_at(const BodyPoses& T_camera_body) const {
  return std::equal(T_camera_body.begin(), T_camera_body.end(), evaluated_.begin(),
                    evaluated_.end(), [](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
                      return a.matrix() == b.matrix();
                    });
}

/// a moves against b, in b's frame; or b against a, in a's.
void CollisionTerm::evaluate_part(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                                  std::size_t i) {
  const CollisionPair& pair = pairs_[i / 2];
  const auto a = static_cast<std::size_t>(pair.a);
  const auto b = static_cast<std::size_t>(pair.b);
  Half& half = halves_[i];
  half.cost = 0.0;
  const Eigen::Isometry3d T_b_a = T_camera_body[b].inverse() * T_camera_body[a];
  const Eigen::AlignedBox3d box_a = model.fields[a]->bounds().transformed(T_b_a);
  if (!box_a.intersects(model.fields[b]->bounds())) {
    return;
  }
  const auto& [surface_a, surface_b] = pair_surfaces_[i / 2];
  if (i % 2 == 0) {
    compare(model, surfaces_[surface_a], pair.b, pair.erosion, T_b_a, half);
  } else {
    compare(model, surfaces_[surface_b], pair.a, pair.erosion, T_b_a.inverse(), half);
  }
}

}  // namespace lockbox
