// SPDX-License-Identifier: BSD-3-Clause
// A callable that is only borrowed, for the time of a call: std::function would copy it to the
// heap.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace lockbox {

/// See below; the signature is that of a function: Result(Arguments...).
template <typename Signature>
class FunctionRef;

/// Refers to the callable that it was made from, which must live as long as it is called.
template <typename Result, typename... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  /// Borrows the callable; it is not copied.
  template <typename Callable>
  requires(!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef>) FunctionRef(
      Callable&& callable)  // NOLINT(google-explicit-constructor): lambdas are passed as they are
      : callable_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
        call_([](void* target, Arguments... arguments) -> Result {
          return (*static_cast<std::add_pointer_t<Callable>>(target))(
              std::forward<Arguments>(arguments)...);
        }) {}

  /// Calls it.
  Result operator()(Arguments... arguments) const {
    return call_(callable_, std::forward<Arguments>(arguments)...);
  }

 private:
  void* callable_;
  Result (*call_)(void*, Arguments...);
};

}  // namespace lockbox
