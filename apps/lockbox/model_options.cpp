// SPDX-License-Identifier: BSD-3-Clause
#include "model_options.hpp"

#include <iostream>

#include "command_line/option_checks.hpp"
#include "command_line/shipped_files.hpp"

namespace lockbox::app {

void ModelOptions::add_to(CLI::App& options) {
  add_model(options, "URDF file, bare .obj, .stl or .ply file, or the name of a shipped model")
      ->required();
}

void ModelOptions::add_optional_to(CLI::App& options, const std::string& help) {
  add_model(options, help);
}

CLI::Option* ModelOptions::add_model(CLI::App& options, const std::string& help) {
  CLI::Option* const model = options.add_option("-m,--model", model_, help)
                                 ->check(suggested(shipped_models()))
                                 ->type_name("FILE");
  options
      .add_option("--package-path", package_paths_,
                  "Folder to search for package:// meshes (repeatable), beside ROS_PACKAGE_PATH "
                  "and AMENT_PREFIX_PATH")
      ->type_name("DIR")
      ->default_str("");
  options
      .add_option("--mesh-scale", mesh_scale_,
                  "Metres a unit of the model's mesh files: 0.001 if they are in millimetres")
      ->check(positive())
      ->type_name("FACTOR")
      ->default_str("1");
  return model;
}

std::filesystem::path ModelOptions::file() const {
  const bool may_be_shipped = model_.find_first_of("/.") == std::string::npos;
  if (std::filesystem::is_directory(model_) && !may_be_shipped) return model_;  // refused by name
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
  options.mesh_scale = mesh_scale_;
  options.on_warning = [](const std::string& text) {
    std::cerr << "lockbox: warning: " << text << '\n';
  };
  return options;
}

}  // namespace lockbox::app
