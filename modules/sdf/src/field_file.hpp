// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a cached field: magic, version, key, length and checksum of the rest, then the
// fields of Storage in the machine's byte order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lockbox/sdf/signed_distance_field.hpp"

namespace lockbox {

/// Raise it whenever the layout, or what build_field makes of the same input, changes.
inline constexpr std::uint32_t kFieldFormat = 5;

std::string to_bytes(const SignedDistanceField::Storage& storage, std::uint64_t key);

/// Nothing unless the bytes are whole, of this format, and of this key.
std::optional<SignedDistanceField::Storage> from_bytes(const std::string& bytes, std::uint64_t key);

}  // namespace lockbox
