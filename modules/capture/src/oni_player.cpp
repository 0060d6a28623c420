// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/oni_player.hpp"

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "image_limits.hpp"
#include "lockbox/capture/oni_validator.hpp"
#include "lockbox/core/error.hpp"
#include "openni_session.hpp"
#include "rectification.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;

constexpr int kSliceMilliseconds = 500;  // a shorter wait pokes the player twice
constexpr int kSlices = 20;              // 10 s without a frame: the player is stuck
constexpr int kTries = 4;                // to get a frame that a busy machine has lost

/// A short name of the recording of its own: OpenNI2 refuses paths of more than 255 characters, and
/// gives whoever opens the same name twice one player, which neither could then step through. What
/// is not plain is copied under that name.
class Alias {
 public:
  explicit Alias(const OniRecording& recording) {
    std::string name = (std::filesystem::temp_directory_path() / "lockbox-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw InputError(name,
                       "a temporary folder cannot be created; set TMPDIR to a writable folder");
    }
    folder_ = name;
    try {
      if (recording.is_plain) {
        std::filesystem::create_symlink(std::filesystem::absolute(recording.file), path());
      } else {
        copy_depth(recording, path());
      }
    } catch (...) {
      remove();
      throw;
    }
  }
  ~Alias() { remove(); }
  Alias(const Alias&) = delete;
  Alias& operator=(const Alias&) = delete;

  std::filesystem::path path() const { return folder_ / "recording.oni"; }

 private:
  void remove() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path folder_;
};

std::string text_of_end(const OniRecording& recording) {
  return recording.file.string() + ": " +
         (recording.end_reason.empty() ? "breaks off at byte " + std::to_string(recording.end) +
                                             ", without the end mark of a finished recording"
                                       : recording.end_reason) +
         "; the " + std::to_string(recording.frame_count) + " depth images before that are played";
}

}  // namespace

struct OniPlayer::Impl {
  Impl(const std::filesystem::path& path, const SourceOptions& options)
      : recording(validate_oni(path)),
        payloads(recording),
        rectification(given_calibration(options)),
        stop(options.stop),
        warn(options.warn) {
    const OniImage& first = recording.images.front();
    const bool is_calibrated = options.camera || options.camera_info;
    rectification.check_size(first.width, first.height, path.string());
    if (is_calibrated) {
      end_at_another_size();
    }
    require_openni();
    check_ahead();
    open();
    if (recording.is_cut_off || !recording.end_reason.empty()) {
      say_end();
    }
    if (!is_calibrated && !angles) {
      throw InputError(path.string(),
                       "does not tell the camera's field of view; give the camera's calibration "
                       "with --camera-info");
    }
    start();
  }

  void say_end() const {
    if (warn) {
      warn(text_of_end(recording));
    }
  }

  /// A calibration is for one size of image.
  void end_at_another_size() {
    const OniImage& first = recording.images.front();
    const auto other = std::find_if(
        recording.images.begin(), recording.images.end(), [&first](const OniImage& image) {
          return image.width != first.width || image.height != first.height;
        });
    if (other == recording.images.end()) {
      return;
    }
    const auto count = static_cast<std::size_t>(other - recording.images.begin());
    end_early(recording, count,
              "from frame " + std::to_string(count + 1) + " on the depth images are " +
                  size_text(other->width, other->height) +
                  ", for which the camera calibration is not");
    leave_out_other_streams(recording);
    payloads = OniPayloadChecker(recording);
  }

  /// That of the next frame.
  PinholeCamera camera() const {
    const OniImage& image = recording.images[delivered];
    return angles ? camera_of(*angles, image.width, image.height)
                  : PinholeCamera{image.width, image.height, 0, 0, 0, 0};
  }

