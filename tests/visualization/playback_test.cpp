// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/playback.hpp"

#include <gtest/gtest.h>

namespace lockbox {
namespace {

std::size_t after(Playback playback, const std::string& key) {
  EXPECT_TRUE(playback.handle(key));
  return playback.position();
}

TEST(Playback, StepsByKeysAndStaysWithinTheRecording) {
  const Playback middle(300, 150, true);
  EXPECT_EQ(after(middle, "Right"), 151U);
  EXPECT_EQ(after(middle, "Left"), 149U);
  EXPECT_EQ(after(middle, "Up"), 160U);
  EXPECT_EQ(after(middle, "Down"), 140U);
  EXPECT_EQ(after(middle, "Next"), 250U);
  EXPECT_EQ(after(middle, "Prior"), 50U);
  EXPECT_EQ(after(middle, "Home"), 0U);
  EXPECT_EQ(after(middle, "End"), 299U);
  EXPECT_EQ(after(Playback(300, 295, true), "Up"), 299U);
  EXPECT_EQ(after(Playback(300, 5, true), "Prior"), 0U);
}

TEST(Playback, PausesWhereTheUserSteps) {
  for (const auto* key : {"Right", "Left", "Up", "Down", "Next", "Prior", "Home"}) {
    Playback playback(300, 150, true);
    playback.handle(key);
    EXPECT_FALSE(playback.is_playing()) << key;
  }
}

TEST(Playback, TogglesWithSpaceAndBeginsAgainFromTheEnd) {
  Playback playback(3, 0, false);
  playback.handle("space");
  EXPECT_TRUE(playback.is_playing());
  playback.handle("space");
  EXPECT_FALSE(playback.is_playing());
  playback.handle("space");
  playback.advance();
  playback.advance();
  EXPECT_FALSE(playback.is_playing()) << "at the end";
  playback.advance();
  EXPECT_EQ(playback.position(), 2U);
  playback.handle("space");
  EXPECT_EQ(playback.position(), 0U);
  EXPECT_TRUE(playback.is_playing());
}

TEST(Playback, DoublesAndHalvesItsSpeedWithoutAPause) {
  Playback playback(300, 0, true);
  EXPECT_EQ(playback.speed(), 1.0);
  EXPECT_TRUE(playback.handle("plus"));
  EXPECT_EQ(playback.speed(), 2.0);
  playback.handle("minus");
  playback.handle("minus");
  EXPECT_EQ(playback.speed(), 0.5);
  for (int i = 0; i < 20; ++i) playback.handle("minus");
  EXPECT_GT(playback.speed(), 0.01) << "it would seem to stand still";
  EXPECT_TRUE(playback.is_playing());
  EXPECT_EQ(playback.position(), 0U);
}

TEST(Playback, SeeksAndPausesThere) {
  Playback playback(300, 0, true);
  playback.seek(200);
  EXPECT_EQ(playback.position(), 200U);
  EXPECT_FALSE(playback.is_playing());
  playback.seek(1000);
  EXPECT_EQ(playback.position(), 299U);
}

TEST(Playback, LeavesOtherKeysAlone) {
  Playback playback(3, 1, true);
  EXPECT_FALSE(playback.handle("e"));
  EXPECT_EQ(playback.position(), 1U);
  EXPECT_TRUE(playback.is_playing());
}

TEST(Playback, GoesBackIntoARecordingThatIsShorterThanItSaid) {
  Playback playback(300, 250, true);
  playback.shorten(100);
  EXPECT_EQ(playback.position(), 99U);
  EXPECT_TRUE(playback.is_at_end());
}

}  // namespace
}  // namespace lockbox
