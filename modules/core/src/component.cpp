// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/component.hpp"

#include <dlfcn.h>

#include <regex>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

std::filesystem::path folder_of(const void* address_in_library) {
  Dl_info here{};
  ::dladdr(address_in_library, &here);
  return std::filesystem::weakly_canonical(here.dli_fname).parent_path();
}

/// Finds it in the nearest folder above the library that has one.
std::filesystem::path folder_above(const void* address_in_library,
                                   const std::filesystem::path& name) {
  std::filesystem::path folder = folder_of(address_in_library);
  for (; folder.has_relative_path(); folder = folder.parent_path()) {
    if (std::filesystem::is_directory(folder / name)) return folder / name;
  }
  return {};
}

}  // namespace

std::filesystem::path find_component(const std::string& name, const void* address_in_library) {
  const std::filesystem::path folder = folder_of(address_in_library);
  const std::filesystem::path beside = LOCKBOX_COMPONENT_FOLDER;
  for (const auto& place : {beside, "../lib" / beside}) {
    const std::filesystem::path candidate = folder / place / name;
    if (std::filesystem::exists(candidate)) {
      return candidate;
    }
  }
  throw InputError((folder / beside / name).string(),
                   "this component is missing; install lockbox completely");
}

std::filesystem::path share_folder(const void* address_in_library) {
  return folder_above(address_in_library, "share/lockbox");
}

std::filesystem::path documents_folder(const void* address_in_library) {
  return folder_above(address_in_library, "share/doc/lockbox/docs").parent_path();
}

std::string with_documents(const std::string& text, const void* address_in_library) {
  static const std::regex document("\\bdocs/[a-z/-]+\\.md");
  const std::filesystem::path folder = documents_folder(address_in_library);
  return folder.empty() ? text : std::regex_replace(text, document, folder.string() + "/$&");
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
