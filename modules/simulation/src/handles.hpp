// SPDX-License-Identifier: BSD-3-Clause
// What one pulls a drawer or a door by.
#pragma once

#include <vector>

#include "lockbox/simulation/object_draft.hpp"
#include "range.hpp"

namespace lockbox::simulation {

enum class HandleKind {
  bar,    ///< square, on two posts
  knob,   ///< round, on a stem
  lip,    ///< a strip that stands out along an edge
  bow,    ///< round bar on two round posts
  cup,    ///< a solid shell
  recess  ///< a hole in the front, with a plate behind it
};

/// All of a piece of furniture are alike.
struct Handle {
  HandleKind kind;
  double length;     ///< metres, as far as the front has room for it
  double thickness;  ///< metres
  double reach;      ///< how far it stands out, metres
};

Handle draw_handle(HandleKind kind, RandomDraws& random);

/// A front of a drawer or a door, in the plane x, z; it reaches from y = 0 to -thickness.
struct Front {
  double left;
  double right;
  double bottom;
  double top;
  double thickness;
  int hinged = 0;  ///< a door's hinge: -1 on the left, 1 on the right; 0: a drawer

  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// The front and its handle: lying in the upper half of a drawer, upright beside the free edge of a
/// door.
std::vector<DraftPart> front_with_handle(const Front& front, const Handle& handle);

}  // namespace lockbox::simulation
