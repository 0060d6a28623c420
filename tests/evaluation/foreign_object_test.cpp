// SPDX-License-Identifier: BSD-3-Clause
// Drawn objects in which the tracker once trusted what was wrong.
#include "lockbox/evaluation/foreign_object.hpp"

#include <gtest/gtest.h>

#include "lockbox/simulation/sensor_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

/// A third of every deviation, of object and camera.
std::vector<ForeignFrame> track(DrawnKind kind, const char* block, std::uint64_t number,
                                int frames) {
  const TemporaryFolder folder;
  ForeignSettings settings;
  settings.camera = sensor_model("primesense").camera;
  settings.deviates = true;
  settings.frames = frames;
  settings.folder = folder.path();
  return track_foreign_object(kind, ObjectBlock(block), number, settings, Executor()).frames;
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

}  // namespace
}  // namespace lockbox
