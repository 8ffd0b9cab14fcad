#!/usr/bin/env python3
"""Objects x materials x lights, to be looked at: contact sheets of what overt renders.

    bench/objects_sheet.py [--overt PROGRAM] [--size PX] [--quality QUALITY] [--textured-only | --docs] FOLDER

Makes two textured objects (vase.glb, stone.glb: colours, metal and roughness, bumps; free of rights), two protocols of
small pictures and, by `overt bake --sheet`, FOLDER/materials.png (six objects in six materials under three lights) and
FOLDER/own.png (the textured ones as their files say, and with single properties given in place of that). With --docs
instead the pictures of docs/: objects.png, materials.png and lights.png, a few of these each (--size 96, below 300 kB
together). Needs nothing but Python.
"""
import argparse
import json
import math
import pathlib
import struct
import subprocess
import zlib


def png(width, height, pixel):
    """A picture by its function of column and row, which gives three codes."""
    raw = b"".join(b"\0" + bytes(code for x in range(width) for code in pixel(x, y)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


def normals_of(height, width, rows, depth):
    """A picture of the normals of a height, given as a function of column and row that goes round; x along the
    columns, y up the picture (glTF 2.0)."""
    def pixel(x, y):
        right = height((x + 1) % width, y) - height((x - 1) % width, y)
        up = height(x, max(y - 1, 0)) - height(x, min(y + 1, rows - 1))
        n = (-depth * right, -depth * up, 1.0)
        length = math.sqrt(sum(v * v for v in n))
        return tuple(round(127.5 * (v / length + 1.0)) for v in n)
    return png(width, rows, pixel)


def lathe(radius, rows, columns):
    """A closed surface about y, in metres, from its radius and height by the share of its length; u round it and v
    down. Positions, places on pictures, triangles."""
    positions, places, triangles = [], [], []
    for row in range(rows + 1):
        for column in range(columns + 1):
            turn = 2.0 * math.pi * column / columns
            r, y = radius(row / rows, turn)
            positions.append((r * math.sin(turn), y, r * math.cos(turn)))
            places.append((column / columns, row / rows))
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b = a + columns + 1
            if row > 0:
                triangles.append((a, b + 1, a + 1))
            if row < rows - 1:
                triangles.append((a, b, b + 1))
    return positions, places, triangles


def write_glb(path, name, shape, pictures, material):
    positions, places, triangles = shape
    parts = [b"".join(struct.pack("<3f", *p) for p in positions), b"".join(struct.pack("<2f", *p) for p in places),
             b"".join(struct.pack("<3I", *t) for t in triangles), *pictures]
    binary, views = b"", []
    for part in parts:
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(part)})
        binary += part + b"\0" * (-len(part) % 4)
    lows = [min(p[i] for p in positions) for i in range(3)]
    highs = [max(p[i] for p in positions) for i in range(3)]
    document = {
        "asset": {"version": "2.0", "generator": "bench/objects_sheet.py",
                  "extras": {"title": name, "license": "CC0-1.0", "author": "overt"}},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": name}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [material], "samplers": [{"wrapS": 10497, "wrapT": 33071}],
        "textures": [{"source": i, "sampler": 0} for i in range(len(pictures))],
        "images": [{"bufferView": 3 + i, "mimeType": "image/png"} for i in range(len(pictures))],
        "buffers": [{"byteLength": len(binary)}], "bufferViews": views,
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3", "min": lows, "max": highs},
            {"bufferView": 1, "componentType": 5126, "count": len(places), "type": "VEC2"},
            {"bufferView": 2, "componentType": 5125, "count": 3 * len(triangles), "type": "SCALAR"}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(binary)) + struct.pack("<II", len(text), 0x4E4F534A)
                     + text + struct.pack("<II", len(binary), 0x004E4942) + binary)


def vase(path):
    """Glazed bands with raised dots on a rough body, and a ring of metal."""
    def radius(t, turn):
        r = 0.045 * math.sin(math.pi * min(1.0, 0.04 + 0.96 * t)) ** 0.5 * (1.0 + 0.35 * math.sin(5.2 * t + 0.4))
        return max(r, 0.0) if 0.0 < t < 1.0 else 0.0, 0.075 - 0.15 * t

    width, rows = 512, 256

    def band(y):
        return "ring" if 60 <= y < 76 else "glaze" if 96 <= y < 200 else "body"

    def dot(x, y):
        u, v = (x % 32 - 16) / 12.0, ((y - 96) % 26 - 13) / 10.0
        return math.sqrt(max(0.0, 1.0 - u * u - v * v)) if band(y) == "glaze" else 0.0

    colours = {"ring": (235, 190, 90), "glaze": (30, 80, 140), "body": (190, 150, 120)}

    def colour(x, y):
        return (225, 215, 190) if dot(x, y) > 0.0 else colours[band(y)]

    def surface(x, y):
        return {"ring": (0, 70, 255), "glaze": (0, 50, 0), "body": (0, 200, 0)}[band(y)]

    write_glb(path, "vase", lathe(radius, 96, 128),
              [png(width, rows, colour), png(width, rows, surface), normals_of(dot, width, rows, 1.2)],
              {"name": "fired", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}},
               "normalTexture": {"index": 2}})


