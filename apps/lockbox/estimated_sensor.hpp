// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "lockbox/capture/frame_source.hpp"
#include "lockbox/sensor/sensor_noise.hpp"

namespace lockbox::app {

/// The noise as the first frame that tells shows it, of the first ten. They are taken from the
/// source: a recording is to be opened anew. None, with a warning, if no frame tells.
std::optional<SensorNoise> noise_of_first_frames(FrameSource& source);

/// The noise as a sentence for people.
std::string noise_text(const SensorNoise& noise);

}  // namespace lockbox::app
