# SPDX-License-Identifier: BSD-3-Clause
"""What a model consists of, and how it is written as URDF with one .obj a link.

All solids are given in the frame of the base, at rest, in millimetres: parts that touch then have
literally the same numbers. Every link frame is parallel to the base's at rest.
"""

import math
import pathlib
from dataclasses import dataclass, field

LICENCE = "SPDX-License-Identifier: BSD-3-Clause"


@dataclass
class Link:
    name: str
    colour: tuple  # red, green, blue
    solids: list
    origin: tuple = (0, 0, 0)  # of the link frame


@dataclass
class Joint:
    name: str
    type: str  # revolute, continuous, prismatic
    parent: str
    child: str
    axis: tuple
    lower: float = 0  # degrees or millimetres
    upper: float = 0


@dataclass
class Model:
    name: str
    about: str
    links: list  # the base first
    joints: list
    position: tuple = (0, 0, 1250)  # T_camera_base of the initial state
    tilt: tuple = (-6, 10, 0)  # degrees about the camera's x, y and z, away from facing it
    # True for configurations (by joint name) that the object cannot take although each joint is
    # within its limits.
    impossible: object = field(default=lambda positions: False)

    def link(self, name):
        return next(link for link in self.links if link.name == name)


def metres(millimetres):
    """The shortest decimal of at most nanometres."""
    text = f"{millimetres / 1000:.9f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def write_mesh(path, link):
    lines = [f"# {LICENCE}", f"# {link.name}, metres"]
    first = 1
    for solid in link.solids:
        vertices, triangles = solid.mesh()
        for vertex in vertices:
            local = (metres(v - o) for v, o in zip(vertex, link.origin))
            lines.append("v " + " ".join(local))
        lines += ["f " + " ".join(str(first + i) for i in triangle) for triangle in triangles]
        first += len(vertices)
    path.write_text("\n".join(lines) + "\n")


def link_element(link):
    red, green, blue = link.colour
    return f"""  <link name="{link.name}">
    <visual>
      <geometry><mesh filename="meshes/{link.name}.obj"/></geometry>
      <material name="{link.name}"><color rgba="{red} {green} {blue} 1"/></material>
    </visual>
  </link>
"""


def joint_element(model, joint):
    parent, child = model.link(joint.parent), model.link(joint.child)
    xyz = " ".join(metres(c - p) for c, p in zip(child.origin, parent.origin))
    limit = ""
    if joint.type != "continuous":
        to_unit = metres if joint.type == "prismatic" else lambda d: f"{math.radians(d):.9g}"
        limit = (f'\n    <limit lower="{to_unit(joint.lower)}" upper="{to_unit(joint.upper)}"'
                 ' effort="10" velocity="2"/>')
    return f"""  <joint name="{joint.name}" type="{joint.type}">
    <parent link="{joint.parent}"/>
    <child link="{joint.child}"/>
    <origin xyz="{xyz}"/>
    <axis xyz="{" ".join(str(a) for a in joint.axis)}"/>{limit}
  </joint>
"""


def quaternion_product(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def initial_state(model):
    """The front faces the camera: x right, y up, z towards it; then tilted."""
    about_x, about_y, about_z = (math.radians(angle) / 2 for angle in model.tilt)
    facing = (1, 0, 0, 0)
    tilted = quaternion_product((0, 0, math.sin(about_z), math.cos(about_z)), facing)
    tilted = quaternion_product((0, math.sin(about_y), 0, math.cos(about_y)), tilted)
    tilted = quaternion_product((math.sin(about_x), 0, 0, math.cos(about_x)), tilted)
    position = ", ".join(metres(p) for p in model.position)
    quaternion = ", ".join(f"{q:.9f}" for q in tilted)
    return f"""# {LICENCE}
initial_state:
  position: [{position}]
  quaternion: [{quaternion}]
  joints: {{}}
"""


def write_model(folder, model):
    """Writes folder/<name>/<name>.urdf, .yaml and meshes/*.obj."""
    root = pathlib.Path(folder) / model.name
    (root / "meshes").mkdir(parents=True, exist_ok=True)
    for link in model.links:
        write_mesh(root / "meshes" / f"{link.name}.obj", link)
    links = "".join(link_element(link) for link in model.links)
    joints = "".join(joint_element(model, joint) for joint in model.joints)
    (root / f"{model.name}.urdf").write_text(
        f'<?xml version="1.0"?>\n<!-- {LICENCE} -->\n<!-- {model.about}\n'
        f'     Written by scripts/generate_models. -->\n'
        f'<robot name="{model.name}">\n{links}{joints}</robot>\n')
    (root / f"{model.name}.yaml").write_text(initial_state(model))
