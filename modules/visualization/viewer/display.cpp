// SPDX-License-Identifier: BSD-3-Clause
#include "display.hpp"

#include <X11/Xlib.h>

#include <cstdlib>

namespace lockbox {
namespace {

constexpr char kAdvice[] =
    "; set DISPLAY to one that can be used (`ssh -X` does), or run the command within `xvfb-run`, "
    "which draws into memory";

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

}  // namespace lockbox
