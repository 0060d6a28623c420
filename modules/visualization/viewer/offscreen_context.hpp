// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lockbox {

/// An OpenGL context that draws into memory and needs no display (EGL without a surface). It is for
/// one thread at a time.
class OffscreenContext {
 public:
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// Empty if it can be drawn with; else the reason.
  const std::string& problem() const { return problem_; }

  void make_current() const;
  bool is_current() const;

 private:
  void open();

  void* display_ = nullptr;  ///< EGLDisplay, which all contexts of the process share
  void* context_ = nullptr;  ///< EGLContext
  std::string problem_;
};

}  // namespace lockbox
