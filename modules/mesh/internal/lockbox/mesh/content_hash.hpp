// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// FNV-1a, 64 bits (Fowler, Noll, Vo), for recognising content; no defence against forgery.
class ContentHash {
 public:
  void add(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) {
      value_ = (value_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001B3ULL;
    }
  }
  /// Adds a number. The sign of a zero does not count.
  void add(double value) {
    const double unsigned_zero = value + 0.0;
    add(std::as_bytes(std::span(&unsigned_zero, 1)));
  }
  void add(std::uint64_t value) { add(std::as_bytes(std::span(&value, 1))); }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

/// The hash as 16 hexadecimal digits, for names of files.
std::string hash_text(std::uint64_t hash);

/// Returns the hash of the vertices' coordinates and the triangles, in their order.
std::uint64_t content_hash(const TriangleMesh& mesh);

}  // namespace lockbox
