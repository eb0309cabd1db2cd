"""ROS maps from files and into files, as nav2's map_server reads and writes them."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from occsim._files import printable, read_source
from occsim._types import ByteArray
from occsim.errors import ParameterError, RobotFileError, choice, expect, real_number
from occsim.imaging import png_size
from occsim.io.images import png
from occsim.io.ros_map.image import (
    MapImage,
    pgm,
    read_image,
    transparent_png,
)
from occsim.io.ros_map.meta import (
    MapMeta,
    MapMode,
    dump_meta,
    parse_meta,
)
from occsim.io.ros_map.ros_map import FREE, OCCUPIED, UNKNOWN, RosMap, Values

MAX_IMAGE_BYTES = 200_000_000

LEVEL_FREE, LEVEL_UNKNOWN, LEVEL_OCCUPIED = 254, 205, 0
"""Grey levels that map_server writes in mode trinary."""

PIXELS_AT_ONCE = 1 << 20

_NEEDED = "a ROS map, a .yaml with its image,"


def load(
    yaml: bytes | str | Path,
    image: bytes | None = None,
    *,
    occupied_thresh: float | None = None,
    free_thresh: float | None = None,
) -> RosMap:
    r"""Return the map of a ROS map_server.

    Parameters
    ----------
    yaml : bytes, str or Path
        The ``.yaml``, or where it is.
    image : bytes, optional
        The image's content; by default the file that the ``.yaml`` names, which must
        lie in its folder or below. Needed where `yaml` is content.
    occupied_thresh, free_thresh : float, optional
        Thresholds to use in place of the file's.

    Returns
    -------
    RosMap

    Raises
    ------
    RobotFileError
        Where a file is missing, damaged or too large, a value makes no sense, or the
        image lies elsewhere.

    Notes
    -----
    Pixels are read as nav2 does [1]_. Mean brightness s gives occ = 1 - s (s with
    ``negate``). Trinary: occupied where occ is above `occupied_thresh`, free where it
    is below `free_thresh`, else unknown; transparency counts as a fourth colour.
    Scale: transparent is unknown; between the thresholds a percentage. Raw: the level
    itself, above 100 unknown.

    A trap: map_server writes unknown as level 205, occ = 0.196. With ``free_thresh:
    0.25``, which newer files state, nav2 reads that as free, and so does this function.
    ``load(..., free_thresh=0.196)`` keeps it unknown.

    References
    ----------
    .. [1] navigation2, nav2_map_server/src/map_io.cpp, loadMapFromFile.

    Examples
    --------
    >>> from occsim.io import ros_map
    >>> about = b"image: m.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
    >>> about += b"occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    >>> ros_map.load(about, b"P2 3 1 255 0 205 254").values
    array([[100,  -1,   0]], dtype=int8)
    """
    data, name = read_source(
        yaml,
        what="the .yaml",
        needed=_NEEDED,
        max_bytes=1_000_000,
        error=RobotFileError,
    )
    meta = parse_meta(data, name)
    thresholds = {"occupied_thresh": occupied_thresh, "free_thresh": free_thresh}
    given: dict[str, Any] = {
        key: real_number(key, value)
        for key, value in thresholds.items()
        if value is not None
    }
    meta = replace(meta, **given)
    found = read_image(*_image_of(meta, yaml, image))
    return RosMap(_read_values(found, meta), meta.resolution_m, meta.origin)


def dump(
    ros_map: RosMap,
    name: str = "map",
    *,
    mode: MapMode = MapMode.TRINARY,
    image_format: str | None = None,
) -> tuple[bytes, bytes]:
    """Return a map as the contents of a ``.yaml`` and of its image.

    Parameters
    ----------
    ros_map : RosMap
        The map.
    name : str, default "map"
        Of the files, without their endings: letters, digits, ``.``, ``_`` and ``-``.
    mode : MapMode, default MapMode.TRINARY
        RAW and SCALE are read back as they were. TRINARY, which every program reads,
        keeps unknown, free (below 19.6 %) and occupied (above 65 %); the rest becomes
        unknown.
    image_format : str, optional
        ``"pgm"`` or ``"png"``; by default PNG for SCALE, which needs transparency where
        anything is unknown, else PGM.

    Returns
    -------
    yaml, image : bytes

    Raises
    ------
    TypeError, ParameterError
        Where an argument is of another type or outside its domain.

    Notes
    -----
    Thresholds are written such that both this library and nav2 read the map back. nav2
    itself writes ``free_thresh: 0.25`` by default, with which unknown becomes free.

    Examples
    --------
    >>> from occsim.io.ros_map import RosMap, dump, load
    >>> room = RosMap([[100, 0], [0, -1]], 0.05)
    >>> yaml, image = dump(room, "room")
    >>> load(yaml, image).values.tolist()
    [[100, 0], [0, -1]]
    """
    expect("ros_map", ros_map, RosMap)
    mode = choice("mode", mode, MapMode)
    ending = image_format or ("png" if mode is MapMode.SCALE else "pgm")
    if ending not in ("pgm", "png"):
        raise ParameterError(f"image_format must be pgm or png; got {ending!r:.40}")
    if not isinstance(name, str) or not _is_plain(name):
        raise ParameterError(
            "name must be letters, digits, dots, underscores and hyphens; got "
            f"{printable(str(name))}"
        )
    meta = MapMeta(
        image=f"{name}.{ending}",
        resolution_m=ros_map.resolution_m,
        origin=ros_map.origin,
        occupied_thresh=1.0 if mode is MapMode.SCALE else 0.65,
        free_thresh=0.0 if mode is MapMode.SCALE else 0.196,
        mode=mode,
    )
    return dump_meta(meta), _image(ros_map, mode, ending)


def save(
    ros_map: RosMap,
    path: str | Path,
    *,
    mode: MapMode = MapMode.TRINARY,
    image_format: str | None = None,
) -> None:
    """Write a map into a ``.yaml`` and an image beside it, of the same name.

    Parameters
    ----------
    ros_map : RosMap
        The map.
    path : str or Path
        The ``.yaml``; both files are replaced if they are there.
    mode, image_format
        As in `dump`.

    Raises
    ------
    TypeError, ParameterError
        As in `dump`.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from occsim.io.ros_map import RosMap, load, save
    >>> with TemporaryDirectory() as folder:
    ...     save(RosMap([[100, 0]], 0.05), Path(folder) / "room.yaml")
    ...     load(Path(folder) / "room.yaml").values.tolist()
    [[100, 0]]
    """
    path = Path(path).with_suffix(".yaml")
    yaml, image = dump(ros_map, path.stem, mode=mode, image_format=image_format)
    ending = "pgm" if png_size(image) is None else "png"
    path.with_suffix(f".{ending}").write_bytes(image)
    path.write_bytes(yaml)


def _is_plain(name: str) -> bool:
    allowed = all(c.isalnum() or c in "._-" for c in name)
    return allowed and name.isascii() and 0 < len(name) < 200 and name[0] != "."


def _image_of(
    meta: MapMeta, yaml: bytes | str | Path, image: bytes | None
) -> tuple[bytes, str]:
    """Return the image's content and name."""
    name = printable(meta.image)
    source: bytes | Path
    if image is not None:
        source = image
    elif isinstance(yaml, str | Path):
        source = _inside(Path(yaml), meta.image, name)
    else:
        raise RobotFileError(f"the image {name} is needed beside the .yaml")
    return read_source(
        source,
        what=name,
        needed=_NEEDED,
        max_bytes=MAX_IMAGE_BYTES,
        error=RobotFileError,
    )


