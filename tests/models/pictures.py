"""PNG files as Vindu writes them (8 bits, RGB or RGBA, not interlaced), read without any library,
and how much of one picture is not in another."""
import struct
import zlib


def read_png(path):
    """(width, height, channels, bytes of all rows)."""
    data = path.read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path}: is no PNG file")
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            if depth != 8 or colour not in (2, 6) or interlaced:
                raise ValueError(f"{path}: is not as Vindu writes PNG files")
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    channels = 3 if colour == 2 else 4
    return width, height, channels, unfiltered(zlib.decompress(packed), width * channels, channels)


def unfiltered(raw, stride, step):
    """PNG specification, 9.2: every row begins with the filter that was put on it."""
    out, before = bytearray(), bytearray(stride)
    for start in range(0, len(raw), stride + 1):
        row = bytearray(raw[start + 1:start + 1 + stride])
        undo(raw[start], row, before, step)
        out += row
        before = row
    return out


def undo(kind, row, before, step):
    if kind == 1:
        for i in range(step, len(row)):
            row[i] = (row[i] + row[i - step]) & 255
    elif kind == 2:
        for i, above in enumerate(before):
            row[i] = (row[i] + above) & 255
    elif kind == 3:
        for i, above in enumerate(before):
            left = row[i - step] if i >= step else 0
            row[i] = (row[i] + (left + above) // 2) & 255
    elif kind == 4:
        for i, above in enumerate(before):
            left, corner = (row[i - step], before[i - step]) if i >= step else (0, 0)
            row[i] = (row[i] + paeth(left, above, corner)) & 255


def paeth(left, above, corner):
    guess = left + above - corner
    to_left, to_above, to_corner = abs(guess - left), abs(guess - above), abs(guess - corner)
    if to_left <= to_above and to_left <= to_corner:
        return left
    return above if to_above <= to_corner else corner


def differing_pixels(picture, other, levels=3):
    """How many pixels are more than so many levels away in any channel; all where the sizes are not
    the same."""
    width, height, channels, bytes_here = picture
    if picture[:3] != other[:3]:
        return width * height
    far = [abs(a - b) > levels for a, b in zip(bytes_here, other[3])]
    return sum(any(far[i:i + channels]) for i in range(0, len(far), channels))
