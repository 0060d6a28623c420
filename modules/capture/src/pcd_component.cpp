// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_component.hpp"

#include <dlfcn.h>

#include "components.hpp"
#include "lockbox/core/error.hpp"
#include "pcd_header.hpp"

namespace lockbox {
namespace {

/// The component stays loaded: unloading VTK's static objects is asking for trouble.
template <typename Function>
Function* find_function(const char* name) {
  const std::string library = find_component(kPcdComponent).string();
  void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const function = handle != nullptr ? ::dlsym(handle, name) : nullptr;
  if (function == nullptr) {
    throw DeviceError(std::string("PCL's .pcd files cannot be used: ") + ::dlerror());
  }
  return reinterpret_cast<Function*>(function);
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
