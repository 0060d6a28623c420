// SPDX-License-Identifier: BSD-3-Clause
// One box of 0.2 x 0.1 x 0.05 m in every format.
#pragma once

#include <string>

namespace lockbox {

std::string box_as_obj();
std::string box_as_text_stl();
std::string box_as_binary_stl();
std::string box_as_text_ply();
std::string box_as_binary_ply();

}  // namespace lockbox
