// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/collision_mode_name.hpp"

namespace lockbox {

std::string mode_name(CollisionMode mode) {
  switch (mode) {
    case CollisionMode::off:
      return "off";
    case CollisionMode::literal:
      return "literal";
    case CollisionMode::eroded:
      return "eroded";
  }
  return "";
}

}  // namespace lockbox
