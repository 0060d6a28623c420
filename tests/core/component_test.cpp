// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/component.hpp"

#include <gmock/gmock.h>

#include "lockbox/core/error.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr char kHere = 0;

TEST(FindComponent, NamesWhatIsMissingAndWhere) {
  EXPECT_THAT([] { find_component("libno_such_component.so", &kHere); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("/libno_such_component.so"),
                                              HasSubstr("install lockbox completely"))));
}

TEST(Documents, AreNamedWhereTheyAre) {
  const std::filesystem::path folder = documents_folder(&kHere);
  ASSERT_FALSE(folder.empty()) << "the build folder has them, too";
  EXPECT_TRUE(std::filesystem::is_regular_file(folder / "docs/sensors.md"));
  EXPECT_EQ(with_documents("see docs/how-to/live.md, or 'mydocs/a.md'", &kHere),
            "see " + folder.string() + "/docs/how-to/live.md, or 'mydocs/a.md'");
}

TEST(FindSymbol, SaysWhyALibraryCannotBeLoaded) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "no_library.so", "this is not a library, but a text that is long enough to be looked at");
  EXPECT_THAT(
      [&] { find_symbol(file, "anything"); },
      ThrowsMessage<InputError>(AllOf(HasSubstr(file.string()), HasSubstr("cannot be loaded"))));
}

}  // namespace
}  // namespace lockbox
