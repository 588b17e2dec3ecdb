"""Contents: compressed cells of notebooks and outputs of workers, named by their hashes."""

import hashlib
import zlib

MAX_BYTES = 50_000  # of an attempt's cells, and of its outputs [bytes]; more is not stored
MAX_UNPACKED_BYTES = 64 << 20  # [bytes]


class ContentError(Exception):
    """Stored contents are damaged."""


def packed(data):
    """Return compressed bytes, or None if they are too long."""
    kept = zlib.compress(data, 9) if len(data) <= MAX_UNPACKED_BYTES else b""
    return kept if 0 < len(kept) <= MAX_BYTES else None


def unpacked(kept):
    """Return the bytes that :func:`packed` compressed. Raises ContentError."""
    try:
        data = zlib.decompressobj()
        found = data.decompress(kept, MAX_UNPACKED_BYTES + 1)
    except zlib.error as error:
        raise ContentError(f"the stored contents are damaged: {error}") from None
    if len(found) > MAX_UNPACKED_BYTES or not data.eof:
        raise ContentError("the stored contents are incomplete or too long")
    return found


def name_of(kept):
    return hashlib.sha256(kept).hexdigest()
