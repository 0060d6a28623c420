// SPDX-License-Identifier: BSD-3-Clause
// The registration as PCL's users know registrations: where a program has an ICP, this goes in.
//
//   pcl::IterativeClosestPointWithNormals<P, P> icp;    lockbox::ArticulatedSdfRegistration<P> icp;
//   icp.setInputSource(scan);                           icp.setInputSource(scan);
//   icp.setInputTarget(model_cloud);                    icp.setModel(lockbox::load_model(file));
//   icp.align(aligned, guess);                          icp.align(aligned, guess);
//
// docs/pcl-registration.md says what PCL's settings mean here.
#pragma once

#include <pcl/point_types.h>
#include <pcl/registration/default_convergence_criteria.h>
#include <pcl/registration/registration.h>

#include <memory>
#include <optional>
#include <string>

#include "lockbox/cloud/point_cloud.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"

namespace lockbox {

/// Aligns a scan (the source, one view of a scene) with an articulated model (the target): finds
/// the base pose as PCL's transformation from source to target, and the joint positions.
///
/// An organized scan is seen as an image: its camera is the one given, or recovered from the
/// points. A scan that is no image has the model and collision terms only, and should hold what is
/// seen from sensor_origin_. Points that are not finite are not measured. With source indices,
/// other points are not matched, but still tell where the camera saw through.
///
/// What PCL leaves to the process's end does not end it here: an empty cloud, one without a finite
/// point, indices of points that the source does not have (of a larger cloud before it, say), no
/// source, no model, a guess that is no rigid motion. Such an alignment says why, as PCL does, does
/// not converge, and leaves the joints alone. A search tree that is null is refused, and nothing
/// changes.
///
/// For pcl::PointXYZ, PointXYZI, PointXYZRGB, PointXYZRGBA, PointNormal and PointXYZRGBNormal, with
/// float and double. One object serves one thread at a time; objects can share a model.
template <typename PointT, typename Scalar = float>
class ArticulatedSdfRegistration : public pcl::Registration<PointT, PointT, Scalar> {
 public:
  using Base = pcl::Registration<PointT, PointT, Scalar>;  ///< PCL's own class
  using typename Base::KdTreePtr;
  using typename Base::KdTreeReciprocalPtr;
  using typename Base::Matrix4;
  using typename Base::PointCloudSource;
  using typename Base::PointCloudSourceConstPtr;
  using typename Base::PointCloudTarget;
  using typename Base::PointCloudTargetConstPtr;
  using typename Base::PointIndicesConstPtr;
  using Ptr = pcl::shared_ptr<ArticulatedSdfRegistration>;             ///< as PCL names it
  using ConstPtr = pcl::shared_ptr<const ArticulatedSdfRegistration>;  ///< as PCL names it
  /// The type of getConvergeCriteria(), as PCL names it.
  using ConvergenceCriteria = pcl::registration::DefaultConvergenceCriteria<Scalar>;
  using Base::correspondences_;

  /// Has neither source nor model yet.
  ArticulatedSdfRegistration();
  ~ArticulatedSdfRegistration() override;

  /// Sets what the scan shows, in place of setInputTarget. The joints start at rest. The target
  /// becomes a cloud of the model's surface in the base's frame, points target_spacing apart
  /// (metres; 0: so that there are about 30,000), and is posed anew whenever the joints change.
  /// Throws InputError if the model cannot be registered.
  void setModel(std::shared_ptr<const ArticulatedModel> model, double target_spacing = 0.0);
  /// Does the same with a model that nobody else shares. Throws InputError as the one above.
  void setModel(ArticulatedModel model, double target_spacing = 0.0);

  /// Sets weights, sensor noise, a fixed base and locked joints. PCL's setMaximumIterations counts
  /// in place of max_iterations. Throws InputError if the model cannot be registered with them.
  void setOptions(const RegistrationOptions& options);
  /// Returns the options in force.
  const RegistrationOptions& getOptions() const;

  /// Sets the camera of the organized scans that follow. Without one it is recovered from each
  /// scan.
  void setCamera(const std::optional<PinholeCamera>& camera);

  /// Sets how many threads an alignment uses; 0, the default, means all cores. The result does not
  /// depend on it.
  void setNumberOfThreads(unsigned int threads);

