"""A ROS map as one zip file, or as the files that a user gives together."""

import io
import zipfile
from collections.abc import Mapping

from occsim import _archives
from occsim._files import printable
from occsim.errors import RobotFileError
from occsim.io.ros_map.files import MAX_IMAGE_BYTES, dump, load
from occsim.io.ros_map.meta import MAX_YAML_BYTES, MapMode, parse_meta
from occsim.io.ros_map.ros_map import RosMap

WHAT = "a zip file of a ROS map"
YAML_ENDINGS = (".yaml", ".yml")
IMAGE_ENDINGS = (".pgm", ".png", ".bmp", ".jpg", ".jpeg", ".gif")
ZIP_MARK = b"PK"
MOST_NAMED = 5
"""Most names in a message."""
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


def map_names(files: Mapping[str, bytes]) -> tuple[str, ...]:
    """Return the names of the maps, of their ``.yaml``, among some files.

    Parameters
    ----------
    files : mapping of str to bytes
        As in `load_files`.

    Returns
    -------
    tuple of str
        In alphabetical order; empty where there is none.

    Raises
    ------
    RobotFileError
        Where a zip file is damaged, or has too many files.
    """
    return tuple(sorted(_with_ending(_names(files), YAML_ENDINGS)))


def load_files(
    files: Mapping[str, bytes],
    *,
    which: str | None = None,
    free_thresh: float | None = None,
) -> RosMap:
    """Return the map of the files that a user gives together.

    Parameters
    ----------
    files : mapping of str to bytes
        Content by name: a ``.yaml`` and its image, or one zip file that holds both. The
        names decide only which is which: a single image need not have the name that
        the ``.yaml`` states, for browsers and zip programs rename files.
    which : str, optional
        The name of one of several maps, as `map_names` gives it.
    free_thresh : float, optional
        As in `load`.

    Returns
    -------
    RosMap

    Raises
    ------
    RobotFileError
        Where one of the two is missing, there are several maps and `which` is none of
        them, or as `load` does.
    """
    names = _names(files)
    yaml = _chosen(_with_ending(names, YAML_ENDINGS), which)
    about = _content(files, yaml, MAX_YAML_BYTES)
    images = _with_ending(names, IMAGE_ENDINGS)
    image = _image_for(yaml, about, images)
    content = _content(files, image, MAX_IMAGE_BYTES)
    return load(about, content, free_thresh=free_thresh)


def _zipped(files: Mapping[str, bytes]) -> bytes | None:
    """Return the zip file, if that is all that was given."""
    if len(files) != 1:
        return None
    [data] = files.values()
    return data if data.startswith(ZIP_MARK) else None


def _names(files: Mapping[str, bytes]) -> list[str]:
    data = _zipped(files)
    if data is None:
        return list(files)
    try:
        return _archives.names_in(data, what=WHAT, needed=WHAT)
    except _archives.ArchiveError as error:
        raise RobotFileError(str(error)) from None


def _content(files: Mapping[str, bytes], name: str, most: int) -> bytes:
    data = _zipped(files)
    if data is None:
        return files[name]
    try:
        found = _archives.unpacked(
            data,
            {name: most},
            required=[name],
            max_bytes=most,
            what=WHAT,
            needed=WHAT,
            others_ignored=True,
        )
    except _archives.ArchiveError as error:
        raise RobotFileError(str(error)) from None
    return found[name]


def _with_ending(names: list[str], endings: tuple[str, ...]) -> list[str]:
    # macOS puts a hidden companion of each file into its archives.
    return [
        name
        for name in names
        if name.lower().endswith(endings)
        and not name.startswith("__MACOSX/")
        and not _base(name).startswith(".")
    ]


def _chosen(yamls: list[str], which: str | None) -> str:
    if not yamls:
        raise RobotFileError("a ROS map needs one .yaml; got none")
    if which is None and len(yamls) == 1:
        return yamls[0]
    if which not in yamls:
        raise RobotFileError(
            f"there are {len(yamls)} maps, {_listed(yamls)}: one must be chosen"
        )
    return which


def _image_for(yaml: str, about: bytes, images: list[str]) -> str:
    """Return the image of a map: the only one, else the one that its .yaml names."""
    if not images:
        raise RobotFileError("a ROS map needs one image (.pgm or .png); got none")
    if len(images) == 1:
        return images[0]
    wanted = _base(parse_meta(about, yaml).image)
    named = [name for name in images if _base(name) == wanted]
    if len(named) > 1:  # maps of several floors, a folder each
        folder = yaml.rpartition("/")[0]
        named = [name for name in named if name.rpartition("/")[0] == folder]
    if len(named) != 1:
        raise RobotFileError(
            f"{printable(yaml)} names the image {printable(wanted)}; got "
            f"{_listed(images)}"
        )
    return named[0]


def _base(name: str) -> str:
    return name.rpartition("/")[2]


def _listed(names: list[str]) -> str:
    shown = ", ".join(printable(name) for name in sorted(names)[:MOST_NAMED])
    return shown + (", ..." if len(names) > MOST_NAMED else "")
