# SPDX-License-Identifier: BSD-3-Clause
"""The kinds of files that are damaged: sound ones, how they are mutated, and who reads them."""
import dataclasses
import os
import pathlib
import shutil
import struct
import subprocess
import typing

import depth_images
import mutation

SHARE = pathlib.Path(__file__).resolve().parents[2] / "share"

CAMERA = depth_images.camera_info(160, 120)

DOOR = """<?xml version="1.0"?>
<robot name="door">
  <material name="wood"><color rgba="0.6 0.4 0.2 1"/></material>
  <link name="frame"><visual><geometry><box size="0.3 0.02 0.4"/></geometry></visual></link>
  <link name="leaf"><visual><origin xyz="0.1 0 0" rpy="0 0.1 0"/>
    <geometry><mesh filename="block.obj" scale="0.5 0.5 0.5"/></geometry>
    <material name="wood"/></visual></link>
  <link name="bolt"><visual>
    <geometry><cylinder radius="0.02" length="0.1"/></geometry></visual></link>
  <link name="knob"><visual><geometry><sphere radius="0.03"/></geometry></visual></link>
  <joint name="hinge" type="revolute"><parent link="frame"/><child link="leaf"/>
    <origin xyz="0.15 0.02 0"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1.5" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="leaf"/><child link="bolt"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="0.05" effort="1" velocity="1"/>
    <mimic joint="hinge" multiplier="0.02" offset="0"/></joint>
  <joint name="weld" type="fixed"><parent link="leaf"/><child link="knob"/>
    <origin xyz="0.2 0.05 0"/></joint>
</robot>
"""

DOOR_PARAMETERS = """voxel: 0.004
link_voxel: {leaf: 0.003}
erosion: 0.001
pair_erosion:
  - {links: [frame, leaf], erosion: 0.002}
initial_state: {position: [0, 0, 1], quaternion: [0, 0, 0, 1], joints: {hinge: 0.3}}
"""

DEVIATION = """seed: 3
object: {scale: 1.01, sizes: 0.001, bend: 0.001, added_parts: 1, added_share: 0.1}
camera: {focal_length: 1.01, principal_point: [1, 2], distortion: [0.01, 0.001]}
depth: {scale: 1.01, bend: 0.001, corners: 0.002}
frames: {rate: 20, repeated: 0.1, missing: 0.1}
"""


OPTIONS = """threads = 2
iterations = 4
sensor = "stereo"
collision = literal
fixed-base = true
"""


@dataclasses.dataclass(frozen=True)
class Kind:
    name: str
    mutate: typing.Callable
    targets: list  # patterns of files, of which one is damaged, as write_sound_files() names them
    commands: list  # the tool's arguments, of which one list is taken
    allowed: tuple = (0,)  # exit statuses of what is not refused
    cache: str = "cache"  # folder of distance fields

    def files(self, folder):
        return [file for target in self.targets for file in sorted(folder.glob(target))]


def _track(source, *more):
    return ["track", "--model", "rigid_block", "--source", source, "--initial-state",
            "{folder}/start.csv", "--output", "{folder}/out", "--threads", "2", "--quiet", *more]


def _simulate(*more):
    return ["simulate", "--model", "rigid_block", "--trajectory", "{folder}/start.csv", "--frames",
            "1", "--camera-info", "{folder}/camera.yaml", "--output", "{folder}/new", "--quiet",
            *more]


INSPECT = [["inspect", "--model", "{target}"]]
EVALUATE = ["evaluate", "--estimate", "{folder}/run/states.csv", "--reference",
            "{folder}/truth.csv", "--output", "{folder}/errors"]
TRACKED = (0, 1, 5)

KINDS = [
    Kind("oni", mutation.recording, ["block.oni"], [_track("{target}")], TRACKED),
    Kind("png", mutation.image, ["images/depth/000000.png", "images/depth/000001.png"],
         [_track("{folder}/images")], TRACKED),
    Kind("index", mutation.text, ["images/depth.txt"], [_track("{folder}/images")], TRACKED),
    # Recorded, as they show no block, which would be sought for long.
    Kind("pcd", mutation.text, ["clouds/*.pcd"],
         [["record", "--source", "{folder}/clouds", "--output", "{folder}/new.oni", "--quiet"]]),
    Kind("camera", mutation.text, ["images/camera_info.yaml"], [_track("{folder}/images")],
         TRACKED),
    Kind("sensor", mutation.text, ["stereo.yaml", "time-of-flight-biased.yaml"],
         [_track("{folder}/images", "--sensor", "{target}"), _simulate("--sensor", "{target}")],
         TRACKED),
    Kind("urdf", mutation.text, ["door.urdf"], INSPECT),
    Kind("model", mutation.text, ["door.yaml"], [["inspect", "--model", "{folder}/door.urdf"]]),
    Kind("obj", mutation.text, ["block.obj"], INSPECT),
    Kind("stl", mutation.binary, ["text.stl", "binary.stl"], INSPECT),
    Kind("ply", mutation.text, ["text.ply", "binary.ply"], INSPECT),
    Kind("scene", mutation.text, ["room.yaml", "room_with_person.yaml"],
         [_simulate("--scene", "{target}")]),
    Kind("deviation", mutation.text, ["deviation.yaml"], [_simulate("--deviation", "{target}")]),
    Kind("states", mutation.text, ["run/states.csv", "truth.csv"], [EVALUATE]),
    Kind("start", mutation.text, ["start.csv"], [_track("{folder}/images")], TRACKED),
    Kind("tum", mutation.text, ["run/base.tum"],
         [["evaluate", "--estimate", "{folder}/run/states.csv", "--reference", "{target}"]]),
    Kind("run", mutation.text, ["run/run.yaml"], [EVALUATE]),
    Kind("config", mutation.text, ["options.ini"],
         [_track("{folder}/images", "--config", "{target}")], TRACKED),
    Kind("cache", mutation.binary, ["one_field/lockbox/*.field"],
         [["inspect", "--model", "rigid_block"]], cache="one_field"),
]


