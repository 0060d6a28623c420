// SPDX-License-Identifier: BSD-3-Clause
// The tree that the seeds of states files and of models' parameters are for.
#pragma once

#include "lockbox/model/articulated_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {

inline KinematicTree door_tree() {
  const TemporaryFolder folder;
  const auto link = [](const std::string& name, const std::string& shape) {
    return "<link name=\"" + name + "\"><visual><geometry>" + shape + "</geometry></visual></link>";
  };
  const std::string limits = "<limit lower=\"0\" upper=\"1.5\" effort=\"1\" velocity=\"1\"/>";
  return load_kinematic_tree(folder.write(
      "door.urdf", "<robot name=\"door\">" + link("frame", "<box size=\".3 .02 .4\"/>") +
                       link("leaf", "<box size=\".1 .1 .1\"/>") +
                       link("bolt", "<cylinder radius=\".02\" length=\".1\"/>") +
                       "<joint name=\"hinge\" type=\"revolute\"><parent link=\"frame\"/>"
                       "<child link=\"leaf\"/><axis xyz=\"0 0 1\"/>" +
                       limits +
                       "</joint><joint name=\"slide\" type=\"prismatic\"><parent link=\"leaf\"/>"
                       "<child link=\"bolt\"/><axis xyz=\"1 0 0\"/>" +
                       limits + "</joint></robot>"));
}

}  // namespace lockbox
