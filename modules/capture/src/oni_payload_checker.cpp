// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>

#include "lockbox/capture/oni_validator.hpp"
#include "lockbox/core/error.hpp"
#include "oni_payloads.hpp"
#include "payload_checks.hpp"

namespace lockbox {
namespace {

/// The number of pixels of a depth image that is sound; nothing if it is damaged.
std::optional<std::size_t> sound_pixels(std::ifstream& file, const OniPayload& payload) {
  const std::string_view codec(payload.codec.data(), payload.codec.size());
  if (codec == "NONE") {
    return payload.size % sizeof(std::uint16_t) == 0
               ? std::optional<std::size_t>(payload.size / sizeof(std::uint16_t))
               : std::nullopt;
  }
  std::vector<std::uint8_t> buffer(payload.size);
  file.seekg(static_cast<std::streamoff>(payload.offset));
  file.read(reinterpret_cast<char*>(buffer.data()), static_cast<std::streamsize>(payload.size));
  return file ? sound_pixels_16z(buffer, codec == "16zT") : std::nullopt;
}

}  // namespace

std::optional<std::string> find_damage(std::ifstream& file, const OniPayload& payload,
                                       std::vector<std::uint8_t>& buffer) {
  const std::string_view codec(payload.codec.data(), payload.codec.size());
  buffer.resize(payload.size);
  file.seekg(static_cast<std::streamoff>(payload.offset));
  file.read(reinterpret_cast<char*>(buffer.data()), static_cast<std::streamsize>(payload.size));
  if (!file) {
    return "it cannot be read any more";
  }
  if (codec == "JPEG") {
    return find_damage_jpeg(buffer, payload.pixels);
  }
  if (codec != "NONE") {
    return find_damage_16z(buffer, payload.pixels, codec == "16zT");
  }
  if (payload.depth && buffer.size() != payload.pixels * 2) {
    return "the image has the wrong size";
  }
  return std::nullopt;
}

OniPayloadChecker::OniPayloadChecker(const OniRecording& recording)
    : recording_(recording), stream_(recording.file, std::ios::binary) {}

bool OniPayloadChecker::check_through(std::size_t frame) {
  for (; next_ < recording_.payloads.size(); ++next_) {
    const OniPayload& payload = recording_.payloads[next_];
    if (payload.depth && payload.frame > frame) {
      return true;
    }
    const std::optional<std::string> damage = find_damage(stream_, payload, buffer_);
    if (damage && payload.depth && begins_another_size(payload)) {
      next_ = recording_.payloads.size();
      return true;
    }
    if (damage && payload.depth) {
      throw InputError(recording_.file.string(), "frame " + std::to_string(payload.frame) +
                                                     " is damaged, at byte " +
                                                     std::to_string(payload.offset) + ": " +
                                                     *damage + "; copy or record it again");
    }
    if (damage) {
      return false;
    }
  }
  return true;
}

bool OniPayloadChecker::begins_another_size(const OniPayload& payload) {
  const auto following =
      std::find_if(recording_.payloads.begin() + static_cast<std::ptrdiff_t>(next_) + 1,
                   recording_.payloads.end(), [](const OniPayload& other) { return other.depth; });
  const std::optional<std::size_t> pixels = sound_pixels(stream_, payload);
  if (!pixels || *pixels == payload.pixels || following == recording_.payloads.end() ||
      sound_pixels(stream_, *following) != pixels) {
    return false;
  }
  frame_count_ = payload.frame - 1;
  end_reason_ = "from frame " + std::to_string(payload.frame) + " on the depth images have " +
                std::to_string(*pixels) + " pixels instead of " + std::to_string(payload.pixels) +
                ", and the recording does not tell of which part of the view";
  return true;
}

}  // namespace lockbox
