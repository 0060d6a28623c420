// SPDX-License-Identifier: BSD-3-Clause
// Keeps libraries in memory that were to be unloaded: what only an unloaded graphics driver pointed
// to would be called a leak, of a module that has no name by which to suppress it.
#include <dlfcn.h>

extern "C" int dlclose(void* /*handle*/) noexcept {
  return 0;
}
