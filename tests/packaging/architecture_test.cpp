// SPDX-License-Identifier: BSD-3-Clause
// Compares every #include under modules/ and apps/ with the tables of docs/architecture.md, public
// headers with the lists in CMakeLists.txt, and finds tests that would write where another does.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Room {
  std::set<std::string> may_use;
  std::set<std::string> libraries;
};

struct Architecture {
  std::map<std::string, Room> rooms;
  std::map<std::string, std::string> library_of_prefix;
};

const fs::path kRoot = LOCKBOX_SOURCE_DIR;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    const auto begin = part.find_first_not_of(" -");
    const auto end = part.find_last_not_of(' ');
    if (begin != std::string::npos) parts.push_back(part.substr(begin, end - begin + 1));
  }
  return parts;
}

std::set<std::string> names(const std::string& cell) {
  const auto parts = split(cell, ',');
  return {parts.begin(), parts.end()};
}

/// Cells of a row `| a | b |`; the empty first part is left out.
std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> result;
  std::stringstream stream(row.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) result.push_back(cell);
  return result;
}

Architecture read_architecture() {
  Architecture architecture;
  std::ifstream file(kRoot / "docs" / "architecture.md");
  std::string table;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("|")) {
      table.clear();
      continue;
    }
    const auto row = cells(line);
    const std::string first = split(row.at(0), ',').empty() ? "" : split(row.at(0), ',').front();
    if (table.empty()) {
      table = first;
    } else if (table == "module" && !first.empty()) {
      architecture.rooms[first] = {names(row.at(2)), names(row.at(3))};
    } else if (table == "library" && !first.empty()) {
      for (const auto& prefix : names(row.at(1))) architecture.library_of_prefix[prefix] = first;
    }
  }
  return architecture;
}

struct Include {
  fs::path file;
  int line;
  std::string room;
  std::string header;
};

std::vector<Include> includes_below(const fs::path& folder, const std::string& room) {
  static const std::regex directive(R"(\s*#\s*include\s*[<"]([^>"]+)[>"].*)");
  std::vector<Include> includes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".hpp" && extension != ".cpp" && extension != ".h") continue;
    std::ifstream file(entry.path());
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      std::smatch match;
      if (std::regex_match(line, match, directive)) {
        includes.push_back({fs::relative(entry.path(), kRoot), number, room, match[1]});
      }
    }
  }
  return includes;
}

/// Folders with sources of their own: `core`, `apps/lockbox`.
std::map<std::string, fs::path> all_rooms() {
  std::map<std::string, fs::path> rooms;
  for (const auto& entry : fs::directory_iterator(kRoot / "modules")) {
    rooms[entry.path().filename().string()] = entry.path();
  }
  for (const auto& entry : fs::directory_iterator(kRoot / "apps")) {
    if (entry.is_directory()) rooms["apps/" + entry.path().filename().string()] = entry.path();
  }
  return rooms;
}

std::vector<Include> all_includes() {
  std::vector<Include> includes;
  for (const auto& [room, folder] : all_rooms()) {
    const auto more = includes_below(folder, room);
    includes.insert(includes.end(), more.begin(), more.end());
  }
  return includes;
}

/// Whether it is there, or made when configuring.
bool is_source(const fs::path& file) {
  return fs::exists(file) || fs::exists(file.string() + ".in");
}

/// The room of a header of the project, "" for others. Programs name each other's headers by their
/// folder, `command_line/progress.hpp`, or relative to their own.
std::string room_of(const Include& include) {
  if (include.header.starts_with("lockbox/")) return split(include.header, '/').at(1);
  for (const fs::path& folder : {include.file.parent_path(), fs::path("apps")}) {
    const fs::path file = (folder / include.header).lexically_normal();
    if (!is_source(kRoot / file)) continue;
    const auto parts = split(file.string(), '/');
    return parts.front() == "apps" ? "apps/" + parts.at(1) : parts.at(1);
  }
  return fs::exists(kRoot / "modules" / include.room / "src" / include.header) ? include.room : "";
}

/// The third-party library of a header, "" for the standard library, POSIX and own headers.
std::string library_of(const Architecture& architecture, const std::string& header) {
  for (const auto& [prefix, library] : architecture.library_of_prefix) {
    if (header.starts_with(prefix)) return library;
  }
  return "";
}

