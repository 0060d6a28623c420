// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/free_form_object.hpp"

#include <sstream>

#include "free_form_kinds.hpp"
#include "lockbox/core/number_text.hpp"
#include "output_file.hpp"

namespace lockbox {
namespace {

void write_whole(const std::filesystem::path& path, const std::string& text) {
  OutputFile file(path);
  file.stream() << text;
  file.close();
}

std::string mesh_text(const TriangleMesh& mesh) {
  std::ostringstream out;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    out << "v " << number_text(p.x()) << ' ' << number_text(p.y()) << ' ' << number_text(p.z())
        << '\n';
  }
  for (const auto& t : mesh.triangles) {
    out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  return out.str();
}

std::string triple(const Eigen::Vector3d& v) {
  return number_text(v.x()) + ' ' + number_text(v.y()) + ' ' + number_text(v.z());
}

std::string description(const FreeFormObject& object) {
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?>\n<robot name=\"" << object.name << "\">\n";
  for (const FreeFormLink& link : object.links) {
    out << "  <link name=\"" << link.name << "\"><visual><geometry><mesh filename=\"" << link.name
        << ".obj\"/></geometry></visual></link>\n";
  }
  for (std::size_t i = 0; i < object.hinges.size(); ++i) {
    const FreeFormHinge& hinge = object.hinges[i];
    out << "  <joint name=\"hinge_" << i + 1 << "\" type=\"revolute\"><parent link=\""
        << object.links[i].name << "\"/><child link=\"" << object.links[i + 1].name
        << "\"/><origin xyz=\"" << triple(hinge.origin) << "\"/><axis xyz=\"" << triple(hinge.axis)
        << "\"/><limit lower=\"" << number_text(hinge.lower) << "\" upper=\""
        << number_text(hinge.upper) << "\" effort=\"1\" velocity=\"1\"/></joint>\n";
  }
  out << "</robot>\n";
  return out.str();
}

}  // namespace

FreeFormObject draw_free_form(const ObjectBlock& block, std::uint64_t number) {
  const auto kinds = block.is_for_tuning() ? evaluation::tuning_kinds() : evaluation::test_kinds();
  RandomDraws random = block.draws(ObjectBlock::Purpose::shape, number);
  return kinds[number % kinds.size()](random);
}

std::filesystem::path write_free_form(const FreeFormObject& object,
                                      const std::filesystem::path& folder) {
  for (const FreeFormLink& link : object.links) {
    write_whole(folder / (link.name + ".obj"), mesh_text(link.mesh));
  }
  const auto file = folder / (object.name + ".urdf");
  write_whole(file, description(object));
  return file;
}

}  // namespace lockbox
