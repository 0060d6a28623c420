// SPDX-License-Identifier: BSD-3-Clause
// The lockbox with its joints held, from the same start and on the same cloud as PCL's
// registrations: until the pose is right to 1 mm and 0.1 degrees, and a single iteration. Left out
// of PCL's times is what it does once for a pair of clouds (search trees, normals, covariances,
// voxels).
#include <pcl/common/io.h>
#include <pcl/filters/filter.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <numbers>
#include <vector>

#include "lockbox/cloud/point_cloud.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "registration_scene.hpp"

namespace lockbox {
namespace {

constexpr double kReach = 0.05;            // metres: PCL's correspondences, the lockbox's gate
constexpr double kTargetSpacing = 0.004;   // metres between points of PCL's target
constexpr float kVoxel = 0.05F;            // metres, of the normal distributions
constexpr double kTranslationGoal = 1e-3;  // metres
constexpr double kRotationGoal = 0.1;      // degrees
constexpr int kMostIterations = 40;
constexpr int kNarrowing = 4;  // iterations until the lockbox's gates are narrow
constexpr int kPatience = 4;   // iterations without getting closer

struct PoseError {
  double translation;  ///< metres
  double rotation;     ///< degrees

  bool is_reached() const { return translation <= kTranslationGoal && rotation <= kRotationGoal; }
  double worst() const {
    return std::max(translation / kTranslationGoal, rotation / kRotationGoal);
  }
};

const View& view() {
  return shipped_lockbox().views.front();
}

PoseError error_of(const Eigen::Isometry3d& T_camera_base) {
  const Twist twist = log_se3(view().truth.T_camera_base.inverse() * T_camera_base);
  return {twist.head<3>().norm(), twist.tail<3>().norm() * 180.0 / std::numbers::pi};
}

/// 2 cm and 2 degrees off, joints as they are.
Configuration start() {
  Twist twist;
  twist << 0.012, -0.012, 0.011, 0.02, -0.02, 0.02;
  Configuration configuration = view().truth;
  configuration.T_camera_base = configuration.T_camera_base * exp_se3(twist);
  return configuration;
}

void report(benchmark::State& state, const PoseError& error, int iterations) {
  state.counters["iterations"] = iterations;
  state.counters["reached"] = error.is_reached() ? 1.0 : 0.0;
  state.counters["off_mm"] = 1e3 * error.translation;
  state.counters["off_deg"] = error.rotation;
}

void rigid_lockbox(benchmark::State& state) {
  const ArticulatedModel& model = shipped_lockbox().model;
  RegistrationOptions options;
  options.locked.assign(static_cast<std::size_t>(model.tree.variables()), true);
  ArticulatedRegistration registration(model, options, Executor(static_cast<int>(state.range(0))));
  const auto is_off = [](const Configuration& configuration, bool /*is_narrow*/) {
    return !error_of(configuration.T_camera_base).is_reached();
  };
  const AlignOptions align_options{.annealing_sigma = kReach,
                                   .iterations = kMostIterations,
                                   .narrowing = kNarrowing,
                                   .on_iteration = is_off,
                                   .at_edges = false};  // that is for tenths of a millimetre
  const Configuration from = start();
  RegistrationResult result;
  for (auto _ : state) {
    registration.align(view().cloud, from, align_options, result);
  }
  report(state, error_of(result.configuration.T_camera_base), result.iterations);
  state.counters["iteration"] =
      benchmark::Counter(result.iterations, benchmark::Counter::kIsIterationInvariantRate |
                                                benchmark::Counter::kInvert);
}

void set(const Eigen::Vector3d& position, const Eigen::Vector3d& /*normal*/, pcl::PointXYZ& point) {
  point.getVector3fMap() = position.cast<float>();
}

void set(const Eigen::Vector3d& position, const Eigen::Vector3d& normal, pcl::PointNormal& point) {
  point.getVector3fMap() = position.cast<float>();
  point.getNormalVector3fMap() = normal.cast<float>();
}

/// The surface of the model that faces the camera, in the base's frame, joints as they are. (With
/// its far sides PCL's registrations end farther off.)
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr target_cloud() {
  const KinematicTree& tree = shipped_lockbox().model.tree;
  Configuration joints = view().truth;
  joints.T_camera_base.setIdentity();
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(tree, joints, poses);
  const Eigen::Vector3d eye = view().truth.T_camera_base.inverse().translation();
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    for (const SurfaceSample& sample : sample_surface(tree.bodies[b].mesh, kTargetSpacing)) {
      const Eigen::Vector3d position = poses[b] * sample.position;
      const Eigen::Vector3d normal = poses[b].linear() * sample.normal;
      if (normal.dot(eye - position) > 0.0) {
        cloud->emplace_back();
        set(position, normal, cloud->back());
      }
    }
  }
  return cloud;
}

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr scan() {
  const pcl::PointCloud<pcl::PointXYZ>::Ptr organized = to_point_cloud(view().cloud);
  pcl::PointCloud<pcl::PointXYZ> finite;
  pcl::Indices indices;
  pcl::removeNaNFromPointCloud(*organized, finite, indices);
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  pcl::copyPointCloud(finite, *cloud);
  return cloud;
}

/// Alignments of one iteration each, the result of one the guess of the next: every intermediate
/// pose can be compared with the truth.
template <typename PointT>
void time_pcl(benchmark::State& state, pcl::Registration<PointT, PointT>& registration) {
  registration.setInputTarget(target_cloud<PointT>());
  registration.setInputSource(scan<PointT>());
  registration.setMaxCorrespondenceDistance(kReach);
  registration.setMaximumIterations(1);
  pcl::PointCloud<PointT> aligned;
  const Eigen::Matrix4f guess = start().T_camera_base.inverse().matrix().cast<float>();
  registration.align(aligned, guess);  // sets up what is kept
  PoseError error{};
  int iterations = 0;
  double seconds = 0.0;
  for (auto _ : state) {
    Eigen::Matrix4f T_base_camera = guess;
    double best = std::numeric_limits<double>::infinity();
    int best_iteration = 0;
    seconds = 0.0;
    iterations = 0;
    do {
      const auto began = std::chrono::steady_clock::now();
      registration.align(aligned, T_base_camera);
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
      T_base_camera = registration.getFinalTransformation();
      error = error_of(Eigen::Isometry3d(T_base_camera.cast<double>()).inverse());
      ++iterations;
      if (error.worst() < 0.99 * best) {
        best = error.worst();
        best_iteration = iterations;
      }
    } while (!error.is_reached() && iterations < kMostIterations &&
             iterations < best_iteration + kPatience);
    state.SetIterationTime(seconds);
  }
  report(state, error, iterations);
  state.counters["iteration"] = benchmark::Counter(
      iterations, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void rigid_icp_with_normals(benchmark::State& state) {
  pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> registration;
  time_pcl(state, registration);
}

void rigid_gicp(benchmark::State& state) {
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> registration;
  time_pcl(state, registration);
}

void rigid_ndt(benchmark::State& state) {
  pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ> registration;
  registration.setResolution(kVoxel);
  time_pcl(state, registration);
}

void once(benchmark::internal::Benchmark* benchmark) {
  benchmark->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(1);
}

BENCHMARK(rigid_lockbox)->Apply(on_one_and_two_threads);
BENCHMARK(rigid_icp_with_normals)->Apply(once);
BENCHMARK(rigid_gicp)->Apply(once);
BENCHMARK(rigid_ndt)->Apply(once);

}  // namespace
}  // namespace lockbox
