// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "tool.hpp"

namespace lockbox {

/// Writes one state of a rigid block, state.csv, and a recording of it, new/block.oni.
inline void simulate_block(const TemporaryFolder& folder) {
  write_text(folder / "state.csv", "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,0,0,1,0,0,0,1\n");
  const auto result = run_tool({"simulate", "--model", "rigid_block", "--trajectory",
                                folder / "state.csv", "--output", folder / "new/block.oni"});
  ASSERT_EQ(result.status, 0) << result.errors;
}

}  // namespace lockbox
