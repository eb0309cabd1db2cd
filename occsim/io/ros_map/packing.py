"""A ROS map as one zip file, or as the files that a user gives together."""

import io
import zipfile
from collections.abc import Mapping

from occsim import _archives
from occsim.errors import RobotFileError
from occsim.io.ros_map.files import MAX_IMAGE_BYTES, dump, load
from occsim.io.ros_map.meta import MAX_YAML_BYTES, MapMode
from occsim.io.ros_map.ros_map import RosMap

WHAT = "a zip file of a ROS map"
YAML_ENDINGS = (".yaml", ".yml")
IMAGE_ENDINGS = (".pgm", ".png", ".bmp", ".jpg", ".jpeg", ".gif")
ZIP_MARK = b"PK"
_EPOCH = (1980, 1, 1, 0, 0, 0)


def pack(
    ros_map: RosMap, name: str = "map", *, mode: MapMode = MapMode.TRINARY
) -> bytes:
    """Return a map as a zip file with its ``.yaml`` and its image.

    Parameters
    ----------
    ros_map, name, mode
        As in `dump`.

    Returns
    -------
    bytes
        Equal maps give equal bytes.

    Raises
    ------
    TypeError, ParameterError
        As in `dump`.

    Examples
    --------
    >>> from occsim.io.ros_map import MapMode, RosMap, load_files, pack
    >>> packed = pack(RosMap([[100, 7], [-1, 0]], 0.05), mode=MapMode.RAW)
    >>> load_files({"map.zip": packed}).values
    array([[100,   7],
           [ -1,   0]], dtype=int8)
    """
    yaml, image = dump(ros_map, name, mode=mode)
    ending = "png" if image.startswith(b"\x89PNG") else "pgm"
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for entry, content in ((f"{name}.yaml", yaml), (f"{name}.{ending}", image)):
            info = zipfile.ZipInfo(entry, _EPOCH)
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, content)
    return file.getvalue()


def load_files(
    files: Mapping[str, bytes], *, free_thresh: float | None = None
) -> RosMap:
    """Return the map of the files that a user gives together.

    Parameters
    ----------
    files : mapping of str to bytes
        Content by name: a ``.yaml`` and its image, or one zip file that holds both. The
        names decide only which is which: the image need not have the name that the
        ``.yaml`` states, for browsers and zip programs rename files.
    free_thresh : float, optional
        As in `load`.

    Returns
    -------
    RosMap

    Raises
    ------
    RobotFileError
        Where one of the two is missing, or as `load` does.
    """
    if len(files) == 1:
        [(name, data)] = files.items()
        if data.startswith(ZIP_MARK):
            files = _unzipped(data)
    yaml = _one_of(files, YAML_ENDINGS, "one .yaml")
    image = _one_of(files, IMAGE_ENDINGS, "one image (.pgm or .png)")
    return load(files[yaml], files[image], free_thresh=free_thresh)


def _unzipped(data: bytes) -> dict[str, bytes]:
    try:
        names = _archives.names_in(data, what=WHAT, needed=WHAT)
        yaml = _one_of(names, YAML_ENDINGS, "one .yaml")
        image = _one_of(names, IMAGE_ENDINGS, "one image (.pgm or .png)")
        limits = {yaml: MAX_YAML_BYTES, image: MAX_IMAGE_BYTES}
        return _archives.unpacked(
            data,
            limits,
            required=limits,
            max_bytes=MAX_IMAGE_BYTES,
            what=WHAT,
            needed=WHAT,
            others_ignored=True,
        )
    except _archives.ArchiveError as error:
        raise RobotFileError(str(error)) from None


def _one_of(
    names: Mapping[str, bytes] | list[str], endings: tuple[str, ...], what: str
) -> str:
    # macOS puts a hidden companion of each file into its archives.
    found = [
        name
        for name in names
        if name.lower().endswith(endings)
        and not name.startswith("__MACOSX/")
        and not name.rpartition("/")[2].startswith(".")
    ]
    if len(found) != 1:
        several = f"{len(found)} such files among {len(names)}"
        raise RobotFileError(
            f"a ROS map needs {what}; got {several if found else 'none'}"
        )
    return found[0]
