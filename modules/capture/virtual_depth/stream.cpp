// SPDX-License-Identifier: BSD-3-Clause
#include "stream.hpp"

#include <PS1080.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace lockbox::virtual_depth {
namespace {

// The encoder of recordings has a table entry for depths below this only.
constexpr int kMaximumDepth = 65535;

template <typename T>
OniStatus answer(const T& value, void* data, int* size) {
  if (*size < static_cast<int>(sizeof(T))) {
    return ONI_STATUS_BAD_PARAMETER;
  }
  std::memcpy(data, &value, sizeof(T));
  *size = static_cast<int>(sizeof(T));
  return ONI_STATUS_OK;
}

OniPixelFormat pixel_format_of(OniSensorType type, std::uint32_t unit) {
  switch (type) {
    case ONI_SENSOR_COLOR:
      return ONI_PIXEL_FORMAT_RGB888;
    case ONI_SENSOR_IR:
      return ONI_PIXEL_FORMAT_GRAY16;
    default:
      return unit == 1000 ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_DEPTH_100_UM;
  }
}

using Rgb = std::array<std::uint8_t, 3>;

Rgb colour_of(std::uint16_t depth) {
  return {static_cast<std::uint8_t>(depth >> 8), static_cast<std::uint8_t>(depth),
          static_cast<std::uint8_t>(depth >> 4)};
}

template <typename Pixel, typename Convert>
void fill_rows(std::span<const std::uint16_t> depth, int width, bool mirrored, void* image,
               Convert convert) {
  auto* row = static_cast<Pixel*>(image);
  for (auto from = depth.begin(); from != depth.end(); from += width, row += width) {
    std::transform(from, from + width, row, convert);
    if (mirrored) {
      std::reverse(row, row + width);
    }
  }
}

}  // namespace

OniVideoMode video_mode_of(OniSensorType type, const VirtualDepthMode& mode) {
  return {pixel_format_of(type, mode.unit), static_cast<int>(mode.width),
          static_cast<int>(mode.height), static_cast<int>(mode.frames_per_second)};
}

Stream::Stream(OniSensorType type, Feed& feed)
    : type_(type), feed_(feed), mode_(video_mode_of(type, feed.connection().modes().front())) {}

Stream::~Stream() {
  stop();
}

OniStatus Stream::start() {
  stop();
  feed_.connection().choose(mode_index_);
  feed_.add(*this);
  return ONI_STATUS_OK;
}

void Stream::stop() {
  feed_.remove(*this);
}

int Stream::pixel_bytes() const {
  return static_cast<int>(type_ == ONI_SENSOR_COLOR ? sizeof(Rgb) : sizeof(std::uint16_t));
}

int Stream::stride() const {
  return mode_.resolutionX * pixel_bytes();
}

int Stream::getRequiredFrameSize() {
  return stride() * mode_.resolutionY;
}

void Stream::fill(std::span<const std::uint16_t> depth, void* image) const {
  const int width = mode_.resolutionX;
  switch (type_) {
    case ONI_SENSOR_COLOR:
      return fill_rows<Rgb>(depth, width, mirrored_, image, colour_of);
    case ONI_SENSOR_IR:
      return fill_rows<std::uint16_t>(depth, width, mirrored_, image, [](std::uint16_t value) {
        return static_cast<std::uint16_t>(value >> 2);
      });
    default:
      return fill_rows<std::uint16_t>(depth, width, mirrored_, image,
                                      [](std::uint16_t value) { return value; });
  }
}

void Stream::fill_cropped(std::span<const std::uint16_t> depth, const OniCropping& cropping,
                          OniFrame& frame) {
  image_.resize(static_cast<std::size_t>(getRequiredFrameSize()));
  fill(depth, image_.data());
  const int row_bytes = cropping.width * pixel_bytes();
  auto* to = static_cast<char*>(frame.data);
  for (int row = 0; row < cropping.height; ++row, to += row_bytes) {
    const int from = (cropping.originY + row) * stride() + cropping.originX * pixel_bytes();
    std::memcpy(to, image_.data() + from, static_cast<std::size_t>(row_bytes));
  }
  frame.width = cropping.width;
  frame.height = cropping.height;
  frame.stride = row_bytes;
}

