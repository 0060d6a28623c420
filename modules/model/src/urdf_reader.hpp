// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urdf_model/model.h>

#include <memory>
#include <string>

namespace lockbox {

/// What urdfdom makes of a guarded URDF. file: name for the errors. Throws InputError.
std::shared_ptr<const urdf::ModelInterface> read_urdf(const std::string& file,
                                                      const std::string& guarded_text);

}  // namespace lockbox
