// SPDX-License-Identifier: BSD-3-Clause
#include "openni_session.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "field_of_view.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

double focal_length(int pixels, float angle) {
  const double focal = 0.5 * pixels / std::tan(0.5 * double{angle});
  double scale = 1.0;
  for (int decimals = 0; decimals <= 9; ++decimals, scale *= 10.0) {
    const double rounded = std::round(focal * scale) / scale;
    if (field_of_view(pixels, rounded) == angle) {
      return rounded;
    }
  }
  return focal;
}

bool is_plausible(float angle) {
  return angle >= kMinimumFieldOfView && angle <= kMaximumFieldOfView;
}

/// Whether what was recorded fits there, and is all there.
bool is_part_of_image(const openni::VideoFrameRef& frame, int left, int top,
                      const PinholeCamera& camera) {
  const openni::VideoMode& mode = frame.getVideoMode();
  const int width = frame.getWidth();
  const int height = frame.getHeight();
  const int row_bytes = width * static_cast<int>(sizeof(std::uint16_t));
  const bool is_whole = width == camera.width && height == camera.height;
  return mode.getResolutionX() == camera.width && mode.getResolutionY() == camera.height &&
         (is_whole || frame.getCroppingEnabled()) && left >= 0 && top >= 0 && width >= 1 &&
         height >= 1 && left <= camera.width - width && top <= camera.height - height &&
         frame.getStrideInBytes() >= row_bytes &&
         frame.getDataSize() >= frame.getStrideInBytes() * (height - 1) + row_bytes;
}

/// Users of OpenNI2's own archives have set this variable; builds use it, OpenNI2 does not read it.
std::string note_on_redist() {
  return std::getenv("OPENNI2_REDIST") == nullptr
             ? ""
             : " (OPENNI2_REDIST is set, but OpenNI2 loads no drivers from there)";
}

}  // namespace

void require_openni() {
  static const openni::Status status = openni::OpenNI::initialize();
  if (status != openni::STATUS_OK) {
    throw DeviceError("OpenNI2 does not start: " + openni_error() +
                      "; its drivers, lib*.so.0, or " + "links to them, must be in " +
                      driver_folder() + ": install Debian's libopenni2-0, and lockbox anew" +
                      note_on_redist());
  }
}

std::string driver_folder() {
  Dl_info library{};
  ::dladdr(reinterpret_cast<const void*>(&oniInitialize), &library);
  const std::filesystem::path file(library.dli_fname == nullptr ? "" : library.dli_fname);
  return (file.parent_path() / "OpenNI2" / "Drivers").lexically_normal().string();
}

std::string openni_error() {
  std::string text = openni::OpenNI::getExtendedError();
  std::replace_if(
      text.begin(), text.end(),
      [](char character) { return character == '\n' || character == '\t'; }, ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  text.erase(0, text.find_first_not_of(' '));
  return text.empty() ? "no reason given" : text;
}

float field_of_view(int pixels, double focal) {
  return static_cast<float>(2.0 * std::atan(0.5 * pixels / focal));
}

std::optional<FieldOfView> field_of_view(const openni::VideoStream& stream) {
  const FieldOfView angles{stream.getHorizontalFieldOfView(), stream.getVerticalFieldOfView()};
  const bool is_known = is_plausible(angles.horizontal) && is_plausible(angles.vertical);
  return is_known ? std::optional(angles) : std::nullopt;
}

PinholeCamera camera_of(const FieldOfView& angles, int width, int height) {
  return {width,
          height,
          focal_length(width, angles.horizontal),
          focal_length(height, angles.vertical),
          0.5 * (width - 1),
          0.5 * (height - 1)};
}

void copy_frame(const openni::VideoFrameRef& from, bool mirrored, const std::string& where,
                DepthFrame& to) {
  const PinholeCamera& camera = to.camera;
  const int width = from.getWidth();
  const bool is_cropped = from.getCroppingEnabled();
  const int left = is_cropped ? from.getCropOriginX() : 0;
  const int top = is_cropped ? from.getCropOriginY() : 0;
  if (!is_part_of_image(from, left, top, camera)) {
    throw DeviceError(where + ": OpenNI2 delivered frame " + std::to_string(from.getFrameIndex()) +
                      " in another size than that of its stream");
  }
  to.depth.assign(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height),
                  0);
  const auto* row = static_cast<const std::uint8_t*>(from.getData());
  for (int v = top; v < top + from.getHeight(); ++v, row += from.getStrideInBytes()) {
    const auto* pixels = reinterpret_cast<const std::uint16_t*>(row);
    const auto begin = to.depth.begin() + std::ptrdiff_t{v} * camera.width;
    if (mirrored) {
      std::reverse_copy(pixels, pixels + width, begin + (camera.width - left - width));
    } else {
      std::copy(pixels, pixels + width, begin + left);
    }
  }
  const bool tenths = from.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM;
  to.metres_per_unit = tenths ? 0.0001F : 0.001F;
  to.stamp = static_cast<double>(from.getTimestamp()) / 1e6;  // as text in seconds is read
}

bool wait_for_frame(openni::VideoStream& stream, int milliseconds) {
  openni::VideoStream* streams[] = {&stream};
  int ready = -1;
  return openni::OpenNI::waitForAnyStream(streams, 1, &ready, milliseconds) == openni::STATUS_OK;
}

}  // namespace lockbox
