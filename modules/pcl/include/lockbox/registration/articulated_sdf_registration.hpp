// SPDX-License-Identifier: BSD-3-Clause
// The name of this header before PCL's face had a module of its own.
#pragma once

#include "lockbox/pcl/articulated_sdf_registration.hpp"
