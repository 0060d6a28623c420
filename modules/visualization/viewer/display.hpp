// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

struct _XDisplay;

namespace lockbox {

/// A connection to the X display, to be made before VTK opens a window, because VTK aborts the
/// process where it cannot. It has to stay open until VTK has one of its own: a virtual X server
/// starts anew when its last client leaves, and refuses the next one meanwhile.
class DisplayConnection {
 public:
  /// Tries the display of the environment.
  DisplayConnection();

  /// Empty if windows with OpenGL can be opened; else the reason, and what to do.
  const std::string& problem() const { return problem_; }

  /// By how much texts are to be larger than on displays of 96 dots per inch, 1 to 4: as the
  /// display's resource Xft.dpi says, else by the size that its screen is said to have.
  double scale() const;

 private:
  struct Close {
    void operator()(_XDisplay* display) const;
  };

  std::unique_ptr<_XDisplay, Close> display_;
  std::string problem_;
};

/// Hands over what is still waiting to be sent, the closing of a window for instance.
void flush(_XDisplay* display);

/// When the connection breaks, Xlib ends the process, because its callers could not go on. With
/// this, it calls on_loss, which must stay where it is, and stops the calling thread for good.
void stop_thread_on_loss(_XDisplay* display, const std::function<void()>& on_loss);

}  // namespace lockbox
