// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/collision_term.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lockbox/core/error.hpp"
#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/registration/rigid_motion.hpp"

namespace lockbox {
namespace {

constexpr double kSamplesPerBody = 4000.0;
constexpr double kFinestSpacing = 0.003;    // metres
constexpr double kCoarsestSpacing = 0.015;  // metres
constexpr double kThicknessShare = 0.125;   // of the thinner body: the largest erosion
// A surface that looks the way the sample itself looks lies on the far side of a thin body.
constexpr float kFarSideCosine = 0.2F;
constexpr int kMaxTraceSteps = 200;
constexpr float kSurfaceTolerance = 2e-6F;  // metres
constexpr std::size_t kSamplesInPatch = 128;
constexpr float kRounding = 1e-5F;  // metres: more than single precision errs

/// Where and how deep a sample sits in the other body, and which way is out.
struct Penetration {
  double depth;  ///< metres, negative
  Eigen::Vector3d normal;
  Eigen::Vector3d point;
};

/// The way back along the sample's own normal to the surface that it came in through: past the
/// middle of a thin body the nearest surface is the wrong one.
std::optional<Penetration> trace_back(const SignedDistanceField& field, const Eigen::Vector3f& p,
                                      const Eigen::Vector3f& outward, float erosion) {
  const auto longest = static_cast<float>(field.bounds().sizes().norm());
  const auto shortest_step = static_cast<float>(0.1 * field.voxel());
  float way = 0.0F;
  for (int step = 0; step < kMaxTraceSteps && way < longest; ++step) {
    const Eigen::Vector3f q = p - way * outward;
    const DistanceSample at = field.sample(q);
    const float f = at.distance + erosion;
    if (f > -kSurfaceTolerance) {
      const float cosine = -at.gradient.dot(outward);
      if (cosine < 0.1F) {
        return std::nullopt;
      }
      if (std::abs(f) < kSurfaceTolerance) {
        return Penetration{-static_cast<double>(way), (at.gradient / cosine).cast<double>(),
                           q.cast<double>()};
      }
      way -= f / cosine;  // Newton's method back onto the surface that the last step went through
      continue;
    }
    way += std::max(-f, shortest_step);
  }
  return std::nullopt;
}

std::optional<Penetration> penetration(const SignedDistanceField& field, const Eigen::Vector3f& p,
                                       const Eigen::Vector3f& outward, float erosion) {
  const DistanceSample at = field.sample(p);
  const float f = at.distance + erosion;
  if (f >= 0.0F) {
    return std::nullopt;
  }
  if (at.gradient.dot(outward) > kFarSideCosine) {
    return trace_back(field, p, outward, erosion);
  }
  return Penetration{static_cast<double>(f), at.gradient.cast<double>(), p.cast<double>()};
}

/// The erosion that the model's file sets for a pair, by any of the links' names.
std::optional<double> pair_erosion(const ArticulatedModel& model, const Body& a, const Body& b) {
  for (const std::string& link_a : a.links) {
    for (const std::string& link_b : b.links) {
      const auto found = model.parameters.pair_erosion.find(std::minmax(link_a, link_b));
      if (found != model.parameters.pair_erosion.end()) {
        return found->second;
      }
    }
  }
  return std::nullopt;
}

void check_erosion(const ArticulatedModel& model, double erosion, double largest, const Body& a,
                   const Body& b) {
  if (erosion > largest) {
    throw InputError(
        model.file.string(),
        "the erosion of " + std::to_string(erosion * 1e3) + " mm for links '" + a.name + "' and '" +
            b.name + "' is more than an eighth of the thinner one (" +
            std::to_string(largest * 1e3) +
            " mm): its eroded surface would vanish; lower it in the model's YAML file");
  }
}

}  // namespace

CollisionTerm::CollisionTerm(const ArticulatedModel& model, const RegistrationOptions& options,
                             const Executor& executor)
    : executor_(executor),
      weight_(options.lambda_collision / (options.collision_sigma * options.collision_sigma)) {
  if (options.collision == CollisionMode::off) {
    return;
  }
  BodyPoses rest;
  forward_kinematics(model.tree, rest_configuration(model.tree), rest);
  const auto bodies = static_cast<int>(model.tree.bodies.size());
  for (int a = 0; a < bodies; ++a) {
    for (int b = a + 1; b < bodies; ++b) {
      const auto& field_a = model.fields[static_cast<std::size_t>(a)];
      const auto& field_b = model.fields[static_cast<std::size_t>(b)];
      if (!field_a || !field_b) {
        continue;
      }
      const Body& body_a = model.tree.bodies[static_cast<std::size_t>(a)];
      const Body& body_b = model.tree.bodies[static_cast<std::size_t>(b)];
      CollisionPair pair{a, b, 0.0, 0.0};
      const std::size_t literal_a = surface_index(model, a, 0.0);
      const std::size_t literal_b = surface_index(model, b, 0.0);
      const auto deepest = [&](const ErodedSurface& surface, const SignedDistanceField& field,
                               const Eigen::Isometry3d& T_other_body) {
        double depth = 0.0;
        for (const Sample& sample : surface.samples) {
          const Eigen::Vector3f p = T_other_body.cast<float>() * sample.p_body;
          depth = std::max(depth, -static_cast<double>(field.sample(p).distance));
        }
        return depth;
      };
      const Eigen::Isometry3d T_b_a =
          rest[static_cast<std::size_t>(b)].inverse() * rest[static_cast<std::size_t>(a)];
      pair.rest_overlap = std::max(deepest(surfaces_[literal_a], *field_b, T_b_a),
                                   deepest(surfaces_[literal_b], *field_a, T_b_a.inverse()));
      if (options.collision == CollisionMode::eroded) {
        const double largest =
            kThicknessShare * std::min(field_a->thickness(), field_b->thickness());
        auto chosen = pair_erosion(model, body_a, body_b);
        chosen = chosen ? chosen : model.parameters.erosion;
        if (chosen) {
          check_erosion(model, *chosen, largest, body_a, body_b);
        }
        pair.erosion =
            chosen.value_or(std::min(options.erosion, largest)) + 0.5 * pair.rest_overlap;
      }
      pair_surfaces_.emplace_back(surface_index(model, a, pair.erosion),
                                  surface_index(model, b, pair.erosion));
      pairs_.push_back(pair);
    }
  }
}

std::size_t CollisionTerm::surface_index(const ArticulatedModel& model, int body, double erosion) {
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    if (surfaces_[i].body == body && surfaces_[i].erosion == erosion) {
      return i;
    }
  }
  const TriangleMesh& mesh = model.tree.bodies[static_cast<std::size_t>(body)].mesh;
  const SignedDistanceField& field = *model.fields[static_cast<std::size_t>(body)];
  const double area = surface_area(mesh);
  const double spacing =
      std::clamp(std::sqrt(area / kSamplesPerBody), kFinestSpacing, kCoarsestSpacing);
  ErodedSurface surface{body, erosion, {}, {}, {}, {}, {}};
  double total = 0.0;
  for (const SurfaceSample& point : sample_surface(mesh, spacing)) {
    Eigen::Vector3f p = point.position.cast<float>();
    for (int step = 0; step < 5; ++step) {  // Newton's method towards the level set
      const DistanceSample at = field.sample(p);
      p -= (at.distance + static_cast<float>(erosion)) * at.gradient /
           std::max(0.25F, at.gradient.squaredNorm());
    }
    const DistanceSample at = field.sample(p);
    if (std::abs(at.distance + static_cast<float>(erosion)) >
        0.25F * static_cast<float>(field.voxel())) {
      continue;  // buried in another shell of the same body, or at a medial axis
    }
    surface.samples.push_back({p, at.gradient.normalized(), point.area});
    total += point.area;
  }
  for (Sample& sample : surface.samples) {
    sample.share /= total;
    surface.x.push_back(sample.p_body.x());
    surface.y.push_back(sample.p_body.y());
    surface.z.push_back(sample.p_body.z());
  }
  for (auto* axis : {&surface.x, &surface.y, &surface.z}) {
    axis->resize(kernels::padded(surface.samples.size()), kernels::kPadding);
  }
  surface.patches = patches_of(surface.samples);
  surfaces_.push_back(std::move(surface));
  return surfaces_.size() - 1;
}

