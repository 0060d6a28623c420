// SPDX-License-Identifier: BSD-3-Clause
// Property "order invariance": no result depends on how a model's files were written.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <random>

#include "initialization/seen_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "model/urdf_test.hpp"
#include "registration/mechanism.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

/// A cabinet of all joint types: chains, fixed parts, a mimic, twins that differ in place only.
std::vector<std::string> elements(const std::string& prefix = "") {
  const auto name = [&](const std::string& plain) { return prefix + plain; };
  const auto at = [](const std::string& xyz) { return "<origin xyz=\"" + xyz + "\"/>"; };
  const std::string axis = "<axis xyz=\"0 0.6 0.8\"/>";
  return {
      link(name("case"),
           box("1 1 0.5") + box("0.1 0.1 0.1", at("0.5 0 0")) + box("0.1 0.1 0.2", at("0 0.5 0"))),
      link(name("door"), box("0.5 1 0.02")),
      link(name("knob"), "<visual><geometry><sphere radius=\"0.02\"/></geometry></visual>"),
      link(name("drawer"), box("0.4 0.2 0.3")),
      link(name("twin"), box("0.4 0.2 0.3")),
      link(name("handle"), box("0.1 0.02 0.02")),
      link(name("disk"),
           "<visual><geometry><cylinder radius=\"0.1\" length=\"0.02\"/></geometry>"
           "</visual>"),
      link(name("arm")),
      joint(name("hinge"), "revolute", name("case"), name("door"), axis + kLimit),
      joint(name("glue"), "fixed", name("door"), name("knob"), at("0.4 0 0.02")),
      joint(name("pull"), "prismatic", name("case"), name("drawer"), at("0 0.2 0") + kLimit),
      joint(name("pull_twin"), "prismatic", name("case"), name("twin"),
            at("0 -0.2 0") + kLimit + "<mimic joint=\"" + name("pull") + "\" multiplier=\"-1\"/>"),
      joint(name("grip"), "revolute", name("drawer"), name("handle"), axis + kLimit),
      joint(name("spin"), "continuous", name("door"), name("disk"), axis + at("0 0 0.1")),
      joint(name("sway"), "revolute", name("door"), name("arm"), axis + at("0 0 0.1") + kLimit),
  };
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += part;
  return text;
}

Configuration some_configuration(const KinematicTree& tree) {
  Configuration configuration = rest_configuration(tree);
  for (int v = 0; v < tree.variables(); ++v) configuration.q[v] = 0.1 * v + 0.05;
  return configuration;
}

void expect_same_bits(const KinematicTree& a, const KinematicTree& b) {
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].name, b.bodies[i].name);
    EXPECT_EQ(a.bodies[i].links, b.bodies[i].links);
    EXPECT_TRUE(a.bodies[i].mesh.vertices == b.bodies[i].mesh.vertices);
    EXPECT_TRUE(a.bodies[i].mesh.triangles == b.bodies[i].mesh.triangles);
  }
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    EXPECT_EQ(a.joints[j].name, b.joints[j].name);
    EXPECT_EQ(a.joints[j].variable, b.joints[j].variable);
    EXPECT_EQ(a.joints[j].parent_body, b.joints[j].parent_body);
  }
  std::vector<Eigen::Isometry3d> poses_a;
  std::vector<Eigen::Isometry3d> poses_b;
  forward_kinematics(a, some_configuration(a), poses_a);
  forward_kinematics(b, some_configuration(b), poses_b);
  for (std::size_t i = 0; i < poses_a.size(); ++i) {
    EXPECT_TRUE(poses_a[i].matrix() == poses_b[i].matrix()) << "body " << i;
  }
}

using CanonicalOrder = UrdfTest;

TEST_F(CanonicalOrder, AnyOrderOfLinksAndJointsGivesTheSameBits) {
  auto parts = elements();
  const KinematicTree reference = load_robot(joined(parts));
  std::mt19937 generator{7};
  for (int i = 0; i < 50; ++i) {
    std::shuffle(parts.begin(), parts.end(), generator);
    expect_same_bits(load_robot(joined(parts)), reference);
  }
}

TEST_F(CanonicalOrder, AnyOrderOfVisualsGivesTheSameBits) {
  std::vector<std::string> visuals{box("1 1 1"), box("1 1 2"), box("1 2 1"),
                                   box("1 1 1", "<origin xyz=\"1 0 0\"/>")};
  const KinematicTree reference = load_robot(link("a", joined(visuals)));
  std::sort(visuals.begin(), visuals.end());
  do {
    expect_same_bits(load_robot(link("a", joined(visuals))), reference);
  } while (std::next_permutation(visuals.begin(), visuals.end()));
}

