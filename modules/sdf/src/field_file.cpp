// SPDX-License-Identifier: BSD-3-Clause
#include "field_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <type_traits>

#include "lockbox/mesh/content_hash.hpp"

namespace lockbox {
namespace {

using Storage = SignedDistanceField::Storage;

struct Header {
  char magic[8] = {'L', 'B', 'X', 'F', 'I', 'E', 'L', 'D'};
  std::uint32_t format = kFieldFormat;
  std::uint32_t header_bytes = sizeof(Header);
  std::uint64_t key = 0;
  std::uint64_t payload_bytes = 0;
  std::uint64_t checksum = 0;

  bool operator==(const Header&) const = default;
};
static_assert(std::has_unique_object_representations_v<Header>, "no padding reaches the file");

Header header_for(std::span<const char> payload, std::uint64_t key) {
  ContentHash hash;
  hash.add(std::as_bytes(payload));
  Header header;
  header.key = key;
  header.payload_bytes = payload.size();
  header.checksum = hash.value();
  return header;
}

/// Appends plain values.
class Writer {
 public:
  template <typename T>
  void operator()(const T& value) {
    static_assert(std::is_arithmetic_v<std::remove_all_extents_t<T>>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename T>
  void operator()(const std::vector<T>& values) {
    (*this)(std::uint64_t{values.size()});
    bytes_.append(reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size());
  }
  void operator()(const Eigen::Vector3d& p) {
    bytes_.append(reinterpret_cast<const char*>(p.data()), 3 * sizeof(double));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Takes the same values in the same order; after a failure all that follows is left as it is.
class Reader {
 public:
  explicit Reader(std::span<const char> bytes) : rest_(bytes) {}

  template <typename T>
  void operator()(T& value) {
    static_assert(std::is_arithmetic_v<std::remove_all_extents_t<T>>);
    take(&value, sizeof value);
  }
  template <typename T>
  void operator()(std::vector<T>& values) {
    std::uint64_t count = 0;
    (*this)(count);
    is_good_ = is_good_ && count <= rest_.size() / sizeof(T);
    if (is_good_) {
      values.resize(count);
      take(values.data(), sizeof(T) * values.size());
    }
  }
  void operator()(Eigen::Vector3d& p) { take(p.data(), 3 * sizeof(double)); }

  bool is_complete() const { return is_good_ && rest_.empty(); }

 private:
  void take(void* to, std::size_t size) {
    is_good_ = is_good_ && size <= rest_.size();
    if (is_good_ && size > 0) {
      std::memcpy(to, rest_.data(), size);
      rest_ = rest_.subspan(size);
    }
  }

  std::span<const char> rest_;
  bool is_good_ = true;
};

/// One list of what a file holds, for both directions.
template <typename Visitor, typename AnyStorage>
void visit_all(Visitor& visit, AnyStorage& storage) {
  auto& grid = storage.grid;
  visit(grid.fine_origin);
  visit(grid.fine_voxel);
  visit(grid.fine_scale);
  visit(grid.blocks);
  visit(grid.coarse_origin);
  visit(grid.coarse_voxel);
  visit(grid.coarse_scale);
  visit(grid.coarse_size);
  visit(storage.bounds.min());
  visit(storage.bounds.max());
  visit(storage.mesh_volume);
  visit(storage.thickness);
  visit(storage.block_first);
  visit(storage.samples);
}

/// Whether no look-up can leave the arrays.
bool is_consistent(const Storage& storage) {
  const auto product = [](const std::int32_t(&size)[3]) {
    return static_cast<double>(size[0]) * size[1] * size[2];
  };
  const auto all_at_least = [](const std::int32_t(&size)[3], std::int32_t least) {
    return std::all_of(size, size + 3, [&](std::int32_t n) { return n >= least; });
  };
  const FieldView& grid = storage.grid;
  const double coarse = product(grid.coarse_size);
  const auto samples = static_cast<double>(storage.samples.size());
  return all_at_least(grid.blocks, 1) && all_at_least(grid.coarse_size, 2) &&
         grid.fine_voxel > 0.0F && grid.coarse_voxel > 0.0F &&
         product(grid.blocks) == static_cast<double>(storage.block_first.size()) &&
         coarse < samples &&
         std::all_of(storage.block_first.begin(), storage.block_first.end(),
                     [&](std::int32_t first) {
                       return first == -1 || (first >= coarse && first + kBlockVolume < samples);
                     });
}

}  // namespace

std::string to_bytes(const Storage& storage, std::uint64_t key) {
  Writer writer;
  visit_all(writer, storage);
  const std::string payload = writer.take();
  const Header header = header_for(payload, key);
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  return bytes += payload;
}

std::optional<Storage> from_bytes(const std::string& bytes, std::uint64_t key) {
  if (bytes.size() < sizeof(Header)) {
    return std::nullopt;
  }
  const std::span<const char> payload = std::span(bytes).subspan(sizeof(Header));
  Header header;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header != header_for(payload, key)) {
    return std::nullopt;
  }
  Storage storage;
  Reader reader(payload);
  visit_all(reader, storage);
  if (!reader.is_complete() || !is_consistent(storage)) {
    return std::nullopt;
  }
  return storage;
}

}  // namespace lockbox
