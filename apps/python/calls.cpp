// SPDX-License-Identifier: BSD-3-Clause
#include "calls.hpp"

namespace lockbox::python {
namespace {

/// Ctrl-C is noticed so late; asking takes Python's lock, for which other threads may make it wait.
constexpr auto kAskInterval = std::chrono::milliseconds(50);

}  // namespace

bool Interruptible::requested() {
  if (caller_.load() != std::this_thread::get_id() || is_interrupted_) return is_interrupted_;
  const auto now = Clock::now();
  if (now - asked_ < kAskInterval) return false;
  asked_ = now;
  const py::gil_scoped_acquire lock;
  is_interrupted_ = PyErr_CheckSignals() != 0;
  return is_interrupted_;
}

void Interruptible::begin() {
  caller_ = std::this_thread::get_id();
  is_interrupted_ = false;
  asked_ = Clock::now();
}

void Interruptible::throw_if_interrupted() {
  if (!is_interrupted_.exchange(false)) return;
  const py::gil_scoped_acquire lock;
  throw py::error_already_set();
}

void Warnings::add(const std::string& text) {
  const std::lock_guard lock(mutex_);
  texts_.push_back(text);
}

void Warnings::issue() {
  std::vector<std::string> texts;
  {
    const std::lock_guard lock(mutex_);
    texts.swap(texts_);
  }
  for (const auto& text : texts) {
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
  }
}

}  // namespace lockbox::python
