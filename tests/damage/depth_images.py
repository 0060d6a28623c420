# SPDX-License-Identifier: BSD-3-Clause
"""Folders of depth images (docs/recordings.md) whose every pixel is given."""
import struct
import zlib


def _chunk(kind, content):
    return (struct.pack(">I", len(content)) + kind + content +
            struct.pack(">I", zlib.crc32(kind + content)))


def png16(width, height, depths):
    """A 16-bit grey PNG file of these depths, row by row."""
    rows = struct.pack(f">{width * height}H", *depths)
    lines = b"".join(b"\0" + rows[2 * width * v:2 * width * (v + 1)] for v in range(height))
    return (b"\x89PNG\r\n\x1a\n" +
            _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)) +
            _chunk(b"IDAT", zlib.compress(lines, 1)) + _chunk(b"IEND", b""))


def camera_info(width, height):
    """The calibration of a camera that sees 58 degrees across."""
    focal = 0.9 * width
    return (f"image_width: {width}\nimage_height: {height}\n"
            f"camera_matrix: {{rows: 3, cols: 3, data: [{focal}, 0, {(width - 1) / 2}, "
            f"0, {focal}, {(height - 1) / 2}, 0, 0, 1]}}\ndistortion_model: plumb_bob\n"
            "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n")


def write_folder(folder, width, height, frames, stamps=None):
    """frames: of each the depths. stamps: seconds, 30 a second if they are not given."""
    (folder / "depth").mkdir(parents=True)
    (folder / "camera_info.yaml").write_text(camera_info(width, height))
    stamps = stamps or [number / 30 for number in range(len(frames))]
    (folder / "depth.txt").write_text("".join(
        f"{stamp:.6f} depth/{number:06}.png\n" for number, stamp in enumerate(stamps)))
    for number, depths in enumerate(frames):
        (folder / f"depth/{number:06}.png").write_bytes(png16(width, height, depths))
    return folder
