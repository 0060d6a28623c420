// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/capture/oni_validator.hpp"

namespace lockbox {

/// What is wrong with a payload that the decoder would trip over, or nothing. The buffer is reused.
std::optional<std::string> find_damage(std::ifstream& file, const OniPayload& payload,
                                       std::vector<std::uint8_t>& buffer);

}  // namespace lockbox
