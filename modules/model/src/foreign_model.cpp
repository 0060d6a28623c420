// SPDX-License-Identifier: BSD-3-Clause
#include "foreign_model.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "lockbox/core/file_kind.hpp"

namespace lockbox {
namespace {

using namespace std::string_view_literals;

constexpr char kToMesh[] = "convert it to .obj, .stl or .ply, for instance with Blender";
constexpr char kCadToMesh[] = "export it as .stl, for instance with FreeCAD";
constexpr char kToUrdf[] = "convert it to a URDF";
constexpr char kAsSource[] = "give it with --source";
constexpr char kBesideIt[] = "give the URDF, or the .obj, .stl or .ply file";

/// A mesh is known by its extension: under another one it comes here.
constexpr std::array kKinds{
    FileKind{"NI10"sv, ".oni ", "a recording of OpenNI", kAsSource},
    FileKind{"# .PCD"sv, ".pcd ", "a cloud", "give the folder that holds it with --source"},
    FileKind{"\x89PNG"sv, ".png ", "an image", kBesideIt},
    FileKind{"\xff\xd8\xff"sv, ".jpg .jpeg ", "an image", kBesideIt},
    FileKind{"glTF"sv, ".gltf .glb ", "a glTF mesh", kToMesh},
    FileKind{"Kaydara FBX"sv, ".fbx ", "an FBX mesh", kToMesh},
    FileKind{"BLENDER"sv, ".blend ", "a scene of Blender",
             "export it from there as .obj, .stl or .ply"},
    FileKind{"#usda"sv, ".usda .usd .usdz ", "a USD scene", kToMesh},
    FileKind{"PXR-USDC"sv, ".usdc ", "a USD scene", kToMesh},
    FileKind{"OFF\n"sv, ".off ", "an OFF mesh", kToMesh},
    FileKind{"#VRML"sv, ".wrl ", "a VRML scene", kToMesh},
    FileKind{"ISO-10303"sv, ".step .stp ", "a STEP drawing", kCadToMesh},
    FileKind{"PK\x03\x04"sv, ".zip .3mf .fcstd ", "an archive, or of a kind that is one", kToMesh},
    FileKind{"ply\n"sv, "", "a PLY mesh", "end its name with .ply"},
    FileKind{"ply\r"sv, "", "a PLY mesh", "end its name with .ply"},
    FileKind{"solid "sv, "", "an STL mesh", "end its name with .stl"},
    FileKind{"v "sv, "", "an OBJ mesh", "end its name with .obj"},
    FileKind{"mtllib "sv, "", "an OBJ mesh", "end its name with .obj"},
    FileKind{""sv, ".dae ", "a COLLADA mesh", kToMesh},
    FileKind{""sv, ".3ds .x3d .lwo .max .ma .mb .abc ", "a mesh of another kind", kToMesh},
    FileKind{""sv, ".iges .igs .sldprt .sldasm .ipt .iam .f3d .dwg .dxf .brep ", "a CAD drawing",
             kCadToMesh},
    FileKind{""sv, ".bag .db3 .mcap .mkv .mp4 .avi ", "a recording", kBesideIt},
    FileKind{""sv, ".yaml .yml .json .csv .txt .tum .md .ini ", "a text of another kind",
             kBesideIt},
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
  if (may_be_xml(first_bytes(file))) return std::nullopt;
  const FileKind* const kind = find_kind(file, kKinds);
  if (kind == nullptr) return std::nullopt;
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
