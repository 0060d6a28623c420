// SPDX-License-Identifier: BSD-3-Clause
// A camera calibration: what was read is written so that it is read again, and frames are delivered
// with it.
#include "lockbox/capture/camera_info.hpp"

#include "fuzz_input.hpp"
#include "lockbox/capture/depth_folder.hpp"

namespace lockbox {
namespace {

void read_twice(const std::filesystem::path& file, const std::filesystem::path& copy) {
  const CameraCalibration read = read_camera_info(file);
  write_camera_info(copy, read);
  const CameraCalibration again = read_camera_info(copy);
  require(again.camera == read.camera && again.distortion == read.distortion &&
              again.depth_scale == read.depth_scale && again.is_equidistant == read.is_equidistant,
          "a calibration that was written is read as it was");
}

/// One image of the size that the seeds are for.
TemporaryFolder& folder_with_image() {
  static TemporaryFolder folder;
  static const bool is_written = [] {
    DepthFrame frame;
    frame.camera = {16, 12, 14.4, 14.4, 7.5, 5.5};
    frame.depth.assign(16 * 12, 1000);
    DepthFolderWriter(folder.path()).write(frame);
    return true;
  }();
  static_cast<void>(is_written);
  return folder;
}

}  // namespace
}  // namespace lockbox

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  const TemporaryFolder& folder = folder_with_image();
  const auto file = folder.write("camera_info.yaml", as_text(data, size));
  take_or_refuse(folder, [&] { read_twice(file, folder / "copy.yaml"); });
  take_or_refuse(folder, [&] {
    DepthFolderSource source(folder.path());
    for (DepthFrame frame; source.next(frame);) continue;
  });
  return 0;
}
