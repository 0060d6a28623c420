// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace lockbox::simulation {

/// Rows of an image that a thread takes at a time.
inline constexpr std::size_t kRowsAtOnce = 16;

}  // namespace lockbox::simulation
