"""Nodal values of the VTU files that the program writes."""

import re
import struct
from pathlib import Path


def read_array(path: Path, name: str) -> list:
    """All numbers of an array; of "Points", the coordinates, three a point."""
    xml, data = path.read_bytes().split(b'<AppendedData encoding="raw">\n_', 1)
    kind, offset = re.search(rf'<DataArray type="(\w+)" Name="{name}"[^>]* offset="(\d+)"', xml.decode()).groups()
    (size,) = struct.unpack_from("<Q", data, int(offset))
    code = {"Float32": "f", "Int32": "i"}[kind]
    return list(struct.unpack_from(f"<{size // 4}{code}", data, int(offset) + 8))


def read_polygons(path: Path) -> list[list[int]]:
    """The points of every cell."""
    points, ends = read_array(path, "connectivity"), read_array(path, "offsets")
    return [points[begin:end] for begin, end in zip([0, *ends], ends)]
