// SPDX-License-Identifier: BSD-3-Clause
#include "urdf_variant.hpp"

#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "lockbox/core/error.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox::app {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

template <typename T>
void shuffle(std::vector<T>& values, RandomDraws& random) {
  for (std::size_t i = values.size(); i > 1; --i) {
    const auto other = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i)));
    std::swap(values[i - 1], values[other]);
  }
}

void reorder_children(XMLElement& robot, RandomDraws& random) {
  std::vector<XMLElement*> children;
  for (auto* child = robot.FirstChildElement(); child; child = child->NextSiblingElement()) {
    children.push_back(child);
  }
  shuffle(children, random);
  for (XMLElement* child : children) robot.InsertEndChild(child);  // moves it
}

void rename_links(XMLElement& robot, RandomDraws& random) {
  std::vector<XMLElement*> links;
  for (auto* link = robot.FirstChildElement("link"); link;
       link = link->NextSiblingElement("link")) {
    links.push_back(link);
  }
  shuffle(links, random);
  std::map<std::string, std::string> names;
  for (std::size_t i = 0; i < links.size(); ++i) {
    std::string& name = names[links[i]->Attribute("name")];
    name = "part_" + std::to_string(i);
    links[i]->SetAttribute("name", name.c_str());
  }
  for (auto* joint = robot.FirstChildElement("joint"); joint;
       joint = joint->NextSiblingElement("joint")) {
    for (const char* end : {"parent", "child"}) {
      XMLElement* reference = joint->FirstChildElement(end);
      reference->SetAttribute("link", names.at(reference->Attribute("link")).c_str());
    }
  }
}

/// Meshes beside the original are found from the copy, too.
void make_paths_absolute(XMLElement& element, const fs::path& folder) {
  const char* file = element.Attribute("filename");
  if (file != nullptr && std::string(file).find("://") == std::string::npos) {
    element.SetAttribute("filename", fs::absolute(folder / file).c_str());
  }
  for (auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
    make_paths_absolute(*child, folder);
  }
}

}  // namespace

void write_urdf_variant(const fs::path& urdf, const fs::path& copy, bool rename, std::uint64_t seed,
                        std::uint64_t number) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(urdf.c_str()) != tinyxml2::XML_SUCCESS ||
      document.RootElement() == nullptr) {
    throw InputError(urdf.string(), std::string("is no URDF: ") + document.ErrorStr());
  }
  RandomDraws random(seed, number);
  XMLElement& robot = *document.RootElement();
  if (rename) rename_links(robot, random);
  reorder_children(robot, random);
  make_paths_absolute(robot, urdf.parent_path());
  fs::create_directories(copy.parent_path());
  if (document.SaveFile(copy.c_str()) != tinyxml2::XML_SUCCESS) {
    throw InputError(copy.string(), "cannot be written");
  }
  const fs::path parameters = fs::path(urdf).replace_extension(".yaml");
  if (fs::exists(parameters)) {
    fs::copy_file(parameters, fs::path(copy).replace_extension(".yaml"),
                  fs::copy_options::overwrite_existing);
  }
}

}  // namespace lockbox::app