def stone(path):
    """A pebble of veined colours, polished, with fine pits."""
    def radius(t, turn):
        polar = math.pi * t
        r = 0.05 * (1.0 + 0.12 * math.sin(2 * turn + 1.0) * math.sin(polar) ** 2 + 0.08 * math.sin(3 * turn) * math.sin(polar) ** 3)
        return r * math.sin(polar), 0.72 * r * math.cos(polar)

    width, rows = 512, 256

    def vein(x, y):
        u = 2.0 * math.pi * x / width
        return math.sin(9.0 * y / rows * math.pi + 2.2 * math.sin(3 * u + 4.0 * y / rows) + 1.3 * math.sin(7 * u) + 0.6 * math.sin(11 * u + 9.0 * y / rows))

    def colour(x, y):
        share = abs(vein(x, y)) ** 0.4
        return tuple(round(a + share * (b - a)) for a, b in zip((235, 225, 205), (70, 105, 85)))

    def height(x, y):
        u = 2.0 * math.pi * x / width
        return 0.35 * math.sin(24 * u + 3 * math.sin(5 * u)) * math.sin(0.4 * y + 2 * math.sin(4 * u))

    write_glb(path, "stone", lathe(radius, 96, 128), [png(width, rows, colour), normals_of(height, width, rows, 0.5)],
              {"name": "polished", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0, "roughnessFactor": 0.25},
               "normalTexture": {"index": 1, "scale": 0.6}})


HEAD = """[protocol]
name = "{name}"
[display]
refresh_hz = 60
output = "native-8bit"
gamma = 2.2
linearised_by = "none"
background = 0.05
[view]
width_px = {size}
height_px = {size}
[[motion]]
kind = "still"
angle_deg = 20
[schedule]
observers = 2
[[task]]
id = "look"
question = "Look."
"""

LIGHTS = {
    "hall": """probe = "gallery"
exposure = 0.5
""",
    "sun": """probe = "overcast"
unit_cd_m2 = 5000
sun_lux = 30000
sun_azimuth_deg = 50
sun_elevation_deg = 35
exposure = 0.45
""",
    "lamps": """probe = "dark"
lamps = ["window", "bulb"]
exposure = 0.0015
""",
}

# Of the light of lamps; without effect where no light names them.
LAMPS = """[[lamp]]
id = "window"
shape = "rectangle"
luminance_cd_m2 = 2500
position = [-160, -160, 120]
width = 120
height = 160
[[lamp]]
id = "bulb"
shape = "sphere"
luminance_cd_m2 = 12000
colour = [1, 0.75, 0.45]
position = [180, -110, 60]
radius = 25
"""

MATERIALS = {
    "red": 'kind = "plastic"\nreflectance = [0.5, 0.06, 0.05]\nroughness = 0.08',
    "silver": 'kind = "rough-conductor"\nmetal = "Ag"\nroughness = 0.08\nanisotropy = 0.6',
    "film": 'kind = "rough-conductor"\nmetal = "Ag"\nroughness = 0.05\nfilm_nm = 350\nfilm_ior = 2.0',
    "glass": 'kind = "glass"\nior = 1.5\nabsorbance = [0.25, 0.05, 0.15]',
    "frosted": 'kind = "glass"\nior = 1.5\nroughness = 0.15',
    "lacquer": 'kind = "metallic-roughness"\nreflectance = [0.1, 0.25, 0.6]\nmetallic = 0.8\nroughness = 0.5\nclear_coat = 1\nclear_coat_roughness = 0.1',
}

OWN = {
    "own": 'kind = "own"',
    "flat": 'kind = "own"\nbumps = "none"',
    "glossy": 'kind = "own"\nroughness = 0.15',
    "matt": 'kind = "own"\nroughness = 0.9\nmetallic = 0',
    "lacquered": 'kind = "own"\nclear_coat = 1',
    "gold": 'kind = "rough-conductor"\nroughness = 0.1\nbumps = "own"',
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--overt", default="overt")
    parser.add_argument("--size", type=int, default=160)
    parser.add_argument("--quality", default="draft")
    parser.add_argument("--textured-only", action="store_true")
    parser.add_argument("--docs", action="store_true")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    vase(options.folder / "vase.glb")
    stone(options.folder / "stone.glb")
    textured = {name: f'mesh = "{name}.glb"' for name in ("vase", "stone")}
    shipped = {name: f'shipped = "{name}"' for name in ("muse", "runner", "scholar", "shape-03")}

    def entries(section, given):
        return "".join(f'[[{section}]]\nid = "{key}"\n{value}\n' for key, value in given.items())

    def only(given, *names):
        return {name: given[name] for name in names}

    def sheet(name, objects, materials, lights=LIGHTS):
        text = HEAD.format(name=name, size=options.size)
        text += "".join(f"[[light]]\nid = \"{key}\"\n{value}" for key, value in lights.items())
        text += LAMPS + entries("object", objects) + entries("material", materials)
        protocol = options.folder / f"{name}.toml"
        protocol.write_text(text)
        subprocess.run([options.overt, "bake", str(protocol), "--quality", options.quality, "--sheet",
                        str(options.folder / f"{name}.png")], check=True)

    if options.docs:
        sheet("objects", textured, OWN, only(LIGHTS, "sun"))
        sheet("materials", textured | only(shipped, "shape-03"),
              only(MATERIALS, "red", "silver", "film", "glass", "lacquer"), only(LIGHTS, "hall"))
        sheet("lights", only(textured, "vase"), only(MATERIALS, "red", "silver", "glass"))
        return
    sheet("own", textured, OWN)
    if not options.textured_only:
        sheet("materials", textured | shipped, MATERIALS)


if __name__ == "__main__":
    main()
