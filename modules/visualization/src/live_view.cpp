// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/live_view.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

namespace lockbox {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPollInterval = std::chrono::milliseconds(10);
/// A tenth of the time of a thread at 0 on a busy core: the view gives way, and still lives (at 19,
/// a seventieth, a window took a minute to open).
constexpr int kNice = 10;

/// Lowers the priority of the calling thread, and of the threads that it will start (those of a
/// renderer in software): on Linux each thread has its own.
void lower_priority() {
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNice);
}

struct Moment {
  DepthFrame frame;
  ShownEstimate estimate;
  std::string title;
};

}  // namespace

/// The thread of the window, and what it is handed.
class LiveView::Loop {
 public:
  Loop(const ArticulatedModel& model, const std::string& shown)
      : title_(window_title(model.tree.name, shown)),
        composer_(model, scene_help()),
        measured_(model, ""),
        unknown_(unknown_configuration(model.tree)) {
    std::promise<void> opened;
    std::promise<void> ended;
    auto is_opened = opened.get_future();
    is_ended_ = ended.get_future();
    thread_ = std::thread([this, &opened, ended = std::move(ended)]() mutable {
      run(opened);
      ended.set_value();
    });
    if (!happens(is_opened)) return;
    try {
      is_opened.get();
    } catch (...) {
      thread_.join();
      throw;
    }
  }

  ~Loop() {
    stop_ = true;
    if (happens(is_ended_)) {
      thread_.join();
    } else {
      thread_.detach();
    }
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void hand_over(const DepthFrame& frame, const ShownEstimate& estimate, const std::string& title) {
    const std::lock_guard lock(mutex_);
    next_.frame = frame;
    next_.estimate = estimate;
    next_.title = title;
    has_next_ = true;
  }

  bool is_open() const { return is_open_; }

 private:
  /// Waits for what the thread will do. False if it stands still instead.
  bool happens(const std::future<void>& event) const {
    while (!is_lost_) {
      if (event.wait_for(kPollInterval) == std::future_status::ready) return true;
    }
    return false;
  }

  void run(std::promise<void>& opened) {
    lower_priority();
    std::unique_ptr<SceneWindow> window;
    try {
      WindowOptions options;
      options.title = title_;
      options.on_display_lost = [this] {
        is_open_ = false;
        is_lost_ = true;
      };
      window = open_scene_window(composer_.parts(), options);
    } catch (...) {
      opened.set_exception(std::current_exception());
      return;
    }
    is_open_ = true;
    opened.set_value();
    while (!stop_ && window->is_open()) {
      const auto start = Clock::now();
      refresh(*window);
      // At most half of the time is for drawing, however slowly the machine draws.
      std::this_thread::sleep_for(std::max<Clock::duration>(Clock::now() - start, kPollInterval));
    }
    is_open_ = false;
  }

  /// Draws if there is something new.
  void refresh(SceneWindow& window) {
    bool is_new = false;
    for (const auto& key : window.poll()) is_new |= choices_.handle(key);
    const bool is_first = !has_shown_;
    is_new |= take_over();
    if (!is_new || !has_shown_) return;
    if (is_first) window.look(camera_near_sensor(now_.frame));
    const auto& scene = composer_.compose(&now_.frame, now_.estimate, now_.title, choices_);
    if (choices_.beside) {
      window.show_beside(
          measured_.compose(&now_.frame, unknown_, kMeasuredTitle, choices_.measured_only()),
          scene);
    } else {
      window.show(scene);
    }
  }

  bool take_over() {
    const std::lock_guard lock(mutex_);
    if (!has_next_) return false;
    std::swap(now_, next_);
    has_next_ = false;
    has_shown_ = true;
    return true;
  }

  const std::string title_;
  SceneComposer composer_;
  SceneComposer measured_;  ///< the left one of two scenes
  const ShownEstimate unknown_;
  SceneChoices choices_;
  Moment now_;  ///< the thread's own
  bool has_shown_ = false;
  std::mutex mutex_;
  Moment next_;  ///< guarded by mutex_
  bool has_next_ = false;
  std::atomic<bool> stop_ = false;
  std::atomic<bool> is_open_ = false;
  std::atomic<bool> is_lost_ = false;  ///< the display; then the thread stands still
  std::future<void> is_ended_;
  std::thread thread_;
};

LiveView::LiveView(const ArticulatedModel& model, const std::string& shown)
    : loop_(std::make_unique<Loop>(model, shown)) {}

LiveView::~LiveView() = default;

void LiveView::show(const DepthFrame& frame, const ShownEstimate& estimate,
                    const std::string& title) {
  if (loop_->is_open()) loop_->hand_over(frame, estimate, title);
}

bool LiveView::is_open() const {
  return loop_->is_open();
}

}  // namespace lockbox
