// SPDX-License-Identifier: BSD-3-Clause
#include <string_view>

#include "foreign_source.hpp"
#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/capture/frame_source.hpp"
#include "lockbox/capture/live_device.hpp"
#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/pcd_folder.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "pcd_files.hpp"
#include "realtime_source.hpp"
#include "steady_stamps.hpp"

namespace lockbox {
namespace {

constexpr std::string_view kLive = "openni2:";

void warn_of_unused_scale(const SourceOptions& options) {
  if (options.depth_scale && options.warn) {
    options.warn(
        "the depth scale that was given (--depth-scale) is not used: the stream itself states its "
        "unit");
  }
}

void warn_of_unused_mode(const SourceOptions& options) {
  if (options.mode && options.warn) {
    options.warn(
        "the mode that was given (--mode) is not used: it is for cameras, and a recording is what "
        "it is");
  }
}

std::unique_ptr<FrameSource> open_folder(const std::filesystem::path& folder,
                                         const SourceOptions& options) {
  if (is_there(folder / "depth.txt")) {
    return std::make_unique<DepthFolderSource>(folder, options);
  }
  if (!pcd_files(folder).empty()) {
    return std::make_unique<PcdFolderSource>(folder, options);
  }
  throw InputError(folder.string(), foreign_folder(folder));
}

std::unique_ptr<FrameSource> open_recording(const std::string& source,
                                            const SourceOptions& options) {
  const std::filesystem::path path(source);
  if (is_folder(path)) {
    return open_folder(path, options);
  }
  if (const std::optional<std::string> kind = foreign_file(path)) {
    throw InputError(source, *kind);
  }
  warn_of_unused_scale(options);
  return std::make_unique<OniPlayer>(path, options);
}

}  // namespace

void require_source(const std::string& source) {
  if (source.starts_with(kLive) || is_there(source)) return;
  throw InputError(source,
                   "no such file or folder; a source is openni2:, openni2:<uri>, an .oni file, a "
                   "folder with depth.txt, or a folder of .pcd files");
}

std::unique_ptr<FrameSource> open_source(const std::string& source, const SourceOptions& options) {
  require_source(source);
  if (source.starts_with(kLive)) {
    warn_of_unused_scale(options);
    return std::make_unique<SteadyStamps>(
        std::make_unique<LiveDevice>(source.substr(kLive.size()), options), options.warn);
  }
  warn_of_unused_mode(options);
  auto recording = std::make_unique<SteadyStamps>(open_recording(source, options), options.warn);
  if (options.realtime) {
    return std::make_unique<RealtimeSource>(std::move(recording), options.stop);
  }
  return recording;
}

}  // namespace lockbox
