// SPDX-License-Identifier: BSD-3-Clause
#include "x_user.hpp"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace lockbox {
namespace {

bool is_shown_as(Display* display, Window window, const std::string& name) {
  XWindowAttributes attributes;
  if (XGetWindowAttributes(display, window, &attributes) == 0) return false;
  char* text = nullptr;
  if (attributes.map_state != IsViewable || XFetchName(display, window, &text) == 0) return false;
  const std::string title = text;
  const bool is_same = title == name || title.starts_with(name + " - ");  // with its frame rate
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

XUser::XUser(const std::string& display) {
  // A server whose last client has just left starts anew, and refuses others meanwhile.
  const char* const name = display.empty() ? std::getenv("DISPLAY") : display.c_str();
  for (int tries = 0; display_ == nullptr && name != nullptr && tries < 50; ++tries) {
    if (tries > 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    display_ = XOpenDisplay(name);
  }
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

void XUser::point(int x, int y) {
  XWarpPointer(display_, None, window_, 0, 0, 0, 0, x, y);  // VTK asks where the pointer is
  XSync(display_, False);
}

void XUser::send_button(bool down, int x, int y) {
  XEvent event = {};
  event.xbutton.type = down ? ButtonPress : ButtonRelease;
  event.xbutton.display = display_;
  event.xbutton.window = window_;
  event.xbutton.root = DefaultRootWindow(display_);
  event.xbutton.same_screen = True;
  event.xbutton.button = Button1;
  event.xbutton.x = x;
  event.xbutton.y = y;
  XSendEvent(display_, window_, True, down ? ButtonPressMask : ButtonReleaseMask, &event);
  XSync(display_, False);
}

std::string XUser::title() const {
  char* text = nullptr;
  if (XFetchName(display_, window_, &text) == 0) return {};
  std::string title = text;
  XFree(text);
  return title;
}

std::vector<unsigned char> XUser::picture() const {
  XWindowAttributes size = {};
  XGetWindowAttributes(display_, window_, &size);
  XImage* const image = XGetImage(display_, window_, 0, 0, static_cast<unsigned>(size.width),
                                  static_cast<unsigned>(size.height), AllPlanes, ZPixmap);
  std::vector<unsigned char> rgb;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const unsigned long pixel = XGetPixel(image, x, y);
      for (const int shift : {16, 8, 0})
        rgb.push_back(static_cast<unsigned char>(pixel >> shift & 0xFF));
    }
  }
  XDestroyImage(image);
  return rgb;
}

void XUser::set_resources(const std::string& lines) {
  XChangeProperty(display_, DefaultRootWindow(display_), XA_RESOURCE_MANAGER, XA_STRING, 8,
                  PropModeReplace, reinterpret_cast<const unsigned char*>(lines.data()),
                  static_cast<int>(lines.size()));
  XSync(display_, False);
}

std::pair<int, int> XUser::screen_size() const {
  const int screen = DefaultScreen(display_);
  return {DisplayWidth(display_, screen), DisplayHeight(display_, screen)};
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
