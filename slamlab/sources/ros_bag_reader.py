"""Reader of ROS bags (ROS 1, ROS 2: SQLite, MCAP) with ``rosbags``, split or compressed."""

from collections import Counter
from contextlib import ExitStack, suppress
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory

from slamlab.extras import needs
from slamlab.files import SourceError, disk_full_error, reason
from slamlab.sources.ros_bag_files import (
    MCAP,
    METADATA,
    ROS1,
    SQLITE,
    SUFFIXES,
    ZSTD,
    fault,
    files_of,
    folder_of,
    magic_number,
    part_of,
    quoted,
    with_footer,
    with_write_ahead_log,
    write_ahead_log,
)
from slamlab.sources.ros_decoding import MessageDecoder, zstd_decompressor

MAX_OVERLAP = 1.0  # of successive files of one recording [s]
PIECE = 1 << 16  # decompressed at a time [bytes]


class BagFiles:
    """Context manager for the open files of a bag. Raises SourceError, ExtraMissing.

    ``counts``: {(topic, type): number of messages}; ``damage``: Counter of unreadable data by kind.
    """

    def __init__(self, path):
        with needs("ros"):
            from rosbags import rosbag1, rosbag2
        # the readers of single files: the folder reader of rosbag2 needs metadata
        self._readers_by_magic = {
            ROS1: rosbag1.Reader,
            **{m: rosbag2.Reader.STORAGE_PLUGINS[SUFFIXES[m]] for m in (SQLITE, MCAP)},
        }
        self.path, self.damage, self.counts = folder_of(Path(path)), Counter(), Counter()
        self._decode, self._stack, self._readers = MessageDecoder(), ExitStack(), []

    def __enter__(self):
        try:
            self._open()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *exc):
        with suppress(Exception):  # of readers of damaged files
            self._stack.close()

    def messages(self, wanted):
        """Yield topic, type, time of reception [s] and message for each of the ``wanted`` topics.

        The message is None if it cannot be decoded.
        """
        for _, reader in self._readers:
            connections = [each for each in reader.connections if _key(each) in wanted]
            lost = sum(each.msgcount for each in connections)
            try:
                for connection, received, data in reader.messages(connections):
                    lost -= 1
                    yield *_key(connection), received * 1e-9, self._decode(connection, data)
            except SourceError:
                raise
            except Exception:  # rosbags raises any exception for a damaged bag
                self.damage["bag truncated"] += 1
            if lost > 0:
                self.damage["messages lost in damaged parts of the bag"] += lost

    def _open(self):
        files, missing = files_of(self.path)
        if missing:
            self.damage[f"missing files of {METADATA}"] += missing
        refusals = []
        for file in files:
            try:
                self._readers.append((file, self._reader(file)))
            except SourceError as error:
                refusals.append(str(error))
        if not self._readers:
            empty = f"{self.path} cannot be read as a ROS bag: it contains no message file"
            raise SourceError(refusals[0] if refusals else f"{empty} (.db3, .mcap)")
        if refusals:
            self.damage["unreadable files of the bag"] += len(refusals)
        self._sort_by_time()
        for _, reader in self._readers:
            for connection in reader.connections:
                self.counts[_key(connection)] += connection.msgcount

    def _sort_by_time(self):
        """Sort the files by time. SourceError: the files are not parts of one recording."""
        if len(self._readers) < 2:
            return
        self._readers.sort(key=lambda each: each[1].metadata.start_time)
        for (first, before), (second, after) in pairwise(self._readers):
            both = f"{first.name} and {second.name}"
            if part_of(first) != part_of(second):
                what = f"{both} have different names"
            elif before.metadata.end_time - after.metadata.start_time > MAX_OVERLAP * 1e9:
                what = f"{both} overlap in time"
            else:
                continue
            raise SourceError(f"{self.path} contains more than one bag ({what}): open one file")

    def _reader(self, file):
        magic, plain = None, file
        try:
            magic = magic_number(file)
            if magic == ZSTD:
                plain = self._decompressed(file)
                magic = magic_number(plain)
            if magic == SQLITE and write_ahead_log(plain).is_file():
                folder = self._stack.enter_context(TemporaryDirectory())
                plain = with_write_ahead_log(plain, folder)
            if magic == SQLITE:  # whose reader puts the path into a URI
                plain = Path(quoted(plain))
            if magic not in self._readers_by_magic:
                raise SourceError(f"{file} cannot be read as a ROS bag: it has a different format")
            return self._opened(magic, plain)
        except SourceError:
            raise
        except OSError as error:
            raise SourceError(f"{file} cannot be read: {reason(error)}") from None
        except Exception:  # as above
            raise SourceError(f"{file} cannot be read as a ROS bag: {fault(file, magic)}") from None

    def _opened(self, magic, path):
        """Return an open reader of a file, or of the whole records of a truncated file."""
        try:
            return self._registered(magic, path)
        except Exception:  # as above
            if magic != MCAP:
                raise
        path = with_footer(path, self._stack.enter_context(TemporaryDirectory()))
        reader = self._registered(magic, path)
        if not reader.connections:
            raise ValueError("no message is left")
        self.damage["bag truncated"] += 1
        return reader

    def _registered(self, magic, path):
        reader = self._readers_by_magic[magic](path)
        reader.open()
        self._stack.callback(reader.close)
        return reader

    def _decompressed(self, file):
        """Decompress a file into a temporary folder and return the path."""
        folder = self._stack.enter_context(TemporaryDirectory())
        plain, decompressor = Path(folder) / file.stem, zstd_decompressor()
        with file.open("rb") as compressed, plain.open("wb") as copy:
            while not decompressor.eof and (piece := compressed.read(PIECE)):
                try:
                    piece = decompressor.decompress(piece)
                except Exception:  # as above
                    break
                try:
                    copy.write(piece)
                except OSError as error:
                    raise disk_full_error(file, error) from None
        if not decompressor.eof:
            self.damage["file truncated"] += 1
        return plain


def _key(connection):
    return connection.topic, connection.msgtype
