// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

/// Pixels along a side: more is a typing error, or a damaged header that would ask for 32 GB.
inline constexpr int kMaximumImageSize = 16384;

}  // namespace lockbox
