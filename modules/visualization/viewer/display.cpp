// SPDX-License-Identifier: BSD-3-Clause
#include "display.hpp"

#include <X11/Xlib.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace lockbox {
namespace {

constexpr char kAdvice[] =
    "; set DISPLAY to one that can be used (`ssh -X` does), or draw pictures, which need none: "
    "`view --screenshot`, `--pictures` or `--video`, `track --snapshots`";

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
  constexpr double kUsual = 96.0;  // dots per inch
  constexpr double kLargest = 4.0;
  const char* const dots = XGetDefault(display_.get(), "Xft", "dpi");
  if (dots == nullptr) return 1.0;
  return std::clamp(std::strtod(dots, nullptr) / kUsual, 1.0, kLargest);
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
