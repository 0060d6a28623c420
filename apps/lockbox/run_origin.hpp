// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/named_values.hpp"

namespace lockbox::app {

/// How, where and when the program was started: `command` as a shell would read it, `folder` that
/// relative names begin in, `started` (ISO 8601 with the offset of the time zone), `host`.
NamedValues run_origin();

}  // namespace lockbox::app
