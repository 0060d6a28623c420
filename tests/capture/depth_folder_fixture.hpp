// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"

namespace lockbox {

/// A folder of depth images, as it is written and read.
class DepthFolder : public ::testing::Test {
 protected:
  void write(std::uint64_t count) {
    DepthFolderWriter writer(path());
    for (std::uint64_t number = 0; number < count; ++number) {
      writer.write(synthetic_frame(number));
    }
  }
  std::filesystem::path path() const { return folder_ / "sequence"; }
  static std::vector<std::string> warnings_of(const std::filesystem::path& folder,
                                              SourceOptions options = {}) {
    std::vector<std::string> warnings;
    options.warn = [&warnings](const std::string& text) { warnings.push_back(text); };
    DepthFolderSource source(folder, options);
    for (DepthFrame frame; source.next(frame);) {
    }
    return warnings;
  }
  void expect_refusal(const std::string& message) const {
    EXPECT_THAT(
        [this] {
          DepthFolderSource source(path());
          DepthFrame frame;
          while (source.next(frame)) {
          }
        },
        ::testing::ThrowsMessage<InputError>(::testing::HasSubstr(message)));
  }

  TemporaryFolder folder_;
};

}  // namespace lockbox
