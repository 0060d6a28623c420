// SPDX-License-Identifier: BSD-3-Clause
#include "key_style.hpp"

#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

#include <utility>

namespace lockbox {

vtkStandardNewMacro(KeyStyle)

    void KeyStyle::OnKeyPress() {
  const std::string key = this->Interactor->GetKeySym();
  if (key == "q" || key == "Escape") {
    this->Interactor->ExitCallback();
  } else {
    keys_.push_back(key);
  }
}

std::vector<std::string> KeyStyle::take_keys() {
  return std::exchange(keys_, {});
}

}  // namespace lockbox
