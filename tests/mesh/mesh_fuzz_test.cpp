// SPDX-License-Identifier: BSD-3-Clause
// Files changed at random are loaded or refused; no memory is taken for what they only claim.
// LOCKBOX_FUZZ_ROUNDS and LOCKBOX_FUZZ_SEED make it longer, and another.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <cstdlib>
#include <random>

#include "lockbox/core/error.hpp"
#include "lockbox/mesh/load_mesh.hpp"
#include "mesh_files.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

unsigned number_from_environment(const char* name, unsigned usual) {
  const char* text = std::getenv(name);
  return text != nullptr ? static_cast<unsigned>(std::strtoul(text, nullptr, 10)) : usual;
}

struct Seed {
  const char* name;
  std::string content;
};

std::vector<Seed> seeds() {
  return {{"a.obj", box_as_obj()},
          {"b.obj",
           "\xEF\xBB\xBFmtllib a.mtl\nv 0 0 0 1 1 1\nv 1 0 \\\n 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
           "vt 0 0\nvn 0 0 1\ng a b\nf 1/1/1 2//1 3/1 4\nf -5 -1 -4\ncstype bspline\nl 1 2\n"},
          {"a.stl", box_as_text_stl()},
          {"b.stl", box_as_binary_stl()},
          {"a.ply", box_as_text_ply()},
          {"b.ply", box_as_binary_ply()},
          {"c.ply",
           "ply\nformat ascii 1.0\nelement tag 2\nproperty list uchar double values\n"
           "element face 2\nproperty list int uint vertex_index\nproperty uchar red\n"
           "element vertex 4\nproperty double z\nproperty float y\nproperty short x\n"
           "end_header\n2 0.5 1\n0\n3 0 1 2 9\n4 3 2 1 0 9\n0 0 0\n0 0 1\n0 1 1\n0 1 0\n"}};
}

/// Changes a text in the ways in which files go bad, and in those that readers die of.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  std::string mutated(std::string text, const std::string& other) {
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
      const std::size_t at = below(text.size() + 1);
      switch (below(7)) {
        case 0:
          if (at < text.size()) text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.resize(at);
          break;
        case 2:
          text.erase(at, 1 + below(20));
          break;
        case 3:
          text.insert(at, text.substr(below(text.size()), below(60)));
          break;
        case 4:
          text.insert(at, other.substr(below(other.size()), below(60)));
          break;
        case 5:
          text.insert(at, word());
          break;
        default:
          replace_number(text, at);
          break;
      }
    }
    return text;
  }

 private:
  std::string word() {
    static const std::array<std::string, 24> kWords = {"\n",
                                                       "\r",
                                                       "\r\n",
                                                       " ",
                                                       "\\\n",
                                                       "#",
                                                       "\f",
                                                       "-1",
                                                       "0",
                                                       "4294967295",
                                                       "4294967296",
                                                       "1e999",
                                                       "nan",
                                                       "-inf",
                                                       "1e300",
                                                       "solid",
                                                       "endsolid",
                                                       "element face 3\n",
                                                       "property list uchar int vertex_indices\n",
                                                       "property double x\n",
                                                       "end_header\n",
                                                       "\xff\xff\xff\x7f",
                                                       "f 1 2 3 1\n",
                                                       "v 0 0 1\n"};
    return kWords[below(kWords.size())];
  }

  void replace_number(std::string& text, std::size_t at) {
    const std::size_t begin = text.find_first_of("0123456789", at);
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_not_of("0123456789", begin), text.size());
    text.replace(begin, end - begin, word());
  }

  std::mt19937 random_;
};

void expect_sound(const TriangleMesh& mesh) {
  EXPECT_FALSE(mesh.triangles.empty());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      ASSERT_LT(vertex, mesh.vertices.size());
      ASSERT_TRUE(mesh.vertices[vertex].allFinite());
    }
  }
}

long most_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST(MeshFuzz, ChangedFilesAreLoadedOrRefused) {
  const unsigned rounds = number_from_environment("LOCKBOX_FUZZ_ROUNDS", 400);
  Mutator mutator(number_from_environment("LOCKBOX_FUZZ_SEED", 7));
  const std::vector<Seed> files = seeds();
  TemporaryFolder folder;
  const long before = most_kilobytes();
  unsigned loaded = 0;
  unsigned refused = 0;
  for (unsigned round = 0; round < rounds; ++round) {
    for (const Seed& seed : files) {
      const std::string& other = files[mutator.below(files.size())].content;
      // Under a name of its own: some file systems wait for the disk when a file is replaced.
      const auto file =
          folder.write(std::to_string(round) + seed.name, mutator.mutated(seed.content, other));
      try {
        expect_sound(load_mesh(file));
        ++loaded;
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(seed.name), std::string::npos) << error.what();
        ++refused;
      }
      std::filesystem::remove(file);
    }
  }
  // Both happen often: neither is everything refused, nor is nothing looked at.
  EXPECT_GT(loaded, rounds / 10);
  EXPECT_GT(refused, rounds / 10);
  // The files are of a few kilobytes. A sanitizer keeps what was freed.
  EXPECT_LT(most_kilobytes() - before, 500'000);
}

}  // namespace
}  // namespace lockbox