  ~Impl() { close(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Measured: this order and the pause keep OpenNI2's player thread from using a stream that is
  /// being destroyed.
  void close() {
    depth.stop();
    std::this_thread::sleep_for(30ms);
    depth.destroy();
    device.close();
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw DeviceError(recording.file.string() + ": OpenNI2 " + problem);
  }

  void open() {
    const Alias alias(recording);
    if (device.open(alias.path().c_str()) != openni::STATUS_OK ||
        depth.create(device, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
      fail("cannot open this recording: " + openni_error());
    }
    if (device.getPlaybackControl()->getNumberOfFrames(depth) !=
        static_cast<int>(recording.frame_count)) {
      fail("understands this recording differently than its validator");
    }
    angles = field_of_view(depth);
  }

  /// Repeating stays on, although nothing is played twice: switching it off makes the player spin
  /// and crash at the end of the file. Manual speed (-1) waits for the consumer at every frame.
  void start() {
    if (device.getPlaybackControl()->setSpeed(-1.0F) != openni::STATUS_OK ||
        depth.start() != openni::STATUS_OK) {
      fail("cannot play this recording: " + openni_error());
    }
  }

  /// Checks what the player decodes next, one frame ahead. When an image of another stream is
  /// damaged, it plays on with a copy of the depth. Returns false if it was told to stop.
  bool check_ahead() {
    const bool is_open = device.isValid();
    const std::size_t frame = delivered + (is_open ? 2 : 1);
    if (payloads.check_through(frame)) {
      end_where_sizes_change();
      return true;
    }
    leave_out_other_streams(recording);
    payloads = OniPayloadChecker(recording);
    payloads.check_through(frame);
    end_where_sizes_change();
    return !is_open || begin_again();
  }

  /// What the player makes of such images is never asked for.
  void end_where_sizes_change() {
    const bool is_new = recording.end_reason.empty() && !payloads.end_reason().empty();
    if (is_new) {
      end_early(recording, payloads.frame_count(), payloads.end_reason());
    }
    if (is_new && device.isValid()) {
      say_end();
    }
  }

  /// What was delivered comes once more, and is passed over when the next frame is read.
  bool begin_again() {
    close();
    open();
    start();
    return true;
  }

  /// Returns false if it was told to stop. Where the processor is so busy that a wait ends before
  /// the player's thread has run, the player is poked twice, and a frame is lost: then all begins
  /// again.
  bool read(std::size_t number, openni::VideoFrameRef& frame) {
    std::size_t taken = 0;
    for (int tries = 0; tries < kTries; ++tries) {
      if (tries > 0) begin_again();
      for (taken = 0; taken < number;) {
        const std::size_t before = taken;
        if (!take(number, frame)) return false;
        taken = static_cast<std::size_t>(frame.getFrameIndex());
        if (taken == number) return true;
        if (taken <= before) break;  // from the end it goes on at the beginning
      }
    }
    fail("delivered frame " + std::to_string(taken) + " instead of frame " +
         std::to_string(number) + "; is the machine too busy?");
  }

  /// The player's next frame. Returns false if it was told to stop.
  bool take(std::size_t number, openni::VideoFrameRef& frame) {
    for (int slice = 0; !wait_for_frame(depth, kSliceMilliseconds); ++slice) {
      if (stop && stop()) {
        return false;
      }
      if (slice == kSlices) {
        fail("does not deliver frame " + std::to_string(number));
      }
    }
    if (depth.readFrame(&frame) != openni::STATUS_OK) {
      fail("cannot read frame " + std::to_string(number) + ": " + openni_error());
    }
    return true;
  }

  OniRecording recording;
  OniPayloadChecker payloads;
  Rectification rectification;
  std::function<bool()> stop;
  std::function<void(const std::string&)> warn;
  openni::Device device;
  openni::VideoStream depth;
  std::optional<FieldOfView> angles;
  std::size_t delivered = 0;
};

OniPlayer::OniPlayer(const std::filesystem::path& file, const SourceOptions& options)
    : impl_(std::make_unique<Impl>(file, options)) {}

OniPlayer::~OniPlayer() = default;

bool OniPlayer::next(DepthFrame& frame) {
  if (impl_->delivered == impl_->recording.frame_count) {
    return false;
  }
  openni::VideoFrameRef read;
  if (!impl_->check_ahead() || !impl_->read(impl_->delivered + 1, read)) {
    return false;
  }
  frame.camera = impl_->camera();
  copy_frame(read, impl_->recording.images[impl_->delivered].mirrored, file_of_frame(), frame);
  frame.index = impl_->delivered++;
  impl_->rectification.apply(frame);
  return true;
}

std::optional<std::size_t> OniPlayer::frame_count() const {
  return impl_->recording.frame_count;
}

std::string OniPlayer::file_of_frame() const {
  return impl_->recording.file.string();
}

std::string OniPlayer::description() const {
  const OniImage& image = impl_->recording.images.front();
  const auto whole = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  return "OpenNI2 recording " + impl_->recording.file.string() +
         (image.mirrored ? ", recorded mirrored" : "") +
         (image.recorded_pixels() < whole ? ", cropped" : "");
}

}  // namespace lockbox
