// SPDX-License-Identifier: BSD-3-Clause
#include "views.hpp"

#include "lockbox/view/view_detail.hpp"

namespace lockbox {
namespace {

/// Points that are enough to come near. Of as many as there may be only the last steps tell more.
constexpr std::size_t kRoughBudget = 3000;
constexpr ViewDetail kRoughDetail{2 * kRoughBudget, 4, 0};

}  // namespace

Views::Views(const RegistrationOptions& options)
    : rough(kRoughBudget, kRoughDetail),
      close(options.point_budget, view_detail(options.point_budget)),
      other(options.point_budget, view_detail(options.point_budget)),
      has_rough(options.point_budget == 0 || options.point_budget > kRoughBudget) {}

void Views::forget() {
  rough.forget();
  close.forget();
}

}  // namespace lockbox
