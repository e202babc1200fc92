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


def read_array(path: Path, name: str | None) -> list[float]:
    """All numbers of a point array; `None` for the coordinates, three a point."""
    text = path.read_text()
    start = text.index("<Points>") if name is None else text.index(f'Name="{name}"')
    tag = re.compile(r'format="binary"[^>]*>').search(text, start)
    content = text[tag.end() : text.index("</DataArray>", tag.end())]
    data = _decode(content)
    return list(struct.unpack(f"<{len(data) // 4}f", data))
