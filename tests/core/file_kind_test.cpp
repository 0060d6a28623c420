// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/file_kind.hpp"

#include <gtest/gtest.h>

#include <array>

#include "temporary_folder.hpp"

namespace lockbox {
namespace {

constexpr std::array kKinds{FileKind{"NI10", ".oni ", "a recording", "play it"},
                            FileKind{"", ".txt .yaml ", "a text", "read it"}};

const FileKind* kind_of(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  return find_kind(folder.write(name, bytes), kKinds);
}

TEST(FileKind, FirstBytesTellMoreThanTheName) {
  EXPECT_EQ(kind_of("kind.txt", "NI10\x01"), &kKinds[0]);
  EXPECT_EQ(kind_of("kind.oni", "no magic"), &kKinds[0]);
  EXPECT_EQ(kind_of("KIND.YAML", "a: 1"), &kKinds[1]);
}

TEST(FileKind, IsNoneOfTheseWhereNeitherTells) {
  EXPECT_EQ(kind_of("kind", "a: 1"), nullptr);
  EXPECT_EQ(kind_of("kind.tx", ""), nullptr);  // the whole extension counts
  EXPECT_EQ(find_kind("no_such_file.bin", kKinds), nullptr);
}

}  // namespace
}  // namespace lockbox
