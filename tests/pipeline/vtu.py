"""Read the VTU files that the tool writes: compressed binary arrays, as the VTK file formats describe them."""
import base64
import struct
import xml.etree.ElementTree as ElementTree
import zlib

NUMBER_FORMATS = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt8": "B"}
QUADRATIC_TRIANGLES = {22, 69}  # VTK_QUADRATIC_TRIANGLE, VTK_LAGRANGE_TRIANGLE
QUADRATIC_TETRAHEDRA = {24, 71}  # VTK_QUADRATIC_TETRA, VTK_LAGRANGE_TETRAHEDRON


def decoded(array):
    """Numbers of a DataArray: a base64 header (blocks, their size, last size, compressed sizes), then the blocks."""
    text = array.text.strip()
    n_blocks = struct.unpack("<I", base64.b64decode(text[:8])[:4])[0]
    n_header_bytes = 4 * (3 + n_blocks)
    n_header_letters = 4 * ((n_header_bytes + 2) // 3)
    header = struct.unpack(f"<{3 + n_blocks}I", base64.b64decode(text[:n_header_letters])[:n_header_bytes])
    data, raw, start = base64.b64decode(text[n_header_letters:]), b"", 0
    for size in header[3:]:
        raw += zlib.decompress(data[start:start + size])
        start += size
    number = NUMBER_FORMATS[array.get("type")]
    return struct.unpack(f"<{len(raw) // struct.calcsize(number)}{number}", raw)


class Mesh:
    """Points (rows of three), cells (lists of points), cell types and fields (name: rows) of one VTU file."""

    def __init__(self, file):
        piece = ElementTree.parse(file).getroot().find("UnstructuredGrid/Piece")
        self.points = self.rows(piece.find("Points/DataArray"))
        cells = {array.get("Name"): decoded(array) for array in piece.find("Cells")}
        ends = cells["offsets"]
        self.cells = [cells["connectivity"][a:b] for a, b in zip((0,) + ends[:-1], ends)]
        self.types = cells["types"]
        self.fields = {array.get("Name"): self.rows(array) for array in piece.find("PointData")}
        assert len(self.points) == int(piece.get("NumberOfPoints"))
        assert len(self.cells) == len(self.types) == int(piece.get("NumberOfCells"))

    @staticmethod
    def rows(array):
        n = int(array.get("NumberOfComponents", "1"))
        values = decoded(array)
        return [values[i:i + n] for i in range(0, len(values), n)]
