// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkGenericOpenGLRenderWindow.h>

#include <memory>

#include "offscreen_context.hpp"

namespace lockbox {

/// What VTK draws into where nothing is to be seen on a screen: Debian's VTK knows X windows only,
/// even for pictures.
class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static OffscreenWindow* New();
  vtkTypeMacro(OffscreenWindow, vtkGenericOpenGLRenderWindow)

      /// Before anything else. context: without a problem.
      void use(std::unique_ptr<OffscreenContext> context);

  void MakeCurrent() override;
  bool IsCurrent() override;

 protected:
  OffscreenWindow() = default;
  ~OffscreenWindow() override;
  void OpenGLInitContext() override;

 private:
  std::unique_ptr<OffscreenContext> context_;
};

}  // namespace lockbox
