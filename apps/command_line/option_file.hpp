// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <istream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lockbox::app {

/// The file that `--config` names. It remembers which options have their values from it, so that
/// messages can say so.
class OptionFile : public CLI::ConfigBase {
 public:
  /// `options` are those that the file may set; they must outlive this.
  explicit OptionFile(const CLI::App& options) : options_(options) {}

  /// Called by CLI11 when it has read the command line, whose values win. Throws InputError if the
  /// file is no text.
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;

  /// Throws CLI::ConversionError unless the line gives one value.
  std::string to_flag(const CLI::ConfigItem& item) const override;

  /// What is wrong with a key, after "FILE:LINE: ", or "FILE: " where it stands in no line.
  std::string problem(const CLI::ConfigError& error) const;

  /// "FILE:LINE" of the first option in what CLI11 complains of that has its value from the file.
  std::optional<std::string> place_of_option_in(const std::string& problem) const;

  /// "FILE:LINE" of a value from the file that the message of an InputError speaks of.
  std::optional<std::string> place_of_value_in(const std::string& message) const;

 private:
  std::string place_of_key(const std::string& key) const;
  std::optional<std::string> place_of(const CLI::Option& option) const;

  const CLI::App& options_;
  // CLI11 reads through a constant reader.
  mutable std::map<std::string, int> lines_;    // of keys, where each stands first
  mutable std::set<const CLI::Option*> given_;  // whose values are from the file
};

}  // namespace lockbox::app
