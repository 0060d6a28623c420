// SPDX-License-Identifier: BSD-3-Clause
#include "option_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "lockbox/core/error.hpp"
#include "lockbox/core/file_kind.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/parallel.hpp"
#include "nearest_name.hpp"

namespace lockbox::app {
namespace {

/// Recordings of other programs, videos, images, clouds, tables, archives.
constexpr std::array kFileKinds = {
    ".avi",  ".bag",  ".csv",  ".db3", ".exr",  ".gif",  ".gz",   ".h5",  ".hdf5", ".jpeg", ".jpg",
    ".json", ".klg",  ".las",  ".m4v", ".mcap", ".mkv",  ".mov",  ".mp4", ".npy",  ".npz",  ".obj",
    ".oni",  ".pcap", ".pcd",  ".pgm", ".ply",  ".png",  ".ppm",  ".rrf", ".stl",  ".svo",  ".tar",
    ".tgz",  ".tif",  ".tiff", ".tum", ".txt",  ".urdf", ".webm", ".xyz", ".yaml", ".yml",  ".zip"};

bool names_a_file(const std::string& text) {
  return std::find(kFileKinds.begin(), kFileKinds.end(), lower_extension(text)) != kFileKinds.end();
}

std::string problem_as_folder(const std::string& text) {
  if (text == "-")
    return "'-', standard output, cannot hold a folder; for one of that name say ./-";
  if (!names_a_file(text)) return "";
  return in_quotes(text) +
         " is the name of a file; what is not a recording (.oni) is written into a folder (end its "
         "name with / if it is one)";
}

CLI::Validator ends_in(const std::string& extension, const std::string& kind) {
  return {[=](std::string& text) -> std::string {
            return std::filesystem::path(text).extension() == extension
                       ? ""
                       : in_quotes(text) + " does not end in " + extension + ", as " + kind + " do";
          },
          ""};
}

// Validators keep the names that they know in their own name, which CLI11 shows nowhere.
constexpr char kChoices[] = "choices";
constexpr char kSuggestions[] = "suggestions";

std::string name_with(const std::string& kind, const std::vector<std::string>& names) {
  std::string kept = kind;
  for (const auto& name : names) kept.append(" ").append(name);
  return kept;
}

std::vector<std::string> names_kept(CLI::Option& option, const std::string& kind) {
  std::vector<std::string> names;
  try {
    for (int i = 0;; ++i) {
      std::istringstream kept(option.get_validator(i)->get_name());
      std::string word;
      if (!(kept >> word) || word != kind) continue;
      while (kept >> word) names.push_back(word);
    }
  } catch (const CLI::OptionNotFound&) {  // there are no more validators
  }
  return names;
}

}  // namespace

CLI::Validator positive() {
  return {[](std::string& text) -> std::string {
            const auto value = parse_number(text);
            return value && *value > 0.0 ? "" : in_quotes(text) + " is not a positive number";
          },
          "POSITIVE"};
}

CLI::Validator not_negative() {
  return {[](std::string& text) -> std::string {
            const auto value = parse_number(text);
            return value && *value >= 0.0 ? "" : in_quotes(text) + " is neither 0 nor positive";
          },
          "NONNEGATIVE"};
}

CLI::Validator whole_number() {
  return {[](std::string& text) -> std::string {
            const auto value = parse_number(text);
            constexpr double kMost = 2e9;  // what the number is kept in ends there
            const bool is_whole = value && std::floor(*value) == *value && std::abs(*value) < kMost;
            if (is_whole) text = std::to_string(static_cast<long>(*value));
            return is_whole ? "" : in_quotes(text) + " is not a whole number below 2e9";
          },
          "INT"};
}

CLI::Validator between(double least, double most) {
  const std::string limits = fixed_number_text(least) + " and " + fixed_number_text(most);
  return {[=](std::string& text) -> std::string {
            const auto value = parse_number(text);
            return value && *value >= least && *value <= most
                       ? ""
                       : in_quotes(text) + " is not a number between " + limits;
          },
          ""};
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  return {[=](std::string& text) -> std::string {
            if (std::find(names.begin(), names.end(), text) != names.end()) return "";
            std::string list;
            for (const auto& name : names) list.append(list.empty() ? "" : ", ").append(name);
            return in_quotes(text) + " is none of " + list + did_you_mean(text, names);
          },
          "", name_with(kChoices, names)};
}

CLI::Validator suggested(const std::vector<std::string>& names) {
  return {[](std::string&) { return std::string(); }, "", name_with(kSuggestions, names)};
}

CLI::Validator readable(const std::function<void(const std::string&)>& read) {
  return {[read](std::string& text) -> std::string {
            try {
              read(text);
              return "";
            } catch (const InputError& error) {
              return error.what();
            }
          },
          ""};
}

std::vector<std::string> choices_of(CLI::Option& option) {
  return names_kept(option, kChoices);
}

std::vector<std::string> suggestions_of(CLI::Option& option) {
  std::vector<std::string> names = choices_of(option);
  for (const auto& name : names_kept(option, kSuggestions)) names.push_back(name);
  return names;
}

CLI::Validator picture_name() {
  return ends_in(".png", "pictures");
}

CLI::Validator video_name() {
  return {[](std::string& text) -> std::string {
            const std::string extension = lower_extension(text);
            return extension == ".mp4" || extension == ".mkv"
                       ? ""
                       : in_quotes(text) + " does not end in .mp4 or .mkv, as videos do";
          },
          ""};
}

CLI::Validator table_name() {
  return ends_in(".csv", "tables");
}

CLI::Validator recording_name() {
  return ends_in(".oni", "recordings");
}

CLI::Validator folder_name() {
  return {[](std::string& text) { return problem_as_folder(text); }, ""};
}

CLI::Validator recording_or_folder_name() {
  return {[](std::string& text) {
            return std::filesystem::path(text).extension() == ".oni" ? std::string()
                                                                     : problem_as_folder(text);
          },
          ""};
}

void add_threads_option(CLI::App& options, int& threads) {
  const auto held_to_machine = [](std::string& text) -> std::string {
    const auto value = parse_number(text);
    constexpr double kMost = 1e6;  // more than any machine has, and still a number of threads
    if (value && *value >= 1.0) {
      text = std::to_string(Executor(static_cast<int>(std::min(*value, kMost))).threads());
    }
    return "";
  };
  options.add_option("--threads", threads, "Threads; 0: all cores; at most four a core are taken")
      ->transform(CLI::Validator(held_to_machine, ""))
      ->check(not_negative())
      ->check(whole_number());
}

void add_overwrite_option(CLI::App& options, bool& overwrite) {
  options.add_flag("--overwrite", overwrite, "Replace what exists under the names of the output");
}

}  // namespace lockbox::app
