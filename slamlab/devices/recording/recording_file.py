"""File format of raw recordings: a JSON header line, then binary records with a CRC checksum.

A record, little endian: u8 kind (0 received, 1 sent, 2 event), u8 channel (0 lidar, 1 eMIR), u64
time of the monotonic clock [ns], u32 length, so many bytes, u32 CRC-32 of all that.
"""

import json
import struct
import zlib
from dataclasses import dataclass
from itertools import count

from slamlab.files.errors import SourceError
from slamlab.files.text_files import read_bytes

FORMAT, VERSION = "slamlab raw recording", 1  # of the header
RX, TX, EVENT = range(3)  # kinds of records: received, sent, event
CHANNELS = "lidar", "emir"  # devices, by number in a record
HEADER, CRC = struct.Struct("<BBQI"), struct.Struct("<I")  # of a record, little endian
MAX_RECORD = 1 << 16  # bytes of a record; the recorder splits what is longer


class RecordingError(SourceError):
    """File that is no raw recording, or a damaged one."""


@dataclass(frozen=True)
class Record:
    """Timestamped record: ``kind`` RX, TX or EVENT, ``channel`` "lidar" or "emir"."""

    kind: int
    channel: str
    time_ns: int
    data: bytes

    @property
    def time(self):
        """Timestamp [s], float."""
        return self.time_ns / 1e9

    def pack(self):
        """Encode the record, with its CRC."""
        head = HEADER.pack(self.kind, CHANNELS.index(self.channel), self.time_ns, len(self.data))
        return head + self.data + CRC.pack(zlib.crc32(head + self.data))


@dataclass(frozen=True)
class Recording:
    """Raw recording that was read from a file.

    Parameters
    ----------
    header : dict
    records : list of Record, in the order they were written
    truncated : str, where and how the file is truncated; empty when it is not
    """

    header: dict
    records: list
    truncated: str = ""

    def of(self, channel, *kinds):
        """Records of a channel, of the given kinds or of all: list of Record."""
        kinds = kinds or (RX, TX, EVENT)
        return [r for r in self.records if r.channel == channel and r.kind in kinds]

    def received(self, channel):
        """Bytes received from a device, all of them."""
        return b"".join(record.data for record in self.of(channel, RX))

    def baud(self, channel):
        """Baud rate of a device's line, int [bit/s]."""
        usual = {"lidar": 115200, "emir": 57600}[channel]
        return self.header.get("devices", {}).get(channel, {}).get("baud", usual)

    @property
    def begin(self):
        """Time of the first record [s], float."""
        return self.records[0].time if self.records else 0.0

    @property
    def seconds(self):
        """Duration [s], float."""
        return self.records[-1].time - self.begin if self.records else 0.0


def header_line(header):
    """Encode a header as the first line of a file, with its CRC checksum.

    Parameters
    ----------
    header : dict

    Returns
    -------
    bytes
    """
    header = {"format": FORMAT, "version": VERSION} | header
    return json.dumps(header | {"crc32": _crc(header)}).encode() + b"\n"


def is_recording(content):
    """Whether a file's content is a raw recording, by its header: bool."""
    try:
        return json.loads(content.split(b"\n", 1)[0])["format"] == FORMAT
    except (ValueError, TypeError, KeyError, RecursionError):
        return False


def load(path, salvage=False):
    """Load a raw recording, plain or gzip; one truncated in mid-record is read up to there.

    Parameters
    ----------
    path : str or Path
    salvage : bool, whether of a damaged one what comes before the damage will do

    Returns
    -------
    Recording

    Raises
    ------
    SourceError : it cannot be read
    RecordingError : it is none, or a record is damaged: the text says which
    """
    content, truncated = read_bytes(path)
    packing = "its gzip packing is damaged or truncated" if truncated else ""
    return parse(content, str(path), salvage, packing)


def parse(content, name="the recording", salvage=False, truncated=""):
    """Parse a raw recording from a file's content; parameters as :func:`load`."""
    line, newline, rest = content.partition(b"\n")
    header = _header(line, name)
    if not newline:
        return Recording(header, [], f"{name} ends in its header")
    records, at = [], 0
    for number in count(1):
        if at == len(rest):
            break
        where = f"record {number} (byte {len(line) + 1 + at})"
        record, size = _record(rest, at)
        if record is None:
            damaged = size is None or _record_follows(rest, at + 1)
            if damaged and not salvage:
                raise RecordingError(
                    f"{name}: {where} is damaged; the {number - 1} before it are whole"
                )
            truncated = f"{name}: {where} is damaged" if damaged else f"{name} ends in {where}"
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
        raise RecordingError(f"{name} is no raw recording, or its header is damaged") from None
    if crc != _crc(header):
        raise RecordingError(f"{name}: its header, the first line, is damaged")
    if version != VERSION:
        raise RecordingError(f"{name} is of version {version}; this slamlab reads {VERSION}")
    return header


def _record(data, at):
    """Record at a place and its size; None where it is truncated; None, None where damaged."""
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
    """Whether a whole record follows: then what ends too early is damaged, not truncated."""
    return any(_record(data, k)[0] is not None for k in range(at, len(data)))


def _crc(header):
    return zlib.crc32(json.dumps(header, sort_keys=True).encode())
