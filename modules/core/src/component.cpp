// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/component.hpp"

#include <dlfcn.h>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

std::filesystem::path folder_of(const void* address_in_library) {
  Dl_info here{};
  ::dladdr(address_in_library, &here);
  return std::filesystem::weakly_canonical(here.dli_fname).parent_path();
}

}  // namespace

std::filesystem::path find_component(const std::string& name, const void* address_in_library) {
  const std::filesystem::path folder = folder_of(address_in_library);
  for (const char* const place : {"lockbox", "../lib/lockbox"}) {
    const std::filesystem::path candidate = folder / place / name;
    if (std::filesystem::exists(candidate)) {
      return candidate;
    }
  }
  throw InputError((folder / "lockbox" / name).string(),
                   "this component is missing; install lockbox completely");
}

std::filesystem::path share_folder(const void* address_in_library) {
  std::filesystem::path folder = folder_of(address_in_library);
  for (; folder.has_relative_path(); folder = folder.parent_path()) {
    const std::filesystem::path candidate = folder / "share" / "lockbox";
    if (std::filesystem::is_directory(candidate)) return candidate;
  }
  return {};
}

void* find_symbol(const std::filesystem::path& library, const std::string& symbol) {
  void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const address = handle != nullptr ? ::dlsym(handle, symbol.c_str()) : nullptr;
  if (address == nullptr) {
    throw InputError(library.string(),
                     std::string("this component cannot be loaded: ") + ::dlerror());
  }
  return address;
}

}  // namespace lockbox
