// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../command_line/shipped_files.hpp"
#include "bindings.hpp"
#include "calls.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/joint_type_name.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "poses.hpp"

namespace lockbox::python {
namespace {

using Points = py::array_t<float, py::array::c_style | py::array::forcecast>;

using Path = std::filesystem::path;

Model load(const Path& file, const std::vector<Path>& package_paths, double mesh_scale) {
  if (!(mesh_scale > 0.0)) throw InputError("mesh_scale", "is not a positive number");
  Warnings warnings;
  LoadOptions options;
  options.package_paths = package_paths;
  options.mesh_scale = mesh_scale;
  options.on_warning = [&](const std::string& text) { warnings.add(text); };
  Model result;
  {
    const py::gil_scoped_release others_go_on;
    result.model = std::make_shared<const ArticulatedModel>(
        load_model(app::find_model(file.string()), options));
  }
  warnings.issue();
  return result;
}

std::size_t body_index(const KinematicTree& tree, const std::string& name) {
  std::string known;
  for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
    const auto& links = tree.bodies[i].links;
    if (tree.bodies[i].name == name) return i;
    if (std::find(links.begin(), links.end(), name) != links.end()) return i;
    known += (i == 0 ? "" : ", ") + tree.bodies[i].name;
  }
  throw InputError(in_quotes(name), "is no body of the model; it has " + known);
}

/// points: N x 3, metres, in the body's frame.
py::tuple distances(const Model& self, const std::string& body, const Points& points) {
  const auto& field = self.model->fields[body_index(self.model->tree, body)];
  if (!field) throw InputError(in_quotes(body), "has no geometry, and so no distances");
  if (points.ndim() != 2 || points.shape(1) != 3) {
    throw InputError("points", "are not an array of N x 3 numbers");
  }
  const py::ssize_t count = points.shape(0);
  py::array_t<float> values(count);
  py::array_t<float> gradients({count, py::ssize_t{3}});
  const float* const from = points.data();
  float* const distance = values.mutable_data();
  float* const gradient = gradients.mutable_data();
  {
    const py::gil_scoped_release others_go_on;
    for (py::ssize_t i = 0; i < count; ++i) {
      const auto sample = field->sample(Eigen::Map<const Eigen::Vector3f>(from + 3 * i));
      distance[i] = sample.distance;
      Eigen::Map<Eigen::Vector3f>(gradient + 3 * i) = sample.gradient;
    }
  }
  return py::make_tuple(values, gradients);
}

std::map<std::string, Eigen::Matrix4d> body_poses(const Model& self, const State& state) {
  const KinematicTree& tree = self.model->tree;
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(tree, to_configuration(tree, state), poses);
  std::map<std::string, Eigen::Matrix4d> result;
  for (std::size_t i = 0; i < poses.size(); ++i) result[tree.bodies[i].name] = poses[i].matrix();
  return result;
}

RenderedDepth drawn(const KinematicTree& tree, const Configuration& configuration,
                    const PinholeCamera& camera) {
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(tree, configuration, poses);
  std::vector<RenderItem> items;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!tree.bodies[i].visuals.empty()) items.push_back(body_item(tree, i, poses[i]));
  }
  RenderedDepth image;
  DepthRenderer(camera, Executor()).render(items, image);
  return image;
}

py::tuple render(const Model& self, const State& state, const Eigen::Matrix3d& intrinsics,
                 const std::pair<int, int>& shape) {
  constexpr int kMostPixels = 1 << 24;  // 4096 x 4096, as images of sources have at most
  const auto [height, width] = shape;
  if (height < 1 || width < 1 || width > kMostPixels / height) {
    throw InputError("shape", "is not (rows, columns) of an image of at most 4096 x 4096 pixels");
  }
  const KinematicTree& tree = self.model->tree;
  const Configuration configuration = to_configuration(tree, state);
  const PinholeCamera camera = to_camera(intrinsics, width, height);
  RenderedDepth image;
  {
    const py::gil_scoped_release others_go_on;
    image = drawn(tree, configuration, camera);
    for (float& depth : image.depth) depth = std::isfinite(depth) ? depth : 0.0F;
  }
  return py::make_tuple(py::array_t<float>({height, width}, image.depth.data()),
                        py::array_t<std::int16_t>({height, width}, image.id.data()));
}

void bind_joint(py::module_& module) {
  py::class_<Joint>(module, "Joint", "A movable joint of a model.")
      .def_readonly("name", &Joint::name, "Its name in the URDF.")
      .def_property_readonly(
          "type", [](const Joint& joint) { return type_name(joint.type); },
          "`revolute`, `continuous` (both in radians) or `prismatic` (in metres).")
      .def_readonly("lower", &Joint::lower,
                    "Lower limit, radians or metres; -inf if there is none.")
      .def_readonly("upper", &Joint::upper, "Upper limit, radians or metres; inf if there is none.")
      .def_readonly("is_mimic", &Joint::is_mimic, "Whether another joint drives it.")
      .def("__repr__", [](const Joint& joint) {
        return "<lockbox.Joint '" + joint.name + "', " + type_name(joint.type) + ">";
      });
}

/// joints: a mapping of names to numbers.
JointValues to_joint_values(const py::object& joints) {
  JointValues values;
  for (const auto& [name, value] : py::dict(joints)) {
    if (!py::isinstance<py::str>(name)) throw py::type_error("names of joints are strings");
    values.emplace_back(name.cast<std::string>(),
                        py::float_(py::reinterpret_borrow<py::object>(value)));
    if (!std::isfinite(values.back().second)) {
      throw InputError(in_quotes(values.back().first),
                       "has a position that is not a finite number");
    }
  }
  return values;
}

