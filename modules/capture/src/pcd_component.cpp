// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_component.hpp"

#include "lockbox/core/component.hpp"
#include "lockbox/core/error.hpp"
#include "pcd_header.hpp"

namespace lockbox {
namespace {

constexpr char kHere = 0;  // its address is in this library

template <typename Function>
Function* find_function(const char* name) {
  static const auto component = find_component(kPcdComponent, &kHere);
  return reinterpret_cast<Function*>(find_symbol(component, name));
}

}  // namespace

void load_pcd(const std::filesystem::path& file, OrganizedCloud& cloud) {
  check_pcd(file);
  std::string problem;
  if (!find_function<LoadPcd>(kLoadPcd)(file, cloud, problem)) {
    throw InputError(file.string(), problem);
  }
}

void save_pcd(const std::filesystem::path& file, const OrganizedCloud& cloud) {
  std::string problem;
  if (!find_function<SavePcd>(kSavePcd)(file, cloud, problem)) {
    throw InputError(file.string(), problem);
  }
}

}  // namespace lockbox
