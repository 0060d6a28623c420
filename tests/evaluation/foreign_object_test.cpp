// SPDX-License-Identifier: BSD-3-Clause
// Drawn objects in which the tracker once trusted what was wrong.
#include "lockbox/evaluation/foreign_object.hpp"

#include <gtest/gtest.h>

#include "lockbox/simulation/sensor_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

/// A sideboard, seen aslant, of which its one closed door is most of what is seen: the door fits
/// with its hinge at any angle, the carcass behind it.
TEST(ForeignObject, ADoorThatHidesTheCarcassIsNotTakenForOpen) {
  const TemporaryFolder folder;
  ForeignSettings settings;
  settings.camera = sensor_model("primesense").camera;
  settings.deviates = true;
  settings.folder = folder.path();
  const ForeignResult result =
      track_foreign_object(DrawnKind::furniture, ObjectBlock("test:11"), 6, settings, Executor());
  ASSERT_EQ(result.frames.size(), 1U);
  EXPECT_TRUE(result.frames.front().is_right()) << result.frames.front().errors.wrong;
}

}  // namespace
}  // namespace lockbox
