// SPDX-License-Identifier: BSD-3-Clause
// openni1-recorder FILE FRAMES finish|abort mirrored|straight|turned|cropped|halved|doubled NODE...
//
// Records synthetic frames of nodes like depth:16zT, image:JPEG, ir:NONE, in this order, with the
// recorder of OpenNI 1; a program of its own, as the libraries of OpenNI 1 and 2 are not made for
// one process. With abort it ends like one that crashed, before the file is finished; turned is
// straight, and mirrored from the third frame on; cropped is cropped from there on, in halved and
// doubled the images are half and twice as large from there on.
#include <XnCppWrapper.h>
#include <XnPropNames.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "synthetic_frames.hpp"

namespace lockbox {
namespace {

PinholeCamera large_images() {
  return {64, 48, 60.0, 60.0, 31.5, 23.5};
}

constexpr int kFirstChanged = 2;

PinholeCamera camera_at(int number, const std::string& manner) {
  return manner == (number < kFirstChanged ? "halved" : "doubled") ? large_images() : tiny_camera();
}

XnCropping cropped_region() {
  return {.bEnabled = 1, .nXOffset = 5, .nYOffset = 3, .nXSize = 20, .nYSize = 17};
}

DepthFrame part_of(const DepthFrame& whole, const XnCropping& region) {
  DepthFrame part = whole;
  part.depth.clear();
  for (int v = 0; v < region.nYSize; ++v) {
    const auto row = whole.depth.begin() + (region.nYOffset + v) * whole.camera.width;
    part.depth.insert(part.depth.end(), row + region.nXOffset,
                      row + region.nXOffset + region.nXSize);
  }
  return part;
}

void require(XnStatus status) {
  if (status != XN_STATUS_OK) {
    throw std::runtime_error(xnGetStatusString(status));
  }
}

XnCodecID codec_of(const std::string& name) {
  return XN_CODEC_ID(name[0], name[1], name[2], name[3]);
}

/// What all kinds of nodes have.
class Node {
 public:
  explicit Node(const std::string& codec) : codec_(codec_of(codec)) {}
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  virtual xn::MapGenerator& generator() = 0;
  virtual void set_data(XnUInt32 frame, const DepthFrame& depth) = 0;

  void set_mode(const PinholeCamera& camera) {
    const XnMapOutputMode mode{static_cast<XnUInt32>(camera.width),
                               static_cast<XnUInt32>(camera.height), 30};
    require(generator().SetGeneralProperty(XN_PROP_MAP_OUTPUT_MODE, sizeof(mode), &mode));
  }

  void set_cropping(const XnCropping& cropping) {
    require(generator().SetGeneralProperty(XN_PROP_CROPPING, sizeof(cropping), &cropping));
  }

  void change(const std::string& manner) {
    if (manner == "turned") {
      require(generator().SetIntProperty(XN_PROP_MIRROR, 1));
    } else if (manner == "cropped") {
      set_cropping(cropped_region());
    } else if (manner == "halved" || manner == "doubled") {
      set_mode(camera_at(kFirstChanged, manner));
    }
  }

  void prepare(const std::string& manner) {
    xn::MapGenerator& node = generator();
    for (const char* const capability :
         {XN_CAPABILITY_MIRROR, XN_CAPABILITY_CROPPING, XN_CAPABILITY_EXTENDED_SERIALIZATION}) {
      require(node.SetIntProperty(capability, 1));
    }
    const XnMapOutputMode mode{32, 24, 30};
    require(node.SetIntProperty(XN_PROP_SUPPORTED_MAP_OUTPUT_MODES_COUNT, 1));
    require(node.SetGeneralProperty(XN_PROP_SUPPORTED_MAP_OUTPUT_MODES, sizeof(mode), &mode));
    set_mode(camera_at(0, manner));
    set_cropping({});
    require(node.SetIntProperty(XN_PROP_MIRROR, manner == "mirrored" ? 1 : 0));
    prepare_kind();
    require(node.SetIntProperty(XN_PROP_STATE_READY, 1));
    require(node.StartGenerating());
  }

  void add_to(xn::Recorder& recorder) { require(recorder.AddNodeToRecording(generator(), codec_)); }

 private:
  virtual void prepare_kind() {}

  XnCodecID codec_;
};

class Depth : public Node {
 public:
  Depth(xn::Context& context, const std::string& codec) : Node(codec) {
    require(node_.Create(context, "Depth"));
  }
  xn::MapGenerator& generator() override { return node_; }
  void set_data(XnUInt32 frame, const DepthFrame& depth) override {
    require(node_.SetData(frame, stamp(depth), size(depth), depth.depth.data()));
  }

