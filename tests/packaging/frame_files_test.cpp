// SPDX-License-Identifier: BSD-3-Clause
// The files that docs/architecture.md lists for who follows one frame: few, there, and each reached
// from one before it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 25;
const fs::path kSources = LOCKBOX_SOURCE_DIR;

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    found.push_back((*match)[1]);
  }
  return found;
}

std::vector<std::string> files_of_a_frame() {
  const std::string text = text_of_file(kSources / "docs" / "architecture.md");
  const std::size_t begin = text.find("## The files of a frame");
  EXPECT_NE(begin, std::string::npos);
  const std::size_t end = text.find("\n## ", begin + 1);
  return all_matches(text.substr(begin, end - begin), std::regex("\n[0-9]+\\. `([^`]+)`"));
}

/// The names, without folders, of headers that a file includes.
std::vector<std::string> included(const fs::path& path) {
  std::vector<std::string> names;
  for (const std::string& header :
       all_matches(text_of_file(path), std::regex("#include \"([^\"]+)\""))) {
    names.push_back(fs::path(header).filename().string());
  }
  return names;
}

/// The header of that name, if it is beside the source or one that others may include.
fs::path header_file(const fs::path& source, const std::string& name) {
  const fs::path module = source.parent_path().parent_path();
  for (const fs::path& folder :
       {source.parent_path(), module / "internal/lockbox" / module.filename(),
        module / "include/lockbox" / module.filename()}) {
    if (fs::exists(folder / name)) return folder / name;
  }
  return {};
}

TEST(FilesOfAFrame, AreFewAndThere) {
  const auto files = files_of_a_frame();
  EXPECT_GE(files.size(), 20U);
  EXPECT_LE(files.size(), kMostFiles);
  for (const std::string& file : files) EXPECT_TRUE(fs::exists(kSources / file)) << file;
}

TEST(FilesOfAFrame, AreReachedFromThoseBefore) {
  std::set<std::string> reached;  // headers that were opened, and those that these include
  for (const std::string& file : files_of_a_frame()) {
    const fs::path path = kSources / file;
    const auto headers = included(path);
    ASSERT_FALSE(headers.empty()) << file;
    // Sources begin with the header that declares what they define; headers are reached themselves.
    const std::string own = path.extension() == ".hpp" ? path.filename().string() : headers.front();
    EXPECT_TRUE(reached.empty() || reached.contains(own)) << file;
    for (const std::string& header : headers) {
      reached.insert(header);
      const fs::path opened = header_file(path, header);
      if (opened.empty()) continue;
      for (const std::string& further : included(opened)) reached.insert(further);
    }
  }
}

}  // namespace
