// SPDX-License-Identifier: BSD-3-Clause
// `lockbox-experiment NAME ...`, which `lockbox experiment NAME ...` becomes.
#include "command_line/program.hpp"
#include "command_line/run_command.hpp"
#include "experiment_command.hpp"

namespace lockbox::app {
namespace {

ExitStatus run(const std::vector<std::string>& arguments) {
  return run_command(*find_command("experiment"), make_experiment_command(), arguments);
}

}  // namespace
}  // namespace lockbox::app

int main(int argc, char** argv) {
  return lockbox::app::run_program(argc, argv, lockbox::app::run);
}
