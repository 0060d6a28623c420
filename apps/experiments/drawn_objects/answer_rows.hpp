// SPDX-License-Identifier: BSD-3-Clause
// What rows of `lockbox experiment furniture`, `boards` and `shapes` have in common.
#pragma once

#include <string>

#include "lockbox/evaluation/table.hpp"

namespace lockbox::app {

/// Whether it was called `tracking`.
bool is_trusted(const Table& table, const Row& row);

/// One line: what is wrong with the piece, of which `what` tells more.
void print_wrong(const Table& table, const Row& row, const std::string& what);

}  // namespace lockbox::app
