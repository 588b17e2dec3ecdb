"""Read text files: plain or gzip (compressed), whole or truncated."""

import zlib
from pathlib import Path

from slamlab.files.errors import SourceError

GZIP = b"\x1f\x8b"  # magic number: the first bytes of a gzip file


def read_bytes(path):
    """Read a file's bytes, decompressed when gzip; a truncated gzip gives what can be decompressed.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    bytes, bool : the content, whether it is truncated or damaged

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
    return decompress(content) if content.startswith(GZIP) else (content, False)


def decompress(compressed):
    """Decompress gzip bytes as far as possible; and whether something is missing or damaged."""
    parts = []
    while compressed.startswith(GZIP):
        decompressor = zlib.decompressobj(wbits=31)
        # small bites: a damaged block costs no more than the bite it is in
        for start in range(0, len(compressed), 512):
            try:
                parts.append(decompressor.decompress(compressed[start : start + 512]))
            except zlib.error:
                return b"".join(parts), True
            if decompressor.eof:
                compressed = decompressor.unused_data + compressed[start + 512 :]
                break
        else:
            return b"".join([*parts, decompressor.flush()]), True
    # padding with zeros after the last member is allowed
    return b"".join(parts), bool(compressed.strip(b"\0"))


def reason(error):
    """The message of an OSError or ValueError, without its number and path."""
    return (getattr(error, "strerror", None) or str(error)).lower()


def lines(content):
    """Split bytes into lines, with a flag that is False where the end of the line is missing.

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
