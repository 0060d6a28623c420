// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "lockbox/core/error.hpp"

namespace lockbox {

/// A YAML file of the running test, removed after it.
class WrittenFile : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    std::ofstream(file_) << text;
    return file_;
  }

  /// What reading the text says, by read(file); empty if it is accepted.
  template <typename Read>
  std::string complaint_of(const Read& read, const std::string& text) const {
    try {
      read(write(text));
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

}  // namespace lockbox
