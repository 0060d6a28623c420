// SPDX-License-Identifier: BSD-3-Clause
// Who writes into a file or folder, and no one else meanwhile.
#pragma once

namespace lockbox {

/// Locks what the descriptor is open on, until the last copy of it is closed; a crash unlocks it,
/// too. False if another one has it locked, in this process or another. Where the file system knows
/// no locks, all are told that it is theirs.
bool lock_alone(int descriptor);

}  // namespace lockbox
