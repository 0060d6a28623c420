// SPDX-License-Identifier: BSD-3-Clause
// Property "contact costs nothing; penetration costs": in valid configurations of the shipped
// models E_collision is exactly 0, at every voxel size; a link that is pushed into its neighbour
// costs, and the gradient pushes it back out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "initialization/seen_model.hpp"
#include "lockbox/sdf/field_cache.hpp"
#include "lockbox/terms/collision_term.hpp"
#include "overlaps.hpp"

namespace lockbox {
namespace {

constexpr double kRounding = 0.0002;  // metres: of fields at edges
constexpr double kInfinity = std::numeric_limits<double>::infinity();

BodyPoses poses_at(const ArticulatedModel& model, const Configuration& configuration) {
  BodyPoses poses;
  forward_kinematics(model.tree, configuration, poses);
  return poses;
}

/// Joints anywhere within their limits such that no link is in another one's way: a drawer cannot
/// be out behind a closed door.
Configuration random_configuration(const ArticulatedModel& model, const Overlaps& overlaps,
                                   std::mt19937& random) {
  Configuration configuration = rest_configuration(model.tree);
  do {
    for (int v = 0; v < model.tree.variables(); ++v) {
      const VariableLimits limits = variable_limits(model.tree, v);
      configuration.q[v] = std::uniform_real_distribution<double>(
          std::max(limits.lower, -4.0), std::min(limits.upper, 4.0))(random);
    }
  } while (overlaps.deepest(poses_at(model, configuration)) > kRounding);
  return configuration;
}

double cost_of(CollisionTerm& term, const ArticulatedModel& model,
               const Configuration& configuration, NormalEquations* equations = nullptr) {
  if (equations != nullptr) {
    equations->set_zero(model.tree.unknowns());
  }
  return equations == nullptr ? term.cost(model, poses_at(model, configuration))
                              : term.linearize(model, poses_at(model, configuration), *equations);
}

/// The model with fields of that voxel, or of the largest that a link's walls allow.
ArticulatedModel with_voxel(const std::string& name, double voxel) {
  ArticulatedModel model = load_model(shipped_file(name), with_cache());
  for (std::size_t b = 0; voxel > 0.0 && b < model.fields.size(); ++b) {
    FieldOptions options;
    options.voxel = std::min(voxel, 0.5 * model.fields[b]->thickness());
    model.fields[b] = load_or_build_field(model.tree.bodies[b].mesh, options,
                                          *with_cache().cache_directory, Executor());
  }
  return model;
}

struct Offer {
  std::string model;
  double voxel;  ///< metres; 0: the chosen one
};

void PrintTo(const Offer& offer, std::ostream* stream) {
  *stream << offer.model << " at " << 1e3 * offer.voxel << " mm";
}

class Contact : public ::testing::TestWithParam<Offer> {};

TEST_P(Contact, CostsNothingInAThousandRandomConfigurations) {
  const ArticulatedModel model = with_voxel(GetParam().model, GetParam().voxel);
  CollisionTerm term(model, CollisionOptions{});
  const Overlaps overlaps(model);
  std::mt19937 random(11);
  for (int trial = 0; trial < 1000; ++trial) {
    const Configuration at = random_configuration(model, overlaps, random);
    ASSERT_EQ(cost_of(term, model, at), 0.0) << "trial " << trial << ": " << at.q.transpose();
  }
}

std::vector<Offer> offers() {
  std::vector<Offer> all;
  for (const char* model : {"lockbox", "cabinet"}) {
    for (const double voxel : {0.0, 0.003, 0.005, kInfinity}) {
      all.push_back({model, voxel});
    }
  }
  all.push_back({"lockbox_overlapping", 0.0});
  all.push_back({"lockbox_overlapping", kInfinity});
  return all;
}

std::string name_of(const ::testing::TestParamInfo<Offer>& offer) {
  const double voxel = offer.param.voxel;
  const std::string size = voxel == 0.0         ? "chosen"
                           : voxel == kInfinity ? "largest"
                                                : std::to_string(std::lround(1e3 * voxel)) + "_mm";
  return offer.param.model + "_" + size + "_voxel";
}

INSTANTIATE_TEST_SUITE_P(OfShippedModels, Contact, ::testing::ValuesIn(offers()), name_of);

/// The tree with joint j replaced by a slide along a direction of the parent's frame.
KinematicTree with_slide(KinematicTree tree, std::size_t j, const Eigen::Vector3d& direction) {
  Joint& joint = tree.joints[j];
  joint.type = JointType::prismatic;
  joint.axis = joint.T_parent_joint.linear().transpose() * direction;
  joint.lower = -kInfinity;
  joint.upper = kInfinity;
  return tree;
}

class Penetration : public ::testing::TestWithParam<Offer> {
 protected:
  ArticulatedModel model_ = with_voxel(GetParam().model, GetParam().voxel);
  const KinematicTree tree_ = model_.tree;
  CollisionTerm term_{model_, CollisionOptions{}};
  const Overlaps overlaps_{model_};

