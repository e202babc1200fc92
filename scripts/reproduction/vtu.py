"""Nodal values of the VTU files that the program writes."""

import base64
import re
import struct
import zlib
from pathlib import Path


def _decode(text: str) -> bytes:
    """The bytes of one binary, zlib-compressed data array: counts and sizes, then the blocks."""
    raw = text.strip()
    n_blocks = struct.unpack("<I", base64.b64decode(raw[:8])[:4])[0]
    header_length = 4 * (3 + n_blocks)
    header_characters = 4 * ((header_length + 2) // 3)
    header = base64.b64decode(raw[:header_characters])
    sizes = struct.unpack(f"<{n_blocks}I", header[12:header_length])
    data = base64.b64decode(raw[header_characters:])
    result = b""
    for size in sizes:
        result += zlib.decompress(data[:size])
        data = data[size:]
    return result


def read_array(path: Path, name: str | None) -> list:
    """All numbers of an array; `None` for the coordinates, three a point."""
    text = path.read_text()
    start = text.index("<Points>") if name is None else text.index(f'Name="{name}"')
    tag = re.compile(r'<DataArray type="(\w+)"[^>]*format="binary"[^>]*>').search(text, text.rindex("<", 0, start + 1))
    content = text[tag.end() : text.index("</DataArray>", tag.end())]
    data = _decode(content)
    code, size = {"Float32": ("f", 4), "Int32": ("i", 4)}[tag[1]]
    return list(struct.unpack(f"<{len(data) // size}{code}", data))


def read_polygons(path: Path) -> list[list[int]]:
    """The points of every cell."""
    points, ends = read_array(path, "connectivity"), read_array(path, "offsets")
    return [points[begin:end] for begin, end in zip([0, *ends], ends)]
