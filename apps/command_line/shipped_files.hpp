// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lockbox::app {

/// The file itself if it exists, else the shipped model of that name: `lockbox` stands for
/// share/lockbox/models/lockbox/lockbox.urdf. Throws InputError that lists the shipped ones.
std::filesystem::path find_model(const std::string& file_or_name);

/// The names of the shipped models, and of the shipped scenes.
std::vector<std::string> shipped_models();
std::vector<std::string> shipped_scenes();

/// Finds a scene likewise: `room` stands for share/lockbox/scenes/room.yaml.
std::filesystem::path find_scene(const std::string& file_or_name);

/// A shipped file by its name below share/lockbox. Throws InputError if it is missing.
std::filesystem::path shipped_file(const std::string& name);

/// The folder with README.md and docs/; empty if none is installed.
std::filesystem::path shipped_documents();

}  // namespace lockbox::app
