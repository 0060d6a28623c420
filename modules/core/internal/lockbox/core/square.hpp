// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

constexpr double square(double x) {
  return x * x;
}

}  // namespace lockbox
