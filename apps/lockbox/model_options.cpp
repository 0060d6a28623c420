// SPDX-License-Identifier: BSD-3-Clause
#include "model_options.hpp"

#include <iostream>

#include "shipped_files.hpp"

namespace lockbox::app {

void ModelOptions::add_to(CLI::App& options) {
  add_model(options, "URDF file, bare .obj, .stl or .ply file, or the name of a shipped model")
      ->required();
}

void ModelOptions::add_optional_to(CLI::App& options, const std::string& help) {
  add_model(options, help);
}

CLI::Option* ModelOptions::add_model(CLI::App& options, const std::string& help) {
  CLI::Option* const model = options.add_option("-m,--model", model_, help)->type_name("FILE");
  options
      .add_option("--package-path", package_paths_,
                  "Folder to search for package:// meshes (repeatable), beside ROS_PACKAGE_PATH")
      ->type_name("DIR")
      ->default_str("");
  return model;
}

std::filesystem::path ModelOptions::file() const {
  return find_model(model_);
}

ArticulatedModel ModelOptions::load() const {
  return load_model(file(), load_options());
}

KinematicTree ModelOptions::load_tree() const {
  return load_kinematic_tree(file(), load_options());
}

LoadOptions ModelOptions::load_options() const {
  LoadOptions options;
  options.package_paths.assign(package_paths_.begin(), package_paths_.end());
  options.on_warning = [](const std::string& text) {
    std::cerr << "lockbox: warning: " << text << '\n';
  };
  return options;
}

}  // namespace lockbox::app