TEST_F(CanonicalOrder, NamesHaveNoSay) {
  const KinematicTree reference = load_robot(joined(elements()));
  for (const std::string prefix : {"a_", "z_"}) {
    const KinematicTree renamed = load_robot(joined(elements(prefix)));
    for (std::size_t i = 0; i < reference.bodies.size(); ++i) {
      EXPECT_EQ(renamed.bodies[i].name, prefix + reference.bodies[i].name);
    }
  }
  // Names that sort the other way round.
  std::string text = joined(elements());
  std::map<std::string, std::string> exchange{{"\"drawer\"", "\"zz\""}, {"\"twin\"", "\"aa\""},
                                              {"\"pull\"", "\"yy\""},   {"\"pull_twin\"", "\"bb\""},
                                              {"\"disk\"", "\"xx\""},   {"\"arm\"", "\"cc\""}};
  for (const auto& [from, to] : exchange) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from)) {
      text.replace(at, from.size(), to);
    }
  }
  const KinematicTree exchanged = load_robot(text);
  for (std::size_t i = 0; i < reference.bodies.size(); ++i) {
    const auto found = exchange.find("\"" + reference.bodies[i].name + "\"");
    EXPECT_EQ("\"" + exchanged.bodies[i].name + "\"",
              found == exchange.end() ? "\"" + reference.bodies[i].name + "\"" : found->second);
  }
}

TEST_F(CanonicalOrder, BodiesStandDepthFirstAndJointsBeforeWhatTheyMove) {
  const KinematicTree tree = load_robot(joined(elements()));
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    EXPECT_EQ(tree.joints[j].child_body, static_cast<int>(j) + 1);
    EXPECT_EQ(tree.bodies[j + 1].parent_joint, static_cast<int>(j));
    EXPECT_LE(tree.joints[j].parent_body, static_cast<int>(j));
  }
  EXPECT_EQ(tree.bodies[0].parent_joint, -1);
}

/// What the registration makes of one measurement, with a model that was written in another way.
RegistrationResult registered(const ArticulatedModel& model) {
  static const TiledCloud cloud =
      cloud_of(measured(mechanism(), mechanism_start(mechanism()), "primesense"));
  Eigen::VectorXd step = Eigen::VectorXd::Constant(model.tree.unknowns(), 0.004);
  step.tail(model.tree.variables()).setConstant(0.01);
  return ArticulatedRegistration(model, {}, Executor(1))
      .align(cloud, stepped(mechanism_start(model), step), {0.01, 6});
}

TEST(OrderInvariance, AnyOrderOfLinksAndJointsGivesTheSameEstimate) {
  const RegistrationResult reference = registered(mechanism());
  std::vector<std::string> parts = mechanism_elements();
  std::mt19937 generator{7};
  for (int i = 0; i < 50; ++i) {
    std::shuffle(parts.begin(), parts.end(), generator);
    const RegistrationResult result = registered(load_mechanism(parts, with_cache()));
    EXPECT_TRUE(result.configuration.T_camera_base.matrix() ==
                reference.configuration.T_camera_base.matrix());
    EXPECT_TRUE(result.configuration.q == reference.configuration.q);
    EXPECT_TRUE(result.covariance == reference.covariance);
  }
}

TEST(OrderInvariance, OtherNamesOfLinksChangeNothingButRounding) {
  const RegistrationResult reference = registered(mechanism());
  std::vector<std::string> names{"plate", "block", "arm", "knob", "follower"};
  std::mt19937 generator{8};
  for (int i = 0; i < 10; ++i) {
    std::shuffle(names.begin(), names.end(), generator);
    std::vector<std::string> parts = mechanism_elements();
    for (std::string& element : parts) {
      for (std::size_t k = 0; k < names.size(); ++k) {
        const std::string quoted = '"' + names[k] + '"';
        for (auto at = element.find(quoted); at != std::string::npos; at = element.find(quoted)) {
          element.replace(at, quoted.size(), "\"part_" + std::to_string(k) + '"');
        }
      }
    }
    const RegistrationResult result = registered(load_mechanism(parts, with_cache()));
    EXPECT_LT((result.configuration.T_camera_base.matrix() -
               reference.configuration.T_camera_base.matrix())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-6);
    EXPECT_LT((result.configuration.q - reference.configuration.q).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(OrderOfFiles, MeshesUnderOtherNamesInOtherPlacesGiveTheSameBits) {
  const TemporaryFolder folder;
  const ArticulatedModel& reference = shipped("lockbox");
  std::ifstream original(shipped_file("lockbox"));
  std::string text((std::istreambuf_iterator<char>(original)), {});
  std::vector<std::filesystem::path> meshes;
  for (const auto& entry :
       std::filesystem::directory_iterator(shipped_file("lockbox").parent_path() / "meshes")) {
    meshes.push_back(entry.path());
  }
  std::sort(meshes.begin(), meshes.end());
  std::mt19937 generator{9};
  std::shuffle(meshes.begin(), meshes.end(), generator);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string other = "part_" + std::to_string(i) + ".obj";
    const std::string own = "meshes/" + meshes[i].filename().string();
    std::filesystem::copy_file(meshes[i], folder / other);
    text.replace(text.find(own), own.size(), other);
  }
  const ArticulatedModel moved = load_model(folder.write("lockbox.urdf", text), with_cache());
  expect_same_bits(moved.tree, reference.tree);
  for (std::size_t b = 0; b < moved.fields.size(); ++b) {
    EXPECT_EQ(moved.fields[b]->storage().samples, reference.fields[b]->storage().samples);
  }
}

}  // namespace
}  // namespace lockbox
