"""Decoder of HQ capsules, with high-resolution nodes and a CRC-32 checksum."""

import zlib

import numpy as np

from slamlab.devices.rplidar.measurement_nodes import NODE_DTYPE, TURN_Q6, PacketDecoder

# a node: angle [90°/16384], distance [1/4 mm], quality, flags of which bit 0 is S
HQ_NODE = np.dtype([("angle", "<u2"), ("distance", "<u4"), ("quality", "u1"), ("flags", "u1")])
SYNC = 0xA5  # first byte
HEADER_SIZE, CRC_SIZE = 9, 4  # before the nodes: sync byte and device time; after them: CRC
MAX_DISTANCE = 2**31 - 1  # of a node [1/4 mm]


class HqDecoder(PacketDecoder):
    """Decoder of HQ capsules with 96 nodes."""

    points = 96
    size = HEADER_SIZE + points * HQ_NODE.itemsize + CRC_SIZE
    marks = ((0xFF, SYNC),)

    def _decode(self):
        while (capsule := self._next_packet()) is not None:
            raw = np.frombuffer(capsule, HQ_NODE, self.points, HEADER_SIZE)
            nodes = np.empty(self.points, NODE_DTYPE)
            nodes["angle_q6"] = (raw["angle"].astype(np.int32) * 90 + 128 >> 8) % TURN_Q6
            nodes["distance_q2"] = np.minimum(raw["distance"], MAX_DISTANCE)
            nodes["quality"] = raw["quality"] >> 2
            nodes["start"] = raw["flags"] & 1
            yield self._marked(nodes)

    def _checksum_is_valid(self, packet):
        return hq_checksum(packet[:-CRC_SIZE]) == packet[-CRC_SIZE:]


def hq_checksum(data):
    """Return the CRC-32 checksum of a capsule's bytes, padded with zeros to whole words."""
    return zlib.crc32(data + bytes(4 - len(data) % 4)).to_bytes(CRC_SIZE, "little")
