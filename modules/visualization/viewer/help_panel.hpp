// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <string>

namespace lockbox {

/// Lines over the middle of a picture, within a frame.
class HelpPanel {
 public:
  /// scale: of the letters, which are smaller where the lines would not fit otherwise.
  HelpPanel(vtkRenderer& renderer, double scale);

  /// Empty: nothing is shown. The window must have its size.
  void set(const std::string& lines);

 private:
  void fit();

  vtkRenderer& renderer_;
  double scale_;
  vtkNew<vtkTextActor> text_;
};

}  // namespace lockbox
