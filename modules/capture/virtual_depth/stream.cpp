// SPDX-License-Identifier: BSD-3-Clause
#include "stream.hpp"

#include <PS1080.h>

#include <array>
#include <chrono>
#include <cstring>
#include <limits>

namespace lockbox::virtual_depth {
namespace {

constexpr int kSlice = 20;  // milliseconds between looks at whether to stop
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

}  // namespace

OniVideoMode video_mode_of(const VirtualDepthHeader& header) {
  return {header.unit == 1000 ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_DEPTH_100_UM,
          static_cast<int>(header.width), static_cast<int>(header.height),
          static_cast<int>(header.frames_per_second)};
}

Stream::Stream(Connection& connection, std::function<void()> on_end)
    : connection_(connection),
      on_end_(std::move(on_end)),
      limit_(connection.header().hold != 0 ? 0 : std::numeric_limits<int>::max()) {}

Stream::~Stream() {
  stop();
}

OniStatus Stream::start() {
  stop();
  running_ = true;
  thread_ = std::thread([this] { run(); });
  return ONI_STATUS_OK;
}

void Stream::stop() {
  running_ = false;
  if (thread_.joinable()) {
    thread_.join();
  }
}

int Stream::getRequiredFrameSize() {
  return static_cast<int>(connection_.frame_bytes());
}

void Stream::run() {
  while (running_) {
    if (frame_index_ >= limit_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    const Connection::Wait state = connection_.wait(kSlice);
    if (state == Connection::Wait::closed || (state == Connection::Wait::ready && !raise_next())) {
      on_end_();
      return;
    }
  }
}

bool Stream::raise_next() {
  OniFrame* const frame = getServices().acquireFrame();
  if (frame == nullptr) {
    return false;
  }
  const bool complete = connection_.read_frame(frame->timestamp, frame->data);
  if (complete) {
    const OniVideoMode mode = video_mode_of(connection_.header());
    frame->dataSize = getRequiredFrameSize();
    frame->sensorType = ONI_SENSOR_DEPTH;
    frame->frameIndex = ++frame_index_;
    frame->width = mode.resolutionX;
    frame->height = mode.resolutionY;
    frame->videoMode = mode;
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = 0;
    frame->cropOriginY = 0;
    frame->stride = mode.resolutionX * static_cast<int>(sizeof(OniDepthPixel));
    raiseNewFrame(frame);
  }
  getServices().releaseFrame(frame);
  return complete;
}

OniStatus Stream::getProperty(int id, void* data, int* size) {
  const VirtualDepthHeader& header = connection_.header();
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return answer(video_mode_of(header), data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return answer(header.horizontal_field_of_view, data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return answer(header.vertical_field_of_view, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return answer(kMaximumDepth, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return answer(0, data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return answer(static_cast<int>(header.width * sizeof(OniDepthPixel)), data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return answer(OniBool{FALSE}, data, size);
    case ONI_STREAM_PROPERTY_CROPPING:  // without an answer, recordings would replay no frames
      return answer(OniCropping{}, data, size);
    case XN_STREAM_PROPERTY_HOLE_FILTER:
      return answer(0, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

/// The device is what it is: setting a property to its value succeeds, all else but
/// the limit fails.
OniStatus Stream::setProperty(int id, const void* data, int size) {
  if (id == kVirtualDepthLimit && size == static_cast<int>(sizeof(int))) {
    int limit = 0;
    std::memcpy(&limit, data, sizeof(limit));
    limit_ = limit;
    return ONI_STATUS_OK;
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
