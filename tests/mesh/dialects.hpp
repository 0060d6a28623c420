// SPDX-License-Identifier: BSD-3-Clause
// Files as different programs write them, all of a box of 0.2 x 0.1 x 0.05 m.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/mesh/load_mesh.hpp"
#include "lockbox/mesh/mesh_audit.hpp"
#include "temporary_folder.hpp"

namespace lockbox {

/// With every occurrence replaced.
inline std::string all_replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

inline void expect_box(const std::string& name, const std::string& content, double volume = 0.001) {
  TemporaryFolder folder;
  try {
    const MeshAudit report = audit(load_mesh(folder.write(name, content)));
    EXPECT_TRUE(report.is_closed());
    EXPECT_EQ(report.non_manifold_edges, 0U);
    EXPECT_NEAR(report.volume, volume, 1e-9);
  } catch (const InputError& error) {
    ADD_FAILURE() << error.what();
  }
}

}  // namespace lockbox
