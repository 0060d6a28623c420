// SPDX-License-Identifier: BSD-3-Clause
#include "foreign_source.hpp"

#include <array>
#include <string_view>

#include "lockbox/core/component.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/file_kind.hpp"

namespace lockbox {
namespace {

using namespace std::string_view_literals;

constexpr char kToDepthFolder[] =
    "convert its depth images to a folder with 16-bit grey PNG images, listed in a depth.txt, and "
    "a "
    "camera_info.yaml (docs/recordings.md)";
constexpr char kBagAdvice[] =
    "convert its depth topic to a folder with 16-bit grey PNG images, listed in a depth.txt, and "
    "its camera_info topic to a camera_info.yaml (docs/recordings.md); or its organized clouds "
    "to "
    "a folder of .pcd files (bag_to_pcd of the ROS package pcl_ros)";

/// Those with first bytes stand before those that others might share.
constexpr std::array kKinds{
    FileKind{"#ROSBAG V"sv, ".bag ", "a ROS 1 bag", kBagAdvice},
    FileKind{"\x89MCAP"sv, ".mcap ", "a ROS 2 bag (MCAP)", kBagAdvice},
    FileKind{"SQLite format 3"sv, ".db3 ", "a ROS 2 bag (SQLite)", kBagAdvice},
    FileKind{"\x1a\x45\xdf\xa3"sv, ".mkv .webm ",
             "a Matroska video, as the Azure Kinect's recorder writes",
             "convert its depth track to a folder with 16-bit grey PNG images (Open3D's "
             "azure_kinect_mkv_reader does), list them in a depth.txt, and add a camera_info.yaml "
             "(docs/recordings.md)"},
    FileKind{"# .PCD"sv, ".pcd ", "a single cloud",
             "give the folder that holds it: all its .pcd files are the sequence"},
    FileKind{
        "ply\n"sv, ".ply ", "a PLY file",
        "convert organized clouds with pcl_ply2pcd, and give the folder that holds the .pcd files"},
    FileKind{"\x89PNG"sv, ".png ", "a single image",
             "give the folder that holds a depth.txt, which lists the images (docs/recordings.md)"},
    FileKind{"\xff\xd8\xff"sv, ".jpg .jpeg ", "a JPEG image",
             "colours do not tell depth; give a folder with 16-bit grey PNG images of depth"},
    FileKind{"\x89HDF"sv, ".h5 .hdf5 ", "an HDF5 file", kToDepthFolder},
    FileKind{
        "PK\x03\x04"sv, ".zip .npz ", "an archive",
        "unpack it; a source is a folder or a .oni file, arrays have to be converted to images"},
    FileKind{"\x1f\x8b"sv, ".gz .tgz ", "an archive",
             "unpack it; a source is a folder or a .oni file"},
    FileKind{"RIFF"sv, ".avi ", "a video",
             "videos of colour hold no depth, and compressed ones not exactly; convert depth to a "
             "folder with 16-bit grey PNG images"},
    FileKind{""sv, ".mp4 .mov .m4v .mpg .mpeg .wmv ", "a video",
             "videos of colour hold no depth, and compressed ones not exactly; convert depth to a "
             "folder with 16-bit grey PNG images"},
    FileKind{""sv, ".klg ", "a recording of Logger2 (Kintinuous, ElasticFusion)", kToDepthFolder},
    FileKind{""sv, ".xef .xrf ", "a recording of Kinect Studio", kToDepthFolder},
    FileKind{""sv, ".svo .svo2 ", "a recording of a ZED camera", kToDepthFolder},
    FileKind{""sv, ".sens ", "a ScanNet recording", kToDepthFolder},
    FileKind{""sv, ".rrf ", "a recording of a pmd camera", kToDepthFolder},
    FileKind{""sv, ".npy .mat .raw .bin .exr .tif .tiff .pgm .bmp ", "an array or a single image",
             kToDepthFolder},
    FileKind{""sv, ".tar .xz .bz2 .7z .rar ", "an archive",
             "unpack it; a source is a folder or a .oni file"},
    FileKind{""sv, ".urdf .xacro .obj .stl .dae ", "a model",
             "give it with --model, not as a source"},
    FileKind{""sv, ".txt .yaml .yml .json .csv ", "a text",
             "give the folder that holds depth.txt, camera_info.yaml and the images"},
};

}  // namespace

std::optional<std::string> foreign_file(const std::filesystem::path& file) {
  if (!is_file(file)) {
    return std::nullopt;
  }
  if (first_bytes(file).starts_with("NI10")) {
    return std::nullopt;
  }
  const FileKind* const kind = find_kind(file, kKinds);
  if (kind == nullptr) {
    return std::nullopt;
  }
  return std::string("is ") + kind->what + ", not a recording of OpenNI; " +
         with_documents(kind->advice, &kKinds);
}

std::string foreign_folder(const std::filesystem::path& folder) {
  std::string text =
      "this folder holds neither a depth.txt (a depth image sequence) nor .pcd files";
  if (is_there(folder / "metadata.yaml")) {
    return text + "; it looks like a ROS 2 bag: " + with_documents(kBagAdvice, &kKinds);
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string extension = lower_extension(entry.path());
    const std::string name = entry.path().filename().string();
    if (extension == ".png") {
      return text + ", but images (" + name +
             "); list them in a depth.txt, a line `timestamp filename` for each";
    }
    if (extension == ".oni") {
      return text + ", but recordings; give one of them, such as " + entry.path().string();
    }
    if (extension == ".ply") {
      return text + ", but PLY files (" + name + "); convert organized clouds with pcl_ply2pcd";
    }
    if (entry.is_directory() && is_there(entry.path() / "depth.txt")) {
      return text + "; the folder " + name + " in it does: give that one";
    }
  }
  return text;
}

}  // namespace lockbox
