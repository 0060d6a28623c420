// SPDX-License-Identifier: BSD-3-Clause
// What the sources on OpenNI2 share. Only sources of this module include it.
#pragma once

#include <OpenNI.h>

#include <optional>
#include <string>

#include "lockbox/core/depth_frame.hpp"

namespace lockbox {

/// Starts OpenNI2 on the first call in the process; later calls do nothing. It stays started until
/// the process ends: stopping waits up to half a second for the USB drivers' threads, and starting
/// again reloads all drivers. Throws DeviceError.
void require_openni();

/// The folder from which OpenNI2 loads drivers: beside its library, as it was loaded.
std::string driver_folder();

/// Text of OpenNI2's last error, for a message.
std::string openni_error();

/// The angles that a stream sees across and down, radians, as OpenNI2 keeps them.
struct FieldOfView {
  float horizontal = 0.0F;
  float vertical = 0.0F;
};

/// Nothing if the stream does not know its field of view. A recording may be asked only before it
/// is started: where it begins again, the player's thread frees and writes its properties, without
/// a lock, while they are read.
std::optional<FieldOfView> field_of_view(const openni::VideoStream& stream);

/// The camera of images of this size. The focal length is the shortest decimal that has this field
/// of view, so that focal lengths written by this library with up to four decimals come back
/// exactly.
PinholeCamera camera_of(const FieldOfView& angles, int width, int height);

/// The field of view of `pixels` pixels at focal length `focal` (pixels), as OpenNI2 keeps it.
float field_of_view(int pixels, double focal);

/// Copies depth, unit and stamp, flipping columns if mirrored; leaves camera and index alone. What
/// a cropped frame leaves out of the camera's image has no measurement. Throws DeviceError if the
/// frame is not a whole depth image of the camera's size, or a part of one; it begins with where,
/// the name of the device or recording.
void copy_frame(const openni::VideoFrameRef& from, bool mirrored, const std::string& where,
                DepthFrame& to);

/// Waits at most milliseconds for a frame: a plain readFrame() waits for ever if a device stalls.
/// Waits below 500 ms on a recording would poke its player twice and lose a frame.
bool wait_for_frame(openni::VideoStream& stream, int milliseconds);

}  // namespace lockbox
