// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sdf/field_cache.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

#include "field_fixture.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

namespace fs = std::filesystem;

class FieldCache : public testing::Test {
 protected:
  SignedDistanceField load(const fs::path& folder) const {
    return load_or_build_field(mesh_, options_, folder, Executor(1));
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      found.push_back(entry.path());
    }
    return found;
  }
  static std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  static void expect_same(const SignedDistanceField& a, const SignedDistanceField& b) {
    EXPECT_EQ(a.storage().samples, b.storage().samples);
    EXPECT_EQ(a.storage().block_first, b.storage().block_first);
    EXPECT_EQ(a.thickness(), b.thickness());
    EXPECT_EQ(a.storage().mesh_volume, b.storage().mesh_volume);
    EXPECT_EQ(a.bounds().min(), b.bounds().min());
    EXPECT_EQ(a.bounds().max(), b.bounds().max());
    const Eigen::Vector3f p(0.013F, -0.021F, 0.4F);
    EXPECT_EQ(a.sample(p).distance, b.sample(p).distance);
    EXPECT_EQ(a.sample(0.1F * p).gradient, b.sample(0.1F * p).gradient);
  }

  TemporaryFolder folder_;
  TriangleMesh mesh_ = make_box({0.02, 0.02, 0.02});
  FieldOptions options_ = [] {
    FieldOptions options;
    options.voxel = 0.002;
    options.far_reach = 0.05;
    return options;
  }();
};

TEST_F(FieldCache, GivesBackWhatWasBuilt) {
  const SignedDistanceField built = load(folder_.path() / "new" / "folder");
  const SignedDistanceField read = load(folder_.path() / "new" / "folder");
  expect_same(built, read);
  expect_same(read, build_field(mesh_, options_, Executor(1)));
}

TEST_F(FieldCache, ReadsInsteadOfBuilding) {
  load(folder_.path());
  ASSERT_EQ(files().size(), 1U);
  const fs::path file = files()[0];
  fs::create_hard_link(file, folder_.path() / "same");  // as what is built takes its place
  load(folder_.path());
  EXPECT_TRUE(fs::equivalent(file, folder_.path() / "same"));
}

TEST_F(FieldCache, WhatWasNotUsedForTheLongestTimeGoesFirst) {
  load(folder_.path());
  const fs::path first = files().at(0);
  const TriangleMesh other = make_cylinder(0.01, 0.03);
  load_or_build_field(other, options_, folder_.path(), Executor(1));
  folder_.write("notes.txt", "not a field");
  const CachedFields both = cached_fields(folder_.path());
  EXPECT_EQ(both.files, 2U);
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(24);
  for (const fs::path& file : files()) fs::last_write_time(file, long_ago);
  load(folder_.path());  // the first one is used again
  const CachedFields left = limit_fields(folder_.path(), both.bytes - 1);
  EXPECT_EQ(left.files, 1U);
  EXPECT_EQ(left.bytes, fs::file_size(first));
  EXPECT_EQ(limit_fields(folder_.path(), 0).files, 0U);
  EXPECT_TRUE(fs::exists(folder_.path() / "notes.txt"));
}

TEST_F(FieldCache, AFolderThatIsNotThereHoldsNothing) {
  EXPECT_EQ(cached_fields(folder_.path() / "none").files, 0U);
  EXPECT_EQ(limit_fields(folder_.path() / "none", 0).files, 0U);
}

TEST_F(FieldCache, KeepsWhatDiffersApart) {
  load(folder_.path());
  mesh_.vertices[0].x() -= 1e-9;
  load(folder_.path());
  EXPECT_EQ(files().size(), 2U);
  options_.voxel = 0.0021;
  load(folder_.path());
  EXPECT_EQ(files().size(), 3U);
}

TEST_F(FieldCache, ReplacesDamagedFiles) {
  const SignedDistanceField built = load(folder_.path());
  const fs::path file = files().at(0);
  const std::string good = content(file);
  std::mt19937 random(1);
  std::vector<std::string> damaged = {"", "another program's file", good.substr(0, 20),
                                      good.substr(0, good.size() - 1), good + "x"};
  for (int i = 0; i < 12; ++i) {
    damaged.push_back(good);
    // Half of them in the header, where a length could be believed.
    const std::size_t range = i % 2 == 0 ? 64 : good.size();
    char& byte = damaged.back()[random() % range];
    byte = static_cast<char>(byte ^ (1 << (random() % 8)));
  }
  for (const std::string& bytes : damaged) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    expect_same(load(folder_.path()), built);
    EXPECT_EQ(content(file), good);
  }
}

/// To open a pipe would wait for who writes into it, and a file may claim to be of any size.
TEST_F(FieldCache, ReplacesPipesAndWhatIsLargerThanTheCache) {
  const SignedDistanceField built = load(folder_.path());
  const fs::path file = files().at(0);
  const std::uintmax_t bytes = fs::file_size(file);
  fs::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  expect_same(load(folder_.path()), built);
  EXPECT_EQ(fs::file_size(file), bytes);
  fs::resize_file(file, std::uintmax_t{1} << 40);
  expect_same(load(folder_.path()), built);
  EXPECT_EQ(fs::file_size(file), bytes);
}

TEST_F(FieldCache, RefusesAFileUnderAnotherName) {
  load(folder_.path());
  const fs::path first = files().at(0);
  mesh_ = make_cylinder(0.01, 0.03);
  const SignedDistanceField built = load(folder_.path());
  for (const fs::path& file : files()) {
    if (file != first) {
      fs::copy_file(first, file, fs::copy_options::overwrite_existing);
    }
  }
  expect_same(load(folder_.path()), built);
}

TEST_F(FieldCache, DoesWithoutAFolder) {
  const SignedDistanceField built = build_field(mesh_, options_, Executor(1));
  expect_same(load({}), built);
  // A file where the folder should be cannot be written into, not even by root.
  expect_same(load(folder_.write("file", "")), built);
  expect_same(load(folder_.path() / "file" / "below"), built);
}

TEST_F(FieldCache, PassesOnWhyAMeshIsRefused) {
  mesh_.triangles.resize(10);
  EXPECT_THROW(load(folder_.path()), InputError);
  EXPECT_TRUE(files().empty());
}

TEST_F(FieldCache, IsSharedByThreads) {
  const SignedDistanceField built = build_field(mesh_, options_, Executor(1));
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int round = 0; round < 3; ++round) {
        expect_same(load(folder_.path()), built);
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(files().size(), 1U);
}

/// Ends itself when its file has this size; SIGKILL asks nobody.
void load_until_killed(const std::function<void()>& load, rlim_t bytes) {
  const rlimit limit = {bytes, bytes};
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, [](int) { kill(getpid(), SIGKILL); });
  load();
}

TEST_F(FieldCache, IsLeftWithoutHalfAFileByAProcessThatIsKilledWhileItWrites) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    load_until_killed([this] { load(folder_.path()); }, 1000);
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it was not killed";
  EXPECT_THAT(files(), testing::IsEmpty());
}

TEST_F(FieldCache, IsSharedByProcesses) {
  const SignedDistanceField built = build_field(mesh_, options_, Executor(1));
  std::vector<pid_t> children;
  for (int i = 0; i < 2; ++i) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      bool is_same = true;
      for (int round = 0; round < 5; ++round) {
        for (const fs::path& file : files()) {
          std::error_code error;
          fs::remove(file, error);  // so that both write again
        }
        is_same = is_same && load(folder_.path()).storage().samples == built.storage().samples;
      }
      _exit(is_same ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  expect_same(load(folder_.path()), built);
}

}  // namespace
}  // namespace lockbox
