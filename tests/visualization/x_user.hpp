// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

struct _XDisplay;

namespace lockbox {

/// Another client of the X display, which does to a window what a user does. While it lives, the
/// server of the tests does not start anew between two windows.
class XUser {
 public:
  /// On the display of the environment, if none is named.
  explicit XUser(const std::string& display = "");
  ~XUser();

  /// False if there is no display.
  bool is_connected() const { return display_ != nullptr; }

  /// Waits until there is a window of this name, and it is on the screen.
  void find_window(const std::string& name);

  /// Waits until there is none: the server hears of a closed window in its own time, and the next
  /// one of the same name must not be taken for it.
  void wait_until_gone(const std::string& name) const;

  /// key: its name in X11, such as `space`.
  void press(const std::string& key);

  /// Moves the pointer; pixels of the window.
  void point(int x, int y);

  /// The left mouse button goes down, or up, at this pixel of the window.
  void press_button(int x, int y) { send_button(true, x, y); }
  void release_button(int x, int y) { send_button(false, x, y); }

  /// The name of the window, as it is now.
  std::string title() const;

  /// What the window shows, three bytes a pixel, row by row.
  std::vector<unsigned char> picture() const;

  /// What programs that start from now on are asked for, as `xrdb` sets it.
  void set_resources(const std::string& lines);

  /// Width and height, pixels.
  std::pair<int, int> screen_size() const;

  /// As with the button of its frame.
  void close();

 private:
  void send_button(bool down, int x, int y);

  _XDisplay* display_ = nullptr;
  unsigned long window_ = 0;
};

}  // namespace lockbox
