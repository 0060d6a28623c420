// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/initialization/initializer.hpp"

#include <limits>
#include <utility>

#include "exact_fit.hpp"
#include "joint_search.hpp"
#include "lockbox/core/error.hpp"
#include "search_image.hpp"
#include "search_rounds.hpp"
#include "sought_model.hpp"

namespace lockbox {
namespace {

void check(const TiledCloud& cloud) {
  if (!cloud.has_image()) {
    throw InputError("cloud", "has no image, which the search for the object needs");
  }
}

}  // namespace

/// What a search is made of; all of it is reused by the next one.
struct Initializer::Workspace {
  Workspace(const ArticulatedModel& model, const InitializerOptions& options,
            const Executor& executor, std::shared_ptr<const LookAlikes> look_alikes)
      : sought(model, options.registration, options.evidence, std::move(look_alikes)),
        noise(options.registration.noise.sigma_inverse_depth()),
        image(sought, noise, options.stop_request, executor),
        exact(model, options, executor),
        rounds(sought, options, exact, executor),
        joints(sought, options, noise, exact, executor) {}

  SoughtModel sought;
  ViewNoise noise;
  SearchImage image;
  ExactFit exact;
  SearchRounds rounds;
  JointSearch joints;
};

Initializer::Initializer(const ArticulatedModel& model, const InitializerOptions& options,
                         const Executor& executor, std::shared_ptr<const LookAlikes> look_alikes)
    : workspace_(std::make_unique<Workspace>(model, options, executor, std::move(look_alikes))) {}
Initializer::~Initializer() = default;
Initializer::Initializer(Initializer&&) noexcept = default;
Initializer& Initializer::operator=(Initializer&&) noexcept = default;

std::vector<Candidate> Initializer::find(const TiledCloud& cloud,
                                         const std::optional<Configuration>& held) {
  SearchProgress progress;
  return find_part(cloud, held, std::numeric_limits<int>::max(), progress);
}

std::vector<Candidate> Initializer::glance(const TiledCloud& cloud) {
  SearchProgress progress;
  const int rounds = workspace_->sought.is_flat ? 1 : std::numeric_limits<int>::max();
  return find_part(cloud, std::nullopt, rounds, progress);
}

std::vector<Candidate> Initializer::find_part(const TiledCloud& cloud,
                                              const std::optional<Configuration>& held,
                                              int most_rounds, SearchProgress& progress) {
  check(cloud);
  Workspace& w = *workspace_;
  const Configuration held_or_rest = held.value_or(rest_configuration(w.sought.model.tree));
  w.image.look_at(cloud);
  std::vector<Candidate> answers = w.rounds.seek(w.image, held_or_rest, most_rounds, progress);
  if (!answers.empty()) w.joints.rescan(w.image, w.rounds.assessment(), answers.front());
  return answers;
}

SoughtJoints Initializer::find_joints(const TiledCloud& cloud, const Configuration& start,
                                      const std::vector<int>& variables) {
  check(cloud);
  return workspace_->joints.find(cloud, start, variables);
}

}  // namespace lockbox
