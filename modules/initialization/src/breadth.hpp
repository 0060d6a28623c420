// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "hypothesis.hpp"

namespace lockbox {

/// What the stages keep: before joints are known, a low score says little, and a large side of a
/// near box explains many pixels.
struct Breadth {
  std::size_t matches_each;  ///< of one template on one region
  Selection matched;         ///< as they are proposed
  Selection placed;          ///< whose bases are aligned, in the coarse view
  Selection posed;           ///< whose joints are aligned with them
  /// Of the poses, those that are improved by the drawing, too, before all but the best are left
  /// out.
  std::optional<Selection> improved;
  std::size_t likeliest;  ///< by their evidence: of the poses, those that are made exact
  bool is_close;          ///< for small things: scored in the finer view from the start
  bool follows_again;     ///< what was followed before in the same image
};

}  // namespace lockbox
