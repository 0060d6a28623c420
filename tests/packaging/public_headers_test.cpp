// SPDX-License-Identifier: BSD-3-Clause
// The narrow face of the modules: which headers are installed, and what they bring with them.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// Headers that are installed, at most. What is public stays so for years: lower it when there are
/// fewer, and make a header internal rather than raise it.
constexpr std::size_t kMostPublicHeaders = 59;

/// Headers of this project that who includes the tracker includes, at most, itself not counted.
constexpr std::size_t kMostHeadersOfTracker = 14;

const fs::path kModules = fs::path(LOCKBOX_SOURCE_DIR) / "modules";

std::string content(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

Names words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

Names modules() {
  Names names;
  for (const auto& folder : fs::directory_iterator(kModules)) {
    names.insert(folder.path().filename().string());
  }
  return names;
}

/// What follows a keyword in a module's call of lockbox_add_module, up to the next keyword.
Names listed(const std::string& module, const std::string& keyword) {
  static const std::regex last(R"(\s(INTERNAL_HEADERS_FOR|SOURCES)\s)");
  const std::string text = content(kModules / module / "CMakeLists.txt");
  const auto begin = text.find(keyword + " ");
  if (begin == std::string::npos) return {};
  const std::string rest = text.substr(begin + keyword.size());
  std::smatch end;
  EXPECT_TRUE(std::regex_search(rest, end, last)) << module;
  return words(rest.substr(0, static_cast<std::size_t>(end.position())));
}

/// Headers below a folder, as they are included.
Names headers_below(const fs::path& folder) {
  Names headers;
  if (!fs::exists(folder)) return headers;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) headers.insert(fs::relative(entry.path(), folder).string());
  }
  return headers;
}

/// Headers that a text includes as the project's: `<lockbox/...>`, and all that are in quotes.
Names own_includes_of(const std::string& text) {
  static const std::regex directive(R"((?:^|\n)\s*#\s*include\s*(?:"|<(?=lockbox/))([^">]+)[">])");
  Names headers;
  for (std::sregex_iterator match(text.begin(), text.end(), directive), end; match != end;
       ++match) {
    headers.insert((*match)[1]);
  }
  return headers;
}

Names own_includes(const fs::path& path) {
  return own_includes_of(content(path));
}

/// Where an included header is that is not public, below `modules`: `solver/internal/lockbox/...`;
/// empty for others.
fs::path hidden_header(const fs::path& includer, const std::string& header) {
  const fs::path beside = (includer.parent_path() / header).lexically_normal();
  if (fs::exists(beside)) {
    const fs::path place = fs::relative(beside, kModules);
    return *std::next(place.begin()) == "include" ? fs::path() : place;
  }
  if (!header.starts_with("lockbox/")) return {};
  const fs::path internal = *std::next(fs::path(header).begin()) / fs::path("internal") / header;
  return fs::exists(kModules / internal) ? internal : fs::path();
}

/// The file of every public header, by how it is included.
std::map<std::string, fs::path> public_headers() {
  std::map<std::string, fs::path> headers;
  for (const std::string& module : modules()) {
    for (const std::string& header : headers_below(kModules / module / "include")) {
      headers[header] = kModules / module / "include" / header;
    }
  }
  return headers;
}

TEST(PublicHeaders, AreListedByName) {
  for (const std::string& module : modules()) {
    Names expected;
    for (const std::string& name : listed(module, "PUBLIC_HEADERS")) {
      expected.insert((fs::path("lockbox") / module / name).lexically_normal().string());
    }
    EXPECT_EQ(headers_below(kModules / module / "include"), expected) << module;
  }
}

TEST(PublicHeaders, AreSeenHoweverTheyAreIncluded) {
  const std::string text =
      "#pragma once\n#include <vector>\n#include \"lockbox/a/b.hpp\"\n  # include "
      "<lockbox/c/d.hpp>\n"
      "#include \"beside.hpp\"\n// #include \"lockbox/e/comment.hpp\"\n#include "
      "<pcl/point_types.h>\n";
  EXPECT_EQ(own_includes_of(text), Names({"lockbox/a/b.hpp", "lockbox/c/d.hpp", "beside.hpp"}));
}

/// A header beside one that is public may not be: it is included by its full name, or not at all.
TEST(PublicHeaders, IncludeNoInternalOnes) {
  const auto headers = public_headers();
  ASSERT_FALSE(headers.empty());
  for (const auto& [name, path] : headers) {
    for (const std::string& included : own_includes(path)) {
      EXPECT_TRUE(headers.contains(included)) << name << " includes " << included;
    }
  }
}

TEST(PublicHeaders, AreFew) {
  EXPECT_LE(public_headers().size(), kMostPublicHeaders);
}

TEST(PublicHeaders, TrackerBringsFewOthers) {
  const auto headers = public_headers();
  Names seen;
  Names next{"lockbox/tracking/tracker.hpp"};
  while (!next.empty()) {
    const std::string header = next.extract(next.begin()).value();
    ASSERT_TRUE(headers.contains(header)) << header;
    seen.insert(header);
    for (const std::string& included : own_includes(headers.at(header))) {
      if (!seen.contains(included)) next.insert(included);
    }
  }
  EXPECT_LE(seen.size() - 1, kMostHeadersOfTracker) << testing::PrintToString(seen);
}

TEST(InternalHeaders, AreForTheModulesThatAreNamed) {
  for (const std::string& user : modules()) {
    for (const auto& entry : fs::recursive_directory_iterator(kModules / user)) {
      if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
      for (const std::string& header : own_includes(entry.path())) {
        const fs::path hidden = hidden_header(entry.path(), header);
        if (hidden.empty() || *hidden.begin() == user) continue;
        EXPECT_EQ(*std::next(hidden.begin()), "internal")
            << entry.path() << " includes " << header << ", which is of another module alone";
        EXPECT_TRUE(listed(*hidden.begin(), "INTERNAL_HEADERS_FOR").contains(user))
            << entry.path() << " includes " << header;
      }
    }
  }
}

}  // namespace
