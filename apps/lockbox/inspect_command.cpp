// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iomanip>
#include <iostream>

#include "command_line/option_checks.hpp"
#include "command_line/output_paths.hpp"
#include "commands.hpp"
#include "counted.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/equal_poses.hpp"
#include "lockbox/mesh/triangle_mesh.hpp"
#include "lockbox/model/contacts.hpp"
#include "lockbox/model/joint_type_name.hpp"
#include "lockbox/visualization/model_painter.hpp"
#include "lockbox/visualization/viewpoint.hpp"
#include "model_options.hpp"

namespace lockbox::app {
namespace {

void print_limits(const Joint& joint) {
  if (!std::isfinite(joint.upper - joint.lower)) return;
  const bool turns = joint.type == JointType::revolute;
  const double scale = turns ? kDegrees : kMillimetres;
  std::cout << ", " << scale * joint.lower << " to " << scale * joint.upper
            << (turns ? " degrees" : " mm");
}

/// Bodies come in depth-first order, so that the tree can be printed line by line.
void print_tree(const KinematicTree& tree) {
  std::vector<int> depth(tree.bodies.size(), 0);
  for (std::size_t body = 0; body < tree.bodies.size(); ++body) {
    const Body& here = tree.bodies[body];
    if (here.parent_joint >= 0) {
      const Joint& joint = tree.joints[static_cast<std::size_t>(here.parent_joint)];
      depth[body] = depth[static_cast<std::size_t>(joint.parent_body)] + 1;
      std::cout << std::string(2 * static_cast<std::size_t>(depth[body]), ' ') << here.name << ": "
                << type_name(joint.type) << " joint " << joint.name;
      print_limits(joint);
      if (joint.is_mimic) {
        const auto driver =
            static_cast<std::size_t>(tree.variable_joint[static_cast<std::size_t>(joint.variable)]);
        std::cout << ", mimics " << tree.joints[driver].name;
      }
    } else {
      std::cout << here.name << ": base";
    }
    if (here.visuals.empty()) std::cout << ", no geometry";
    std::cout << '\n';
  }
}

/// Prints the sizes of each body, along its own axes.
void print_sizes(const KinematicTree& tree) {
  std::cout << std::left << std::setw(24) << "body" << std::right;
  for (const char* const axis : {"x, mm", "y, mm", "z, mm"}) std::cout << std::setw(12) << axis;
  std::cout << '\n';
  for (const Body& body : tree.bodies) {
    if (body.visuals.empty()) continue;
    std::cout << std::left << std::setw(24) << body.name << std::right;
    const Eigen::Vector3d size = kMillimetres * bounds(body.mesh).sizes();
    std::cout << std::setw(12) << size.x() << std::setw(12) << size.y() << std::setw(12) << size.z()
              << '\n';
  }
}

void print_fields(const ArticulatedModel& model) {
  std::cout << std::left << std::setw(24) << "body" << std::right << std::setw(10) << "voxel"
            << std::setw(12) << "memory" << std::setw(14) << "field volume" << std::setw(14)
            << "mesh volume" << std::setw(12) << "difference" << std::setw(12) << "thickness\n"
            << std::left << std::setw(24) << "" << std::right << std::setw(10) << "mm"
            << std::setw(12) << "MB" << std::setw(14) << "cm^3" << std::setw(14) << "cm^3"
            << std::setw(12) << "%" << std::setw(12) << "mm\n";
  for (std::size_t body = 0; body < model.fields.size(); ++body) {
    if (!model.fields[body]) continue;
    const auto& field = *model.fields[body];
    const double volume = field.enclosed_volume();
    const double mesh_volume = field.storage().mesh_volume;
    std::cout << std::left << std::setw(24) << model.tree.bodies[body].name << std::right
              << std::setw(10) << kMillimetres * field.voxel() << std::setw(12)
              << static_cast<double>(field.memory_bytes()) / 1e6 << std::setw(14) << 1e6 * volume
              << std::setw(14) << 1e6 * mesh_volume << std::setw(12)
              << 100.0 * (volume / mesh_volume - 1.0) << std::setw(11)
              << kMillimetres * field.thickness() << '\n';
  }
}

void print_contacts(const ArticulatedModel& model) {
  const auto contacts = rest_contacts(model);
  if (contacts.empty()) std::cout << "none\n";
  for (const auto& contact : contacts) {
    std::cout << model.tree.bodies[contact.body_a].name << " and "
              << model.tree.bodies[contact.body_b].name << ": ";
    if (contact.overlap > kContactTolerance) {
      std::cout << "overlap by " << kMillimetres * contact.overlap << " mm\n";
    } else {
      std::cout << "touch\n";
    }
  }
}

void print_symmetries(const ArticulatedModel& model) {
  const EqualPoses equal(model);
  if (!equal.any()) std::cout << "none\n";
  for (const auto& turn : equal.turns()) std::cout << turn << '\n';
}

class InspectCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    model_.add_to(options);
    options.add_option("--picture", picture_, "Also draw the model at rest into a PNG file")
        ->check(picture_name())
        ->type_name("FILE.png");
  }

  ExitStatus run() override {
    const ArticulatedModel model = model_.load();
    const std::size_t bodies = model.tree.bodies.size();
    std::cout << std::fixed << std::setprecision(2) << model.file.string() << ": "
              << (bodies == 1 ? "1 body" : std::to_string(bodies) + " bodies") << ", "
              << counted(model.tree.joints.size(), "joint") << ", "
              << counted(static_cast<std::size_t>(model.tree.variables()), "joint variable")
              << "\n\nKinematic tree\n";
    print_tree(model.tree);
    std::cout << "\nSizes, along the axes of each body\n";
    print_sizes(model.tree);
    std::cout << "\nDistance fields\n";
    print_fields(model);
    std::cout << "\nContacts at rest\n";
    print_contacts(model);
    std::cout << "\nTurns after which the model looks the same (joints at rest; axes of the base, "
                 "through the model's middle)\n";
    print_symmetries(model);
    if (!picture_.empty()) draw(model.tree);
    return ExitStatus::done;
  }

 private:
  void draw(const KinematicTree& tree) const {
    constexpr int kWidth = 960;
    constexpr int kHeight = 720;
    Configuration configuration = rest_configuration(tree);
    const Viewpoint view = overview(tree, configuration, kWidth, kHeight);
    configuration.T_camera_base = view.T_camera_base;
    RgbImage image(kWidth, kHeight);
    ModelPainter(tree, view.camera, Executor()).paint(configuration, 1.0F, image);
    make_folder_of(picture_);
    write_png(picture_, image);
    std::cout << "\nPicture: " << picture_ << '\n';
  }

  ModelOptions model_;
  std::string picture_;
};

}  // namespace

std::unique_ptr<Command> make_inspect_command() {
  return std::make_unique<InspectCommand>();
}

}  // namespace lockbox::app
