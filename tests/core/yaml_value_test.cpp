// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/yaml_value.hpp"

#include <gmock/gmock.h>

#include "lockbox/core/error.hpp"
#include "lockbox/core/yaml_map.hpp"

namespace lockbox {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

YamlValue parsed(const std::string& text) {
  return YamlValue::parse("a.yaml", text);
}

TEST(YamlValue, GivesTheEntriesOfAMapInTheirOrder) {
  const auto entries = parsed("b: 1.5\na: [2, 3]\n").entries();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].first.text(), "b");
  EXPECT_EQ(entries[0].second.number(), 1.5);
  EXPECT_EQ(entries[1].first.text(), "a");
  EXPECT_EQ(entries[1].second.items(2)[1].number(), 3.0);
}

TEST(YamlValue, RefusesWithFileAndLine) {
  const auto refusal = [](const std::string& part) {
    return ThrowsMessage<InputError>(HasSubstr(part));
  };
  EXPECT_THAT([] { parsed("a: [1,\n"); }, refusal("a.yaml:2: is not YAML"));
  EXPECT_THAT([] { parsed("a: 1\na: 2\n").entries(); },
              refusal("a.yaml:2: the key 'a' stands there twice"));
  EXPECT_THAT([] { parsed("- 1\n- 2\n").entries(); }, refusal("a.yaml:1: a map"));
  EXPECT_THAT([] { parsed("\n[1, 2]\n").items(3); }, refusal("a.yaml:2: a list of 3"));
  EXPECT_THAT([] { parsed("inf").number(); }, refusal("'inf' is not a finite number"));
}

/// Of files that other programs may have written: nothing is refused.
TEST(YamlValue, NamesTheKeysOfAnyText) {
  EXPECT_THAT(parsed("a: 1\n[b]: 2\na: 3\n").plain_keys(), ElementsAre("a", "a"));
  EXPECT_THAT(parsed("- a: 1\n").plain_keys(), IsEmpty());
  EXPECT_THAT(parsed("").plain_keys(), IsEmpty());
}

TEST(YamlValue, FindsWhatIsThere) {
  const YamlValue value = parsed("a: 1\nb:\n");
  EXPECT_EQ(value.find("a").value().number(), 1.0);
  EXPECT_FALSE(value.find("b"));
  EXPECT_FALSE(value.find("c"));
  EXPECT_FALSE(parsed("[1]").find("a"));
}

TEST(YamlMap, RefusesUnknownKeysAndValuesOutOfRange) {
  EXPECT_THAT(
      [] {
        YamlMap(parsed("x: 1\n\ny: 2\n"), {"x", "z"});
      },
      ThrowsMessage<InputError>(HasSubstr("a.yaml:3: unknown key 'y'; known here: x, z")));
  const YamlMap map(parsed("x: 1\nz: yes\n"), {"x", "z"});
  double x = 0.0;
  EXPECT_THAT(
      [&] {
        map.read("x", {2.0, 3.0, "must be from 2 to 3"}, x);
      },
      ThrowsMessage<InputError>(HasSubstr("a.yaml:1: 'x' must be from 2 to 3")));
  bool z = false;
  EXPECT_THAT([&] { map.read("z", z); },
              ThrowsMessage<InputError>(HasSubstr("a.yaml:2: 'z' must be true or false")));
}

}  // namespace
}  // namespace lockbox
