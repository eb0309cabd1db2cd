"""Scans and transforms out of the messages of a bag."""

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from occsim._files import printable
from occsim._npz import Array
from occsim._types import FloatArray
from occsim.errors import OccsimError, RobotFileError
from occsim.io.bags.limits import MAX_BEAMS, MAX_SCANS, PoseSource
from occsim.io.bags.transforms import Edges, led_to
from occsim.io.rigid import in_plane

SCAN = "sensor_msgs/msg/LaserScan"
ODOMETRY = "nav_msgs/msg/Odometry"
TF = "tf2_msgs/msg/TFMessage"
TYPES = {
    SCAN: SCAN,
    ODOMETRY: ODOMETRY,
    TF: TF,
    "tf/msg/tfMessage": TF,  # of ROS 1; the same bytes
}
"""The types that are read, and as what: definitions inside the bag are not trusted."""

TF_TEXT = "geometry_msgs/TransformStamped[] transforms"


def extract(
    paths: list[str], name: str, scan_topic: str | None, poses: str, max_ranges: int
) -> tuple[dict[str, Any], dict[str, Array]]:
    """Return what a bag says of its scans.

    Parameters
    ----------
    paths : list of str
        The files of one recording in their order, by their suffix of ROS 1 (.bag) or
        ROS 2.
    name : str
        What to call it.
    scan_topic, poses
        As in `occsim.io.bags.load`.
    max_ranges : int
        Most of all scans together.

    Returns
    -------
    facts : dict
        The fields of a `BagLog` that are no arrays.
    arrays : dict
        Times, poses, bearings, ranges and the greatest range, as `metric_scans` takes
        them.

    Raises
    ------
    RobotFileError
        Where it is damaged, or has no scans or no poses.
    """
    try:
        bag = _Bag([Path(path) for path in paths], name, scan_topic, max_ranges)
    except OccsimError:
        raise
    except MemoryError:
        raise
    except Exception:  # damaged bags end in errors of many types
        raise RobotFileError(f"{name} is damaged: it cannot be read as a bag") from None
    return bag.placed(PoseSource(poses))


RangeArray = npt.NDArray[np.float32]


