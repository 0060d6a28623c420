// SPDX-License-Identifier: BSD-3-Clause
#include "foreign_states.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "lockbox/core/file_kind.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

using namespace std::string_view_literals;

constexpr char kOfARun[] = "give the states.csv of a run, or a groundtruth.csv";
constexpr char kToText[] = "write its numbers as text, in columns timestamp,tx,ty,tz,qx,qy,qz,qw";
constexpr char kToTum[] = "convert it to a TUM trajectory, for instance with evo_traj of evo";

constexpr std::array kOtherKinds{
    FileKind{"NI10"sv, ".oni ", "a recording of OpenNI", kOfARun},
    FileKind{"# .PCD"sv, ".pcd ", "a cloud", kOfARun},
    FileKind{"\x89PNG"sv, ".png ", "an image", kOfARun},
    FileKind{"\xff\xd8\xff"sv, ".jpg .jpeg ", "an image", kOfARun},
    FileKind{"#ROSBAG"sv, ".bag .db3 .mcap ", "a ROS bag", kToTum},
    FileKind{"\x93NUMPY"sv, ".npy .npz ", "an array of NumPy", kToText},
    FileKind{"\x89HDF"sv, ".h5 .hdf5 ", "an HDF5 file", kToText},
    FileKind{"MATLAB"sv, ".mat ", "a file of MATLAB", kToText},
    FileKind{"PK\x03\x04"sv, ".xlsx .ods .zip ", "a spreadsheet, or another archive", kToText},
    FileKind{"<"sv, ".urdf .xml .xacro ", "an XML text", kOfARun},
    FileKind{"{"sv, ".json ", "a JSON text", kToText},
    FileKind{"#timestamp [ns]"sv, "", "a trajectory in the manner of EuRoC", kToTum},
    FileKind{""sv, ".yaml .yml ", "a YAML text", kOfARun},
};

/// How many numbers the first line that is no comment holds, blanks between them; 0 if it holds
/// anything else.
std::size_t numbers_in_first_line(std::span<const std::string_view> lines) {
  const auto line = std::find_if(lines.begin(), lines.end(), [](std::string_view text) {
    return !text.empty() && text.front() != '#';
  });
  if (line == lines.end()) return 0;
  std::istringstream words{std::string(*line)};
  std::size_t count = 0;
  for (std::string word; words >> word; ++count) {
    if (!parse_number(word)) return 0;
  }
  return count;
}

std::string text_of(const char* what, const char* advice) {
  return std::string("is ") + what + ", not a states file; " + advice;
}

}  // namespace

std::optional<std::string> foreign_states(const std::filesystem::path& file,
                                          std::span<const std::string_view> lines) {
  constexpr std::size_t kTum = 8;     // time, position, quaternion
  constexpr std::size_t kKitti = 12;  // the upper rows of a matrix
  const std::size_t numbers = numbers_in_first_line(lines);
  if (numbers == kTum) {
    return text_of("a TUM trajectory",
                   "put commas between its numbers, the header timestamp,tx,ty,tz,qx,qy,qz,qw "
                   "before them, and a column for each joint behind them");
  }
  if (numbers == kKitti) return text_of("a trajectory in the manner of KITTI", kToTum);
  const FileKind* const kind = find_kind(file, kOtherKinds);
  if (kind == nullptr) return std::nullopt;
  return text_of(kind->what, kind->advice);
}

}  // namespace lockbox
