// SPDX-License-Identifier: BSD-3-Clause
// How old a frame is when its state is known: from when a virtual camera begins to send it, through
// the real OpenNI2 runtime, to the tracker's result. One run, because it is the clock's.
//   live_latency MODEL DEPTH_FOLDER [SECONDS]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <mutex>
#include <vector>

#include "../capture/virtual_camera.hpp"
#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/capture/live_device.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRate = 30;          // frames a second
constexpr std::size_t kWarm = 30;  // frames with a state before those that are measured

/// Plays the frames forwards and backwards, and notes when each was sent.
class TimedFrames {
 public:
  explicit TimedFrames(const std::string& folder) {
    DepthFolderSource source(folder, {});
    for (DepthFrame frame; source.next(frame);) frames_.push_back(frame);
  }

  DepthFrame operator()(std::uint64_t number) {
    const std::uint64_t turn = 2 * (frames_.size() - 1);
    const std::uint64_t at = number % turn;
    DepthFrame frame = frames_[at < frames_.size() ? at : turn - at];
    frame.stamp = static_cast<double>(number) / kRate;
    const std::lock_guard lock(mutex_);
    sent_.resize(std::max<std::size_t>(sent_.size(), number + 1));
    sent_[number] = Clock::now();
    return frame;
  }

  double milliseconds_since(double stamp) {
    const std::lock_guard lock(mutex_);
    const auto sent = sent_[static_cast<std::size_t>(std::llround(stamp * kRate))];
    return std::chrono::duration<double, std::milli>(Clock::now() - sent).count();
  }

 private:
  std::vector<DepthFrame> frames_;
  std::mutex mutex_;
  std::vector<Clock::time_point> sent_;
};

double percentile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

void print(std::vector<double> ages, std::size_t dropped) {
  std::sort(ages.begin(), ages.end());
  std::printf(
      "%zu frames, %zu dropped; age of a state: %.1f ms (median), %.1f (95 %%), "
      "%.1f (99 %%), %.1f (longest)\n",
      ages.size(), dropped, percentile(ages, 0.5), percentile(ages, 0.95), percentile(ages, 0.99),
      ages.back());
}

void measure(const std::string& model_file, const std::string& folder, double seconds) {
  const ArticulatedModel model = load_model(model_file);
  TimedFrames frames(folder);
  const VirtualCamera camera([&frames](std::uint64_t number) { return frames(number); }, kRate);
  LiveDevice device(camera.uri());
  TrackerOptions options;
  options.background_search = true;
  Tracker tracker(model, options);
  std::vector<double> ages;
  std::size_t known = 0;
  std::size_t dropped_before = 0;
  double begin = 0.0;
  for (DepthFrame frame; device.next(frame);) {
    const auto status = tracker.process(frame).status;
    const double age = frames.milliseconds_since(frame.stamp);
    known += status == TrackingStatus::tracking ? 1 : 0;
    if (known <= kWarm) {
      begin = frame.stamp;
      dropped_before = device.faults().dropped;
      continue;
    }
    ages.push_back(age);
    if (frame.stamp > begin + seconds) break;
  }
  print(std::move(ages), device.faults().dropped - dropped_before);
}

}  // namespace
}  // namespace lockbox

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::fputs("usage: live_latency MODEL DEPTH_FOLDER [SECONDS]\n", stderr);
    return 2;
  }
  constexpr double kSeconds = 60.0;
  lockbox::measure(argv[1], argv[2], argc > 3 ? std::stod(argv[3]) : kSeconds);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "live_latency: %s\n", error.what());
  return 1;
}
