// SPDX-License-Identifier: BSD-3-Clause
#include "return_watch.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "lockbox/capture/virtual_depth_protocol.hpp"

namespace lockbox::virtual_depth {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(100);  // between looks

bool is_there(const std::string& uri) {
  std::error_code missing;
  return std::filesystem::is_socket(uri.substr(sizeof(kVirtualDepthPrefix) - 1), missing);
}

}  // namespace

ReturnWatch::~ReturnWatch() {
  running_ = false;
  if (thread_.joinable()) thread_.join();
}

void ReturnWatch::await(const std::string& uri) {
  const std::lock_guard lock(mutex_);
  away_.push_back(uri);
  if (!running_.exchange(true)) thread_ = std::thread([this] { run(); });
}

void ReturnWatch::run() {
  while (running_) {
    for (const auto& uri : take_returned()) on_return_(uri);
    std::this_thread::sleep_for(kInterval);
  }
}

std::vector<std::string> ReturnWatch::take_returned() {
  const std::lock_guard lock(mutex_);
  const auto first = std::stable_partition(away_.begin(), away_.end(),
                                           [](const std::string& uri) { return !is_there(uri); });
  std::vector<std::string> returned(first, away_.end());
  away_.erase(first, away_.end());
  return returned;
}

}  // namespace lockbox::virtual_depth
