// SPDX-License-Identifier: BSD-3-Clause
// Limits of joints that mimic others.
#include <gmock/gmock.h>

#include "units_fixture.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Joints that mimic with limits that were copied from what they mimic.
class MimicLimits : public Units {
 protected:
  std::string fingers(const std::string& limit, const std::string& multiplier = "-1") const {
    return link("palm", box("0.24 0.12 0.08")) + link("left") + link("right") +
           joint("l", "prismatic", "palm", "left", limits("0", "0.05")) +
           joint("r", "prismatic", "palm", "right",
                 limit + "<mimic joint=\"l\" multiplier=\"" + multiplier + "\"/>");
  }
};

TEST_F(MimicLimits, ThatWouldFreezeItDoNotCountAndAreNamed) {
  const std::string copied = fingers(limits("0", "0.05"));
  const KinematicTree tree = load_robot(copied);
  EXPECT_EQ(variable_limits(tree, 0).lower, 0.0);
  EXPECT_EQ(variable_limits(tree, 0).upper, 0.05);
  const Joint& right = tree.joints[static_cast<std::size_t>(joint_index(tree, "r"))];
  EXPECT_EQ(right.lower, -0.05);
  EXPECT_EQ(right.upper, 0.0);
  EXPECT_THAT(warnings_of(copied),
              AllOf(HasSubstr("joint 'r': it mimics 'l', and moves with it from -0.05 to 0"),
                    HasSubstr("its own limits, 0 to 0.05, are not enforced")));
}

TEST_F(MimicLimits, ThatAreJunkOrMissingStopNothing) {
  for (const std::string& limit :
       {std::string(), limits("0.05", "0"), limits("x", ""), limits("7", "9"),
        std::string("<limit effort=\"1\"/>"), limits("0", "0.05") + limits("0", "1")}) {
    EXPECT_EQ(variable_limits(load_robot(fingers(limit)), 0).upper, 0.05) << limit;
  }
  EXPECT_EQ(warnings_of(fingers("")), "");
  EXPECT_EQ(warnings_of(fingers(limits("-0.05", "0"))), "");
  EXPECT_EQ(warnings_of(fingers(limits("-0.0499", "0"))), "");
}

TEST_F(MimicLimits, OfAMultiplierOfZeroAreNamed) {
  EXPECT_THAT(warnings_of(fingers("", "0")), HasSubstr("joint 'r': it cannot move"));
}

}  // namespace
}  // namespace lockbox