  /// Pushes a pair's bodies into each other by moving joint j; false if they miss each other.
  bool push(const CollisionPair& pair, std::size_t j, const Eigen::Vector3d& direction);
};

bool Penetration::push(const CollisionPair& pair, std::size_t j, const Eigen::Vector3d& direction) {
  const double depth = 3.0 * pair.erosion;
  const auto a = static_cast<std::size_t>(pair.a);
  const auto b = static_cast<std::size_t>(pair.b);
  model_.tree = with_slide(tree_, j, direction);
  Configuration pushed = rest_configuration(model_.tree);
  const int variable = model_.tree.joints[j].variable;
  pushed.q[variable] += depth;
  if (overlaps_.between(a, b, poses_at(model_, pushed)) < 0.95 * depth) {
    return false;
  }
  NormalEquations equations;
  const auto unknown = unknown_of(variable);
  EXPECT_GT(cost_of(term_, model_, pushed, &equations), 0.0);
  EXPECT_GT(equations.gradient[unknown], 0.0) << "does not push back out";
  // Newton's method along the slide takes it out.
  double cost = kInfinity;
  for (int k = 0; k < 20 && cost > 0.0; ++k) {
    cost = cost_of(term_, model_, pushed, &equations);
    if (cost > 0.0) {
      pushed.q[variable] -= equations.gradient[unknown] / equations.hessian(unknown, unknown);
    }
  }
  EXPECT_LT(cost, 1e-6);
  EXPECT_LT(pushed.q[variable], depth);
  EXPECT_GT(pushed.q[variable], -pair.erosion) << "thrown out on the wrong side";
  return true;
}

TEST_P(Penetration, CostsAndIsPushedBackOut) {
  std::vector<int> pushes(tree_.joints.size(), 0);
  for (const CollisionPair& pair : term_.pairs()) {
    for (std::size_t j = 0; j < tree_.joints.size(); ++j) {
      const bool moves =
          tree_.joints[j].child_body == pair.a || tree_.joints[j].child_body == pair.b;
      for (int side = 0; moves && side < 6; ++side) {
        const Eigen::Vector3d direction =
            (side % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(side / 2);
        SCOPED_TRACE(tree_.bodies[static_cast<std::size_t>(pair.a)].name + " and " +
                     tree_.bodies[static_cast<std::size_t>(pair.b)].name + ", joint " +
                     tree_.joints[j].name + " along " + std::to_string(side));
        pushes[j] += push(pair, j, direction) ? 1 : 0;
      }
    }
  }
  for (std::size_t j = 0; j < pushes.size(); ++j) {
    EXPECT_GT(pushes[j], 0) << tree_.joints[j].name << " met no neighbour";
  }
}

INSTANTIATE_TEST_SUITE_P(OfShippedModels, Penetration,
                         ::testing::Values(Offer{"lockbox", 0.0}, Offer{"lockbox_overlapping", 0.0},
                                           Offer{"cabinet", 0.0}, Offer{"cabinet", kInfinity}),
                         name_of);

}  // namespace
}  // namespace lockbox
