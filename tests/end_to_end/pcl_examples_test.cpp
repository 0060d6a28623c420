// SPDX-License-Identifier: BSD-3-Clause
// The example programs as PCL's users run them: an ICP, and the registration in its place.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "lockbox/capture/pcd_folder.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/pcl/articulated_sdf_registration.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

namespace fs = std::filesystem;

struct Printed {
  int status = -1;
  Eigen::Isometry3d T_camera_model;
  std::vector<double> joints;
};

class PclExamplesTest : public ::testing::Test {
 protected:
  /// Files of a shipped model in the pose of its YAML file, before a wall.
  void make_files(const std::string& name, const std::map<std::string, double>& joints) {
    urdf = fs::path(LOCKBOX_MODELS) / name / (name + ".urdf");
    LoadOptions options;
    options.cache_directory = LOCKBOX_CACHE;
    const auto model = std::make_shared<const ArticulatedModel>(load_model(urdf, options));
    State state;
    state.configuration = *model->parameters.initial_configuration;
    for (const auto& [joint, position] : joints) {
      set_joint_position(model->tree, state.configuration, joint, position);
    }
    truth = state.configuration;
    tree = model->tree;
    write_scan(*model, state);
    write_model(model);
  }

  Printed run(const std::string& program, const fs::path& model) const {
    Twist offset;
    offset << 0.01, -0.008, 0.01, 0.02, -0.03, 0.02;
    const Eigen::Isometry3d start = truth.T_camera_base * exp_se3(offset);
    const Eigen::Matrix3d R = start.linear();
    std::ostringstream command;
    command << "XDG_CACHE_HOME=" << LOCKBOX_CACHE << ' ' << program << ' ' << scan << ' ' << model
            << ' ' << start.translation().transpose() << ' ' << std::atan2(R(2, 1), R(2, 2)) << ' '
            << std::asin(-R(2, 0)) << ' ' << std::atan2(R(1, 0), R(0, 0));
    Printed printed;
    FILE* const pipe = ::popen(command.str().c_str(), "r");
    std::string output;
    for (std::array<char, 256> line; std::fgets(line.data(), line.size(), pipe) != nullptr;) {
      output += line.data();
    }
    const int status = ::pclose(pipe);
    printed.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    parse(output, printed);
    return printed;
  }

  Twist error(const Printed& printed) const {
    return log_se3(truth.T_camera_base.inverse() * printed.T_camera_model);
  }

  const TemporaryFolder folder;
  fs::path urdf;
  fs::path scan;
  fs::path model_cloud;
  Configuration truth;
  KinematicTree tree;

 private:
  void write_scan(const ArticulatedModel& model, const State& state) {
    Scene scene;
    scene.planes.push_back({SceneFrame::world, {0.0, 0.0, 1.9}, {0.0, 0.0, -1.0}, {5.0, 5.0}});
    const PinholeCamera camera{320, 240, 287.9, 287.9, 159.5, 119.5};
    Simulator simulator(model.tree, camera, PlacedScene(scene, {state}), sensor_model("primesense"),
                        1, Executor(1));
    DepthFrame frame;
    simulator.simulate(state, 0, frame);
    PcdFolderWriter(folder / "scan").write(frame);
    scan = fs::directory_iterator(folder / "scan")->path();
  }

  void write_model(const std::shared_ptr<const ArticulatedModel>& model) {
    ArticulatedSdfRegistration<pcl::PointNormal> registration;
    registration.setModel(model, 0.005);
    const auto cloud = registration.getInputTarget();
    model_cloud = folder / "model.pcd";
    std::ofstream file(model_cloud);
    file << "VERSION 0.7\nFIELDS x y z normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4\n"
         << "TYPE F F F F F F\nCOUNT 1 1 1 1 1 1\nWIDTH " << cloud->size()
         << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << cloud->size() << "\nDATA ascii\n";
    for (const pcl::PointNormal& point : *cloud) {
      file << point.getVector3fMap().transpose() << ' ' << point.getNormalVector3fMap().transpose()
           << '\n';
    }
  }

  static void parse(const std::string& output, Printed& printed) {
    std::istringstream pose(output.substr(output.find("model:") + 6));
    Eigen::Matrix4d T;
    for (int i = 0; i < 16; ++i) {
      pose >> T(i / 4, i % 4);
    }
    printed.T_camera_model = orthonormalized(Eigen::Isometry3d(T));
    std::string word;
    pose >> word;
    for (double joint = 0.0; pose >> joint;) {
      printed.joints.push_back(joint);
    }
  }
};

TEST_F(PclExamplesTest, BothFindARigidObject) {
  make_files("rigid_block", {});
  for (const Printed& printed :
       {run(LOCKBOX_PCL_ICP, model_cloud), run(LOCKBOX_PCL_ARTICULATED_SDF, urdf)}) {
    EXPECT_EQ(printed.status, 0);
    EXPECT_LT(error(printed).head<3>().norm(), 0.0035);  // a pixel
    EXPECT_LT(error(printed).tail<3>().norm(), 0.01);
  }
}

TEST_F(PclExamplesTest, TheSwapFindsJointsToo) {
  make_files("cabinet", {{"drawer", 0.03}, {"door", 0.1}});
  const Printed swapped = run(LOCKBOX_PCL_ARTICULATED_SDF, urdf);
  EXPECT_EQ(swapped.status, 0);
  EXPECT_LT(error(swapped).head<3>().norm(), 0.0035);
  ASSERT_EQ(swapped.joints.size(), static_cast<std::size_t>(truth.q.size()));
  for (const std::string joint : {"drawer", "door"}) {
    const int v = tree.joints[static_cast<std::size_t>(joint_index(tree, joint))].variable;
    EXPECT_NEAR(swapped.joints[static_cast<std::size_t>(v)], truth.q[v], 0.008) << joint;
  }
}

}  // namespace
}  // namespace lockbox
