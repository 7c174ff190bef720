"""Writes glTF 2.0 binary files (.glb): just what Vindu's renderer draws.

Metallic-roughness factors, base colour texture (PNG inside the file), linear vertex colours,
KHR_materials_unlit, node transforms and node animation. Standard library only; equal input gives
equal bytes.
"""

import json
import struct
import zlib


def png(width, height, rgb):
    """PNG bytes of 8-bit RGB rows from the top."""
    stride = width * 3
    rows = bytearray()
    for y in range(height):
        row = rgb[y * stride : (y + 1) * stride]
        rows.append(1)  # filter "sub": bytes minus those one pixel to the left
        rows += row[:3]
        rows += bytes((a - b) & 255 for a, b in zip(row[3:], row[:-3]))

    def chunk(kind, data):
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
        + chunk(b"IEND", b"")
    )


class Document:
    """One scene; add materials, meshes, nodes and animation channels, then write."""

    def __init__(self, name):
        self.name = name
        self.binary = bytearray()
        self.views, self.accessors, self.materials, self.meshes, self.nodes = [], [], [], [], []
        self.images, self.textures, self.samplers, self.channels = [], [], [], []
        self.roots = []
        self.triangles = 0

    def _view(self, data, target=None):
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.binary += data
        self.views.append(view)
        return len(self.views) - 1

    def _accessor(self, data, kind, component, count, **more):
        target = more.pop("target", None)
        self.accessors.append(
            {
                "bufferView": self._view(data, target),
                "componentType": component,
                "count": count,
                "type": kind,
                **more,
            }
        )
        return len(self.accessors) - 1

    def _floats(self, rows, kind, **more):
        flat = [round(v, 5) + 0.0 for row in rows for v in row]
        return self._accessor(struct.pack(f"<{len(flat)}f", *flat), kind, 5126, len(rows), **more)

    def texture(self, png_bytes, name):
        self.images.append(
            {"bufferView": self._view(png_bytes), "mimeType": "image/png", "name": name}
        )
        self.textures.append({"source": len(self.images) - 1})
        return len(self.textures) - 1

    def material(self, name, base=(1, 1, 1, 1), **options):
        """Options: metallic, roughness, emissive, texture, unlit, blend, double_sided."""
        pbr = {
            "baseColorFactor": list(base),
            "metallicFactor": options.get("metallic", 0),
            "roughnessFactor": options.get("roughness", 0.7),
        }
        if options.get("texture") is not None:
            pbr["baseColorTexture"] = {"index": options["texture"]}
        entry = {"name": name, "pbrMetallicRoughness": pbr}
        if "emissive" in options:
            entry["emissiveFactor"] = list(options["emissive"])
        if options.get("unlit"):
            entry["extensions"] = {"KHR_materials_unlit": {}}
        if options.get("blend"):
            entry["alphaMode"] = "BLEND"
        if options.get("double_sided"):
            entry["doubleSided"] = True
        self.materials.append(entry)
        return len(self.materials) - 1

    def mesh(self, name, builder, material):
        """`builder` is a mesh.Mesh."""
        count = len(builder.positions)
        lows = [round(min(p[i] for p in builder.positions), 5) for i in range(3)]
        highs = [round(max(p[i] for p in builder.positions), 5) for i in range(3)]
        attributes = {
            "POSITION": self._floats(builder.positions, "VEC3", target=34962, min=lows, max=highs),
            "NORMAL": self._floats(builder.normals, "VEC3", target=34962),
        }
        if any(c != (1, 1, 1, 1) for c in builder.colours):
            data = bytes(max(0, min(255, int(v * 255 + 0.5))) for c in builder.colours for v in c)
            attributes["COLOR_0"] = self._accessor(
                data, "VEC4", 5121, count, normalized=True, target=34962
            )
        if builder.uvs:
            attributes["TEXCOORD_0"] = self._floats(builder.uvs, "VEC2", target=34962)
        wide = count > 65535
        data = struct.pack(f"<{len(builder.indices)}{'I' if wide else 'H'}", *builder.indices)
        indices = self._accessor(
            data, "SCALAR", 5125 if wide else 5123, len(builder.indices), target=34963
        )
        self.meshes.append(
            {
                "name": name,
                "primitives": [
                    {"attributes": attributes, "indices": indices, "material": material}
                ],
            }
        )
        self.triangles += len(builder.indices) // 3
        return len(self.meshes) - 1

    def node(self, name, mesh=None, parent=None, translation=None, rotation=None, scale=None):
        """Rotation: quaternion (x, y, z, w). Returns the node's index."""
        entry = {"name": name}
        for key, value in (
            ("mesh", mesh),
            ("translation", translation),
            ("rotation", rotation),
            ("scale", scale),
        ):
            if value is not None:
                entry[key] = value if key == "mesh" else [round(v, 6) + 0.0 for v in value]
        self.nodes.append(entry)
        index = len(self.nodes) - 1
        if parent is None:
            self.roots.append(index)
        else:
            self.nodes[parent].setdefault("children", []).append(index)
        return index

    def animate(self, node, path, times_s, values):
        """Linear keys of "translation", "rotation" or "scale"."""
        time = self._accessor(
            struct.pack(f"<{len(times_s)}f", *times_s),
            "SCALAR",
            5126,
            len(times_s),
            min=[times_s[0]],
            max=[times_s[-1]],
        )
        value = self._floats(values, "VEC4" if path == "rotation" else "VEC3")
        self.samplers.append({"input": time, "output": value, "interpolation": "LINEAR"})
        self.channels.append(
            {"sampler": len(self.samplers) - 1, "target": {"node": node, "path": path}}
        )

    def _json(self):
        document = {
            "asset": {"version": "2.0", "generator": "vindu tools/make_assets"},
            "scene": 0,
            "scenes": [{"name": self.name, "nodes": self.roots}],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": len(self.binary)}],
        }
        if any("extensions" in m for m in self.materials):
            document["extensionsUsed"] = ["KHR_materials_unlit"]
        if self.textures:
            document["images"], document["textures"] = self.images, self.textures
        if self.channels:
            document["animations"] = [
                {"name": "loop", "samplers": self.samplers, "channels": self.channels}
            ]
        return json.dumps(document, separators=(",", ":")).encode()

    def write(self, file):
        self.binary += b"\0" * (-len(self.binary) % 4)
        text = self._json()
        text += b" " * (-len(text) % 4)
        total = 12 + 8 + len(text) + 8 + len(self.binary)
        data = (
            struct.pack("<4sII", b"glTF", 2, total)
            + struct.pack("<I4s", len(text), b"JSON")
            + text
            + struct.pack("<I4s", len(self.binary), b"BIN\0")
            + bytes(self.binary)
        )
        with open(file, "wb") as out:
            out.write(data)
        print(f"{file}: {self.triangles} triangles, {len(self.meshes)} meshes, {len(data)} bytes")
