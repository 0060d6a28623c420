// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox::app {

/// The options that name a model, shared by the subcommands.
class ModelOptions {
 public:
  void add_to(CLI::App& options);

  /// The model's file: as given, or shipped under that name.
  std::filesystem::path file() const;

  /// The model with its fields; warnings go to standard error.
  ArticulatedModel load() const;

  /// The model without fields.
  KinematicTree load_tree() const;

 private:
  LoadOptions load_options() const;

  std::string model_;
  std::vector<std::string> package_paths_;
};

}  // namespace lockbox::app
