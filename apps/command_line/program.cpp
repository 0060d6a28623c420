// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>

namespace lockbox::app {
namespace {

/// Nobody has read what a full disk has swallowed. That a pipe was closed, its signal tells.
ExitStatus require_output(ExitStatus status) {
  if (std::cout.flush() || status == ExitStatus::pipe_closed) return status;
  return fail(ExitStatus::invalid_input, "standard output cannot be written; is the disk full?");
}

}  // namespace

int run_program(int argc, char** argv, ExitStatus (*run)(const std::vector<std::string>&)) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // whoever reads a pipe sees each line at once
  return static_cast<int>(require_output(run({argv + std::min(argc, 1), argv + argc})));
}

ExitStatus fail(ExitStatus status, const std::string& message) {
  std::cerr << "lockbox: " << message << '\n';
  return status;
}

}  // namespace lockbox::app
