// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lockbox/core/stop_request.hpp"
#include "lockbox/terms/low_prominence.hpp"

namespace lockbox {

/// Moves each variable whose part hardly stands out of the noise, or of which too little is
/// seen, to where over its whole range the likelihood of the image is highest. All else must be
/// known to a few millimetres. margins: of scan_joints(), in pixels of the finer view; kNotTold is
/// put where the image does not tell one position from others. Throws Stopped if that is requested.
void scan_by_image(LowProminence& low_prominence, const TiledCloud& cloud,
                   const std::vector<int>& variables, std::vector<double>& margins,
                   const StopRequest& stop_request, Configuration& configuration);

}  // namespace lockbox
