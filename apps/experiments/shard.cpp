// SPDX-License-Identifier: BSD-3-Clause
#include "shard.hpp"

#include <CLI/Error.hpp>
#include <algorithm>
#include <charconv>

namespace lockbox::app {

void Shard::add_to(CLI::App& options) {
  options
      .add_option_function<std::string>(
          "--shard", [this](const std::string& text) { parse(text); },
          "Only the i-th of n parts of the runs; rows of all parts in the folder are summed up")
      ->type_name("I/N");
}

void Shard::parse(const std::string& text) {
  const auto slash = text.find('/');
  const auto parse_number = [&](std::size_t begin, std::size_t end, std::uint64_t& value) {
    const auto result = std::from_chars(text.data() + begin, text.data() + end, value);
    return result.ec == std::errc() && result.ptr == text.data() + end;
  };
  const bool valid = slash != std::string::npos && parse_number(0, slash, index_) &&
                     parse_number(slash + 1, text.size(), count_) && index_ >= 1 &&
                     index_ <= count_;
  if (!valid) {
    throw CLI::ValidationError("--shard", "'" + text + "' is no shard; write i/n, from 1/n to n/n");
  }
}

std::filesystem::path Shard::rows_file(const std::filesystem::path& stem) const {
  std::string name = stem.string();
  if (count_ > 1) name += "_shard" + std::to_string(index_) + "of" + std::to_string(count_);
  return name + ".csv";
}

Table continued_table(const std::filesystem::path& file, const std::vector<std::string>& columns) {
  return std::filesystem::exists(file) ? read_table(file, columns) : Table(columns);
}

std::vector<std::filesystem::path> rows_files(const std::filesystem::path& stem) {
  std::vector<std::filesystem::path> files;
  const std::string start = stem.filename().string();
  for (const auto& entry : std::filesystem::directory_iterator(stem.parent_path())) {
    const std::string name = entry.path().filename().string();
    const bool ours = name == start + ".csv" || name.rfind(start + "_shard", 0) == 0;
    if (ours && entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace lockbox::app
