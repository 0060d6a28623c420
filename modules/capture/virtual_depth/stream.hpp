// SPDX-License-Identifier: BSD-3-Clause
// The streams of the virtual device.
#pragma once

// Debian ships OniDriverAPI.h without the platform header that defines these.
#define FALSE 0
#define TRUE 1
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include <Driver/OniDriverAPI.h>

#include <atomic>
#include <mutex>
#include <vector>

#include "feed.hpp"

namespace lockbox::virtual_depth {

/// The producer's depth, or a colour (RGB) or infrared (16-bit grey) image made of it: pictures
/// that follow from the depth of the same frame, for those who record and play such streams. Images
/// can be mirrored and cropped, as those of real devices; they are cropped last. The mode can be
/// chosen until it is started first.
class Stream : public oni::driver::StreamBase, private Listener {
 public:
  Stream(OniSensorType type, Feed& feed);
  ~Stream() override;

  OniStatus start() override;
  void stop() override;
  int getRequiredFrameSize() override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;

 private:
  void take(std::span<const std::uint16_t> depth, std::uint64_t timestamp) override;
  void fill(std::span<const std::uint16_t> depth, void* image) const;
  void fill_cropped(std::span<const std::uint16_t> depth, const OniCropping& cropping,
                    OniFrame& frame);
  int pixel_bytes() const;
  int stride() const;
  bool choose(const OniVideoMode& mode);
  OniCropping cropping();
  void set_cropping(const OniCropping& cropping);

  OniSensorType type_;
  Feed& feed_;
  OniVideoMode mode_;
  std::size_t mode_index_ = 0;
  std::atomic<bool> mirrored_{false};
  std::mutex mutex_;  ///< of the cropping
  OniCropping cropping_{};
  std::vector<char> image_;  ///< that is cropped
  int frame_index_ = 0;
};

OniVideoMode video_mode_of(OniSensorType type, const VirtualDepthMode& mode);

}  // namespace lockbox::virtual_depth
