// SPDX-License-Identifier: BSD-3-Clause
// A program of somebody who builds with pkg-config: loads the model that it is given.
#include <cstdio>

#include "lockbox/model/articulated_model.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const lockbox::ArticulatedModel model = lockbox::load_model(argv[1]);
  std::printf("%s: %d joint variables\n", model.tree.name.c_str(), model.tree.variables());
  return 0;
}
