# SPDX-License-Identifier: BSD-3-Clause
"""Damages files in the ways in which they go bad, and in those that readers die of.

Every function takes what it damages and a random.Random, from which all of it follows.
"""
import re
import struct
import zlib

WORDS = [b"", b"\n", b"\r\n", b" ", b"\t", b"#", b",", b";", b"0", b"-1", b"1e-300", b"1e300",
         b"1e999", b"nan", b"-inf", b"4294967295", b"4294967296", b"9223372036854775807",
         b"-2147483648", b"0x10", b"1,5", b"\xff\xfe", b"\xef\xbb\xbf", b"\x00", b"{", b"[[[[",
         b"&a *a", b"<", b"&amp;", b"..", b"/dev/zero"]
NUMBERS_32 = [0, 1, 2, 0x7F, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFE, 0xFFFFFFFF]
ONI_HEADER = 24


def _range(data, random, longest):
    begin = random.randrange(len(data) + 1)
    return begin, min(len(data), begin + random.randint(1, longest))


def _change_bytes(data, random):
    """One change that needs no knowledge of the format."""
    change = random.choice("flip number cut erase repeat zero".split())
    begin, end = _range(data, random, 64)
    if change == "flip" and begin < len(data):
        return data[:begin] + bytes([random.randrange(256)]) + data[begin + 1:]
    if change == "number":
        return data[:begin] + struct.pack("<I", random.choice(NUMBERS_32)) + data[begin + 4:]
    if change == "cut":
        return data[:begin]
    if change == "erase":
        return data[:begin] + data[end:]
    if change == "repeat":
        return data[:end] + data[begin:]
    return data[:begin] + bytes(end - begin) + data[end:]


def binary(data, random):
    for _ in range(random.randint(1, 4)):
        data = _change_bytes(data, random)
    return data


def _replace_number(data, random):
    numbers = list(re.finditer(rb"-?\d+(\.\d+)?(e-?\d+)?", data))
    if not numbers:
        return data
    number = random.choice(numbers)
    return data[:number.start()] + random.choice(WORDS) + data[number.end():]


def _change_lines(data, random):
    lines = data.split(b"\n")
    first, second = random.randrange(len(lines)), random.randrange(len(lines))
    change = random.choice("swap remove repeat".split())
    if change == "swap":
        lines[first], lines[second] = lines[second], lines[first]
    elif change == "remove":
        del lines[first]
    else:
        lines.insert(second, lines[first])
    return b"\n".join(lines)


def _insert_word(data, random):
    at = random.randrange(len(data) + 1)
    return data[:at] + random.choice(WORDS) + data[at:]


def text(data, random):
    for _ in range(random.randint(1, 3)):
        change = random.choice([_replace_number, _replace_number, _change_lines, _insert_word,
                                _change_bytes])
        data = change(data, random)
    return data


def _change_blocks(blocks, random):
    """Blocks of a file duplicated, removed, reordered, or the file cut off between two."""
    first, second = random.randrange(len(blocks)), random.randrange(len(blocks))
    change = random.choice("duplicate remove swap cut".split())
    if change == "duplicate":
        blocks.insert(second, blocks[first])
    elif change == "remove":
        del blocks[first]
    elif change == "swap":
        blocks[first], blocks[second] = blocks[second], blocks[first]
    else:
        del blocks[first:]
    return blocks


def oni_records(data):
    """The records of a sound recording, header, fields and payload (docs/recordings.md)."""
    records, begin = [], ONI_HEADER
    while begin < len(data):
        fields, payload = struct.unpack_from("<II", data, begin + 12)
        records.append(data[begin:begin + fields + payload])
        begin += fields + payload
    return records


def _change_one(blocks, random, header):
    """Damages the first bytes of a block, or what follows them."""
    at = random.randrange(len(blocks))
    block = blocks[at]
    if random.random() < 0.5:
        blocks[at] = binary(block[:header], random) + block[header:]
    else:
        blocks[at] = block[:header] + binary(block[header:], random)
    return blocks


def recording(data, random):
    """A .oni file: its header, headers and payloads of records, records as a whole, or cut off."""
    way = random.choice("header record records any".split())
    if way == "any":
        return binary(data, random)
    if way == "header":
        return binary(data[:ONI_HEADER], random) + data[ONI_HEADER:]
    change = (lambda b, r: _change_one(b, r, 28)) if way == "record" else _change_blocks
    return data[:ONI_HEADER] + b"".join(change(oni_records(data), random))


def _png_chunks(data):
    chunks, begin = [], 8
    while begin < len(data):
        size, = struct.unpack_from(">I", data, begin)
        chunks.append((data[begin + 4:begin + 8], data[begin + 8:begin + 8 + size]))
        begin += 12 + size
    return chunks


def image(data, random):
    """A PNG file. In most cases checksums are right: else nothing behind them is ever reached."""
    if random.random() < 0.3:
        return binary(data, random)
    chunks = _png_chunks(data)
    if random.random() < 0.3:
        chunks = _change_blocks(chunks, random)
    else:
        at = random.randrange(len(chunks))
        kind, content = chunks[at]
        if kind == b"IDAT" and random.random() < 0.5:
            content = zlib.compress(binary(zlib.decompress(content), random))
        else:
            content = binary(content, random)
        chunks[at] = kind, content
    return data[:8] + b"".join(
        struct.pack(">I", len(content)) + kind + content +
        struct.pack(">I", zlib.crc32(kind + content)) for kind, content in chunks)
