// SPDX-License-Identifier: BSD-3-Clause
// Signals that end a run: noted, so that loops, searches and waiting sources can end early and
// leave complete files.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace lockbox::app {

/// While it lives, the first SIGHUP, SIGINT, SIGPIPE or SIGTERM is only noted. The next one ends
/// the process at once, as usual; but for SIGPIPE, which comes with every line that nobody reads.
/// What whoever started the program has told it to ignore (nohup) stays ignored; but for SIGINT,
/// which shells ignore for everything in the background. At most one lives at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  bool requested() const;

 private:
  static constexpr std::size_t kSignals = 4;
  std::array<void (*)(int), kSignals> before_{};
};

namespace interruption {

/// Whether such a signal was noted, by any Interruption. For any thread, at any time.
bool requested() noexcept;

/// Its number, 0 if there was none.
int signal_number() noexcept;

/// Its name, such as "SIGINT".
std::string signal_name();

}  // namespace interruption
}  // namespace lockbox::app