bool is_of_the_platform(const std::string& header) {
  static const std::regex standard("[a-z_0-9]+");
  static const std::set<std::string> posix = {"dirent.h", "dlfcn.h",   "errno.h",   "fcntl.h",
                                              "poll.h",   "pthread.h", "signal.h",  "spawn.h",
                                              "stdio.h",  "stdlib.h",  "termios.h", "unistd.h"};
  return std::regex_match(header, standard) || posix.contains(header) ||
         header.starts_with("sys/") || header.starts_with("linux/");
}

std::string place(const Include& include) {
  return include.file.string() + ":" + std::to_string(include.line) + " includes " + include.header;
}

TEST(Architecture, HasARowForEveryModuleAndProgram) {
  const auto architecture = read_architecture();
  for (const auto& [room, folder] : all_rooms()) {
    EXPECT_TRUE(architecture.rooms.contains(room)) << folder;
  }
}

TEST(Architecture, DependenciesFormNoCycle) {
  auto rooms = read_architecture().rooms;
  ASSERT_FALSE(rooms.empty());
  for (bool removed = true; removed;) {
    removed = false;
    for (auto room = rooms.begin(); room != rooms.end(); ++room) {
      const auto& uses = room->second.may_use;
      if (std::none_of(uses.begin(), uses.end(), [&](auto& use) { return rooms.contains(use); })) {
        rooms.erase(room);
        removed = true;
        break;
      }
    }
  }
  EXPECT_TRUE(rooms.empty()) << rooms.begin()->first << " is part of a cycle";
}

TEST(Architecture, ModulesUseOnlyWhatTheTableAllows) {
  const auto architecture = read_architecture();
  for (const auto& include : all_includes()) {
    const std::string used = room_of(include);
    EXPECT_TRUE(used.empty() || used == include.room ||
                architecture.rooms.at(include.room).may_use.contains(used))
        << place(include) << ", which " << include.room << " may not use";
  }
}

/// What nobody uses is not allowed: the table says how things are.
TEST(Architecture, WhatTheTableAllowsIsUsed) {
  const auto architecture = read_architecture();
  std::map<std::string, Room> used;
  for (const auto& include : all_includes()) {
    used[include.room].may_use.insert(room_of(include));
    used[include.room].libraries.insert(library_of(architecture, include.header));
  }
  for (const auto& [name, allowed] : architecture.rooms) {
    for (const std::string& room : allowed.may_use) {
      EXPECT_TRUE(used[name].may_use.contains(room)) << name << " uses nothing of " << room;
    }
    for (const std::string& library : allowed.libraries) {
      EXPECT_TRUE(used[name].libraries.contains(library)) << name << " uses nothing of " << library;
    }
  }
}

TEST(Architecture, ThirdPartyHeadersStayInTheirRooms) {
  const auto architecture = read_architecture();
  for (const auto& include : all_includes()) {
    const auto library = library_of(architecture, include.header);
    if (library.empty()) continue;
    EXPECT_TRUE(architecture.rooms.at(include.room).libraries.contains(library))
        << place(include) << " of " << library << ", which is not for " << include.room;
  }
}

TEST(Architecture, EveryHeaderIsOwnOrKnown) {
  const auto architecture = read_architecture();
  for (const auto& include : all_includes()) {
    EXPECT_TRUE(!room_of(include).empty() || is_of_the_platform(include.header) ||
                !library_of(architecture, include.header).empty())
        << place(include) << ", which no table of docs/architecture.md names";
  }
}

TEST(Tests, KeepTheirFilesInTemporaryFolders) {
  static const std::regex shared_place(R"(.*(TempDir|temp_directory_path|mkdtemp|tmpnam)\s*\(.*)");
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests")) {
    const auto extension = entry.path().extension();
    if (extension != ".hpp" && extension != ".cpp") continue;
    if (entry.path().filename() == "temporary_folder.hpp") continue;
    std::ifstream file(entry.path());
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      EXPECT_FALSE(std::regex_match(line, shared_place))
          << entry.path().string() << ':' << number << " uses what is shared by tests that run at "
          << "once; take a TemporaryFolder of tests/temporary_folder.hpp";
    }
  }
}

}  // namespace
