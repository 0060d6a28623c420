// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "lockbox/evaluation/free_form_object.hpp"

namespace lockbox::evaluation {

using DrawFreeForm = FreeFormObject (*)(RandomDraws&);

/// Returns the kinds to tune with: mug, animal, elbow, pliers.
std::span<const DrawFreeForm> tuning_kinds();
/// Returns the kinds of test blocks: bottle, can, tap, drill, hand, lamp.
std::span<const DrawFreeForm> test_kinds();

}  // namespace lockbox::evaluation
