"""Input files, read in chunks, with decompression (gzip, bzip2, xz) and Unicode encodings."""

import bz2
import codecs
import lzma
import zlib
from itertools import chain
from pathlib import Path

GZIP = b"\x1f\x8b"  # magic number: the first bytes of a gzip file
DECOMPRESSORS = {
    GZIP: lambda: zlib.decompressobj(wbits=31),
    b"BZh": bz2.BZ2Decompressor,
    b"\xfd7zXZ\0": lambda: lzma.LZMADecompressor(memlimit=1 << 28),
}
DAMAGED = zlib.error, lzma.LZMAError, OSError, EOFError, ValueError  # raised by decompressors
BYTE_ORDER_MARKS = {
    codecs.BOM_UTF8: "utf-8",
    codecs.BOM_UTF32_LE: "utf-32-le",  # before the mark of UTF-16, which is its prefix
    codecs.BOM_UTF32_BE: "utf-32-be",
    codecs.BOM_UTF16_LE: "utf-16-le",
    codecs.BOM_UTF16_BE: "utf-16-be",
}
CHUNK, SLICE = 1 << 16, 512  # read, and decompressed, at a time [bytes]
MAX_COMPRESSIONS = 3  # of a file, one within the other
HEAD = 1 << 20  # for the detection of the format [bytes]
MAX_LINE = 1 << 26  # longest line of text [bytes]


class SourceError(ValueError):
    """A data source cannot be opened or contains no usable data; the message suggests a fix."""


class InputFile:
    """Iterable of the bytes of a file in chunks, decompressed as far as possible.

    Text is converted to UTF-8 without a byte-order mark. Only one iteration is possible; after it,
    ``truncated`` states whether bytes are lost.
    """

    def __init__(self, path):
        self.path, self.truncated = Path(path), False
        self._chunks = _to_utf8(self._decompressed())

    def __iter__(self):
        return self._chunks

    def head(self):
        """Return at least the first HEAD bytes, if available; the iteration still includes them."""
        chunks, size = [], 0
        while size < HEAD and (chunk := next(self._chunks, None)) is not None:
            chunks.append(chunk)
            size += len(chunk)
        self._chunks = chain(chunks, self._chunks)
        return b"".join(chunks)

    def lines(self):
        """Yield (number, text without line end, whether the line has a line end) for each line."""
        number, held, size = 0, [], 0
        for chunk in self:
            held.append(chunk)
            size += len(chunk)
            if b"\n" in chunk or b"\r" in chunk:
                *rows, last = b"".join(held).splitlines(keepends=True)
                for more, row in enumerate(rows, 1):
                    yield number + more, row.rstrip(b"\r\n"), True
                number += len(rows)
                held, size = [last], len(last)  # the next chunk may continue it
            if size > MAX_LINE:
                where = f"{self.path}, line {number + 1}"
                raise SourceError(
                    f"{where} is longer than {MAX_LINE >> 20} MB. The file is not text"
                )
        for more, (row, ended) in enumerate(lines(b"".join(held)), 1):
            yield number + more, row, ended

    def _read(self):
        try:
            with self.path.open("rb") as file:
                while chunk := file.read(CHUNK):
                    yield chunk
        except FileNotFoundError:
            raise SourceError(f"{self.path} does not exist. Check the name") from None
        except IsADirectoryError:
            raise SourceError(f"{self.path} is a folder. Open a log file in this folder") from None
        except (OSError, ValueError) as error:
            raise SourceError(f"{self.path} cannot be read: {reason(error)}") from None

    def _decompressed(self):
        chunks = self._read()
        for _ in range(MAX_COMPRESSIONS):
            first = next(filter(None, chunks), b"")
            chunks = chain([first], chunks)
            make = next((m for magic, m in DECOMPRESSORS.items() if first.startswith(magic)), None)
            if make is None:
                break
            chunks = self._inflated(chunks, make)
        return chunks

    def _inflated(self, chunks, make):
        decompressor = None
        for chunk in chunks:
            # small slices, so that a damaged block costs at most one slice
            for start in range(0, len(chunk), SLICE):
                part = chunk[start : start + SLICE]
                # padding with zeros after the last stream is allowed
                while part and (decompressor or part.strip(b"\0")):
                    decompressor = decompressor or make()
                    try:
                        yield from _decompress(decompressor, part)
                    except DAMAGED:
                        self.truncated = True
                        return
                    part = decompressor.unused_data
                    if decompressor.eof:
                        decompressor = None
        self.truncated = self.truncated or decompressor is not None


def _decompress(decompressor, part):
    """Decompress some bytes and yield chunks of bounded size."""
    while True:
        yield decompressor.decompress(part, CHUNK)
        # zlib returns the unconsumed rest, the others keep it
        part = getattr(decompressor, "unconsumed_tail", b"")
        if decompressor.eof or not (part or not getattr(decompressor, "needs_input", True)):
            return


def _to_utf8(chunks):
    """Yield text chunks as UTF-8 without a byte-order mark, and other chunks unchanged."""
    start = b""
    for chunk in chunks:
        start += chunk
        if len(start) >= CHUNK:
            break
    mark = next((mark for mark in BYTE_ORDER_MARKS if start.startswith(mark)), b"")
    encoding = BYTE_ORDER_MARKS.get(mark) or _unmarked_encoding(start[:32])
    chunks = chain([start[len(mark) :]], chunks)
    if encoding == "utf-8":
        yield from chunks
        return
    decoder = codecs.getincrementaldecoder(encoding)("replace")
    for chunk in chunks:
        yield decoder.decode(chunk).encode()
    yield decoder.decode(b"", final=True).encode()


def _unmarked_encoding(start):
    """Detect the encoding of text without a byte-order mark; in UTF-16, every second byte is 0."""
    for encoding, zeros, letters in (
        ("utf-16-le", start[1::2], start[::2]),
        ("utf-16-be", start[::2], start[1::2]),
    ):
        if len(start) >= 8 and not zeros.strip(b"\0") and b"\0" not in letters:
            return encoding
    return "utf-8"


def read_bytes(path):
    """Return the bytes of an InputFile and whether any bytes are lost. Raises SourceError."""
    file = InputFile(path)
    return b"".join(file), file.truncated


def lines(content):
    """Yield (text without line end, whether the line has a line end) for each line."""
    for line in content.splitlines(keepends=True):
        bare = line.rstrip(b"\r\n")
        yield bare, len(bare) < len(line)


def disk_full_error(what, error):
    """Return the SourceError for an OSError in the temporary folder, such as a full disk."""
    where = "the folder of temporary files"
    why = f"{reason(error)}. Free space, or set TMPDIR to another folder"
    return SourceError(f"{what} cannot be stored in {where}: {why}")


def reason(error):
    """Return the message of an OSError or ValueError, without error number and path."""
    return (getattr(error, "strerror", None) or str(error)).lower()
