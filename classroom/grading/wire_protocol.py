"""Wire protocol (serialisation) between judge and worker: frames of JSON and raw arrays.

A frame consists of the lengths of header and payload (u32 each, little-endian), a header in JSON
``{"head": {…}, "arrays": [[name, type, shape], …]}``, and the bytes of the arrays in order.
Anything that violates the format or its limits is rejected with :class:`WireError`.
"""

import json
import math
import struct

import numpy as np

MAX_HEADER = 1 << 20  # [bytes]
MAX_PAYLOAD = 8 << 20  # [bytes]
MAX_DEPTH = 6  # of nested JSON
MAX_DIMENSIONS = 8  # of one array
MAX_ARRAYS = 512  # in one frame

_LENGTHS = struct.Struct("<II")
_TYPES = {"f8": np.dtype("<f8"), "i8": np.dtype("<i8"), "b1": np.dtype("u1")}


class WireError(Exception):
    """A frame violates the protocol or is too large."""


def pack(head, arrays=None) -> bytes:
    """Return a frame with a head (plain values), and float, int or bool arrays by name. Raises
    WireError.
    """
    listed, buffers = [], []
    for name, array in (arrays or {}).items():
        array = np.asarray(array)
        code = {"f": "f8", "i": "i8", "b": "b1"}.get(array.dtype.kind)
        if code is None:
            raise WireError(f"array {name} is of type {array.dtype}")
        listed.append([name, code, list(array.shape)])
        buffers.append(np.ascontiguousarray(array, dtype=_TYPES[code]).tobytes())
    try:
        text = json.dumps({"head": head, "arrays": listed}, allow_nan=False).encode()
    except (TypeError, ValueError, RecursionError) as error:
        raise WireError(f"header: {error}") from None
    payload = b"".join(buffers)
    _check_size(len(text), len(payload))
    return _LENGTHS.pack(len(text), len(payload)) + text + payload


def send(stream, head, arrays=None):
    stream.write(pack(head, arrays))
    stream.flush()


def receive(stream):
    """Return (head, arrays) read from a binary stream, or None if the stream ends before a frame.
    Raises WireError.
    """
    lengths = _read(stream, _LENGTHS.size, may_end=True)
    if lengths is None:
        return None
    header, payload = _LENGTHS.unpack(lengths)
    _check_size(header, payload)
    return unpack(_read(stream, header), _read(stream, payload))


def unpack(header: bytes, payload: bytes):
    """Return (head, arrays) from a header and a payload. Raises WireError."""
    frame = _parse(header)
    if not isinstance(frame, dict) or set(frame) != {"head", "arrays"}:
        raise WireError("header is not {head, arrays}")
    if not isinstance(frame["head"], dict):
        raise WireError("head is not a dict")
    if not isinstance(frame["arrays"], list) or len(frame["arrays"]) > MAX_ARRAYS:
        raise WireError("arrays are not a list, or there are too many")
    arrays, start = {}, 0
    for item in frame["arrays"]:
        name, kind, shape = _array_description(item)
        size = math.prod(shape) * kind.itemsize
        if name in arrays or start + size > len(payload):
            raise WireError(f"array {name} occurs twice or is longer than the payload")
        array = np.frombuffer(payload, kind, math.prod(shape), start).reshape(shape)
        arrays[name] = np.array(array != 0 if kind == _TYPES["b1"] else array)
        start += size
    if start != len(payload):
        raise WireError("the payload is longer than its arrays")
    return frame["head"], arrays


def _read(stream, length, may_end=False):
    parts, missing = [], length
    while missing:
        part = stream.read(missing)
        if not part:
            if may_end and missing == length:
                return None
            raise WireError("the stream ended within a frame")
        parts.append(part)
        missing -= len(part)
    return b"".join(parts)


def _check_size(header, payload):
    if header > MAX_HEADER or payload > MAX_PAYLOAD:
        raise WireError(f"a frame of {header} + {payload} bytes is too large")


def _parse(text):
    try:
        frame = json.loads(
            text.decode("utf-8"), object_pairs_hook=_unique_keys, parse_constant=_refuse
        )
    except (ValueError, RecursionError) as error:
        raise WireError(f"header is not JSON: {type(error).__name__}") from None
    _check_plain(frame)
    return frame


def _unique_keys(pairs):
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("a key occurs twice")
    return found


def _refuse(name):
    raise ValueError(f"{name} is not a JSON number")


def _check_plain(value, depth=0):
    if depth > MAX_DEPTH:
        raise WireError("header is nested too deeply")
    if isinstance(value, dict):
        for key, item in value.items():
            _check_plain(key, depth)
            _check_plain(item, depth + 1)
    elif isinstance(value, list):
        for item in value:
            _check_plain(item, depth + 1)
    elif isinstance(value, str):
        if any("\ud800" <= c <= "\udfff" for c in value):
            raise WireError("header contains a lone surrogate")
    elif isinstance(value, float):
        if not math.isfinite(value):
            raise WireError("header contains a number that is not finite")
    elif isinstance(value, int) and abs(value) >= 1 << 63:
        raise WireError("header contains an integer of more than 64 bits")


def _array_description(item):
    if not isinstance(item, list) or len(item) != 3:
        raise WireError("an array is not [name, type, shape]")
    name, code, shape = item
    if not isinstance(name, str) or len(name) > 64:
        raise WireError("an array's name is not a short text")
    if not isinstance(code, str) or code not in _TYPES:
        raise WireError("an array's type is not f8, i8 or b1")
    if not isinstance(shape, list) or len(shape) > MAX_DIMENSIONS:
        raise WireError("an array's shape is not a list, or it is too long")
    if any(type(n) is not int or n < 0 for n in shape):
        raise WireError("an array's shape contains an invalid size")
    if math.prod(max(n, 1) for n in shape) > MAX_PAYLOAD:
        raise WireError("an array is too large")
    return name, _TYPES[code], shape
