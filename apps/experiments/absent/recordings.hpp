// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace lockbox::app {

/// The recordings that a name stands for: itself, if it is a source, else what the folder of that
/// name holds (.oni files, folders with depth.txt, folders of .pcd files), in the order of their
/// names. Throws InputError if there is neither.
std::vector<std::string> recordings_in(const std::string& source_or_folder);

}  // namespace lockbox::app
