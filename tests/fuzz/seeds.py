#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the first inputs of each target of libFuzzer into FOLDER/<target>: sound files, most of
them those that tests/damage damages; and words to put into them, into FOLDER/<target>.dict.

LOCKBOX_TOOL names the tool, which simulates what is recorded.
"""
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "damage"))
import depth_images  # pylint: disable=wrong-import-position
import kinds  # pylint: disable=wrong-import-position
import mutation  # pylint: disable=wrong-import-position

SMALL = 16, 12  # pixels, of the images that depth_folder and camera_info are for
DRAWER = 32, 24  # pixels, of those that tracker and search are for (drawer.hpp)

# What sound files of tests/damage hold little of.
EQUIDISTANT = """image_width: 16
image_height: 12
camera_matrix: {rows: 3, cols: 3, data: [14.4, 0, 7.5, 0, 14.4, 5.5, 0, 0, 1]}
distortion_model: equidistant
distortion_coefficients: {rows: 1, cols: 4, data: [0.01, -0.002, 0.0003, 0]}
depth_scale: 5000
"""
BENT = EQUIDISTANT.replace("equidistant", "rational_polynomial").replace(
    "cols: 4, data: [0.01, -0.002, 0.0003, 0]",
    "cols: 8, data: [0.1, -0.02, 0.001, 0.001, 0, 0.1, -0.02, 0]")
STATES = """timestamp,tx,ty,tz,qx,qy,qz,qw,hinge,slide,status,belief
0,0,0,1,0,0,0,1,0.3,0.01,tracking,0.9
0.033333,0.1,-0.2,1.5,0.5,0.5,0.5,0.5,0.4,0.02,uncertain,0.5
0.066667,nan,nan,nan,nan,nan,nan,nan,nan,nan,lost,0
"""
# As target run takes them: MODEL stands for a model.
RUN = """lockbox: 0.1.0
model: MODEL
options: {mesh-scale: 0.001, threads: 2}
end: end of the source
"""
TUM = """# timestamp tx ty tz qx qy qz qw\r
1305031098.6659 1.3563 0.6305 1.6380 0.6132 0.5962 -0.3311 -0.3986\r
  1305031098.6758\t1.3543 -.6306 1e0 0 0 0.6 0.8 \r
"""
# A tetrahedron, also with what only faces of .obj files have.
VERTICES = [(0, 0, 0), (100, 0, 0), (0, 100, 0), (0, 0, 100)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
OBJ = """mtllib a.mtl
o part
v 0 0 0
v 100 0 0 1.0
v 0 1e2 0
v 0 0 100
vt 0 0
vn 0 0 1
g side
usemtl wood
s off
f 1/1/1 3/1/1 2/1/1
f -4//1 -3//1 -1//1
f 1 4 3
f 2/1 3/1 \\
 4/1
