// SPDX-License-Identifier: BSD-3-Clause
// All benchmarks of the registration in one run; docs/benchmarks.md says what they mean.
#include "ratio_reporter.hpp"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  lockbox::RatioReporter reporter({
      {"step / floor, one thread", "registration_step/threads:1", "look_up_floor/threads:1"},
      {"step / floor, two threads", "registration_step/threads:2", "look_up_floor/threads:2"},
      {"three terms / floor, one thread", "three_terms_step/threads:1", "look_up_floor/threads:1"},
      {"three terms / floor, two threads", "three_terms_step/threads:2", "look_up_floor/threads:2"},
      {"step on one thread / on two", "registration_step/threads:1", "registration_step/threads:2"},
      {"three terms on one thread / on two", "three_terms_step/threads:1",
       "three_terms_step/threads:2"},
      {"floor on one thread / on two", "look_up_floor/threads:1", "look_up_floor/threads:2"},
      {"step of 40000 points / of all, one thread", "budgeted_step/points:40000",
       "registration_step/threads:1"},
      {"step of 10000 points / of all, one thread", "budgeted_step/points:10000",
       "registration_step/threads:1"},
      {"step of 5000 points / of all, one thread", "budgeted_step/points:5000",
       "registration_step/threads:1"},
      {"points: 320 columns / 160", "points/columns:320", "points/columns:160"},
      {"points: 640 columns / 320", "points/columns:640", "points/columns:320"},
      {"points: 1280 columns / 640", "points/columns:1280", "points/columns:640"},
      {"links: 8 / 1", "links/8", "links/1"},
      {"links: 64 / 8", "links/64", "links/8"},
      {"joints: 63 / 1", "joints/63", "joints/1"},
      {"ICP with normals / lockbox on one thread", "rigid_icp_with_normals",
       "rigid_lockbox/threads:1"},
      {"generalized ICP / lockbox on one thread", "rigid_gicp", "rigid_lockbox/threads:1"},
      {"NDT / lockbox on one thread", "rigid_ndt", "rigid_lockbox/threads:1"},
  });
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
}
