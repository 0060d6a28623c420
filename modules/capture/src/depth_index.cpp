// SPDX-License-Identifier: BSD-3-Clause
#include "depth_index.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string_view>

#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/number_text.hpp"
#include "natural_order.hpp"
#include "stamps_in_seconds.hpp"

namespace lockbox {
namespace {

constexpr std::uintmax_t kMaximumIndexBytes = 1U << 30U;  // a week at 30 Hz

std::optional<DepthIndexEntry> parse_entry(std::string_view text, int line,
                                           const std::filesystem::path& folder) {
  const std::size_t space = text.find_first_of(" \t");
  const std::size_t name = text.find_first_not_of(" \t", space);
  const std::optional<double> stamp = parse_finite_number(text.substr(0, space));
  if (!stamp || name == std::string_view::npos) {
    return std::nullopt;
  }
  return DepthIndexEntry{*stamp, folder / text.substr(name), line};
}

std::vector<DepthIndexEntry> read_entries(const std::filesystem::path& file) {
  std::ifstream in;
  if (is_file(file)) in.open(file);  // to open a pipe would wait for who writes into it
  if (!in.is_open()) {
    throw InputError(file.string(), "no such file, or it cannot be read");
  }
  if (std::filesystem::file_size(file) > kMaximumIndexBytes) {
    throw InputError(file.string(), "has more than 1 GB: is it a list of images?");
  }
  std::vector<DepthIndexEntry> entries;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string::npos || text[first] == '#') {
      continue;
    }
    const std::size_t last = text.find_last_not_of(" \t\r");
    std::optional<DepthIndexEntry> entry = parse_entry(
        std::string_view(text).substr(first, last - first + 1), line, file.parent_path());
    if (entry) {
      entries.push_back(std::move(*entry));
    } else if (!in.eof()) {  // else the program that wrote it was ended in this line
      throw InputError(file.string(), line, "expected \"timestamp filename\"");
    }
  }
  if (entries.empty()) {
    throw InputError(file.string(), "lists no images");
  }
  return entries;
}

void convert_stamps(std::vector<DepthIndexEntry>& entries, const std::string& file,
                    const std::function<void(const std::string&)>& warn) {
  std::vector<double> stamps;
  stamps.reserve(entries.size());
  for (const DepthIndexEntry& entry : entries) {
    stamps.push_back(entry.stamp);
  }
  bring_to_seconds(stamps, file, warn);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i].stamp = stamps[i];
  }
}

/// If the names are in order, the stamps are to blame, not the order of the lines.
void sort_if_shuffled(std::vector<DepthIndexEntry>& entries, const std::string& file,
                      const std::function<void(const std::string&)>& warn) {
  const auto earlier = [](const DepthIndexEntry& a, const DepthIndexEntry& b) {
    return a.stamp < b.stamp;
  };
  const auto before = [](const DepthIndexEntry& a, const DepthIndexEntry& b) {
    return natural_less(a.image.string(), b.image.string());
  };
  const auto late = std::is_sorted_until(entries.begin(), entries.end(), earlier);
  if (late == entries.end() || std::is_sorted(entries.begin(), entries.end(), before)) {
    return;
  }
  if (warn) {
    warn(file + ": its lines are not in the order of their timestamps (first at " +
         late->image.filename().string() +
         "); the images are taken in the order of their timestamps");
  }
  std::stable_sort(entries.begin(), entries.end(), earlier);
}

}  // namespace

std::vector<DepthIndexEntry> read_depth_index(const std::filesystem::path& file,
                                              const std::function<void(const std::string&)>& warn) {
  std::vector<DepthIndexEntry> entries = read_entries(file);
  sort_if_shuffled(entries, file.string(), warn);
  convert_stamps(entries, file.string(), warn);
  return entries;
}

}  // namespace lockbox
