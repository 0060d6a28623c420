// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "urdf_test.hpp"

namespace lockbox {

/// What is said of the lengths and angles of a model.
class Units : public UrdfTest {
 protected:
  /// All warnings, a line each.
  std::string warnings_of(const std::string& body, double mesh_scale = 1.0) const {
    std::string warnings;
    load_robot(body, listening(warnings, mesh_scale));
    return warnings;
  }
  std::string warnings_of_mesh(const std::filesystem::path& file, double mesh_scale = 1.0) const {
    std::string warnings;
    load_kinematic_tree(file, listening(warnings, mesh_scale));
    return warnings;
  }
  std::string refusal_of(const std::string& body, double mesh_scale = 1.0) const {
    return message_of<InputError>([&] { warnings_of(body, mesh_scale); });
  }

  /// A tetrahedron that is so large, in numbers of the file.
  std::filesystem::path mesh_of(double size) const {
    const std::string x = std::to_string(size);
    return folder_.write("part.obj", "v 0 0 0\nv " + x + " 0 0\nv 0 " + x + " 0\nv 0 0 " + x +
                                         "\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  }
  static std::string mesh_link(const std::string& name, const std::string& scale = "") {
    const std::string attribute = scale.empty() ? "" : " scale=\"" + scale + "\"";
    return link(name, "<visual><geometry><mesh filename=\"part.obj\"" + attribute +
                          "/></geometry></visual>");
  }

 private:
  static LoadOptions listening(std::string& warnings, double mesh_scale) {
    LoadOptions options;
    options.on_warning = [&](const std::string& text) { warnings += text + "\n"; };
    options.mesh_scale = mesh_scale;
    return options;
  }
};

inline std::string limits(const std::string& lower, const std::string& upper) {
  return "<limit lower=\"" + lower + "\" upper=\"" + upper + "\"/>";
}

}  // namespace lockbox
