// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "lockbox/terms/term_options.hpp"

namespace lockbox {

/// The word that `--collision` has for it.
std::string mode_name(CollisionMode mode);

}  // namespace lockbox
