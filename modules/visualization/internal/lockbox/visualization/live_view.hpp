// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/visualization/scene_composer.hpp"

namespace lockbox {

/// A window beside a loop over frames. It has a thread of its own, of low priority, and shows the
/// newest frame whenever it is done with the one before: it holds nobody up.
class LiveView {
 public:
  /// The model must outlive it. shown: what the title names beside it, the source for instance.
  /// Throws InputError if no window can be opened.
  LiveView(const ArticulatedModel& model, const std::string& shown);

  /// Closes the window.
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  /// Copies what is to be shown next. Does not wait for the drawing.
  void show(const DepthFrame& frame, const ShownEstimate& estimate, const std::string& title);

  /// False after the user has closed the window.
  bool is_open() const;

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace lockbox
