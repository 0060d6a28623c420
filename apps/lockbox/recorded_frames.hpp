// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <memory>

#include "lockbox/capture/frame_source.hpp"

namespace lockbox::app {

/// The frames of a recording in any order. Sources deliver them in their own order only, so the
/// latest are kept, and what lies further back is read again from the beginning.
class RecordedFrames {
 public:
  using Open = std::function<std::unique_ptr<FrameSource>()>;

  /// source: of a recording, nothing read yet. reopen: opens the same again. Throws InputError if
  /// the recording has no frames.
  RecordedFrames(std::unique_ptr<FrameSource> source, Open reopen);

  /// Returns as many as the recording says, until its end was seen.
  std::size_t size() const { return size_; }

  /// Null if the recording ends before. Valid until the next call.
  const DepthFrame* at(std::size_t index);

 private:
  void read_next();

  std::unique_ptr<FrameSource> source_;
  Open reopen_;
  std::size_t size_;
  std::size_t read_ = 0;         ///< frames read since the beginning; kept_.back() is the last
  bool ended_ = false;           ///< of reading
  std::deque<DepthFrame> kept_;  ///< consecutive
};

}  // namespace lockbox::app
