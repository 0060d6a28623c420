// SPDX-License-Identifier: BSD-3-Clause
#include "simulation_record.hpp"

#include <yaml-cpp/yaml.h>

#include "command_line/version.hpp"
#include "command_line/whole_file.hpp"

namespace lockbox::app {

void write_simulation_record(const std::filesystem::path& file, const NamedValues& origin,
                             const std::filesystem::path& model, const NamedValues& options,
                             const Deviation& deviation) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  for (const auto& [name, value] : origin) out << YAML::Key << name << YAML::Value << value;
  out << YAML::Key << "lockbox" << YAML::Value << kVersion;
  out << YAML::Key << "model" << YAML::Value << std::filesystem::absolute(model).string();
  out << YAML::Key << "options" << YAML::Value << YAML::BeginMap;
  for (const auto& [name, value] : options) out << YAML::Key << name << YAML::Value << value;
  out << YAML::EndMap;
  out << YAML::Key << "deviation" << YAML::Value << YAML::Load(deviation_text(deviation));
  out << YAML::EndMap;
  write_whole_file(file, std::string(out.c_str()) + '\n');
}

}  // namespace lockbox::app
