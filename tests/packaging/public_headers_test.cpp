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

/// Own headers that a file includes by their full names.
Names own_includes(const fs::path& path) {
  static const std::regex directive(R"(#include "(lockbox/[^"]+)\")");
  const std::string text = content(path);
  Names headers;
  for (std::sregex_iterator match(text.begin(), text.end(), directive), end; match != end;
       ++match) {
    headers.insert((*match)[1]);
  }
  return headers;
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
        const std::string owner = std::next(fs::path(header).begin())->string();
        if (owner == user || !fs::exists(kModules / owner / "internal" / header)) continue;
        EXPECT_TRUE(listed(owner, "INTERNAL_HEADERS_FOR").contains(user))
            << entry.path() << " includes " << header;
      }
    }
  }
}

}  // namespace
