// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/simulation/deviation.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;

class DeviationFile : public ::testing::Test {
 protected:
  Deviation read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_deviation(file_);
  }

  /// What reading the text says; empty if it is accepted.
  std::string complaint(const std::string& text) const {
    try {
      read(text);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  void TearDown() override { std::filesystem::remove(file_); }

  std::filesystem::path file_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".yaml");
};

TEST_F(DeviationFile, EverythingThatItSaysIsReadAndWrittenAgain) {
  const Deviation deviation = read(R"(
seed: 7
object:
  scale: 1.01
  sizes: 0.002
  joint_origins: 0.003
  joint_axes: 0.0087
  added_parts: 3
  added_share: 0.15
  missing_handles: 1
  missing_parts: [door, drawer]
)");
  EXPECT_EQ(deviation.seed, 7U);
  EXPECT_EQ(deviation.object.scale, 1.01);
  EXPECT_EQ(deviation.object.sizes, 0.002);
  EXPECT_EQ(deviation.object.joint_origins, 0.003);
  EXPECT_EQ(deviation.object.joint_axes, 0.0087);
  EXPECT_EQ(deviation.object.added_parts, 3);
  EXPECT_EQ(deviation.object.added_share, 0.15);
  EXPECT_EQ(deviation.object.missing_handles, 1);
  EXPECT_THAT(deviation.object.missing_parts, ::testing::ElementsAre("door", "drawer"));
  const std::string text = deviation_text(deviation);
  EXPECT_EQ(deviation_text(read(text)), text);
}

TEST_F(DeviationFile, WhatItDoesNotSayDoesNotDeviate) {
  EXPECT_EQ(deviation_text(read("object: {}")), deviation_text(Deviation{}));
}

TEST_F(DeviationFile, WhatIsWrongIsRefusedWithFileAndKey) {
  EXPECT_THAT(complaint("objet: {}"), HasSubstr("'objet'"));
  EXPECT_THAT(complaint("objet: {}"), HasSubstr(file_.string()));
  EXPECT_THAT(complaint("seed: 1\nobject:\n  size: 0.1"), HasSubstr(":3"));
  EXPECT_THAT(complaint("object: {size: 0.1}"), HasSubstr("'size'"));
  EXPECT_THAT(complaint("object: {sizes: -0.1}"), HasSubstr("'sizes'"));
  EXPECT_THAT(complaint("object: {scale: 0}"), HasSubstr("'scale'"));
  EXPECT_THAT(complaint("object: {added_parts: 1.5}"), HasSubstr("'added_parts'"));
  EXPECT_THAT(complaint("object: {missing_parts: door}"), HasSubstr("'missing_parts'"));
  EXPECT_THAT(complaint("seed: -1"), HasSubstr("'seed'"));
  EXPECT_THAT(complaint("object: {scale: [1"), HasSubstr("is not YAML"));
}

}  // namespace
}  // namespace lockbox
