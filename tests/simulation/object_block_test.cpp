// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/object_block.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

#include "lockbox/core/error.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/model_bounds.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

KinematicTree loaded(const ObjectDraft& draft) {
  const TemporaryFolder folder;
  const auto file = folder.write(draft.name + ".urdf", urdf_text(draft));
  return load_kinematic_tree(file);
}

TEST(ObjectBlock, DrawsTheSameObjectForTheSameNumberAndAnotherForAnother) {
  const ObjectBlock tune("tune");
  for (const auto draw : {draw_furniture, draw_board, draw_household}) {
    EXPECT_EQ(urdf_text(draw(tune, 3)), urdf_text(draw(ObjectBlock("tune"), 3)));
    EXPECT_NE(urdf_text(draw(tune, 3)), urdf_text(draw(tune, 4)));
    EXPECT_NE(urdf_text(draw(tune, 3)), urdf_text(draw(ObjectBlock("test:0"), 3)));
    EXPECT_NE(urdf_text(draw(ObjectBlock("test:1"), 3)), urdf_text(draw(ObjectBlock("test:0"), 3)));
  }
}

TEST(ObjectBlock, RefusesNamesThatAreNone) {
  for (const char* name : {"", "test", "test:", "test:x", "test:-1", "test:1 ", "tuning"}) {
    EXPECT_THROW(ObjectBlock{name}, InputError) << name;
  }
}

TEST(Furniture, LoadsWithOneToSevenDrawersAndDoorsThatOpen) {
  std::set<std::size_t> counts;
  for (const char* block : {"tune", "test:1"}) {
    for (std::uint64_t number = 0; number < 40; ++number) {
      const KinematicTree tree = loaded(draw_furniture(ObjectBlock(block), number));
      counts.insert(tree.joints.size());
      for (const Joint& joint : tree.joints) {
        EXPECT_EQ(joint.lower, 0.0);
        EXPECT_GT(joint.upper, joint.type == JointType::prismatic ? 0.15 : 1.5);
      }
    }
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{1, 2, 3, 4, 5, 6, 7}));
}

TEST(Furniture, OpensTowardsItsFront) {
  for (std::uint64_t number = 0; number < 10; ++number) {
    const KinematicTree tree = loaded(draw_furniture(ObjectBlock("tune"), number));
    const Configuration rest = rest_configuration(tree);
    const double closed = model_bounds(tree, rest).min().y();
    for (int v = 0; v < tree.variables(); ++v) {
      Configuration open = rest;
      open.q[v] = variable_limits(tree, v).upper;
      EXPECT_LT(model_bounds(tree, open).min().y(), closed - 0.1);
      EXPECT_NEAR(model_bounds(tree, open).max().y(), model_bounds(tree, rest).max().y(), 1e-9);
    }
  }
}

TEST(Board, IsFrom40CentimetresToOneMetreAndHasEqualTwins) {
  int twins = 0;
  for (const char* block : {"tune", "test:1"}) {
    for (std::uint64_t number = 0; number < 40; ++number) {
      const ObjectDraft draft = draw_board(ObjectBlock(block), number);
      const KinematicTree tree = loaded(draft);
      EXPECT_GE(tree.joints.size(), 1U);
      const Eigen::Vector3d& size = draft.links.front().parts.front().size;
      EXPECT_GE(size.head<2>().minCoeff(), 0.4);
      EXPECT_LE(size.head<2>().maxCoeff(), 1.0);
      std::set<std::string> kinds;
      for (const DraftLink& link : draft.links) {
        ObjectDraft alone;
        alone.links = {{"", link.parts}};
        kinds.insert(urdf_text(alone));
      }
      twins += kinds.size() < draft.links.size() ? 1 : 0;
    }
  }
  EXPECT_GT(twins, 10);
}

TEST(Board, HasMechanismsThatStayInFrontOfIt) {
  for (std::uint64_t number = 0; number < 20; ++number) {
    const KinematicTree tree = loaded(draw_board(ObjectBlock("test:2"), number));
    const double back = model_bounds(tree, rest_configuration(tree)).min().z();
    for (int v = 0; v < tree.variables(); ++v) {
      for (const double share : {0.3, 1.0}) {
        Configuration moved = rest_configuration(tree);
        const VariableLimits limits = variable_limits(tree, v);
        moved.q[v] = std::isfinite(limits.upper) ? share * limits.upper : share;
        EXPECT_NEAR(model_bounds(tree, moved).min().z(), back, 1e-9);
      }
    }
  }
}

TEST(Household, StandsOnItsFootAndMovesWithoutSharedKinds) {
  std::set<std::string> tuning;
  std::set<std::string> tests;
  for (std::uint64_t number = 0; number < 24; ++number) {
    for (const auto& [block, names] : {std::pair("tune", &tuning), std::pair("test:1", &tests)}) {
      const KinematicTree tree = loaded(draw_household(ObjectBlock(block), number));
      names->insert(tree.name);
      EXPECT_GE(tree.variables(), 1) << tree.name;
      const Eigen::AlignedBox3d box = model_bounds(tree, rest_configuration(tree));
      EXPECT_NEAR(box.min().z(), 0.0, 0.02) << tree.name;
      EXPECT_LT(box.sizes().maxCoeff(), 1.1) << tree.name;
      EXPECT_GT(box.sizes().maxCoeff(), 0.09) << tree.name;
    }
  }
  EXPECT_EQ(tuning.size(), 12U);
  EXPECT_EQ(tests.size(), 12U);
  for (const std::string& name : tuning) EXPECT_EQ(tests.count(name), 0U) << name;
}

}  // namespace
}  // namespace lockbox