/// Samples follow each other along a space-filling curve.
std::vector<CollisionTerm::Patch> CollisionTerm::patches_of(const std::vector<Sample>& samples) {
  std::vector<Patch> patches;
  for (std::size_t first = 0; first < samples.size(); first += kSamplesInPatch) {
    const std::size_t size = std::min(kSamplesInPatch, samples.size() - first);
    Eigen::AlignedBox3d box;
    for (std::size_t i = first; i < first + size; ++i) {
      box.extend(samples[i].p_body.cast<double>());
    }
    patches.push_back({first, kernels::padded(size), box.center(), 0.5 * box.diagonal().norm()});
  }
  return patches;
}

void CollisionTerm::evaluate_half(const ArticulatedModel& model, const ErodedSurface& surface,
                                  int other, double erosion, const Eigen::Isometry3d& T_other_body,
                                  bool with_system, Half& half) {
  const SignedDistanceField& field = *model.fields[static_cast<std::size_t>(other)];
  half.cost = 0.0;
  half.system = {};
  half.clear_ways.resize(surface.patches.size());
  const Eigen::AlignedBox3f box = field.bounds().cast<float>();
  const Eigen::Isometry3f T = T_other_body.cast<float>();
  const auto eroded = static_cast<float>(erosion);
  const kernels::RigidMotion motion = to_rigid_motion(T_other_body);
  std::array<float, kSamplesInPatch> distance;
  for (std::size_t k = 0; k < surface.patches.size(); ++k) {
    const Patch& patch = surface.patches[k];
    ClearWay& clear_way = half.clear_ways[k];
    const double off = field.bounds().squaredExteriorDistance(T_other_body * patch.centre);
    if (off > patch.radius * patch.radius ||
        clear_way.covers(T_other_body, patch.centre, patch.radius)) {
      continue;
    }
    kernels::look_up_distance(field.view(), motion,
                              {surface.x.data() + patch.first, surface.y.data() + patch.first,
                               surface.z.data() + patch.first, patch.size},
                              distance.data());
    clear_way = ClearWay(T_other_body, field);
    clear_way.note(*std::min_element(distance.begin(),
                                     distance.begin() + static_cast<std::ptrdiff_t>(patch.size)) +
                   eroded);
    for (std::size_t i = 0; i < patch.size; ++i) {
      if (distance[i] + eroded < kRounding) {
        add_sample(field, box, T, surface.samples[patch.first + i], eroded, with_system, half);
      }
    }
  }
}

