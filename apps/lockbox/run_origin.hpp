// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lockbox::app {

using NamedValues = std::vector<std::pair<std::string, std::string>>;

/// How, where and when the program was started: `command` as a shell would read it, `folder` that
/// relative names begin in, `started` (ISO 8601 with the offset of the time zone), `host`.
NamedValues run_origin();

}  // namespace lockbox::app
