// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/matching_stamps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::ThrowsMessage;

/// count states, rate a second, from a time in seconds; the stamps in a unit.
StatesFile run_of(double first, int count, double rate = 30.0, double per_second = 1.0) {
  StatesFile file;
  for (int i = 0; i < count; ++i) {
    State& state = file.states.emplace_back();
    state.stamp = (first + i / rate) * per_second;
  }
  return file;
}

TEST(MatchingStamps, ThoseInSecondsAreLeftAlone) {
  StatesFile estimate = run_of(0.0, 30);
  StatesFile reference = run_of(0.001, 20);
  EXPECT_THAT(match_stamps(estimate, reference, "truth.csv"), IsEmpty());
  EXPECT_EQ(reference.states[1].stamp, 0.001 + 1.0 / 30.0);
}

TEST(MatchingStamps, OtherUnitsOfEitherAreConverted) {
  for (const double first : {0.0, 1.7e9}) {
    for (const double per_second : {1e3, 1e6, 1e9}) {
      StatesFile estimate = run_of(first, 30);
      StatesFile reference = run_of(first, 30, 30.0, per_second);
      EXPECT_THAT(match_stamps(estimate, reference, "truth.csv"),
                  ElementsAre(HasSubstr("of the reference are taken for")));
      EXPECT_NEAR(reference.states[7].stamp, estimate.states[7].stamp, 1e-5);
      reference = run_of(first, 30);
      estimate = run_of(first, 30, 30.0, per_second);
      EXPECT_THAT(match_stamps(estimate, reference, "truth.csv"), SizeIs(1));
    }
  }
}

TEST(MatchingStamps, TheTruthOfAnotherRecordingIsRefused) {
  StatesFile estimate = run_of(0.0, 31);
  StatesFile elsewhere = run_of(1000.0, 301);
  EXPECT_THAT([&] { match_stamps(estimate, elsewhere, "truth.csv"); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("truth.csv: "), HasSubstr("1000 s to 1010 s"),
                        HasSubstr("the estimate 0 s to 1 s"), HasSubstr("another recording"),
                        testing::Not(HasSubstr("subtract")))));
  StatesFile later = run_of(1000.0, 31);
  EXPECT_THAT([&] { match_stamps(estimate, later, "truth.csv"); },
              ThrowsMessage<InputError>(HasSubstr("subtract 1000 s from")));
}

TEST(MatchingStamps, FasterReferencesAreTakenWhereEstimatesAre) {
  const StatesFile estimate = run_of(0.5, 10);
  const StatesFile thinned = at_times_of(estimate, run_of(0.0, 300, 200.0));
  ASSERT_THAT(thinned.states, SizeIs(10));
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(thinned.states[i].stamp, estimate.states[i].stamp, 0.0026);
  }
  EXPECT_THAT(at_times_of(estimate, run_of(0.0, 60)).states, SizeIs(60));
}

}  // namespace
}  // namespace lockbox