"""
CUBE = """<robot name="cube"><link name="cube"><visual><geometry><box size="0.02 0.02 0.02"/>
</geometry></visual></link></robot>
"""


def _field(folder):
    """The cached distance field of a small cube."""
    (folder / "cube.urdf").write_text(CUBE)
    (folder / "cube.yaml").write_text("voxel: 0.005\n")
    subprocess.run([os.environ["LOCKBOX_TOOL"], "inspect", "--model", folder / "cube.urdf"],
                   env={**os.environ, "XDG_CACHE_HOME": str(folder / "cube")}, check=True,
                   stdout=subprocess.DEVNULL)
    return next((folder / "cube").glob("lockbox/*.field")).read_bytes()


def _payloads(recording):
    """The encoded images of a recording (docs/recordings.md), as target oni_payload takes them."""
    for record in mutation.oni_records(recording):
        kind, _, fields = struct.unpack_from("<III", record, 4)
        if kind == 0xA:
            yield b"T" + struct.pack("<H", 160 * 120) + record[fields:]


def _depth_folders():
    """Sound ones of one image, as target depth_folder takes them: as stored, and with two lines."""
    width, height = SMALL
    image = depth_images.png16(width, height, [900 + 7 * i % 300 for i in range(width * height)])
    for index in ["0.0 image.png\n", "# timestamp file\n1e3 image.png\n2e3 ./image.png\n"]:
        yield index.encode() + b"\0" + image


def _drawer_images():
    """The drawer before a wall, as targets tracker and search take it: at rest, pulled, far."""
    width, height = DRAWER
    for pulled, distance in [(0, 500), (40, 500), (20, 700)]:
        image = [1200] * (width * height)
        for v in range(height):
            for u in range(width):
                x, y = (u - 15.5) / 32 * distance, (v - 11.5) / 32 * distance
                if abs(x) < 120 and abs(y) < 80:
                    image[v * width + u] = distance
                if abs(x - 50) < 40 and abs(y - 20) < 30:
                    image[v * width + u] = distance - 40 - pulled
        yield struct.pack(f"<{len(image)}H", *image)


# Words that readers know and that no sound file holds.
KNOWN = (b"floating planar package:// file:// model:// collision inertial safety_controller capsule "
         b"<!DOCTYPE <!ENTITY <!-- xacro: sphere cylinder cube tiff fisheye plumb_bob uchar double "
         b"list binary_big_endian binary_compressed inf null true ~ NONE 16zP JPEG").split()


def _dictionary(inputs):
    """The words of these inputs, and those that readers die of, as libFuzzer takes them."""
    words = set(re.findall(rb"[A-Za-z_.]{3,40}", b" ".join(inputs))) | set(mutation.WORDS + KNOWN)
    return "".join('"' + "".join(f"\\x{byte:02x}" for byte in word) + '"\n'
                   for word in sorted(words) if word)


def _read(folder, *patterns):
    return [file.read_bytes() for pattern in patterns for file in sorted(folder.glob(pattern))]


def _runs(files):
    """A run names its model by its path."""
    return [RUN.encode()] + [re.sub(rb"(?m)^model: .*$", b"model: MODEL", text)
                             for text in _read(files, "run/run.yaml")]


def _urdfs(files):
    """Round shapes have thousands of triangles, whose topology takes most of the time."""
    sound = _read(files, "door.urdf") + _read(kinds.SHARE, "models/*/*.urdf")
    flat = [re.sub(rb"<(sphere|cylinder) [^>]*/>", b'<box size="0.1 0.1 0.1"/>', text)
            for text in sound]
    return flat + sound[:1]


def seeds(files):
    """Of each target the inputs, made of what kinds.write_sound_files() has written."""
    images = list(_drawer_images())
    meshes = files / "tetrahedron"
    meshes.mkdir()
    kinds.write_meshes(meshes, VERTICES, FACES)
    return {
        "urdf": _urdfs(files),
        "obj": [OBJ.encode()],
        "stl": _read(meshes, "*.stl"),
        "ply": _read(meshes, "*.ply"),
        "model_parameters": _read(files, "door.yaml") + _read(kinds.SHARE, "models/*/*.yaml"),
        "states": [STATES.encode()] + _read(files, "truth.csv", "run/states.csv"),
        "field": [_field(files)],
        "camera_info": [depth_images.camera_info(*SMALL).encode(), EQUIDISTANT.encode(),
                        BENT.encode()],
        "depth_folder": list(_depth_folders()),
        "pcd": kinds.clouds(8),
        "oni": _read(files, "block.oni"),
        "oni_payload": list(_payloads((files / "block.oni").read_bytes())),
        "sensor": _read(kinds.SHARE, "sensors/*.yaml"),
        "scene": _read(kinds.SHARE, "scenes/*.yaml"),
        "deviation": _read(files, "deviation.yaml"),
        "tum": [TUM.encode()] + _read(files, "run/base.tum"),
        "run": _runs(files),
        "tracker": images + [images[0] + images[1]],
        "search": images,
    }


def main():
    corpora = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory(prefix="lockbox-sound-") as place:
        files = pathlib.Path(place)
        kinds.write_sound_files(files)
        for target, inputs in seeds(files).items():
            folder = corpora / target
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            for number, content in enumerate(inputs):
                (folder / str(number)).write_bytes(content)
            (corpora / f"{target}.dict").write_text(_dictionary(inputs))


if __name__ == "__main__":
    main()
