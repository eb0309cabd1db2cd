"""Damaged files of every format, from a seed; ``python -m tests.robust.files``.

A damaged file is read, or refused in a sentence: any error but an `OccsimError`, and
any file that takes long, is a fault.
"""

import argparse
import io
import json
import struct
import time
import zipfile
import zlib
from collections.abc import Callable
from functools import partial

import numpy as np
from PIL import Image

from occsim import OccsimError, Trajectory, load_drawing, load_sample
from occsim.building import building_from_drawing
from occsim.io.metric import MetricFrame
from occsim.io.project import Project, dump_project, load_project
from occsim.io.trajectories import (
    TrajectoryFormat,
    dump_trajectory,
    read_trajectory_table,
)
from tests.robust import hostile

MAX_SECONDS = 10.0
FRAME = MetricFrame(height_px=100, metres_per_px=0.05)

# Typical values of damaged lengths and counts, and texts that parsers often mishandle.
TOKENS = (
    *[b"\0\0\0\0", b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\x80\0\0\0", b"\x01"],
    *[b"nan", b"1e999", b"-1", b"", b'"', b"[" * 500, b"\\ud800", b"\xed\xa0\x80"],
    *[b"\r", b"\n", b";", b",", b"\t", b"%", b"#", b"9" * 400, b"True", b"{}", b"<<"],
)


def plan() -> Image.Image:
    """A small drawing."""
    pixels = np.full((60, 80, 3), 255, np.uint8)
    pixels[10:13, 10:70] = pixels[10:50, 10:13] = (20, 20, 60)
    return Image.fromarray(pixels)


def encoded(kind: str, mode: str = "RGB", **options: object) -> bytes:
    """The small drawing as an image file."""
    out = io.BytesIO()
    plan().convert(mode).save(out, kind, **options)
    return out.getvalue()


def good_files() -> dict[str, list[bytes]]:
    """Undamaged files by format, several kinds of each."""
    poses = load_sample("a").trajectory
    few = type(poses)(poses=poses.poses[:8])
    text = {
        kind.value: [dump_trajectory(few, kind, degrees=turn) for turn in (True, False)]
        for kind in TrajectoryFormat
    }
    text["npy"].pop(0)  # the format cannot state degrees
    objects = [{"x": 1, "y": 2.5, "theta_deg": 90}, {"x": 3, "y": 4, "theta_deg": 0}]
    text["json"].append(json.dumps(objects).encode())
    text["tum"].append(b"1.0 0.5 0.5 0 0 0 0 1\n2.0 1 1 0 0 0 0.6 0.8\n")
    text["txt"] += ["x;y;θ°\n1,5;2;90\n".encode("utf-16"), b"1 0 0 1 0 1 0 0 0 0 1 2\n"]
    line = b"0 0 m 600 400 l S BT ET q 1 0 0 1 5 5 cm 3 w 0 0 9 9 re f Q"
    building = building_from_drawing(
        load_drawing(encoded("PNG")), load_sample("a").sensor
    )
    return text | {
        "png": [encoded("PNG"), encoded("PNG", "P"), encoded("PNG", "LA", dpi=(1, 1))],
        "jpeg": [encoded("JPEG"), encoded("JPEG", "CMYK", progressive=True)],
        "tiff": [
            *[encoded("TIFF", compression=c) for c in ("raw", "tiff_lzw", "jpeg")],
            *[encoded("TIFF", "1", compression="group4"), encoded("TIFF", "I;16")],
        ],
        "gif": [encoded("GIF")],
        "bmp": [encoded("BMP"), encoded("BMP", "1")],
        "webp": [encoded("WEBP"), encoded("WEBP", "RGBA", lossless=True)],
        "pgm": [encoded("PPM", "L"), b"P2\n9 9\n15\n" + b"3 " * 81],
        "pdf": [
            hostile.page(line, b""),
            hostile.page(line, b"", packed=True),
            hostile.nested_forms(2, 3),
        ],
        "project": [dump_project(Project(building=building, settings={"a": "b"}))],
    }


def opener(kind: str) -> Callable[[bytes], object]:
    """The function that opens a file of this format."""
    if kind == "project":
        return lambda data: load_project(data, name="a.zip")
    if kind in {item.value for item in TrajectoryFormat}:
        return lambda data: _trajectory(data, f"a.{kind}")
    return lambda data: load_drawing(data, name=f"a.{kind}", max_side_px=40)


def _trajectory(data: bytes, name: str) -> Trajectory:
    table = read_trajectory_table(data, name=name)
    return table.to_trajectory(frame=FRAME if table.metres else None)


def damaged(data: bytes, rng: np.random.Generator) -> bytes:
    """Bytes changed, cut, doubled or replaced, in one to four places."""
    out = bytearray(data)
    for _ in range(rng.integers(1, 5)):
        at, size = int(rng.integers(0, len(out) + 1)), int(rng.integers(1, 33))
        match rng.integers(0, 6):
            case 0:
                out[at : at + 1] = rng.bytes(1)
            case 1:
                out[at : at + size] = b""
            case 2:
                out[at:at] = out[at : at + size]
            case 3:
                out[at : at + 4] = TOKENS[rng.integers(0, len(TOKENS))]
            case 4:
                out[at:at] = TOKENS[rng.integers(0, len(TOKENS))]
            case _:
                del out[max(at, 1) :]
    return bytes(out)


def damaged_inside(kind: str, data: bytes, rng: np.random.Generator) -> bytes:
    """A file damaged below its checksums, where the format has any."""
    if kind == "project":
        return _damaged_project(data, rng)
    out = damaged(data, rng)
    return _with_checksums(out) if kind == "png" else out


def _damaged_project(data: bytes, rng: np.random.Generator) -> bytes:
    """One member damaged and all packed again, in one of zip's ways."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    name = list(members)[rng.integers(0, len(members))]
    kind = name.rpartition(".")[2]
    members[name] = damaged_inside(kind, members[name], rng)
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", (0, 8, 12, 14)[rng.integers(0, 4)]) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return out.getvalue()


def _with_checksums(data: bytes) -> bytes:
    """A PNG whose checksums are right as far as its chunks can be followed."""
    out, at = bytearray(data), 8
    while at + 12 <= len(out):
        end = at + 8 + struct.unpack_from(">I", out, at)[0]
        if end + 4 > len(out):
            break
        struct.pack_into(">I", out, end, zlib.crc32(out[at + 4 : end]))
        at = end + 4
    return bytes(out)


def faults(kind: str, files: list[bytes], n: int, seed: int) -> list[str]:
    """The faults of n damaged files of a format."""
    rng = np.random.default_rng([seed, *kind.encode()])
    found = []
    for number in range(n):
        damage = damaged if number % 2 else partial(damaged_inside, kind)
        data = damage(files[number % len(files)], rng)
        start = time.perf_counter()
        try:
            opener(kind)(data)
        except OccsimError as error:
            message = str(error)
            if "\n" in message or len(message) > 500 or not message.isprintable():
                found.append(f"{kind} {number}: no sentence: {message!r:.200}")
        except Exception as error:
            found.append(f"{kind} {number}: {type(error).__name__}: {error!s:.100}")
        seconds = time.perf_counter() - start
        if seconds > MAX_SECONDS:
            found.append(f"{kind} {number}: {seconds:.1f} s")
    return found


def main() -> None:
    """Damage many files of every format."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kinds", nargs="*", help="formats; all by default")
    parser.add_argument("--n", type=int, default=1000, help="files of each format")
    parser.add_argument("--seed", type=int, default=0)
    args = parser.parse_args()
    n_faults = 0
    for kind, files in good_files().items():
        if args.kinds and kind not in args.kinds:
            continue
        start = time.perf_counter()
        found = faults(kind, files, args.n, args.seed)
        print(f"{kind}: {len(found)} faults, {time.perf_counter() - start:.1f} s")
        print("\n".join(found[:10]), end="\n" if found else "")
        n_faults += len(found)
    raise SystemExit(bool(n_faults))


if __name__ == "__main__":
    main()