/// What may penetrate, if it does. box: the field's bounds.
void CollisionTerm::add_sample(const SignedDistanceField& field, const Eigen::AlignedBox3f& box,
                               const Eigen::Isometry3f& T_other_body, const Sample& sample,
                               float erosion, bool with_system, Half& half) const {
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
  if (with_system) {
    Twist row;
    row << inside->normal, inside->point.cross(inside->normal);
    half.system.hessian.noalias() += w * row * row.transpose();
    half.system.gradient += w * inside->depth * row;
  }
}

double CollisionTerm::evaluate(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                               NormalEquations* equations) {
  halves_.resize(2 * pairs_.size());
  executor_.for_each(pairs_.size(), [&](std::size_t i) {
    evaluate_pair(model, T_camera_body, i, equations != nullptr);
  });
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

/// a moves against b, in b's frame; and b against a, in a's.
void CollisionTerm::evaluate_pair(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                                  std::size_t i, bool with_systems) {
  const CollisionPair& pair = pairs_[i];
  const auto a = static_cast<std::size_t>(pair.a);
  const auto b = static_cast<std::size_t>(pair.b);
  Half& first = halves_[2 * i];
  Half& second = halves_[2 * i + 1];
  first.cost = second.cost = 0.0;
  const Eigen::Isometry3d T_b_a = T_camera_body[b].inverse() * T_camera_body[a];
  const Eigen::AlignedBox3d box_a = model.fields[a]->bounds().transformed(T_b_a);
  if (!box_a.intersects(model.fields[b]->bounds())) {
    return;
  }
  evaluate_half(model, surfaces_[pair_surfaces_[i].first], pair.b, pair.erosion, T_b_a,
                with_systems, first);
  evaluate_half(model, surfaces_[pair_surfaces_[i].second], pair.a, pair.erosion, T_b_a.inverse(),
                with_systems, second);
}

}  // namespace lockbox
