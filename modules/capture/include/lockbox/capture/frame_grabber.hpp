// SPDX-License-Identifier: BSD-3-Clause
// Any frame source as a pcl::Grabber.
#pragma once

#include <pcl/io/grabber.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <atomic>
#include <boost/signals2/signal.hpp>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// Pulls frames in a thread of its own and signals them. Recordings are signalled completely, frame
/// by frame, however slow the callbacks are; live devices skip what comes meanwhile.
///
/// pcl::io::OpenNI2Grabber is not used because stopping it is a race that ends the process about
/// once in a hundred times, it never tells the end of a recording, and it drops frames.
class FrameGrabber : public pcl::Grabber {
 public:
  /// Gets an organized cloud, metres, in the camera's optical frame, with NaN where nothing was
  /// measured. The header holds the stamp in microseconds and the frame's index.
  using CloudCallback = void(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr&);
  /// Gets the frame as its source delivered it, before the cloud is made of it.
  using FrameCallback = void(const std::shared_ptr<const DepthFrame>&);
  /// Is called once when the source ends by itself; the text is empty, or what went wrong.
  using EndCallback = void(const std::string& error);

  /// Opens the source at every start(), and at once, so that errors come here. Throws as it does.
  explicit FrameGrabber(std::function<std::unique_ptr<FrameSource>()> open);

  /// Plays open_source(source, options).
  explicit FrameGrabber(const std::string& source, const SourceOptions& options = {});

  /// Stops, and waits for a running callback. So a callback may not destroy its grabber.
  ~FrameGrabber() noexcept override;

  /// Starts from the beginning of a recording. Does nothing while running, or in a callback.
  void start() override;

  /// Stops pulling frames. No callback runs any more when it returns, unless a callback itself
  /// calls it: then the grabber ends after that callback. Takes half a second at most if the
  /// grabber has opened its source itself; else it may take as long as the source waits for a
  /// frame.
  void stop() override;

  /// Returns whether the thread that pulls frames is there.
  bool isRunning() const override { return running_; }
  /// Returns the name that PCL asks of every grabber.
  std::string getName() const override { return "lockbox::FrameGrabber"; }

  /// Returns the rate of the last frames by their stamps; it is 0 before the second frame.
  float getFramesPerSecond() const override { return frames_per_second_; }

 private:
  void run();
  void publish(const std::shared_ptr<const DepthFrame>& frame);
  void join();
  bool in_callback() const { return worker_ == std::this_thread::get_id(); }

  std::function<std::unique_ptr<FrameSource>()> open_;
  std::unique_ptr<FrameSource> source_;
  boost::signals2::signal<CloudCallback>* clouds_;
  boost::signals2::signal<FrameCallback>* frames_;
  boost::signals2::signal<EndCallback>* ends_;
  std::mutex control_;  ///< start() and stop() exclude each other
  std::thread thread_;
  std::atomic<std::thread::id> worker_;
  std::atomic<bool> running_{false};
  std::atomic<bool> stop_{false};
  std::atomic<float> frames_per_second_{0.0F};
};

}  // namespace lockbox
