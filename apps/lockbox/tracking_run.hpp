// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/command.hpp"
#include "lockbox/capture/frame_source.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/publishing/publisher.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "run_description.hpp"
#include "run_settings.hpp"

namespace lockbox::app {

/// Tracks all frames of the source, until its end, the frame limit, or a signal (Interruption);
/// then the files are complete, and the publisher is closed. The camera of the description is
/// filled in from the first frame.
ExitStatus track_source(FrameSource& source, Tracker& tracker, const ArticulatedModel& model,
                        RunDescription description, const RunSettings& settings,
                        Publisher& publisher);

}  // namespace lockbox::app
