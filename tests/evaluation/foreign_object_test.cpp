// SPDX-License-Identifier: BSD-3-Clause
// Drawn objects in which the tracker once trusted what was wrong.
#include "lockbox/evaluation/foreign_object.hpp"

#include <gtest/gtest.h>

#include "lockbox/simulation/sensor_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

std::vector<ForeignFrame> track(DrawnKind kind, const char* block, std::uint64_t number,
                                ForeignSettings settings) {
  const TemporaryFolder folder;
  settings.camera = sensor_model("primesense").camera;
  settings.folder = folder.path();
  return track_foreign_object(kind, ObjectBlock(block), number, settings, Executor()).frames;
}

/// A third of every deviation, of object and camera.
std::vector<ForeignFrame> track(DrawnKind kind, const char* block, std::uint64_t number,
                                int frames) {
  ForeignSettings settings;
  settings.deviates = true;
  settings.frames = frames;
  return track(kind, block, number, settings);
}

ForeignFrame track_furniture(const char* block, std::uint64_t number) {
  return track(DrawnKind::furniture, block, number, 1).at(0);
}

/// A sideboard, seen aslant, of which its one closed door is most of what is seen: the door fits
/// with its hinge at any angle, the carcass behind it.
TEST(ForeignObject, ADoorThatHidesTheCarcassIsNotTakenForOpen) {
  const ForeignFrame frame = track_furniture("test:11", 6);
  EXPECT_TRUE(frame.is_right()) << frame.errors.wrong;
}

/// A chest of seven drawers, seen from the front: the carcass may stand 40 mm farther back, with
/// all drawers that far out, and the image says as much for that.
TEST(ForeignObject, ACarcassBehindItsFrontsIsNotTrustedAnywhere) {
  const ForeignFrame frame = track_furniture("test:14", 29);
  EXPECT_TRUE(frame.is_right() || !frame.is_trusted()) << frame.errors.wrong;
}

/// A stapler in the air has more evidence upside down, by cells of one width; the camera does not
/// move, and every search of every frame is another draw of the noise.
TEST(ForeignObject, AStaplerUpsideDownIsNotTrustedHoweverOftenItIsSought) {
  for (const ForeignFrame& frame : track(DrawnKind::household, "test:5", 22, 10)) {
    EXPECT_TRUE(frame.is_right() || !frame.is_trusted()) << frame.errors.wrong;
    EXPECT_TRUE(frame.is_right() || frame.belief < 0.999) << frame.belief;
  }
}

/// Pliers that are closed look nearly the same the other way up. Seen so, their jaw passed for the
/// table that it lies on.
TEST(ForeignObject, PliersUpsideDownAreNotTrustedHoweverExactTheSensor) {
  ForeignSettings settings;
  settings.sensor = "ideal";
  const ForeignFrame frame = track(DrawnKind::household, "tune", 9, settings).at(0);
  EXPECT_TRUE(frame.is_right() || frame.looks_equal || !frame.is_trusted()) << frame.errors.wrong;
}

/// A box of about its size stands beside a coffee press, half of which it hides.
TEST(ForeignObject, ABoxIsNotTrustedForAPress) {
  const ForeignFrame frame = track(DrawnKind::household, "test:2", 20, ForeignSettings{}).at(0);
  EXPECT_TRUE(frame.is_right() || frame.looks_equal || !frame.is_trusted()) << frame.errors.wrong;
}

/// A folding rule and a box with a lid, of 10 to 20 cm: their thin parts passed for the table.
TEST(ForeignObject, SmallThingsAreNotTrustedWrongly) {
  ForeignSettings settings;
  settings.size = 0.5;
  for (const std::uint64_t number : {2U, 25U}) {
    const ForeignFrame frame = track(DrawnKind::household, "tune", number, settings).at(0);
    EXPECT_TRUE(frame.is_right() || frame.looks_equal || !frame.is_trusted()) << frame.errors.wrong;
  }
}

}  // namespace
}  // namespace lockbox