class _Bag:
    """The messages of a bag that matter here."""

    def __init__(
        self,
        paths: list[Path],
        name: str,
        scan_topic: str | None,
        max_ranges: int,
    ) -> None:
        self.name, self.scans = name, list[tuple[float, Any]]()
        self._max_ranges, self._n_ranges = max_ranges, 0
        self.transforms, self.odometry = Edges(), dict[str, Edges]()
        connections = []
        for path in paths:
            with _reader(path) as reader:
                connections += reader.connections
        self.topic = _topic_of_scans(connections, name, scan_topic)
        for path in paths:
            with _reader(path) as reader:
                for message in _messages(reader, self.topic, path):
                    self._take(*message)
        if not self.scans:
            raise RobotFileError(f"{name} has no scan in {printable(self.topic)}")

    def _take(self, topic: str, kind: str, time_s: float, message: Any) -> None:
        if kind == SCAN:
            self.scans.append((_stamp(message.header.stamp) or time_s, message))
            self._n_ranges += len(message.ranges)
            if len(self.scans) > MAX_SCANS or self._n_ranges > self._max_ranges:
                raise RobotFileError(
                    f"{self.name} may have {MAX_SCANS:,} scans and "
                    f"{self._max_ranges:,} ranges; it has more"
                )
        elif kind == TF:
            for item in message.transforms:
                self._add(self.transforms, item, item.transform, topic)
        else:
            edges = self.odometry.setdefault(topic, Edges())
            self._add(edges, message, message.pose.pose, topic)

    def _add(self, edges: Edges, item: Any, pose: Any, topic: str) -> None:
        at = pose.position if hasattr(pose, "position") else pose.translation
        turn = pose.orientation if hasattr(pose, "orientation") else pose.rotation
        row = (at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w)
        is_fixed = topic.endswith("tf_static")
        time_s = 0.0 if is_fixed else _stamp(item.header.stamp)
        edges.add(item.header.frame_id, item.child_frame_id, (time_s, *row), is_fixed)

    def placed(self, source: PoseSource) -> tuple[dict[str, Any], dict[str, Array]]:
        """Return facts and arrays of the scans whose place is known."""
        times, ranges, first, left_out = self._alike()
        route, poses_from = self._route(source, first.header.frame_id)
        within = np.ones(times.size, dtype=np.bool_)
        for edge in route:
            within &= edge.covers(times)
        if not within.any():
            raise RobotFileError(
                f"{self.name}: no scan lies within the times of the poses from "
                f"{poses_from}"
            )
        poses = np.tile(np.eye(4), (int(within.sum()), 1, 1))
        for edge in route:
            poses = poses @ edge.at(times[within])
        flat, upside_down = in_plane(poses)
        beam = np.arange(ranges.shape[1])
        bearings = float(first.angle_min) + float(first.angle_increment) * beam
        facts = {
            "scan_topic": printable(self.topic),
            "poses_from": poses_from,
            "n_left_out": left_out + int((~within).sum()),
        }
        return facts, {
            "times_s": times[within],
            "poses_m": flat,
            # A range finder that hangs upside down counts to the other side.
            "bearings_rad": -bearings if upside_down.mean() > 0.5 else bearings,
            "ranges_m": ranges[within],
            "max_range_m": np.array(float(first.range_max)),
        }

    def _alike(self) -> tuple[FloatArray, RangeArray, Any, int]:
        """Return times and ranges of the scans with the beams that most have."""
        layouts = Counter(_layout(scan) for _, scan in self.scans)
        ((layout, _),) = layouts.most_common(1)
        kept = [pair for pair in self.scans if _layout(pair[1]) == layout]
        times, first = np.array([time_s for time_s, _ in kept]), kept[0][1]
        if not (0 < layout[0] <= MAX_BEAMS and 0.0 < first.range_max < np.inf):
            raise RobotFileError(
                f"{self.name}: a scan must have 1 to {MAX_BEAMS:,} beams and a "
                f"greatest range above 0; got {layout[0]:,} and {first.range_max:g}"
            )
        ranges = np.array([scan.ranges for _, scan in kept], dtype=np.float32)
        ranges[ranges < max(first.range_min, 0.0)] = np.nan
        return times, ranges, first, len(self.scans) - len(kept)

    def _route(self, source: PoseSource, frame: str) -> tuple[list[Any], str]:
        """Return the edges that lead to the range finder, and what they are called."""
        frame = frame.strip("/")
        if source is not PoseSource.ODOMETRY:
            route = led_to(frame, self.transforms)
            if any(edge.moves for edge in route):
                return route, f"frames {printable(route[0].parent)} to {frame}"
        if source is not PoseSource.TRANSFORMS and self.odometry:
            topic, edges = max(self.odometry.items(), key=lambda item: len(item[1]))
            (moving,) = edges.all()[:1]
            mount = led_to(frame, self.transforms.fixed(), moving.child)
            return [moving, *mount], printable(topic)
        wanted = {
            PoseSource.AUTO: "neither transforms that lead to it nor nav_msgs/Odometry",
            PoseSource.TRANSFORMS: "no transforms that lead to it",
            PoseSource.ODOMETRY: "no nav_msgs/Odometry",
        }[source]
        raise RobotFileError(
            f"{self.name} does not say where its scans in {printable(self.topic)} were "
            f"taken: it has {wanted}"
        )


def _reader(path: Path) -> Any:
    if path.suffix == ".bag":
        from rosbags.rosbag1 import Reader as Reader1

        return Reader1(path)
    from rosbags.rosbag2 import Reader as Reader2

    return Reader2(path)


def _topic_of_scans(connections: Any, name: str, wanted: str | None) -> str:
    counts = Counter[str]()
    for connection in connections:
        if connection.msgtype == SCAN:
            counts[connection.topic] += connection.msgcount
    topics = ", ".join(sorted(counts))
    if not counts:
        raise RobotFileError(f"{name} has no topic of sensor_msgs/LaserScan")
    if wanted is None:
        return max(sorted(counts), key=lambda topic: counts[topic])
    if wanted not in counts:
        raise RobotFileError(
            f"{name} has no scans in {printable(wanted)}; it has them in "
            f"{printable(topics)}"
        )
    return wanted


def _messages(
    reader: Any, scan_topic: str, path: Path
) -> Iterator[tuple[str, str, float, Any]]:
    """Yield topic, type, time and content of the messages that matter."""
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    is_1 = path.suffix == ".bag"
    store = get_typestore(Stores.ROS1_NOETIC if is_1 else Stores.LATEST)
    if TF not in store.types:  # rosbags leaves it out for ROS 1
        store.register(get_types_from_msg(TF_TEXT, TF))
    read = store.deserialize_ros1 if is_1 else store.deserialize_cdr
    chosen = [
        connection
        for connection in reader.connections
        if connection.msgtype in TYPES
        and (connection.msgtype != SCAN or connection.topic == scan_topic)
    ]
    for connection, time_ns, data in reader.messages(connections=chosen):
        kind = TYPES[connection.msgtype]
        yield connection.topic, kind, time_ns * 1e-9, read(data, kind)


def _stamp(stamp: Any) -> float:
    return float(stamp.sec) + 1e-9 * float(stamp.nanosec)


def _layout(scan: Any) -> tuple[int, float, float]:
    return len(scan.ranges), float(scan.angle_min), float(scan.angle_increment)
