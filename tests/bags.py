"""Bags for the tests, written with the writers of `rosbags`."""

from pathlib import Path

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

SCAN, ODOMETRY = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry"
TF, OLD_TF = "tf2_msgs/msg/TFMessage", "tf/msg/tfMessage"


class Bag:
    """The messages of a bag, of ROS 1 or 2."""

    def __init__(self, ros=1):
        self.ros = ros
        self.store = get_typestore(Stores.ROS1_NOETIC if ros == 1 else Stores.LATEST)
        if ros == 1:
            text = "geometry_msgs/TransformStamped[] transforms"
            for kind in (TF, OLD_TF):
                self.store.register(get_types_from_msg(text, kind))
        self.messages = []

    def add(self, topic, kind, time_s, message):
        self.messages.append((topic, kind, time_s, message))
        return self

    def scan(self, time_s, ranges, topic="/scan", frame="laser", **changed):
        n = len(ranges)
        fields = {
            "angle_min": -np.pi / 2,
            "angle_max": np.pi / 2,
            "angle_increment": np.pi / max(n - 1, 1),
            "time_increment": 0.0,
            "scan_time": 0.1,
            "range_min": 0.1,
            "range_max": 30.0,
            "ranges": np.array(ranges, np.float32),
            "intensities": np.zeros(0, np.float32),
        } | changed
        header = self._header(time_s, frame)
        message = self.store.types[SCAN](header=header, **fields)
        return self.add(topic, SCAN, time_s, message)

    def odometry(self, time_s, pose, topic="/odom", frame="odom", child="base_link"):
        kinds = self.store.types
        zero = kinds["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
        at = kinds["geometry_msgs/msg/Point"](float(pose[0]), float(pose[1]), 0.0)
        pose = kinds["geometry_msgs/msg/Pose"](at, self._turn(pose[2]))
        twist = kinds["geometry_msgs/msg/Twist"](zero, zero)
        message = kinds[ODOMETRY](
            header=self._header(time_s, frame),
            child_frame_id=child,
            pose=kinds["geometry_msgs/msg/PoseWithCovariance"](pose, np.zeros(36)),
            twist=kinds["geometry_msgs/msg/TwistWithCovariance"](twist, np.zeros(36)),
        )
        return self.add(topic, ODOMETRY, time_s, message)

    def tf(self, time_s, parent, child, pose, topic="/tf", quaternion=None, kind=TF):
        kinds = self.store.types
        at = kinds["geometry_msgs/msg/Vector3"](float(pose[0]), float(pose[1]), 0.0)
        turn = self._turn(pose[2])
        if quaternion is not None:
            turn = kinds["geometry_msgs/msg/Quaternion"](*map(float, quaternion))
        item = kinds["geometry_msgs/msg/TransformStamped"](
            header=self._header(time_s, parent),
            child_frame_id=child,
            transform=kinds["geometry_msgs/msg/Transform"](at, turn),
        )
        return self.add(topic, kind, time_s, kinds[kind]([item]))

    def _turn(self, yaw):
        kind = self.store.types["geometry_msgs/msg/Quaternion"]
        return kind(0.0, 0.0, float(np.sin(yaw / 2)), float(np.cos(yaw / 2)))

    def _header(self, time_s, frame):
        stamp = self.store.types["builtin_interfaces/msg/Time"](
            int(time_s), round(time_s % 1 * 1e9)
        )
        fields = {"seq": 0} if self.ros == 1 else {}
        return self.store.types["std_msgs/msg/Header"](
            stamp=stamp, frame_id=frame, **fields
        )

    def content(self, folder, suffix=".bag", compression=None) -> bytes:
        """The bag as the content of one file."""
        folder = Path(folder)
        if self.ros == 1:
            path = folder / "own.bag"
            path.unlink(missing_ok=True)
            writer, write = Writer1(path), self.store.serialize_ros1
            if compression:
                writer.set_compression(Writer1.CompressionFormat[compression])
        else:
            plugin = {".db3": StoragePlugin.SQLITE3, ".mcap": StoragePlugin.MCAP}
            writer = Writer2(folder / "own", version=9, storage_plugin=plugin[suffix])
            write, path = self.store.serialize_cdr, folder / "own" / f"own{suffix}"
        with writer:
            connections = {}
            for topic, kind, time_s, message in self.messages:
                if topic not in connections:
                    connections[topic] = writer.add_connection(
                        topic, kind, typestore=self.store
                    )
                data = write(message, kind)
                writer.write(connections[topic], int(time_s * 1e9), data)
        return path.read_bytes()
