// SPDX-License-Identifier: BSD-3-Clause
#include "offscreen_window.hpp"

#include <GL/glew.h>
#include <vtkObjectFactory.h>

#include <utility>

namespace lockbox {

vtkStandardNewMacro(OffscreenWindow);

OffscreenWindow::~OffscreenWindow() {
  Finalize();  // while the context is there
}

void OffscreenWindow::use(std::unique_ptr<OffscreenContext> context) {
  context_ = std::move(context);
  SetOffScreenRendering(1);
  SetReadyForRendering(true);
  SetSupportsOpenGL(1);
  SetMapped(1);
}

void OffscreenWindow::MakeCurrent() {
  if (context_) context_->make_current();
}

bool OffscreenWindow::IsCurrent() {
  return context_ && context_->is_current();
}

void OffscreenWindow::OpenGLInitContext() {
  if (!Initialized) {
    MakeCurrent();
    // GLEW finds OpenGL's functions first, and then looks for the X display, which is not there:
    // VTK would take that for a failure.
    const GLenum found = glewInit();
    GlewInitValid = found == GLEW_OK || found == GLEW_ERROR_NO_GLX_DISPLAY;
    Initialized = GlewInitValid;
  }
  vtkGenericOpenGLRenderWindow::OpenGLInitContext();
}

}  // namespace lockbox
