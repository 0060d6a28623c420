// SPDX-License-Identifier: BSD-3-Clause
#include "display.hpp"

#include <X11/Xlib.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lockbox {
namespace {

constexpr char kAdvice[] =
    "; set DISPLAY to one that can be used (`ssh -X` does), or draw pictures, which need none: "
    "`view --screenshot`, `--pictures` or `--video`, `track --snapshots`";

constexpr double kUsual = 96.0;  // dots per inch
constexpr double kLargest = 4.0;

/// By the size that the server says its screen has. Whole halves, rounded down: servers that nobody
/// has told their screen's size say 96 or 100 dots per inch.
double scale_of_screen(Display* display) {
  constexpr double kInch = 25.4;    // millimetres
  constexpr double kRounded = 0.1;  // of a half: what whole millimetres may take from a scale
  const int screen = DefaultScreen(display);
  const int height = DisplayHeightMM(display, screen);
  if (height <= 0) return 1.0;
  const double dots = kInch * DisplayHeight(display, screen) / height;
  return std::floor(2.0 * dots / kUsual + kRounded) / 2.0;
}

}  // namespace

void DisplayConnection::Close::operator()(_XDisplay* display) const {
  XCloseDisplay(display);
}

DisplayConnection::DisplayConnection() {
  const char* const name = std::getenv("DISPLAY");
  if (name == nullptr || *name == '\0') {
    problem_ = std::string("there is no X display: DISPLAY is not set") + kAdvice;
    return;
  }
  display_.reset(XOpenDisplay(name));
  int opcode = 0;
  int event = 0;
  int error = 0;
  if (!display_) {
    problem_ = std::string("the X display ") + name + " cannot be reached" + kAdvice;
  } else if (XQueryExtension(display_.get(), "GLX", &opcode, &event, &error) == 0) {
    problem_ = std::string("the X display ") + name + " has no OpenGL (GLX)" + kAdvice;
  }
}

double DisplayConnection::scale() const {
  const char* const dots = XGetDefault(display_.get(), "Xft", "dpi");
  const double asked =
      dots == nullptr ? scale_of_screen(display_.get()) : std::strtod(dots, nullptr) / kUsual;
  return std::clamp(asked, 1.0, kLargest);
}

void flush(_XDisplay* display) {
  XFlush(display);
}

void stop_thread_on_loss(_XDisplay* display, const std::function<void()>& on_loss) {
  XSetIOErrorHandler([](Display*) { return 0; });  // the one that is there ends the process
  const auto stop = [](Display* broken, void* told) {
    XUnlockDisplay(broken);  // Xlib has locked it so that no other thread could exit
    (*static_cast<const std::function<void()>*>(told))();
    for (;;) ::pause();
  };
  XSetIOErrorExitHandler(display, stop, const_cast<std::function<void()>*>(&on_loss));
}

}  // namespace lockbox