/// Returns the values as they are: those of results may be NaN.
py::tuple pickled_state(const State& state) {
  return py::make_tuple(state.base, state.joints);
}

State unpickled_state(const py::tuple& parts) {
  return {parts[0].cast<Eigen::Matrix4d>(), parts[1].cast<JointValues>()};
}

void bind_state(py::module_& module) {
  py::class_<State>(module, "State", "Where the object is, and how its joints stand.")
      .def(py::init([](const Eigen::Matrix4d& base, const py::object& joints) {
             to_pose(base);
             return State{base, to_joint_values(joints)};
           }),
           py::arg("base"), py::arg("joints") = py::dict(),
           "base: the 4x4 pose of the base link in the depth camera's optical frame (x right, y "
           "down, z forward; metres). joints: positions by name, radians or metres; those that are "
           "not named are at rest. Raises InputError.")
      .def_property(
          "base", [](const State& state) -> const Eigen::Matrix4d& { return state.base; },
          [](State& state, const Eigen::Matrix4d& base) {
            to_pose(base);
            state.base = base;
          },
          "The 4x4 pose of the base in the camera's frame, metres; it is assigned as a whole.")
      .def_property(
          "joints",
          [](const State& state) {
            return py::module_::import("types").attr("MappingProxyType")(to_dict(state.joints));
          },
          [](State& state, const py::object& joints) { state.joints = to_joint_values(joints); },
          "Positions by name, radians or metres; of states that the model or a result gives, in "
          "the order of `Model.joints`. It cannot be changed in place: assign a whole dict, as in "
          "state.joints = {**state.joints, 'door': 1.0}.")
      .def(py::pickle(&pickled_state, &unpickled_state))
      .def("__repr__", [](const State& state) {
        return py::str("<lockbox.State of {} joints, base at {}>")
            .format(state.joints.size(),
                    py::cast(Eigen::Vector3d(state.base.topRightCorner<3, 1>())));
      });
}

void bind_properties(py::class_<Model>& model) {
  model
      .def_property_readonly(
          "name", [](const Model& self) { return self.model->tree.name; }, "The robot's name.")
      .def_property_readonly(
          "file", [](const Model& self) { return self.model->file.string(); },
          "The file that it was read from.")
      .def_property_readonly(
          "joints",
          [](const Model& self) {
            std::vector<Joint> joints;
            for (const int i : self.model->tree.file_order) {
              joints.push_back(self.model->tree.joints[static_cast<std::size_t>(i)]);
            }
            return joints;
          },
          "Its movable joints in the order of the file.")
      .def_property_readonly(
          "variables",
          [](const Model& self) {
            const KinematicTree& tree = self.model->tree;
            std::vector<std::string> names;
            for (const int variable : variables_of_file(tree)) {
              const int joint = tree.variable_joint[static_cast<std::size_t>(variable)];
              names.push_back(tree.joints[static_cast<std::size_t>(joint)].name);
            }
            return names;
          },
          "The names of the joints that mimic no other, in the order of `joints`. Rows and columns "
          "6 and up of `Result.covariance` are theirs.")
      .def_property_readonly(
          "bodies",
          [](const Model& self) {
            std::vector<std::string> names;
            for (const Body& body : self.model->tree.bodies) names.push_back(body.name);
            return names;
          },
          "The names of its rigid bodies, the base first; body masks hold indices into this list.")
      .def_property_readonly(
          "rest_state",
          [](const Model& self) {
            return to_state(self.model->tree, rest_configuration(self.model->tree));
          },
          "The state with the base at the camera and all joints at rest.");
}

}  // namespace

void bind_model(py::module_& module) {
  bind_joint(module);
  bind_state(module);
  py::class_<Model> model(module, "Model",
                          "An articulated object: rigid bodies connected by joints.");
  bind_properties(model);
  model
      .def("body_poses", &body_poses, py::arg("state"),
           "The 4x4 poses of all bodies in the camera's frame, by name, metres.")
      .def(
          "signed_distance",
          [](const Model& self, const std::string& body, const Points& points) {
            return distances(self, body, points)[0].cast<py::array>();
          },
          py::arg("body"), py::arg("points"),
          "The distances (N, float32, metres, negative inside) of points (N x 3, metres, in the "
          "body's frame) to the surface of a body.")
      .def("signed_distance_and_gradient", &distances, py::arg("body"), py::arg("points"),
           "The same, and the gradients (N x 3, float32, without unit).")
      .def("render", &render, py::arg("state"), py::arg("intrinsics"), py::arg("shape"),
           "What a camera sees of the model: depths (rows x columns, float32, metres, 0 where "
           "nothing is) and the body of each pixel (rows x columns, int16, index into `bodies`, -1 "
           "where nothing is). intrinsics: the 3x3 camera matrix, pixels. shape: (rows, columns).")
      .def("__repr__", [](const Model& self) {
        return "<lockbox.Model '" + self.model->tree.name + "', " +
               std::to_string(self.model->tree.bodies.size()) + " bodies, " +
               std::to_string(self.model->tree.joints.size()) + " joints>";
      });
  module.def(
      "load_model", &load, py::arg("file"), py::arg("package_paths") = std::vector<Path>(),
      py::arg("mesh_scale") = 1.0,
      "Reads a URDF file, a bare .obj, .stl or .ply file, or a shipped model by its name. "
      "package_paths: folders to search for package:// meshes. mesh_scale: metres a unit of "
      "the mesh files. Distance fields are built, or taken from the cache. Raises InputError.");
}

}  // namespace lockbox::python
