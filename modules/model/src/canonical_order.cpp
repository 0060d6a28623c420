// SPDX-License-Identifier: BSD-3-Clause
#include "canonical_order.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "lockbox/mesh/content_hash.hpp"
#include "lockbox/mesh/mesh_audit.hpp"

namespace lockbox {
namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// What a joint and all that it carries are, apart from names.
struct Content {
  std::vector<double> joint;   ///< placement, axis, type, limits, mimic parameters
  std::uint64_t geometry = 0;  ///< of the child body
  std::uint64_t subtree = 0;   ///< of all that hangs on the child body

  bool operator<(const Content& other) const {
    return std::tie(joint, geometry, subtree) <
           std::tie(other.joint, other.geometry, other.subtree);
  }
};

std::vector<double> joint_content(const Joint& joint) {
  std::vector<double> content;
  const auto& T = joint.T_parent_joint.matrix();
  for (const int column : {3, 0, 1, 2}) {
    for (int row = 0; row < 3; ++row) content.push_back(T(row, column));
  }
  content.insert(content.end(), joint.axis.begin(), joint.axis.end());
  content.insert(content.end(), {static_cast<double>(joint.type), joint.lower, joint.upper,
                                 joint.is_mimic ? 1.0 : 0.0, joint.multiplier, joint.offset});
  for (double& value : content) value += 0.0;  // -0 and 0 are the same place
  return content;
}

std::uint64_t subtree_hash(const std::vector<int>& sorted_children,
                           const std::vector<Content>& contents) {
  ContentHash hash;
  for (const int joint : sorted_children) {
    const Content& content = contents[index(joint)];
    for (const double value : content.joint) hash.add(value);
    hash.add(content.geometry);
    hash.add(content.subtree);
  }
  return hash.value();
}

void merge_visuals(Body& body) {
  using Keyed = std::pair<std::uint64_t, ColoredMesh>;
  std::vector<Keyed> keyed;
  for (ColoredMesh& visual : body.visuals) {
    keyed.emplace_back(content_hash(visual.mesh), std::move(visual));
  }
  std::stable_sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    const auto& [hash_a, visual_a] = a;
    const auto& [hash_b, visual_b] = b;
    if (hash_a != hash_b) return hash_a < hash_b;
    return std::lexicographical_compare(visual_a.rgba.begin(), visual_a.rgba.end(),
                                        visual_b.rgba.begin(), visual_b.rgba.end());
  });
  body.visuals.clear();
  for (auto& [hash, visual] : keyed) {
    append(body.mesh, visual.mesh);
    body.visuals.push_back(std::move(visual));
  }
  body.encloses_solid = encloses_solid(body.mesh);
}

/// Returns for each body the joints that hang on it, sorted by content.
std::vector<std::vector<int>> sorted_children(const RigidBodies& rigid) {
  std::vector<std::vector<int>> children(rigid.bodies.size());
  std::vector<Content> contents(rigid.joints.size());
  const auto less = [&](int a, int b) {
    if (contents[index(a)] < contents[index(b)]) return true;
    if (contents[index(b)] < contents[index(a)]) return false;
    return rigid.joints[index(a)].name < rigid.joints[index(b)].name;
  };
  // Children follow their parents, so that backwards every subtree is complete when it is read.
  for (int body = static_cast<int>(rigid.bodies.size()) - 1; body >= 0; --body) {
    auto& own = children[index(body)];
    std::sort(own.begin(), own.end(), less);
    const int above = rigid.bodies[index(body)].parent_joint;
    if (above < 0) continue;
    contents[index(above)] = {joint_content(rigid.joints[index(above)]),
                              content_hash(rigid.bodies[index(body)].mesh),
                              subtree_hash(own, contents)};
    children[index(rigid.joints[index(above)].parent_body)].push_back(above);
  }
  return children;
}

}  // namespace

RigidBodies in_canonical_order(RigidBodies rigid) {
  for (Body& body : rigid.bodies) merge_visuals(body);
  const auto children = sorted_children(rigid);
  RigidBodies ordered;
  ordered.mimics = std::move(rigid.mimics);
  ordered.extents = std::move(rigid.extents);
  std::vector<int> new_index(rigid.bodies.size());
  std::vector<int> waiting{0};
  while (!waiting.empty()) {
    const int body = waiting.back();
    waiting.pop_back();
    new_index[index(body)] = static_cast<int>(ordered.bodies.size());
    Body& moved = ordered.bodies.emplace_back(std::move(rigid.bodies[index(body)]));
    if (moved.parent_joint >= 0) {
      Joint& joint =
          ordered.joints.emplace_back(std::move(rigid.joints[index(moved.parent_joint)]));
      joint.parent_body = new_index[index(joint.parent_body)];
      joint.child_body = new_index[index(body)];
      moved.parent_joint = static_cast<int>(ordered.joints.size()) - 1;
    }
    const auto& own = children[index(body)];
    // The last one in is the first one out.
    for (auto joint = own.rbegin(); joint != own.rend(); ++joint) waiting.push_back(*joint + 1);
  }
  return ordered;
}

}  // namespace lockbox
