// SPDX-License-Identifier: BSD-3-Clause
#include "foreign_model.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string_view>

namespace lockbox {
namespace {

using namespace std::string_view_literals;

constexpr char kToMesh[] = "convert it to .obj, .stl or .ply, for instance with Blender";
constexpr char kCadToMesh[] = "export it as .stl, for instance with FreeCAD";
constexpr char kToUrdf[] = "convert it to a URDF";
constexpr char kAsSource[] = "give it with --source";
constexpr char kBesideIt[] = "give the URDF, or the .obj, .stl or .ply file";

struct Kind {
  std::string_view magic;       ///< first bytes; empty: only the extension tells
  std::string_view extensions;  ///< each with a blank behind it
  const char* what;
  const char* advice;
};

/// A mesh is known by its extension: under another one it comes here.
constexpr std::array kKinds{
    Kind{"NI10"sv, ".oni ", "a recording of OpenNI", kAsSource},
    Kind{"# .PCD"sv, ".pcd ", "a cloud", "give the folder that holds it with --source"},
    Kind{"\x89PNG"sv, ".png ", "an image", kBesideIt},
    Kind{"\xff\xd8\xff"sv, ".jpg .jpeg ", "an image", kBesideIt},
    Kind{"glTF"sv, ".gltf .glb ", "a glTF mesh", kToMesh},
    Kind{"Kaydara FBX"sv, ".fbx ", "an FBX mesh", kToMesh},
    Kind{"BLENDER"sv, ".blend ", "a scene of Blender",
         "export it from there as .obj, .stl or .ply"},
    Kind{"#usda"sv, ".usda .usd .usdz ", "a USD scene", kToMesh},
    Kind{"PXR-USDC"sv, ".usdc ", "a USD scene", kToMesh},
    Kind{"OFF\n"sv, ".off ", "an OFF mesh", kToMesh},
    Kind{"#VRML"sv, ".wrl ", "a VRML scene", kToMesh},
    Kind{"ISO-10303"sv, ".step .stp ", "a STEP drawing", kCadToMesh},
    Kind{"PK\x03\x04"sv, ".zip .3mf .fcstd ", "an archive, or of a kind that is one", kToMesh},
    Kind{"ply\n"sv, "", "a PLY mesh", "end its name with .ply"},
    Kind{"ply\r"sv, "", "a PLY mesh", "end its name with .ply"},
    Kind{"solid "sv, "", "an STL mesh", "end its name with .stl"},
    Kind{"v "sv, "", "an OBJ mesh", "end its name with .obj"},
    Kind{"mtllib "sv, "", "an OBJ mesh", "end its name with .obj"},
    Kind{""sv, ".dae ", "a COLLADA mesh", kToMesh},
    Kind{""sv, ".3ds .x3d .lwo .max .ma .mb .abc ", "a mesh of another kind", kToMesh},
    Kind{""sv, ".iges .igs .sldprt .sldasm .ipt .iam .f3d .dwg .dxf .brep ", "a CAD drawing",
         kCadToMesh},
    Kind{""sv, ".bag .db3 .mcap .mkv .mp4 .avi ", "a recording", kBesideIt},
    Kind{""sv, ".yaml .yml .json .csv .txt .tum .md .ini ", "a text of another kind", kBesideIt},
};

struct Root {
  std::string_view element;
  const char* what;
  const char* advice;
};

constexpr std::array kRoots{Root{"sdf"sv, "an SDF model, as Gazebo reads", kToUrdf},
                            Root{"mujoco"sv, "a model of MuJoCo", kToUrdf},
                            Root{"COLLADA"sv, "a COLLADA mesh", kToMesh},
                            Root{"svg"sv, "a picture", kBesideIt}};

std::string first_bytes(const std::filesystem::path& file) {
  std::string bytes(16, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

/// Whatever its name, a file with a blank or a `<` in front is probably XML, which is looked into.
bool may_be_xml(const std::string& bytes) {
  const auto is_blank = [](unsigned char c) { return std::isspace(c) != 0; };
  const std::size_t mark = bytes.starts_with("\xef\xbb\xbf") ? 3 : 0;
  const auto first =
      std::find_if_not(bytes.begin() + static_cast<std::ptrdiff_t>(mark), bytes.end(), is_blank);
  return first == bytes.end() || *first == '<';
}

}  // namespace

std::optional<std::string> foreign_model(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  const std::string bytes = first_bytes(file);
  if (may_be_xml(bytes)) return std::nullopt;
  const std::string extension = lower_extension(file) + ' ';
  const auto begins = [&bytes](const Kind& kind) {
    return !kind.magic.empty() && bytes.starts_with(kind.magic);
  };
  const auto is_named = [&extension](const Kind& kind) {
    return extension.size() > 1 && kind.extensions.find(extension) != std::string_view::npos;
  };
  const auto* kind = std::find_if(kKinds.begin(), kKinds.end(), begins);
  if (kind == kKinds.end()) kind = std::find_if(kKinds.begin(), kKinds.end(), is_named);
  if (kind == kKinds.end()) return std::nullopt;
  return std::string("is ") + kind->what + ", not a model; " + kind->advice;
}

std::string foreign_root(const std::string& element) {
  const auto* root = std::find_if(kRoots.begin(), kRoots.end(), [&element](const Root& candidate) {
    return candidate.element == element;
  });
  if (root == kRoots.end()) return "";
  return std::string("; it is ") + root->what + ": " + root->advice;
}

}  // namespace lockbox
