// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/frame_grabber.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace lockbox {
namespace {

constexpr float kSmoothing = 0.1F;  // weight of the newest interval in the frame rate

pcl::PointCloud<pcl::PointXYZ>::Ptr make_cloud(const DepthFrame& frame) {
  const PinholeCamera& camera = frame.camera;
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(
      static_cast<std::uint32_t>(camera.width), static_cast<std::uint32_t>(camera.height));
  cloud->header.stamp = static_cast<std::uint64_t>(std::llround(frame.stamp * 1e6));
  cloud->header.seq = static_cast<std::uint32_t>(frame.index);
  cloud->header.frame_id = "depth_optical_frame";
  cloud->is_dense = false;
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  auto point = cloud->begin();
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u, ++point) {
      const float z = frame.metres(u, v);
      if (z > 0.0F) {
        point->getVector3fMap() = camera.back_project(u, v, double{z}).cast<float>();
      } else {
        point->getVector3fMap().setConstant(kNothing);
      }
    }
  }
  return cloud;
}

}  // namespace

FrameGrabber::FrameGrabber(std::function<std::unique_ptr<FrameSource>()> open)
    : open_(std::move(open)),
      source_(open_()),
      clouds_(createSignal<CloudCallback>()),
      frames_(createSignal<FrameCallback>()),
      ends_(createSignal<EndCallback>()) {}

FrameGrabber::FrameGrabber(const std::string& source, const SourceOptions& options)
    : FrameGrabber([this, source, options]() {
        SourceOptions stoppable = options;
        stoppable.stop = [this, stop = options.stop] { return stop_ || (stop && stop()); };
        return open_source(source, stoppable);
      }) {}

FrameGrabber::~FrameGrabber() noexcept {
  stop();
  join();
}

void FrameGrabber::start() {
  if (in_callback()) {
    return;
  }
  const std::lock_guard<std::mutex> lock(control_);
  if (running_) {
    return;
  }
  join();
  if (!source_) {
    source_ = open_();
  }
  stop_ = false;
  running_ = true;
  thread_ = std::thread([this] { run(); });
}

void FrameGrabber::stop() {
  stop_ = true;
  if (in_callback()) {
    return;  // it cannot wait for itself
  }
  const std::lock_guard<std::mutex> lock(control_);
  join();
}

void FrameGrabber::join() {
  if (thread_.joinable()) {
    thread_.join();
    worker_ = std::thread::id();  // which another thread may have from now on
  }
}

void FrameGrabber::run() {
  worker_ = std::this_thread::get_id();
  std::string error;
  bool ended = false;
  try {
    double last_stamp = 0.0;
    for (bool first = true; !stop_; first = false) {
      const auto frame = std::make_shared<DepthFrame>();
      if (!source_->next(*frame)) {
        ended = !stop_;
        break;
      }
      if (!first && frame->stamp > last_stamp) {
        const auto rate = static_cast<float>(1.0 / (frame->stamp - last_stamp));
        const float before = frames_per_second_;
        frames_per_second_ = before == 0.0F ? rate : before + kSmoothing * (rate - before);
      }
      last_stamp = frame->stamp;
      publish(frame);
    }
  } catch (const std::exception& exception) {
    error = exception.what();
    ended = true;
  }
  source_.reset();
  running_ = false;
  if (ended) {
    (*ends_)(error);
  }
}

void FrameGrabber::publish(const std::shared_ptr<const DepthFrame>& frame) {
  if (frames_->num_slots() > 0) {
    (*frames_)(frame);
  }
  if (clouds_->num_slots() > 0) {
    (*clouds_)(make_cloud(*frame));
  }
}

}  // namespace lockbox
