// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "lockbox/core/error.hpp"
#include "temporary_folder.hpp"

namespace lockbox {

/// A YAML file of the running test.
class WrittenFile : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    return folder_.write("written.yaml", text);
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

  const TemporaryFolder folder_;
};

}  // namespace lockbox
