"""Decoding (deserialisation) of ROS 1 and ROS 2 messages with ``rosbags``."""

import importlib
from contextlib import suppress
from functools import cache

from slamlab.extras import needs
from slamlab.sources.ros_bag_files import ZSTD

TF, OLD_TF = "tf2_msgs/msg/TFMessage", "tf/msg/tfMessage"  # transforms: tf2's type, and tf's
TF_FIELDS = "geometry_msgs/TransformStamped[] transforms"  # definition of both


class MessageDecoder:
    """Decoder of the messages of a bag's connections. Raises ExtraMissing."""

    def __init__(self):
        (self._ros1, self._ros2), self._stores = _usual_stores(), {}

    def __call__(self, connection, data):
        """Decode a message; return None if the message cannot be decoded."""
        kind = TF if connection.msgtype == OLD_TF else connection.msgtype
        try:
            if bytes(data[:4]) == ZSTD:  # each message is compressed
                data = zstd_decompressor().decompress(data)
            if hasattr(connection.ext, "serialization_format"):
                return self._ros2.deserialize_cdr(data, kind)
            return self._ros1_store(connection, kind).deserialize_ros1(data, kind)
        except Exception:  # rosbags raises any exception for a damaged message
            return None

    def _ros1_store(self, connection, kind):
        """Return a type store with the bag's own message definition if it is not the usual one."""
        key = connection.digest, kind
        if key not in self._stores:
            self._stores[key] = self._ros1
            with suppress(Exception):  # as above, of a definition
                if self._ros1.generate_msgdef(kind, ros_version=1)[1] != connection.digest:
                    self._stores[key] = _store("EMPTY", connection.msgdef.data, kind)
        return self._stores[key]


@cache  # rosbags compiles a decoder for each type of a store, which takes longer than a small bag
def _usual_stores():
    return _store("ROS1_NOETIC", TF_FIELDS, TF), _store("LATEST")  # rosbags lacks TF of ROS 1


def _store(name, definition=None, kind=None):
    """Return a type store of rosbags with one more message definition. Raises ExtraMissing."""
    with needs("ros"):
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore
    store = get_typestore(Stores[name])
    if definition is not None:
        store.register(get_types_from_msg(definition, kind))
    return store


def zstd_decompressor():
    """Return a new Zstandard decompressor of the package that rosbags uses. Raises ExtraMissing."""
    with suppress(ModuleNotFoundError):
        return importlib.import_module("compression.zstd").ZstdDecompressor()
    with needs("ros"):
        return importlib.import_module("backports.zstd").ZstdDecompressor()
