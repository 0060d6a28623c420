// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkInteractorStyleTrackballCamera.h>

#include <string>
#include <vector>

namespace lockbox {

/// The mouse turns, shifts and zooms the view; keys are collected instead of VTK's own meanings.
class KeyStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static KeyStyle* New();
  vtkTypeMacro(KeyStyle, vtkInteractorStyleTrackballCamera)

      void OnKeyPress() override;
  void OnChar() override {}

  /// The keys that were pressed since the last call; `q` and Escape close the window instead.
  std::vector<std::string> take_keys();

 private:
  std::vector<std::string> keys_;
};

}  // namespace lockbox
