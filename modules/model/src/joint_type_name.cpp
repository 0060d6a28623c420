// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/joint_type_name.hpp"

namespace lockbox {

std::string type_name(JointType type) {
  switch (type) {
    case JointType::revolute:
      return "revolute";
    case JointType::continuous:
      return "continuous";
    case JointType::prismatic:
      return "prismatic";
  }
  return "";
}

}  // namespace lockbox
