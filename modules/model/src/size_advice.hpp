// SPDX-License-Identifier: BSD-3-Clause
// What is said of a visual whose size is absurd.
#pragma once

#include <string>

#include "visual_extent.hpp"

namespace lockbox {

/// What sizes are compared with, and how they can be mended.
struct SizeContext {
  double usual = 0.0;       ///< of the model's lengths, metres; see usual_length()
  double mesh_scale = 1.0;  ///< see LoadOptions
  bool is_bare = false;     ///< a mesh file: there is no URDF to mend
};

/// How large it is, the unit that it seems to be in, and what to write instead.
std::string advice_on_large(const VisualExtent& visual, const SizeContext& context);
std::string advice_on_small(const VisualExtent& visual, const SizeContext& context);

}  // namespace lockbox
