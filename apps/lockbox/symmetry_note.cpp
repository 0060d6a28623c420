// SPDX-License-Identifier: BSD-3-Clause
#include "symmetry_note.hpp"

namespace lockbox::app {

std::string symmetry_text(const KinematicTree& tree, const EqualPoses& equal) {
  std::string turns;
  for (const auto& turn : equal.turns()) turns.append(turns.empty() ? "" : ", ").append(turn);
  return std::string(tree.variables() > 0 ? "with its joints at rest, " : "") +
         "the model looks the same turned by " + turns +
         (equal.turns().size() == 1 ? " (axis" : " (axes") + " of its base, through its middle)";
}

}  // namespace lockbox::app
