"""The wire protocol transports only data, and invalid frames raise one exception."""

import io
import json
import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from classroom.grading import wire_protocol
from classroom.grading.wire_protocol import WireError

PLAIN = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**63) + 1, 2**63 - 1)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)
ARRAY = hnp.arrays(
    st.sampled_from([np.float64, np.int64, np.bool_]),
    hnp.array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=4),
)


def frame(header, payload=b""):
    if not isinstance(header, bytes):
        header = json.dumps(header).encode()
    return struct.pack("<II", len(header), len(payload)) + header + payload


def of_arrays(arrays, payload=b""):
    return frame({"head": {}, "arrays": arrays}, payload)


def received(data):
    return wire_protocol.receive(io.BytesIO(data))


def depth(value):
    items = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return 1 + max(map(depth, items), default=0)


@given(
    st.dictionaries(st.text(), PLAIN, max_size=3).filter(lambda head: depth(head) < 6),
    st.dictionaries(st.text(max_size=20), ARRAY, max_size=3),
)
def test_a_frame_is_received_as_it_was_sent(head, arrays):
    got_head, got = received(wire_protocol.pack(head, arrays))
    assert got_head == head
    assert set(got) == set(arrays)
    for name, array in arrays.items():
        assert got[name].dtype == array.dtype
        np.testing.assert_array_equal(got[name], array)
        assert got[name].flags.writeable


def test_a_stream_that_ends_before_a_frame_is_distinguished_from_one_that_ends_within():
    assert received(b"") is None
    whole = wire_protocol.pack({"a": 1}, {"x": np.arange(3.0)})
    for length in range(1, len(whole)):
        with pytest.raises(WireError, match="ended within"):
            received(whole[:length])


@pytest.mark.parametrize(
    "data",
    [
        frame(b""),
        frame(b"[]"),
        frame({"head": [], "arrays": []}),
        of_arrays({}),
        frame({"head": {}, "arrays": [], "more": 1}),
        frame(b'{"head": {}, "head": {}, "arrays": []}'),
        frame(b'{"head": {"a": NaN}, "arrays": []}'),
        frame(b'{"head": {"a": 1e999}, "arrays": []}'),
        frame(b'{"head": {"a": ' + b"9" * 5000 + b'}, "arrays": []}'),
        frame(b'{"head": {"a": 9223372036854775808}, "arrays": []}'),
        frame(b'{"head": {"a": "\\ud800"}, "arrays": []}'),
        frame(b'{"head": {"a": "\xff"}, "arrays": []}'),
        frame(b"[" * 500_000),
        frame({"head": {"a": [[[[[[[[1]]]]]]]]}, "arrays": []}),
        of_arrays([["x", "f8", [1]]], b"1234567"),
        of_arrays([["x", "f8", [1]]], b"123456789"),
        of_arrays([["x", "O", [1]]], b"12345678"),
        of_arrays([["x", "f8", 1]], b"12345678"),
        of_arrays([["x", "f8", [-1]]], b"12345678"),
        of_arrays([["x", "f8", [True]]], b"12345678"),
        of_arrays([["x", "f8", [0, 2**62]]]),
        of_arrays([["x", "f8", [1] * 9]], b"12345678"),
        of_arrays([["x" * 65, "f8", [1]]], b"12345678"),
        of_arrays([[1, "f8", [1]]], b"12345678"),
        of_arrays([["x", "b1", [1]]] * 2, b"12"),
        of_arrays([[str(n), "b1", [0]] for n in range(513)]),
        struct.pack("<II", wire_protocol.MAX_HEADER + 1, 0),
        struct.pack("<II", 2, wire_protocol.MAX_PAYLOAD + 1),
    ],
    ids=lambda data: repr(data[8:40]),
)
def test_invalid_frames_are_rejected(data):
    with pytest.raises(WireError):
        received(data)


@pytest.mark.parametrize(
    ("head", "arrays"),
    [
        ({"a": object()}, {}),
        ({"a": float("nan")}, {}),
        ({"a": "x" * wire_protocol.MAX_HEADER}, {}),
        ({}, {"x": np.zeros(wire_protocol.MAX_PAYLOAD // 8 + 1)}),
        ({}, {"x": np.array([1j])}),
        ({}, {"x": np.array([object()])}),
    ],
)
def test_data_that_fit_no_frame_are_not_sent(head, arrays):
    with pytest.raises(WireError):
        wire_protocol.pack(head, arrays)


def test_bytes_of_booleans_other_than_zero_become_true():
    _, arrays = received(of_arrays([["x", "b1", [3]]], b"\x00\x01\x7f"))
    assert arrays["x"].tolist() == [False, True, True]


WHOLE = wire_protocol.pack({"turn": 3, "problem": "x"}, {"r": np.arange(4.0), "b": [True, False]})
HOT = b'{}[]",:0123456789-.eE\\u\x00\xff fib'


def damaged(count, seed):
    """Yield frames with some bytes changed, some with their end cut off."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        data = bytearray(WHOLE)
        for position in rng.integers(0, len(data), rng.integers(1, 5)):
            data[position] = (
                HOT[rng.integers(len(HOT))] if rng.random() < 0.7 else rng.integers(256)
            )
        if rng.random() < 0.2:
            del data[rng.integers(len(data)) :]
        yield bytes(data)


def rejected_or_plain(data):
    """Whether some bytes are a frame; anything but a clean rejection or plain data is an error."""
    try:
        got = wire_protocol.receive(io.BytesIO(data))
    except wire_protocol.WireError:
        return False
    if got is not None:
        head, arrays = got
        assert isinstance(head, dict)
        assert all(array.dtype.kind in "fib" for array in arrays.values())
    return got is not None


@settings(max_examples=1000)
@given(st.binary(max_size=60), st.binary(max_size=40))
def test_any_bytes_are_rejected_cleanly_or_are_a_frame(header, payload):
    rejected_or_plain(header + payload)
    rejected_or_plain(frame(header, payload))


@settings(max_examples=250)  # and 10⁴ messages below
@given(PLAIN, st.lists(st.tuples(PLAIN, PLAIN, PLAIN) | PLAIN, max_size=3), st.binary(max_size=40))
def test_any_json_is_rejected_cleanly_or_is_a_frame(head, arrays, payload):
    rejected_or_plain(frame({"head": head, "arrays": arrays}, payload))
    rejected_or_plain(frame(head, payload))


def test_ten_thousand_damaged_frames_are_rejected_cleanly_or_are_frames():
    assert 0 < sum(rejected_or_plain(data) for data in damaged(10_000, seed=8)) < 10_000
