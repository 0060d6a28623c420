// SPDX-License-Identifier: BSD-3-Clause
// How long a program that tracks the shipped lockbox needs until it can: reading the model, its
// fields built or taken from the cache, and the registration's own constant data.
#include <filesystem>

#include "registration_scene.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

double field_bytes(const ArticulatedModel& model) {
  double bytes = 0.0;
  for (const auto& field : model.fields) {
    bytes += field ? static_cast<double>(field->memory_bytes()) : 0.0;
  }
  return bytes;
}

void load(benchmark::State& state, const std::filesystem::path& cache) {
  LoadOptions options;
  options.cache_directory = cache;
  double bytes = 0.0;
  for (auto _ : state) {
    bytes = field_bytes(load_model(kLockboxFile, options));
  }
  state.counters["field_MB"] = 1e-6 * bytes;
}

void start_cold(benchmark::State& state) {
  load(state, {});
}

void start_cached(benchmark::State& state) {
  const TemporaryFolder folder;
  LoadOptions options;
  options.cache_directory = folder.path();
  load_model(kLockboxFile, options);
  load(state, folder.path());
}

void start_registration(benchmark::State& state) {
  const ArticulatedModel& model = shipped_lockbox().model;
  for (auto _ : state) {
    const ArticulatedRegistration registration(model, RegistrationOptions{}, Executor());
    benchmark::DoNotOptimize(&registration);
  }
}

BENCHMARK(start_cold)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);
BENCHMARK(start_cached)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(start_registration)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lockbox
