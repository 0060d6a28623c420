// SPDX-License-Identifier: BSD-3-Clause
// Images that are mirrored, or in another unit than they are read in.
#include <gmock/gmock.h>

#include "search_failure_fixture.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;

using OtherReadings = SearchFailureTest;

TEST_F(OtherReadings, TheFrameIsMirrored) {
  mirror();
  SearchFailure found = failure();
  EXPECT_FALSE(is_explained(found));
  try_readings(found);
  EXPECT_TRUE(found.is_mirrored);
  EXPECT_THAT(said(found), HasSubstr("mirror"));
}

TEST_F(OtherReadings, AMirrorTellsNothingOfAModelThatLooksTheSameInIt) {
  const ArticulatedModel box = box_with("");
  frame = measured(box, mechanism_start(box), "primesense");
  mirror();
  EXPECT_FALSE(looks_mirrored(box));
}

TEST_F(OtherReadings, AMirrorTellsNothingWhereTheModelMayAsWellBeElsewhereInIt) {
  const ArticulatedModel box = box_with("");
  frame = measured(box, mechanism_start(box), "primesense");
  EXPECT_FALSE(looks_mirrored(box_with(R"(<visual><origin xyz="0.1 0.06 0.05"/>
    <geometry><box size="0.012 0.012 0.01"/></geometry></visual>)")));
}

/// Mirrored, it is found and fits well; but more speaks for it as it is, uncertain for another
/// reason.
TEST_F(OtherReadings, AMirrorTellsNothingWhereTheImageFitsBetterAsItIs) {
  const ArticulatedModel nearly_symmetric = box_with(
      R"(<visual><origin xyz="-0.105 0 0.115"/><geometry><box size="0.03 0.1 0.14"/></geometry>
    </visual><visual><origin xyz="0.1 0.06 0.05"/><geometry><box size="0.012 0.012 0.01"/>
    </geometry></visual>)");
  const Configuration there = mechanism_start(nearly_symmetric);
  frame = measured(nearly_symmetric, there, "primesense");
  EXPECT_TRUE(looks_mirrored(nearly_symmetric)) << "where nothing was found as it is";
  RegistrationResult best;
  best.configuration = there;
  EXPECT_FALSE(looks_mirrored(nearly_symmetric, &best));
}

TEST_F(OtherReadings, DepthsAreInAnotherUnit) {
  frame.metres_per_unit *= 5.0F;
  SearchFailure found = failure();
  try_readings(found);
  EXPECT_FALSE(found.is_mirrored);
  EXPECT_DOUBLE_EQ(found.depth_factor, 0.2);
  EXPECT_THAT(said(found), HasSubstr("--depth-scale 1000 the camera's?"));
}

TEST_F(OtherReadings, AUnitThatIsStatedIsNotDoubted) {
  frame.metres_per_unit *= 5.0F;
  SearchFailure found = failure();
  TrackerOptions stated = options();
  stated.try_other_units = false;
  try_other_readings(frame, model, stated, Executor(1), nullptr, found);
  EXPECT_DOUBLE_EQ(found.depth_factor, 1.0);
}

}  // namespace
}  // namespace lockbox
