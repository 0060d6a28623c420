// SPDX-License-Identifier: BSD-3-Clause
#include "components.hpp"

#include <dlfcn.h>

#include "lockbox/core/error.hpp"

namespace lockbox {

std::filesystem::path find_component(const std::string& name) {
  Dl_info here{};
  ::dladdr(reinterpret_cast<void*>(&find_component), &here);
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(here.dli_fname).parent_path();
  for (const char* const place : {"lockbox", "../lib/lockbox"}) {
    const std::filesystem::path candidate = folder / place / name;
    if (std::filesystem::exists(candidate)) {
      return candidate;
    }
  }
  throw DeviceError("the component " + name + " is missing beside " + folder.string() +
                    "; install lockbox completely");
}

}  // namespace lockbox
