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

  /// Adds the options for commands that can do without a model, or find out by themselves which it
  /// is.
  void add_optional_to(CLI::App& options, const std::string& help);

  bool is_given() const { return !model_.empty(); }

  /// The model's file: as given, or shipped under that name.
  std::filesystem::path file() const;

  /// The model with its fields; warnings go to standard error.
  ArticulatedModel load() const;

  /// The model without fields.
  KinematicTree load_tree() const;

  /// How files that the model names are found.
  LoadOptions load_options() const;

 private:
  CLI::Option* add_model(CLI::App& options, const std::string& help);

  std::string model_;
  std::vector<std::string> package_paths_;
  double mesh_scale_ = 1.0;
};

}  // namespace lockbox::app