def _inside(yaml: Path, image: str, name: str) -> Path:
    """Return where the image lies, if that is in the folder of the ``.yaml``."""
    try:
        folder = yaml.parent.resolve()
        path = (folder / image).resolve()
    except (OSError, ValueError, RuntimeError):  # NUL in the name, a loop of links
        path = folder = Path()
    if not path.is_relative_to(folder) or path == folder:
        raise RobotFileError(
            f"the image must lie in the folder of the .yaml or below; got {name}"
        )
    return path


def _read_values(image: MapImage, meta: MapMeta) -> Values:
    """Return the percentages of an image, a strip at a time: memory stays bounded."""
    height, width = image.colour.shape
    values = np.empty((height, width), dtype=np.int8)
    step = PIXELS_AT_ONCE // width + 1
    for top in range(0, height, step):
        values[top : top + step] = _values(image.rows(top, top + step), meta)
    return values


def _values(image: MapImage, meta: MapMeta) -> Values:
    """Return percentages as nav2 reads them (loadMapFromFile)."""
    shade = image.colour
    if meta.mode is MapMode.RAW:
        level = np.floor(shade * 255.0 + 0.5)
        return np.where(level <= OCCUPIED, level, UNKNOWN).astype(np.int8)
    if meta.mode is MapMode.TRINARY and image.alpha is not None:
        shade = (3.0 * shade + image.alpha) / 4.0
    occ = shade if meta.negate else 1.0 - shade
    between = np.full(occ.shape, float(UNKNOWN))
    if meta.mode is MapMode.SCALE:
        span = meta.occupied_thresh - meta.free_thresh
        between = np.rint((occ - meta.free_thresh) / span * 100.0)
    values = np.where(occ < meta.free_thresh, FREE, between)
    values = np.where(meta.occupied_thresh < occ, OCCUPIED, values)
    if meta.mode is MapMode.SCALE:
        values = np.where(image.is_opaque, values, UNKNOWN)
    return values.astype(np.int8)


def _image(ros_map: RosMap, mode: MapMode, ending: str) -> bytes:
    unknown = ros_map.is_unknown
    if mode is MapMode.SCALE and unknown.any():
        if ending != "png":
            raise ParameterError(
                "image_format must be png in mode scale where pixels are unknown: "
                "they are transparent"
            )
        return transparent_png(_levels(ros_map, mode), ~unknown)
    levels = _levels(ros_map, mode)
    return png(levels) if ending == "png" else pgm(levels)


def _levels(ros_map: RosMap, mode: MapMode) -> ByteArray:
    values = ros_map.values
    if mode is MapMode.RAW:
        levels = np.where(values < 0, 255, values.astype(np.int16))
    elif mode is MapMode.SCALE:
        levels = np.rint((100.0 - np.maximum(values, 0)) * 2.55)
    else:
        levels = np.full(values.shape, LEVEL_UNKNOWN)
        levels[(values >= 0) & (values < 19.6)] = LEVEL_FREE
        levels[values > 65] = LEVEL_OCCUPIED
    return levels.astype(np.uint8)
