"""Reads PNG files, as far as to tell whether two pictures look alike: 8 bits, grey or RGB, not interlaced."""

import struct
import zlib
from pathlib import Path


def chunks(data: bytes):
    """Kind and content of each chunk (PNG specification, 5.3)."""
    at = 8
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        yield kind, data[at + 8:at + 8 + length]
        at += 12 + length


def paeth(a: int, b: int, c: int) -> int:
    """PNG specification, 9.4."""
    pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
    return a if pa <= pb and pa <= pc else b if pb <= pc else c


def unfiltered(kind: int, line: bytearray, above: bytearray, step: int) -> bytearray:
    """One line of samples (PNG specification, 9.2)."""
    for i in range(len(line) if kind else 0):
        left, corner = (line[i - step], above[i - step]) if i >= step else (0, 0)
        guess = (left, above[i], (left + above[i]) // 2, paeth(left, above[i], corner))[kind - 1]
        line[i] = (line[i] + guess) & 255
    return line


def samples(path: Path) -> tuple[tuple[int, int, int], bytes]:
    """Width, height and samples a pixel; and the samples. Throws ValueError for another kind of PNG."""
    packed, size = b"", None
    for kind, content in chunks(path.read_bytes()):
        if kind == b"IHDR":
            width, height, depth, color, *_, interlaced = struct.unpack(">IIBBBBB", content)
            if depth != 8 or color not in (0, 2) or interlaced:
                raise ValueError(f"{path}: not 8 bits, grey or RGB, without interlacing")
            size = (width, height, 3 if color == 2 else 1)
        elif kind == b"IDAT":
            packed += content
    raw, step = zlib.decompress(packed), size[2]
    row = size[0] * step
    above, image = bytearray(row), bytearray()
    for y in range(size[1]):
        start = y * (row + 1)
        above = unfiltered(raw[start], bytearray(raw[start + 1:start + 1 + row]), above, step)
        image += above
    return size, bytes(image)


def mean_difference(a: Path, b: Path) -> float:
    """Of two pictures, from 0 (the same) to 1; 1 where their sizes differ."""
    (size_a, samples_a), (size_b, samples_b) = samples(a), samples(b)
    if size_a != size_b:
        return 1
    return sum(abs(x - y) for x, y in zip(samples_a, samples_b)) / (255 * len(samples_a))
