// SPDX-License-Identifier: BSD-3-Clause
#include "x_user.hpp"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace lockbox {
namespace {

bool is_shown_as(Display* display, Window window, const std::string& name) {
  XWindowAttributes attributes;
  if (XGetWindowAttributes(display, window, &attributes) == 0) return false;
  char* text = nullptr;
  if (attributes.map_state != IsViewable || XFetchName(display, window, &text) == 0) return false;
  const bool is_same = name == text;
  XFree(text);
  return is_same;
}

/// 0 if there is none.
Window window_of_name(Display* display, const std::string& name) {
  Window root = 0;
  Window parent = 0;
  Window* children = nullptr;
  unsigned int count = 0;
  Window found = 0;
  XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
  for (unsigned int i = 0; i < count; ++i) {
    if (is_shown_as(display, children[i], name)) found = children[i];
  }
  if (children != nullptr) XFree(children);
  return found;
}

/// Throws with the problem when patience ends.
template <typename Condition>
void wait_for(const std::string& problem, Condition condition) {
  constexpr auto kPatience = std::chrono::seconds(120);
  const auto start = std::chrono::steady_clock::now();
  while (!condition()) {
    if (std::chrono::steady_clock::now() - start > kPatience) throw std::runtime_error(problem);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace

XUser::XUser(const std::string& display)
    : display_(XOpenDisplay(display.empty() ? nullptr : display.c_str())) {
  // Windows may go between two questions about them.
  XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
}

XUser::~XUser() {
  if (display_ != nullptr) XCloseDisplay(display_);
}

void XUser::find_window(const std::string& name) {
  wait_for("no window " + name, [&] { return (window_ = window_of_name(display_, name)) != 0; });
}

void XUser::wait_until_gone(const std::string& name) const {
  wait_for("still a window " + name, [&] { return window_of_name(display_, name) == 0; });
}

void XUser::press(const std::string& key) {
  XEvent event = {};
  event.xkey.type = KeyPress;
  event.xkey.display = display_;
  event.xkey.window = window_;
  event.xkey.root = DefaultRootWindow(display_);
  event.xkey.same_screen = True;
  event.xkey.keycode = XKeysymToKeycode(display_, XStringToKeysym(key.c_str()));
  XSendEvent(display_, window_, True, KeyPressMask, &event);
  XSync(display_, False);
}

void XUser::close() {
  XEvent event = {};
  event.xclient.type = ClientMessage;
  event.xclient.window = window_;
  event.xclient.message_type = XInternAtom(display_, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display_, "WM_DELETE_WINDOW", False));
  XSendEvent(display_, window_, False, NoEventMask, &event);
  XSync(display_, False);
}

}  // namespace lockbox
