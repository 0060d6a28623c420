// SPDX-License-Identifier: BSD-3-Clause
// Lines on standard output. Its kind is the caller's choice (a pipe, a file, a terminal), and it is
// shared with other programs, so that it must not be made non-blocking: a thread waits for it.
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <condition_variable>
#include <mutex>
#include <string_view>

#include "lockbox/core/error.hpp"
#include "outlet.hpp"
#include "quiet_thread.hpp"

namespace lockbox {
namespace {

constexpr int kPollInterval = 20;  // milliseconds; how late the end is noticed

class StandardOutput : public Outlet {
 public:
  explicit StandardOutput(std::string target)
      : target_(std::move(target)), thread_(start_quiet_thread([this] { write_all(); })) {}

  ~StandardOutput() override { StandardOutput::close(); }

  void send(const Line& line) override {
    {
      const std::lock_guard lock(mutex_);
      dropped_ += is_gone_ ? 1 : queue_.push(line);
    }
    changed_.notify_one();
  }

  void close() override {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      is_closing_ = true;
      give_up_ = Clock::now() + kFarewell;
    }
    changed_.notify_one();
    thread_.join();
  }

  std::string address() const override { return "standard output"; }

  Publication publication() const override {
    const std::lock_guard lock(mutex_);
    return {target_, 1, dropped_, address()};
  }

  int error() const override {
    const std::lock_guard lock(mutex_);
    return error_;
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// The thread.
  void write_all() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return is_closing_ || !queue_.empty(); });
      if (queue_.empty()) return;
      const Line line = queue_.pop();
      lock.unlock();
      const bool is_written = write_line(*line);
      lock.lock();
      if (is_written) continue;
      is_gone_ = true;
      dropped_ += queue_.size() + 1;
      queue_ = {};
      return;
    }
  }

  /// False if nobody will read it, or the time is up.
  bool write_line(std::string_view text) {
    while (!text.empty()) {
      if (!wait_until_writable()) return false;
      // So much goes into a pipe that is writable without waiting.
      const ssize_t written =
          ::write(STDOUT_FILENO, text.data(), std::min<std::size_t>(text.size(), PIPE_BUF));
      if (written < 0 && errno != EINTR && errno != EAGAIN) {
        const int error = errno;
        const std::lock_guard lock(mutex_);
        error_ = error;
        return false;
      }
      if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }

  bool wait_until_writable() {
    pollfd output = {STDOUT_FILENO, POLLOUT, 0};
    while (::poll(&output, 1, kPollInterval) <= 0) {
      const std::lock_guard lock(mutex_);
      if (is_closing_ && Clock::now() > give_up_) return false;
    }
    return true;
  }

  std::string target_;
  mutable std::mutex mutex_;  ///< of all below
  std::condition_variable changed_;
  LineQueue queue_;
  std::size_t dropped_ = 0;
  bool is_gone_ = false;  ///< who read, or the space on the disk
  int error_ = 0;         ///< of the write that failed; 0: none did
  bool is_closing_ = false;
  Clock::time_point give_up_;
  std::thread thread_;  ///< last: it uses all others
};

}  // namespace

std::unique_ptr<Outlet> make_standard_output(const PublishTarget& target) {
  if (::fcntl(STDOUT_FILENO, F_GETFD) < 0) {  // the next file that is opened would be in its place
    throw InputError(target.text, "standard output is closed; give a pipe or a file, or a socket");
  }
  return std::make_unique<StandardOutput>(target.text);
}

}  // namespace lockbox
