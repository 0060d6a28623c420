// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/view/view_options.hpp"

namespace lockbox {

/// What the terms that compare the model with the image are weighed by (docs/mathematics.md).
struct TermOptions : ViewOptions {
  /// The odds of the body that is predicted in a pixel against others as near. Source: a block that
  /// slides on a board, whose points held it back without (docs/mathematics.md).
  double visible_odds = 20.0;
  /// The weight of free space. 0: it is not looked at. Source: the demo's motion seen from 2.25 m:
  /// half and double of it change errors by 7 % at most, without it they are up to seven times as
  /// large.
  double lambda_free = 3.0;
};

enum class CollisionMode { off, literal, eroded };

/// What bodies that penetrate each other are weighed by.
struct CollisionOptions {
  /// Whether penetration costs, and of which surfaces. Source: docs/experiments.md, `intersection`.
  CollisionMode collision = CollisionMode::eroded;
  /// The weight of penetration against the data terms, whose pixels count by noise_correlation.
  /// Source: what counts is lambda_collision / collision_sigma^2: with it a hundredth of a surface
  /// that penetrates outweighs 20,000 pixels of 3 mm of noise nine times. Half and double of it
  /// change no figure of the demo's errors.
  double lambda_collision = 1000.0;
  /// What penetration is divided by. Unit: metres. Source: half of what distance fields resolve;
  /// half and double of it change no figure of the demo's errors.
  double collision_sigma = 1e-4;
  /// By so much bodies shrink before they can collide, unless the model or a pair says otherwise.
  /// Unit: metres. Source: the demo's motion seen from 2.25 m: half and double of it change no
  /// figure of the errors, without it flush contact costs, and the slider errs 3 % more.
  double erosion = 0.0015;
};

}  // namespace lockbox