/// False if there is no such mode, or another one was begun with.
bool Stream::choose(const OniVideoMode& mode) {
  const auto& modes = feed_.connection().modes();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const OniVideoMode offered = video_mode_of(type_, modes[i]);
    if (std::memcmp(&offered, &mode, sizeof(mode)) != 0) continue;
    if (feed_.connection().is_chosen() && i != mode_index_) return false;
    mode_ = offered;
    mode_index_ = i;
    return true;
  }
  return false;
}

OniCropping Stream::cropping() {
  const std::lock_guard lock(mutex_);
  return cropping_;
}

void Stream::set_cropping(const OniCropping& cropping) {
  const bool is_inside = cropping.originX >= 0 && cropping.originY >= 0 && cropping.width > 0 &&
                         cropping.height > 0 &&
                         cropping.originX <= mode_.resolutionX - cropping.width &&
                         cropping.originY <= mode_.resolutionY - cropping.height;
  if (is_inside || cropping.enabled == FALSE) {
    const std::lock_guard lock(mutex_);
    cropping_ = cropping;
  }
}

void Stream::take(std::span<const std::uint16_t> depth, std::uint64_t timestamp) {
  OniFrame* const frame = getServices().acquireFrame();
  if (frame == nullptr) {
    return;
  }
  const OniCropping region = cropping();
  frame->croppingEnabled = region.enabled;
  frame->cropOriginX = region.enabled ? region.originX : 0;
  frame->cropOriginY = region.enabled ? region.originY : 0;
  if (region.enabled != FALSE) {
    fill_cropped(depth, region, *frame);
  } else {
    fill(depth, frame->data);
    frame->width = mode_.resolutionX;
    frame->height = mode_.resolutionY;
    frame->stride = stride();
  }
  frame->timestamp = timestamp;
  frame->dataSize = frame->stride * frame->height;
  frame->sensorType = type_;
  frame->frameIndex = ++frame_index_;
  frame->videoMode = mode_;
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

OniStatus Stream::getProperty(int id, void* data, int* size) {
  const VirtualDepthHeader& header = feed_.connection().header();
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return answer(mode_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return answer(header.horizontal_field_of_view, data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return answer(header.vertical_field_of_view, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return answer(kMaximumDepth, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return answer(0, data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return answer(stride(), data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return answer(OniBool{mirrored_ ? TRUE : FALSE}, data, size);
    case ONI_STREAM_PROPERTY_CROPPING:  // without an answer, recordings would replay no frames
      return answer(cropping(), data, size);
    case XN_STREAM_PROPERTY_HOLE_FILTER:
      return answer(0, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

/// The device is what it is: setting a property to its value succeeds, all else but the limit, the
/// mode, mirroring and cropping fails.
OniStatus Stream::setProperty(int id, const void* data, int size) {
  if (id == kVirtualDepthLimit && size == static_cast<int>(sizeof(int))) {
    int limit = 0;
    std::memcpy(&limit, data, sizeof(limit));
    feed_.set_limit(limit);
    return ONI_STATUS_OK;
  }
  if (id == ONI_STREAM_PROPERTY_MIRRORING && size == static_cast<int>(sizeof(OniBool))) {
    OniBool mirrored = FALSE;
    std::memcpy(&mirrored, data, sizeof(mirrored));
    mirrored_ = mirrored != FALSE;
  }
  if (id == ONI_STREAM_PROPERTY_VIDEO_MODE && size == static_cast<int>(sizeof(OniVideoMode))) {
    OniVideoMode asked{};
    std::memcpy(&asked, data, sizeof(asked));
    choose(asked);
  }
  if (id == ONI_STREAM_PROPERTY_CROPPING && size == static_cast<int>(sizeof(OniCropping))) {
    OniCropping asked{};
    std::memcpy(&asked, data, sizeof(asked));
    set_cropping(asked);
  }
  std::array<char, 64> value;
  int value_size = static_cast<int>(value.size());
  if (getProperty(id, value.data(), &value_size) != ONI_STATUS_OK || size != value_size ||
      std::memcmp(data, value.data(), static_cast<std::size_t>(size)) != 0) {
    return ONI_STATUS_NOT_SUPPORTED;
  }
  raisePropertyChanged(id, data, size);
  return ONI_STATUS_OK;
}

OniBool Stream::isPropertySupported(int id) {
  std::array<char, 64> value;
  int size = static_cast<int>(value.size());
  return getProperty(id, value.data(), &size) == ONI_STATUS_OK ? TRUE : FALSE;
}

}  // namespace lockbox::virtual_depth
