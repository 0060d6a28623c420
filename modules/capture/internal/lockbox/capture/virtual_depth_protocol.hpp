// SPDX-License-Identifier: BSD-3-Clause
// What a producer of depth frames and the virtual device driver say to each other, over a stream
// socket: one header, then frames, each a u64 timestamp in microseconds and width * height depths
// of u16, row by row; all little-endian. The end of the stream is the device being unplugged.
//
// A camera with several modes says version 2, and behind the header how many more it has (u32) and
// those (VirtualDepthMode). When its depth is started first, the driver sends the number of the
// mode that was chosen (u32; 0: that of the header), once. The frames come in that mode.
#pragma once

#include <cstdint>

namespace lockbox {

/// Devices are named `virtual-depth:<path of a Unix socket>`, on which the producer listens, or
/// `virtual-depth:fd:<number>`, an inherited end of a socket pair.
inline constexpr char kVirtualDepthPrefix[] = "virtual-depth:";

/// Paths of sockets, with colons between them: these devices are found without naming them.
inline constexpr char kVirtualDepthVariable[] = "LOCKBOX_VIRTUAL_DEPTH";

/// A stream property (int): the device delivers no more than so many frames in all. Whoever may not
/// lose frames raises it from 0, first after start() has returned: OpenNI2 drops what comes before.
inline constexpr int kVirtualDepthLimit = 0x4C420001;

struct VirtualDepthHeader {
  char magic[8] = {'L', 'B', 'X', 'D', 'E', 'P', 'T', 'H'};
  std::uint32_t version = 1;            ///< 2: more modes follow
  std::uint32_t width = 0;              ///< pixels
  std::uint32_t height = 0;             ///< pixels
  std::uint32_t frames_per_second = 0;  ///< nominal
  float horizontal_field_of_view = 0;   ///< radians
  float vertical_field_of_view = 0;     ///< radians
  std::uint32_t unit = 1000;            ///< micrometres: 1000 or 100
  std::uint32_t hold = 0;               ///< 1: kVirtualDepthLimit begins at 0; 0: no limit
};
static_assert(sizeof(VirtualDepthHeader) == 40);

/// One more mode. The field of view is that of the header.
struct VirtualDepthMode {
  std::uint32_t width = 0;              ///< pixels
  std::uint32_t height = 0;             ///< pixels
  std::uint32_t frames_per_second = 0;  ///< nominal
  std::uint32_t unit = 1000;            ///< micrometres: 1000 or 100
};
static_assert(sizeof(VirtualDepthMode) == 16);

}  // namespace lockbox