  static XnUInt64 stamp(const DepthFrame& depth) {
    return static_cast<XnUInt64>(depth.stamp * 1e6 + 1.5);  // 0 would be no time
  }
  static XnUInt32 size(const DepthFrame& depth) {
    return static_cast<XnUInt32>(depth.depth.size() * sizeof(XnDepthPixel));
  }

 private:
  void prepare_kind() override {
    const XnFieldOfView field_of_view{0.98, 0.76};
    require(node_.SetIntProperty(XN_PROP_DEVICE_MAX_DEPTH, 10000));
    require(node_.SetGeneralProperty(XN_PROP_FIELD_OF_VIEW, sizeof(field_of_view), &field_of_view));
  }

  xn::MockDepthGenerator node_;
};

class Image : public Node {
 public:
  Image(xn::Context& context, const std::string& codec) : Node(codec), is_grey_(codec == "Im8z") {
    require(node_.Create(context, "Image"));
  }
  xn::MapGenerator& generator() override { return node_; }
  void set_data(XnUInt32 frame, const DepthFrame& depth) override {
    std::vector<XnUInt8> pixels;
    for (const std::uint16_t value : depth.depth) {
      pixels.insert(pixels.end(), is_grey_ ? 1 : 3, static_cast<XnUInt8>(value >> 4));
    }
    require(node_.SetData(frame, Depth::stamp(depth), static_cast<XnUInt32>(pixels.size()),
                          pixels.data()));
  }

 private:
  void prepare_kind() override {
    const XnSupportedPixelFormats formats{1, 0, 1, 0, 0, 0, 0};
    require(node_.SetGeneralProperty(XN_PROP_SUPPORTED_PIXEL_FORMATS, sizeof(formats), &formats));
    require(node_.SetIntProperty(
        XN_PROP_PIXEL_FORMAT, is_grey_ ? XN_PIXEL_FORMAT_GRAYSCALE_8_BIT : XN_PIXEL_FORMAT_RGB24));
  }

  bool is_grey_;
  xn::MockImageGenerator node_;
};

class Infrared : public Node {
 public:
  Infrared(xn::Context& context, const std::string& codec) : Node(codec) {
    require(node_.Create(context, "IR"));
  }
  xn::MapGenerator& generator() override { return node_; }
  void set_data(XnUInt32 frame, const DepthFrame& depth) override {
    require(node_.SetData(frame, Depth::stamp(depth), Depth::size(depth), depth.depth.data()));
  }

 private:
  xn::MockIRGenerator node_;
};

std::unique_ptr<Node> make_node(xn::Context& context, const std::string& kind_and_codec) {
  const std::size_t colon = kind_and_codec.find(':');
  const std::string kind = kind_and_codec.substr(0, colon);
  const std::string codec = kind_and_codec.substr(colon + 1);
  if (kind == "depth") {
    return std::make_unique<Depth>(context, codec);
  }
  if (kind == "image") {
    return std::make_unique<Image>(context, codec);
  }
  return std::make_unique<Infrared>(context, codec);
}

void record(const std::vector<std::string>& arguments) {
  xn::Context context;
  require(context.Init());
  xn::Recorder recorder;
  require(recorder.Create(context));
  require(recorder.SetDestination(XN_RECORD_MEDIUM_FILE, arguments[0].c_str()));
  std::vector<std::unique_ptr<Node>> nodes;
  for (std::size_t i = 4; i < arguments.size(); ++i) {
    nodes.push_back(make_node(context, arguments[i]));
    nodes.back()->prepare(arguments[3]);
    nodes.back()->add_to(recorder);
  }
  const int frames = std::stoi(arguments[1]);
  for (int number = 0; number < frames; ++number) {
    DepthFrame frame =
        synthetic_frame(static_cast<std::uint64_t>(number), camera_at(number, arguments[3]));
    if (arguments[3] == "cropped" && number >= kFirstChanged) {
      frame = part_of(frame, cropped_region());
    }
    for (const auto& node : nodes) {
      if (number == kFirstChanged) {
        node->change(arguments[3]);
      }
      node->set_data(static_cast<XnUInt32>(number) + 1, frame);
    }
    require(context.WaitNoneUpdateAll());
    require(recorder.Record());
  }
  if (arguments[2] == "abort") {
    std::fflush(nullptr);  // OpenNI buffers, as most programs do
  } else {
    recorder.Release();
  }
  std::_Exit(0);
}

}  // namespace
}  // namespace lockbox

int main(int argc, char** argv) {
  try {
    lockbox::record({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "openni1-recorder: " << error.what() << '\n';
  }
  return 1;
}
