// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "message_of.hpp"
#include "temporary_folder.hpp"

namespace lockbox {

/// Loads URDF text, given without <robot>.
class UrdfTest : public testing::Test {
 protected:
  KinematicTree load_robot(const std::string& body, const LoadOptions& options = {}) const {
    return load("<robot name=\"r\">\n" + body + "\n</robot>\n", options);
  }
  KinematicTree load(const std::string& text, const LoadOptions& options = {}) const {
    return load_kinematic_tree(folder_.write("model.urdf", text), options);
  }
  std::string refusal_of_robot(const std::string& body) const {
    return message_of<InputError>([&] { load_robot(body); });
  }
  std::string refusal(const std::string& text) const {
    return message_of<InputError>([&] { load(text); });
  }

  const TemporaryFolder folder_;
};

inline std::string link(const std::string& name, const std::string& content = "") {
  return "<link name=\"" + name + "\">" + content + "</link>\n";
}

inline std::string box(const std::string& size, const std::string& more = "") {
  return "<visual>" + more + "<geometry><box size=\"" + size + "\"/></geometry></visual>";
}

inline std::string joint(const std::string& name, const std::string& type,
                         const std::string& parent, const std::string& child,
                         const std::string& content = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + content + "</joint>\n";
}

inline const char* const kLimit = "<limit lower=\"-1\" upper=\"1\"/>";

}  // namespace lockbox
