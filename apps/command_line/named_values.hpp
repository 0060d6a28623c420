// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lockbox::app {

/// What run.yaml lists: names and values, in an order.
using NamedValues = std::vector<std::pair<std::string, std::string>>;

}  // namespace lockbox::app
