"""File format of raw recordings: a JSON header line, then binary records with a CRC-32 checksum."""

import json
import struct
import zlib
from dataclasses import dataclass
from itertools import count

from slamlab.files import SourceError, read_bytes

FORMAT, VERSION = "slamlab raw recording", 1  # of the header
RX, TX, EVENT = range(3)  # kinds of records: received, sent, event
CHANNELS = "lidar", "emir"  # devices, by number in a record
BAUD_RATES = {"lidar": 115200, "emir": 57600}  # defaults [bit/s]
# A record, little endian: u8 kind, u8 channel, u64 time of the monotonic clock [ns], u32 length,
# data, u32 CRC-32 checksum of all preceding fields.
HEADER, CRC = struct.Struct("<BBQI"), struct.Struct("<I")
MAX_RECORD = 1 << 16  # bytes of a record; the recorder splits longer data


class RecordingError(SourceError):
    """The file is not a raw recording or is corrupted."""


@dataclass(frozen=True)
class Record:
    """Timestamped record with a ``kind`` (RX, TX, EVENT) and ``channel`` ("lidar", "emir")."""

    kind: int
    channel: str
    time_ns: int
    data: bytes

    @property
    def time(self):
        """Timestamp [s]."""
        return self.time_ns / 1e9

    def pack(self):
        head = HEADER.pack(self.kind, CHANNELS.index(self.channel), self.time_ns, len(self.data))
        return head + self.data + CRC.pack(zlib.crc32(head + self.data))


@dataclass(frozen=True)
class Recording:
    """A raw recording that was read from a file.

    Parameters
    ----------
    header : dict
    records : list of Record, in the order of writing
    truncated : str, where and how the file is truncated; empty for a complete file
    """

    header: dict
    records: list
    truncated: str = ""

    def of(self, channel, *kinds):
        """Return the records of a channel, of the given kinds or of all kinds."""
        kinds = kinds or (RX, TX, EVENT)
        return [r for r in self.records if r.channel == channel and r.kind in kinds]

    def received(self, channel):
        return b"".join(record.data for record in self.of(channel, RX))

    def baud(self, channel):
        """Return the baud rate of the line to a device [bit/s]."""
        known = self.header.get("devices", {}).get(channel, {})
        return known.get("baud") or BAUD_RATES[channel]

    @property
    def begin(self):
        """Time of the first record [s]."""
        return self.records[0].time if self.records else 0.0

    @property
    def seconds(self):
        """Duration [s]."""
        return self.records[-1].time - self.begin if self.records else 0.0


def header_line(header):
    header = {"format": FORMAT, "version": VERSION} | header
    return json.dumps(header | {"crc32": _crc(header)}).encode() + b"\n"


def is_recording(content):
    """Return whether the content of a file begins with the header of a raw recording."""
    try:
        return json.loads(content.split(b"\n", 1)[0])["format"] == FORMAT
    except (ValueError, TypeError, KeyError, RecursionError):
        return False


def load(path, salvage=False):
    """Load a raw recording, plain or gzip; a truncated file gives all complete records. Returns a
    Recording. Raises SourceError or RecordingError.

    Parameters
    ----------
    path : str or Path
    salvage : bool, whether to return the records before the first corrupted one
    """
    content, truncated = read_bytes(path)
    compression = f"{path}: the gzip compression is corrupted or truncated" if truncated else ""
    return parse(content, str(path), salvage, compression)


def parse(content, name="the recording", salvage=False, truncated=""):
    """Parse a file's content into a Recording; arguments as in :func:`load`."""
    line, newline, rest = content.partition(b"\n")
    header = _header(line, name)
    if not newline:
        return Recording(header, [], f"{name} is truncated in its header")
    records, at = [], 0
    for number in count(1):
        if at == len(rest):
            break
        where = f"record {number} (byte {len(line) + 1 + at})"
        record, size = _record(rest, at)
        if record is None:
            corrupted = size is None or _record_follows(rest, at + 1)
            if corrupted and not salvage:
                raise RecordingError(
                    f"{name}: {where} is corrupted; the {number - 1} previous records are intact"
                )
            how = f": {where} is corrupted" if corrupted else f" is truncated in {where}"
            truncated = f"{name}{how}"
            break
        records.append(record)
        at += size
    return Recording(header, records, truncated)


def _header(line, name):
    try:
        header = json.loads(line)
        version, crc = header["version"], header.pop("crc32")
        if header["format"] != FORMAT:
            raise ValueError
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        raise RecordingError(f"{name} is not a raw recording, or its header is corrupted") from None
    if crc != _crc(header):
        raise RecordingError(f"{name}: the header (first line) is corrupted")
    if version != VERSION:
        raise RecordingError(f"{name} has version {version}; this slamlab reads version {VERSION}")
    return header


def _record(data, at):
    """Return a record and its size; (None, 0) if it is truncated, (None, None) if corrupted."""
    if len(data) - at < HEADER.size:
        return None, 0
    kind, channel, time_ns, length = HEADER.unpack_from(data, at)
    if kind > EVENT or channel >= len(CHANNELS) or length > MAX_RECORD:
        return None, None
    end = at + HEADER.size + length
    if len(data) < end + CRC.size:
        return None, 0
    if CRC.unpack_from(data, end)[0] != zlib.crc32(data[at:end]):
        return None, None
    record = Record(kind, CHANNELS[channel], time_ns, data[at + HEADER.size : end])
    return record, end + CRC.size - at


def _record_follows(data, at):
    """Return whether a later record is valid: then the file is not truncated but corrupted."""
    return any(_record(data, k)[0] is not None for k in range(at, len(data)))


def _crc(header):
    return zlib.crc32(json.dumps(header, sort_keys=True).encode())