  /// Sets where the joints start: one value, metres or radians, for each joint that mimics no
  /// other, in the order of KinematicTree::variable_joint. Throws InputError without a model, and
  /// for another number of values or values that are not finite.
  void setJointPositions(const Eigen::VectorXd& positions);
  /// Sets where one joint starts, by its name in the model, metres or radians. Throws InputError
  /// without a model, for a joint that it does not have or that mimics another, and for a value
  /// that is not finite.
  void setJointPosition(const std::string& joint, double position);
  /// Returns where the joints start, and after an alignment what it found, as setJointPositions
  /// takes them. It is empty before setModel.
  const Eigen::VectorXd& getJointPositions() const;
  /// Returns the position of one joint by its name in the model, metres or radians, also of one
  /// that mimics another. Throws InputError without a model, and for a joint that it does not have.
  double getJointPosition(const std::string& joint) const;

  /// Returns the covariance of (base twist in the base's frame, joint positions), translation
  /// first, of the last alignment that had data; metres and radians. It is empty before, as are the
  /// next two.
  const Eigen::MatrixXd& getCovariance() const;
  /// Returns the square roots of its diagonal.
  const Eigen::VectorXd& getStandardDeviations() const;
  /// Says of each of these unknowns whether the scan determines it.
  const std::vector<bool>& getObservable() const;

  /// Returns shares of the visible surface; all are zero for a scan that is no image.
  const Agreement& getAgreement() const;
  /// Returns the share that is measured where the model says.
  double getExplainedShare() const { return getAgreement().explained; }
  /// Returns the share that is seen through, or measured behind.
  double getContradictedShare() const { return getAgreement().contradicted; }

  /// Returns the criteria by which an alignment ends, as IterativeClosestPoint does.
  typename ConvergenceCriteria::Ptr getConvergeCriteria() const;

  /// Sets the scan. An empty cloud is taken: PCL's error is printed, no alignment then succeeds,
  /// and what indices selected is forgotten.
  void setInputSource(const PointCloudSourceConstPtr& cloud) override;

  /// Sets which points of the source are matched, of this one and of those that follow. Null
  /// selects all.
  void setIndices(const pcl::IndicesPtr& indices) override;
  /// Does the same with a copy of indices that must not be changed.
  void setIndices(const pcl::IndicesConstPtr& indices) override;
  /// Does the same with a copy of indices as PCL's segmentations give them.
  void setIndices(const PointIndicesConstPtr& indices) override;
  /// Selects a window of an organized source, in pixels. One that does not fit is refused as PCL
  /// does, and what was selected before stays.
  void setIndices(std::size_t first_row, std::size_t first_column, std::size_t rows,
                  std::size_t columns) override;

  /// Returns what setIndices() was given; null means all. (PCL's own, which cannot be overridden,
  /// knows nothing of them: it would follow them beyond the end of a cloud.)
  pcl::IndicesPtr getIndices() const;

  /// Leaves the target alone, which is the model. A cloud is refused with a warning once there is
  /// one.
  void setInputTarget(const PointCloudTargetConstPtr& cloud) override;

  /// Calls PCL's, which cannot be overridden, with a tree that is not null; no tree but its own is
  /// used.
  /// Through a pointer to the base class PCL's own is called: a null tree then has to be followed
  /// by setInputSource, setModel or setJointPositions, which mend it.
  void setSearchMethodTarget(const KdTreePtr& tree, bool force_no_recompute = false);
  /// Does the same for the source, of which no tree is used at all.
  void setSearchMethodSource(const KdTreeReciprocalPtr& tree, bool force_no_recompute = false);

  /// Has no meaning here, and warns of that once; it is there for programs that call it of an ICP.
  void setUseReciprocalCorrespondences(bool use);
  /// Has no meaning here, as the one above.
  void setUseSymmetricObjective(bool use);
  /// Has no meaning here, as the one above.
  void setEnforceSameDirectionNormals(bool enforce);

 protected:
  using Base::converged_;
  using Base::final_transformation_;
  using Base::input_;
  using Base::nr_iterations_;
  using Base::previous_transformation_;
  using Base::target_;
  using Base::transformation_;
  using Base::tree_;

  /// Aligns once, from the guess. pcl::Registration::align() calls it.
  void computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

 private:
  class Criteria;
  struct State;

  void warn_of_ignored_settings();
  void warn_once(const std::string& setting);
  void refuse_null_tree(const char* function) const;
  void restore_search_tree();
  bool selects_missing_points() const;
  bool begin(const Matrix4& guess);
  void find_configuration();
  bool go_on(const Configuration& configuration, bool is_narrow);
  bool pair_up();
  void show();
  void pose_target(const Configuration& joints);
  double reach() const;

  std::unique_ptr<State> state_;
};

}  // namespace lockbox
