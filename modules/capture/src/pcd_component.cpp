// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_component.hpp"

#include "lockbox/core/component.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

constexpr char kHere = 0;  // its address is in this library

template <typename Function>
Function* find_function(const char* name) {
  static const auto component = find_component(kPcdComponent, &kHere);
  return reinterpret_cast<Function*>(find_symbol(component, name));
}

}  // namespace

bool decompress_lzf(const std::vector<char>& packed, std::vector<char>& data) {
  return find_function<DecompressLzf>(kDecompressLzf)(packed.data(), packed.size() - kLzfPadding,
                                                      data);
}

void save_pcd(const std::filesystem::path& file, const OrganizedCloud& cloud) {
  std::string problem;
  if (!find_function<SavePcd>(kSavePcd)(file, cloud, problem)) {
    throw InputError(file.string(), problem);
  }
}

}  // namespace lockbox
