"""Images as different programs read them, in one form."""

import struct
import zlib
from dataclasses import dataclass

import OpenEXR
import OpenImageIO as oiio
import numpy as np


@dataclass
class Exr:
    """An EXR file. Windows are (x0, y0, x1, y1), the ends inclusive."""

    channels: dict
    film: tuple
    window: tuple
    compression: str
    increasing: bool
    attributes: dict


def by_openexr(path):
    """What OpenEXR's own library reads."""
    file = OpenEXR.File(str(path), separate_channels=True)
    assert len(file.parts) == 1, "one part"
    header = file.header()
    box = lambda name: tuple(int(x) for corner in header[name] for x in corner)
    return Exr(
        channels={name: channel.pixels for name, channel in file.channels().items()},
        film=box("displayWindow"),
        window=box("dataWindow"),
        compression=header["compression"].name.removesuffix("_COMPRESSION").lower(),
        increasing=header["lineOrder"].name == "INCREASING_Y",
        attributes=header,
    )


def by_openimageio(path):
    """What OpenImageIO reads, each channel in its own type."""
    file = oiio.ImageInput.open(str(path))
    assert file, oiio.geterror()
    spec = file.spec()
    assert not file.seek_subimage(1, 0), "one part"
    formats = spec.channelformats or [spec.format] * spec.nchannels
    channels = {}
    for k, (name, format) in enumerate(zip(spec.channelnames, formats)):
        pixels = file.read_image(0, 0, k, k + 1, str(format))
        channels[name] = pixels.reshape(spec.height, spec.width)
    return Exr(
        channels=channels,
        film=(spec.full_x, spec.full_y, spec.full_x + spec.full_width - 1, spec.full_y + spec.full_height - 1),
        window=(spec.x, spec.y, spec.x + spec.width - 1, spec.y + spec.height - 1),
        compression=spec.get_string_attribute("compression"),
        increasing=spec.get_string_attribute("openexr:lineOrder") == "increasingY",
        attributes={attribute.name: attribute.value for attribute in spec.extra_attribs},
    )


def png_texts(path):
    """The texts of a PNG by their keywords, by the format's definition alone."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "a PNG"
    texts, at = {}, 8
    while at < len(data):
        (length,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        body = data[at + 8 : at + 8 + length]
        (crc,) = struct.unpack(">I", data[at + 8 + length : at + 12 + length])
        assert crc == zlib.crc32(kind + body), f"checksum of {kind}"
        if kind == b"tEXt":
            keyword, text = body.split(b"\0", 1)
            texts[keyword.decode("latin-1")] = text.decode("latin-1")
        elif kind == b"iTXt":
            keyword, rest = body.split(b"\0", 1)
            assert rest[0] == 0, "not compressed"
            texts[keyword.decode("latin-1")] = rest[2:].split(b"\0", 2)[2].decode("utf-8")
        at += 12 + length
    return texts


def pfm(path):
    """A PFM by the format's definition alone: rows from the bottom."""
    kind, size, scale, samples = path.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    shape = {b"Pf": (height, width), b"PF": (height, width, 3)}[kind]
    array = np.frombuffer(samples, "<f4" if float(scale) < 0 else ">f4")
    return array.reshape(shape)[::-1]
