"""Files of lines: plain or gzip, whole or torn."""

import zlib
from pathlib import Path

from slamlab.sources.base import SourceError

GZIP = b"\x1f\x8b"


def read_bytes(path):
    """A file's content, unpacked when it is gzip; a torn gzip gives what can be unpacked.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    bytes, bool : the content, whether it ends before its packing says

    Raises
    ------
    SourceError : no such file, a folder, not readable
    """
    path = Path(path)
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        raise SourceError(f"{path}: no such file") from None
    except IsADirectoryError:
        raise SourceError(f"{path} is a folder: name a log file in it") from None
    except (OSError, ValueError) as error:
        raise SourceError(f"{path} cannot be read: {reason(error)}") from None
    return unpack(content) if content.startswith(GZIP) else (content, False)


def unpack(packed):
    """All that can be unpacked of gzip bytes, and whether something is missing or damaged."""
    parts = []
    while packed.startswith(GZIP):
        unpacker = zlib.decompressobj(wbits=31)
        # small bites: a damaged block costs no more than the bite it is in
        for start in range(0, len(packed), 512):
            try:
                parts.append(unpacker.decompress(packed[start : start + 512]))
            except zlib.error:
                return b"".join(parts), True
            if unpacker.eof:
                packed = unpacker.unused_data + packed[start + 512 :]
                break
        else:
            return b"".join([*parts, unpacker.flush()]), True
    # padding with zeros after the last member is allowed
    return b"".join(parts), bool(packed.strip(b"\0"))


def reason(error):
    """What an OSError or ValueError says, without its number and path."""
    return (getattr(error, "strerror", None) or str(error)).lower()


def lines(content):
    """Lines with a flag that is False where the end of the line is missing.

    Parameters
    ----------
    content : bytes

    Yields
    ------
    bytes, bool : the line without its end, whether it had one
    """
    for line in content.splitlines(keepends=True):
        bare = line.rstrip(b"\r\n")
        yield bare, len(bare) < len(line)
