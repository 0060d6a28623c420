// SPDX-License-Identifier: BSD-3-Clause
#include <iomanip>
#include <iostream>

#include "commands.hpp"
#include "counted.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/model/cache_folder.hpp"
#include "lockbox/sdf/field_cache.hpp"

namespace lockbox::app {
namespace {

double megabytes(std::uintmax_t bytes) {
  return 1e-6 * static_cast<double>(bytes);
}

class CacheCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    options.add_flag("--clear", clear_, "Delete all of it; what is needed is built again");
  }

  ExitStatus run() override {
    const std::filesystem::path folder = default_cache_folder();
    if (folder.empty()) {
      std::cout << "no distance fields are kept: neither XDG_CACHE_HOME nor HOME is an absolute "
                   "path\n";
      return ExitStatus::done;
    }
    const CachedFields before = cached_fields(folder);
    const CachedFields left = clear_ ? limit_fields(folder, 0) : before;
    if (clear_ && left.files > 0) {
      throw InputError(folder.string(), counted(left.files, "field") + " cannot be deleted");
    }
    std::cout << folder.string() << ": " << counted(before.files, "distance field") << ", "
              << std::fixed << std::setprecision(1) << megabytes(before.bytes) << " MB"
              << (clear_ ? ", deleted\n" : "");
    if (!clear_) {
      std::cout << "; up to " << std::setprecision(0) << megabytes(kMostCachedBytes)
                << " MB are kept\n";
    }
    return ExitStatus::done;
  }

 private:
  bool clear_ = false;
};

}  // namespace

std::unique_ptr<Command> make_cache_command() {
  return std::make_unique<CacheCommand>();
}

}  // namespace lockbox::app