def _faces():
    """The triangles of the shipped block."""
    vertices, faces = [], []
    for line in (SHARE / "models/rigid_block/meshes/block.obj").read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append(tuple(float(word) for word in words[1:4]))
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
            faces += [(corners[0], *pair) for pair in zip(corners[1:], corners[2:])]
    return vertices, faces


def write_meshes(folder, vertices, faces):
    """Text and binary .stl and .ply files."""
    corners = [[vertices[index] for index in face] for face in faces]
    (folder / "text.stl").write_text("solid block\n" + "".join(
        "facet normal 0 0 0\nouter loop\n" +
        "".join("vertex {} {} {}\n".format(*corner) for corner in triangle) +
        "endloop\nendfacet\n" for triangle in corners) + "endsolid block\n")
    (folder / "binary.stl").write_bytes(bytes(80) + struct.pack("<I", len(corners)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *sum(triangle, ()), 0) for triangle in corners))
    header = ("ply\nformat {} 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
              "property float z\nelement face %d\nproperty list uchar int vertex_indices\n"
              "end_header\n") % (len(vertices), len(faces))
    (folder / "text.ply").write_text(
        header.format("ascii") + "".join("{} {} {}\n".format(*vertex) for vertex in vertices) +
        "".join("3 {} {} {}\n".format(*face) for face in faces))
    (folder / "binary.ply").write_bytes(
        header.format("binary_little_endian").encode() +
        b"".join(struct.pack("<3f", *vertex) for vertex in vertices) +
        b"".join(struct.pack("<B3i", 3, *face) for face in faces))


def clouds(stride):
    """A wall at 1 m with a step in it, seen by every stride-th pixel of the camera above: .pcd
    files of text, of bytes, and compressed ones, of which every byte stands for itself."""
    points = [((u - 79.5) * z / 144, (v - 59.5) * z / 144, z)
              for v in range(0, 120, stride) for u in range(0, 160, stride)
              for z in [0.8 if 60 < u < 100 else 1.0]]
    header = ("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {}\n"
              "HEIGHT {}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA ").format(
                  160 // stride, 120 // stride, len(points))
    columns = b"".join(struct.pack(f"<{len(points)}f", *column) for column in zip(*points))
    runs = [columns[at:at + 32] for at in range(0, len(columns), 32)]  # LZF's longest of literals
    packed = b"".join(bytes([len(run) - 1]) + run for run in runs)
    words = "".join("{:g} {:g} {:g}\n".format(*point) for point in points)
    plain = b"".join(struct.pack("<3f", *point) for point in points)
    sizes = struct.pack("<II", len(packed), len(columns))
    return [(header + "ascii\n" + words).encode(), (header + "binary\n").encode() + plain,
            (header + "binary_compressed\n").encode() + sizes + packed]


def _write_clouds(folder):
    folder.mkdir()
    for number, content in enumerate(clouds(1)):
        (folder / f"{number}.pcd").write_bytes(content)


def write_sound_files(folder):
    """All files that are damaged, and those that are read with them."""
    def lockbox(*arguments, cache="cache"):
        subprocess.run([os.environ["LOCKBOX_TOOL"], *map(str, arguments)], check=True,
                       env={**os.environ, "XDG_CACHE_HOME": str(folder / cache)},
                       stdout=subprocess.DEVNULL)

    (folder / "camera.yaml").write_text(CAMERA)
    (folder / "door.urdf").write_text(DOOR)
    (folder / "door.yaml").write_text(DOOR_PARAMETERS)
    (folder / "deviation.yaml").write_text(DEVIATION)
    (folder / "options.ini").write_text(OPTIONS)
    for file in ["scenes/room.yaml", "scenes/room_with_person.yaml", "sensors/stereo.yaml",
                 "sensors/time-of-flight-biased.yaml"]:
        shutil.copy(SHARE / file, folder)
    shutil.copy(SHARE / "models/rigid_block/meshes/block.obj", folder)
    write_meshes(folder, *_faces())
    _write_clouds(folder / "clouds")
    simulated = ["simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames", 3,
                 "--camera-info", folder / "camera.yaml", "--quiet", "--output"]
    lockbox(*simulated, folder / "images")
    lockbox(*simulated, folder / "block.oni", "--overwrite")
    (folder / "groundtruth.csv").rename(folder / "start.csv")
    shutil.copy(folder / "start.csv", folder / "truth.csv")
    lockbox("track", "--model", "rigid_block", "--source", folder / "block.oni", "--initial-state",
            folder / "start.csv", "--output", folder / "run", "--quiet")
    for model in ["door.urdf", "block.obj"]:
        lockbox("inspect", "--model", folder / model)
    lockbox("inspect", "--model", "rigid_block", cache="one_field")
