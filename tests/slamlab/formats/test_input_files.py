"""Text reaches every reader alike, whatever its encoding, compression, line ends and damage."""

import bz2
import gzip
import lzma
import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import files
from slamlab.files import InputFile, SourceError, lines, read_bytes

TEXT = "FLASER 2 1.0 2.0\nDüsseldorf Σ\n\nlast\n"
ENCODINGS = {
    "utf-8": TEXT.encode(),
    "utf-8 with a mark": TEXT.encode("utf-8-sig"),
    "utf-16 of PowerShell": TEXT.encode("utf-16"),
    "utf-16 little endian, no mark": TEXT.encode("utf-16-le"),
    "utf-16 big endian, no mark": TEXT.encode("utf-16-be"),
    "utf-16 big endian": b"\xfe\xff" + TEXT.encode("utf-16-be"),
    "utf-32": TEXT.encode("utf-32"),
}
COMPRESSIONS = {
    "plain": bytes,
    "gzip": gzip.compress,
    "bzip2": bz2.compress,
    "xz": lzma.compress,
    "gzip in bzip2": lambda content: bz2.compress(gzip.compress(content, mtime=0)),
}


def written(folder, content):
    path = folder / "file"
    path.write_bytes(content)
    return path


@pytest.mark.parametrize("compression", COMPRESSIONS)
@pytest.mark.parametrize("encoding", ENCODINGS)
def test_text_is_read_equally_in_every_encoding_and_compression(tmp_path, encoding, compression):
    path = written(tmp_path, COMPRESSIONS[compression](ENCODINGS[encoding]))
    assert read_bytes(path) == (TEXT.encode(), False)
    file = InputFile(path)
    assert file.head() == TEXT.encode()  # looking at it first takes nothing away
    assert [(n, row.decode()) for n, row, _ in file.lines()] == [*enumerate(TEXT.splitlines(), 1)]


@settings(max_examples=80)
@given(
    st.lists(st.sampled_from([b"a", b"bcd", b"\n", b"\r", b"\r\n", b"\0", b"\xff"]), max_size=40),
    st.integers(1, 5),
)
def test_lines_do_not_depend_on_the_chunks(tmp_path_factory, parts, piece):
    content = b"x" + b"".join(parts)
    path = written(tmp_path_factory.mktemp("lines"), content)
    usual, files.CHUNK = files.CHUNK, piece
    try:
        found = [(row, ended) for _, row, ended in InputFile(path).lines()]
    finally:
        files.CHUNK = usual
    assert found == list(lines(content))


def test_gzip_streams_one_after_another_and_padding_are_one_file(tmp_path):
    content = gzip.compress(b"one\n") + gzip.compress(b"two\n") + b"\0" * 700
    assert read_bytes(written(tmp_path, content)) == (b"one\ntwo\n", False)


@pytest.mark.parametrize("junk", [b"junk", b"\0\0\1"])
def test_other_bytes_after_a_gzip_stream_are_reported_as_truncated(tmp_path, junk):
    assert read_bytes(written(tmp_path, gzip.compress(b"one\n") + junk)) == (b"one\n", True)


def test_a_line_without_an_end_is_refused_with_its_number(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "MAX_LINE", 1 << 20)
    path = written(tmp_path, b"first\n" + b"x" * (3 << 20))
    with pytest.raises(SourceError, match="line 2 is longer than 1 MB"):
        list(InputFile(path).lines())


@pytest.mark.parametrize("compress", [gzip.compress, bz2.compress, lzma.compress])
def test_zeros_by_the_gigabyte_are_refused_in_bounded_memory(tmp_path, monkeypatch, compress):
    monkeypatch.setattr(files, "MAX_LINE", 1 << 20)
    path = written(tmp_path, compress(bytes(30 << 20)))
    tracemalloc.start()
    with pytest.raises(SourceError, match="line 1 is longer"):
        list(InputFile(path).lines())
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 20 << 20  # xz's own dictionary is 8 MB


@settings(max_examples=60)
@given(st.sampled_from(list(COMPRESSIONS)[1:]), st.data())
def test_damaged_compression_gives_what_comes_before_it(tmp_path_factory, compression, data):
    rng = np.random.default_rng(1)
    text = "\n".join(map(str, rng.random(1000))).encode()
    packed = bytearray(COMPRESSIONS[compression](text))
    at = data.draw(st.integers(8, len(packed) - 1))
    packed[at] ^= data.draw(st.integers(1, 255))
    content, torn = read_bytes(written(tmp_path_factory.mktemp("damage"), bytes(packed)))
    assert torn or content == text
    if compression == "gzip":
        assert content[: max(0, at - 9000)] == text[: max(0, at - 9000)]
