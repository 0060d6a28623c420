// SPDX-License-Identifier: BSD-3-Clause
// Once warm, a registration takes no memory from the heap: counted at malloc itself, which Eigen,
// the standard library and everything else ask in the end. (Not under sanitizers, which replace
// it.)
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>

#include "lockbox/registration/articulated_registration.hpp"
#include "mechanism.hpp"

namespace {

std::atomic<bool> counting{false};
std::atomic<int> allocations{0};

void count_one() {
  if (counting.load(std::memory_order_relaxed)) {
    allocations.fetch_add(1, std::memory_order_relaxed);
  }
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT: glibc's names
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
void* __libc_realloc(void* memory, std::size_t size);            // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT

void* malloc(std::size_t size) {
  count_one();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  count_one();
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  count_one();
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count_one();
  return __libc_memalign(alignment, size);
}
}

namespace lockbox {
namespace {

int allocations_of(ArticulatedRegistration& registration, const TiledCloud& cloud,
                   const Configuration& start, const AlignOptions& align_options,
                   RegistrationResult& result) {
  allocations = 0;
  counting = true;
  registration.align(cloud, start, align_options, result);
  counting = false;
  return allocations;
}

TEST(CountingAllocations, SeesOne) {
  allocations = 0;
  counting = true;
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(100);
  counting = false;
  EXPECT_EQ(allocations, 1) << vector.size();
}

class Allocation : public ::testing::TestWithParam<std::size_t> {};

/// By point budget; 0: all points.
TEST_P(Allocation, AWarmRegistrationTakesNoMemory) {
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  const TiledCloud first = cloud_of(measured(model, truth, "primesense", 1));
  const TiledCloud second = cloud_of(measured(model, truth, "primesense", 2));
  Configuration start = truth;
  start.q[0] += 0.003;
  RegistrationOptions options;
  options.point_budget = GetParam();
  RegistrationResult result;
  ArticulatedRegistration registration(model, options, Executor(1));
  const AlignOptions align_options{.annealing_sigma = 0.005, .iterations = 5, .is_predicted = true};
  registration.align(second, start, align_options, result);
  registration.align(first, start, align_options, result);
  EXPECT_EQ(allocations_of(registration, second, start, align_options, result), 0);
}

INSTANTIATE_TEST_SUITE_P(OfPoints, Allocation, ::testing::Values(0, 2000, 40000));

}  // namespace
}  // namespace lockbox
