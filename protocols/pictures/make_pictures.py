#!/usr/bin/env python3
"""Makes the pictures of ../pictures.toml beside itself: a room with a face, a ball and a window, three times, and a
movie in which the ball swings. Drawn for overt, under its licence."""
import math
import pathlib
import struct
import zlib

SIZE, FINER = 256, 3  # pixels each way; samples each way in a pixel


def mixed(one, other, share):
    return tuple(a + (b - a) * share for a, b in zip(one, other))


def ball(x, y, middle, radius, colour):
    """The colour of a lit ball at a place, or nothing."""
    right, down = (x - middle[0]) / radius, (y - middle[1]) / radius
    if right * right + down * down > 1:
        return None
    out = math.sqrt(1 - right * right - down * down)
    light = max(0.0, -0.45 * right - 0.6 * down + 0.66 * out)
    return tuple(c * (0.25 + 0.75 * light) + 0.5 * light ** 40 for c in colour)


def face(x, y, middle):
    right, down = (x - middle[0]) / 30, (y - middle[1]) / 36
    if right * right + down * down > 1:
        return None
    for side in (-1, 1):
        if math.hypot((right - 0.38 * side) / 0.17, (down + 0.2) / 0.13) < 1:
            return (0.06, 0.05, 0.05) if math.hypot(right - 0.38 * side, down + 0.2) < 0.09 else (0.9, 0.9, 0.88)
    if abs(down - 0.45 + 0.35 * right * right) < 0.06 and abs(right) < 0.42:
        return (0.45, 0.12, 0.12)
    return mixed((0.78, 0.55, 0.43), (0.5, 0.32, 0.24), min(1.0, max(0.0, 0.5 + 0.5 * right)))


def scene(x, y, face_at, ball_at, window_at):
    for found in (face(x, y, face_at), ball(x, y, ball_at, 24, (0.75, 0.16, 0.12))):
        if found:
            return found
    across, down = x - window_at[0], y - window_at[1]
    if abs(across) < 34 and abs(down) < 28:
        frame = abs(across) > 30 or abs(down) > 24 or abs(across) < 2 or abs(down) < 2
        return (0.32, 0.24, 0.16) if frame else mixed((0.55, 0.7, 0.9), (0.8, 0.85, 0.9), (down + 28) / 56)
    if y > 190:
        plank = (int((x - 128) / (y - 120) * 6 + 100) % 2) * 0.04
        return (0.42 + plank, 0.33 + plank, 0.25 + plank)
    return mixed((0.62, 0.62, 0.58), (0.5, 0.5, 0.47), y / 190)


def encoded(linear):
    value = min(1.0, max(0.0, linear))
    return round(255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055))


def write_png(path, **places):
    rows = []
    for y in range(SIZE):
        row = bytearray(b"\0")
        for x in range(SIZE):
            sums = [0.0, 0.0, 0.0]
            for i in range(FINER * FINER):
                found = scene(x + (i % FINER + 0.5) / FINER, y + (i // FINER + 0.5) / FINER, **places)
                sums = [a + b for a, b in zip(sums, found)]
            row += bytes(encoded(s / FINER ** 2) for s in sums)
        rows.append(bytes(row))

    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))


def main():
    here = pathlib.Path(__file__).resolve().parent
    write_png(here / "room_1.png", face_at=(64, 110), ball_at=(196, 206), window_at=(190, 60))
    write_png(here / "room_2.png", face_at=(190, 120), ball_at=(70, 200), window_at=(64, 64))
    write_png(here / "room_3.png", face_at=(128, 100), ball_at=(40, 210), window_at=(212, 56))
    for frame in range(12):
        swing = math.radians(35 * math.sin(2 * math.pi * frame / 12))
        write_png(here / f"swing_{frame:02}.png", face_at=(64, 110), window_at=(64, 40),
                  ball_at=(180 + 120 * math.sin(swing), 60 + 120 * math.cos(swing)))


if __name__ == "__main__":
    main()
