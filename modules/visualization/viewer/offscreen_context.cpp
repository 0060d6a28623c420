// SPDX-License-Identifier: BSD-3-Clause
#include "offscreen_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <sstream>

namespace lockbox {
namespace {

std::string failed(const char* what) {
  std::ostringstream text;
  text << what << " failed (EGL error 0x" << std::hex << eglGetError() << ')';
  return text.str();
}

}  // namespace

OffscreenContext::OffscreenContext() {
  open();
}

/// The display stays open: other contexts of the process may draw with it.
OffscreenContext::~OffscreenContext() {
  if (context_ == nullptr) return;
  if (is_current()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void OffscreenContext::open() {
  constexpr EGLint kAnyOpenGl[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                   EGL_OPENGL_BIT, EGL_NONE};
  // What VTK 9 needs.
  constexpr EGLint kVersion[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 2,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
  display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA,
                                   reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) {
    problem_ = failed("drawing into memory");
  } else if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
             eglChooseConfig(display_, kAnyOpenGl, &config, 1, &configs) == EGL_FALSE ||
             configs == 0) {
    problem_ = failed("looking for OpenGL that draws into memory");
  } else {
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, kVersion);
    if (context_ == EGL_NO_CONTEXT) problem_ = failed("opening OpenGL 3.2 that draws into memory");
  }
}

void OffscreenContext::make_current() const {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

bool OffscreenContext::is_current() const {
  return context_ != nullptr && eglGetCurrentContext() == context_;
}

}  // namespace lockbox
