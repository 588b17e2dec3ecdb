"""Files of ROS bags as they lie on disks: split, compressed, renamed, cut short, damaged, large."""

import shutil
import sqlite3
import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import sources
from slamlab.sources import SourceError, disk_buffer

pytest.importorskip("rosbags", reason="rosbags, the extra 'ros', is not installed")
from rosbags import rosbag1, rosbag2

from tests.slamlab.formats.bag_writing import KINDS, Bag
from tests.slamlab.formats.mutations import mutated
from tests.slamlab.formats.recorded_robot import COUNT, Recording, map_errors


def split(path, kind, parts=3, compress=None):
    """A recording in a folder of several files, the transforms in the first alone."""
    path.mkdir()
    files = []
    for part in range(parts):
        folder = path / f"part{part}"
        each = COUNT // parts
        with Bag(folder, kind, compress) as bag:
            Recording(odometry="tf").write_into(bag, (each * part, each * (part + 1)))
        (file,) = (p for p in folder.iterdir() if p.suffix != ".yaml")
        files.append(file.rename(path / f"run_{part}{''.join(file.suffixes)}"))
        shutil.rmtree(folder)
    return files


def assert_whole(source):
    assert map_errors(source).max() < 0.02 and len(source) == COUNT and not source.damage


def metadata(path, names):
    lines = ["rosbag2_bagfile_information:", "  relative_file_paths:"]
    (path / "metadata.yaml").write_text("\n".join([*lines, *(f"    - {n}" for n in names)]) + "\n")


def by_zstd(mode):
    return lambda writer: writer.set_compression(mode, rosbag2.CompressionFormat.ZSTD)


by_file, by_message, by_storage = map(by_zstd, list(rosbag2.CompressionMode)[1:])


def by(name):
    """Compression of a bag of ROS 1."""
    return lambda writer: writer.set_compression(rosbag1.Writer.CompressionFormat[name])


@pytest.mark.parametrize(
    ("kind", "compress"),
    [
        ("sqlite3", None),
        ("mcap", None),
        ("sqlite3", by_file),
        ("mcap", by_file),
        ("sqlite3", by_message),
        ("mcap", by_message),
        ("mcap", by_storage),
        ("ros1", by("LZ4")),
        ("ros1", by("BZ2")),
    ],
)
@pytest.mark.parametrize("with_metadata", [True, False])
def test_bags_are_read_compressed_or_not_with_and_without_metadata(
    tmp_path, kind, compress, with_metadata
):
    path = Recording(kind=kind, compress=compress).write(tmp_path)
    if not with_metadata and path.is_dir():
        (path / "metadata.yaml").unlink()
    assert_whole(sources.open(path))


@pytest.mark.parametrize("kind", ["sqlite3", "mcap"])
@pytest.mark.parametrize("half", [b"", b"{[", b"rosbag2_bagfile_information:\n", b"\xff"])
def test_a_recording_that_was_killed_has_half_of_its_metadata(tmp_path, kind, half):
    path = Recording(kind=kind).write(tmp_path)
    (path / "metadata.yaml").write_bytes(half)
    assert_whole(sources.open(path))


@pytest.mark.parametrize("kind", ["sqlite3", "mcap"])
@pytest.mark.parametrize("compress", [None, by_file])
def test_a_split_bag_is_read_completely_in_order_of_time(tmp_path, kind, compress):
    files = split(tmp_path / "run", kind, 3, compress)
    # in the order of their names the last comes second
    files[2].rename(tmp_path / "run" / files[2].name.replace("run_2", "run_10"))
    source = sources.open(tmp_path / "run")
    assert_whole(source)
    assert np.diff([reading.time for reading in source]).min() > 0


def test_a_missing_file_of_the_metadata_is_reported_and_the_rest_is_read(tmp_path):
    path = tmp_path / "run"
    files = split(path, "mcap")
    metadata(path, [file.name for file in files])
    files[1].unlink()
    source = sources.open(path)
    assert source.damage["missing files of metadata.yaml"] == 1
    assert source.damage["scans outside the odometry's time"] == 0 and len(source) == 20
    assert map_errors(source).max() < 0.02
    metadata(path, ["before_it_was_renamed.mcap"])
    assert not sources.open(path).damage and len(sources.open(path)) == 20


def test_a_copy_beside_the_bag_is_not_read_twice(tmp_path):
    path = Recording(kind="mcap").write(tmp_path)
    (file,) = path.glob("*.mcap")
    shutil.copy(file, path / "copy.mcap")
    assert len(sources.open(path)) == COUNT  # by metadata
    (path / "metadata.yaml").unlink()
    with pytest.raises(
        SourceError, match=r"more than one bag \(.* have different names\): open one"
    ):
        sources.open(path)
    (path / "copy.mcap").rename(path / "run_1.mcap")
    with pytest.raises(SourceError, match=r"more than one bag \(.*overlap in time\): open one"):
        sources.open(path)


@pytest.mark.parametrize("compress", [None, by_storage])
@pytest.mark.parametrize("share", [0.2, 0.5, 0.9])
def test_what_a_killed_recorder_wrote_into_an_mcap_file_is_read(tmp_path, compress, share):
    path = tmp_path / "run"
    with Bag(path, "mcap", compress) as bag:
        wide(bag, 600, 2000)
    (path / "metadata.yaml").unlink()
    (file,) = path.glob("*.mcap")
    content = file.read_bytes()
    data = content.rindex(b"\x0f\x04" + bytes(7))  # the record at the end of the data
    file.write_bytes(content[: int(share * data)])
    source = sources.open(path)
    assert source.damage["bag truncated"] == 1
    assert 0 < len(source) < 600 and len(list(source)) == len(source)
    if not compress:  # of every chunk of 1 MB that is whole
        assert share * 600 - 140 < len(source) <= share * 600 + 5


def test_a_damaged_file_of_several_costs_that_file_alone(tmp_path):
    files = split(tmp_path / "run", "mcap")
    files[2].write_bytes(files[2].read_bytes()[:500])
    source = sources.open(tmp_path / "run")
    assert source.damage == {"unreadable files of the bag": 1} and len(source) == 20
    assert map_errors(source).max() < 0.02


@pytest.mark.parametrize("kind", ["sqlite3", "mcap", "ros1"])
@pytest.mark.parametrize("name", ["run 1#2?3%41.x", "my_recording"])
def test_a_file_of_any_name_is_recognised_by_its_content(tmp_path, kind, name):
    path = Recording(kind=kind).write(tmp_path)
    (file,) = [path] if kind == "ros1" else (p for p in path.iterdir() if p.suffix != ".yaml")
    for spec in (file.rename(tmp_path / name), f"{tmp_path / name}#/scan"):
        assert map_errors(sources.open(spec)).max() < 0.02


def test_metadata_stands_for_its_folder(tmp_path):
    path = Recording(kind="sqlite3").write(tmp_path)
    assert len(sources.open(path / "metadata.yaml")) == COUNT


def test_what_sqlite_had_not_yet_written_into_the_database_is_read(tmp_path):
    path = Recording(kind="sqlite3").write(tmp_path)
    (file,) = path.glob("*.db3")
    connection = sqlite3.connect(file)
    connection.execute("PRAGMA journal_mode=WAL")
    connection.execute("PRAGMA wal_autocheckpoint=0")
    connection.execute("CREATE TABLE later AS SELECT * FROM messages WHERE timestamp > 101.5e9")
    connection.execute("DELETE FROM messages WHERE timestamp > 101.5e9")
    connection.commit()
    connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    connection.execute("INSERT INTO messages SELECT * FROM later")
    connection.commit()
    robot = tmp_path / "as the robot was switched off"
    shutil.copytree(path, robot)  # with the log, which closing would write into the database
    connection.close()
    assert_whole(sources.open(robot))
    for log in robot.glob("*.db3-wal"):
        log.unlink()
    assert len(sources.open(robot)) < COUNT


@pytest.mark.parametrize("schema", [1, 2])
def test_databases_of_older_ros2_are_read(tmp_path, schema):
    path = Recording(kind="sqlite3").write(tmp_path)
    (file,) = path.glob("*.db3")
    with sqlite3.connect(file) as connection:
        for table in ("schema", "metadata", "message_definitions"):
            connection.execute(f"DROP TABLE {table}")
        columns = ["type_description_hash", "offered_qos_profiles"]
        for column in columns[: 3 - schema]:
            connection.execute(f"ALTER TABLE topics DROP COLUMN {column}")
    connection.close()
    assert_whole(sources.open(path))


def unlike(path, old, new):
    """A file with other bytes at its beginning."""
    path.write_bytes(path.read_bytes().replace(old, new, 1))
    return path


def test_files_that_cannot_be_opened_are_refused_with_their_format_and_a_remedy(tmp_path):
    bag = Recording().write(tmp_path)
    (mcap,) = Recording(kind="mcap").write(tmp_path / "mcap").glob("*.mcap")
    (db3,) = Recording(kind="sqlite3").write(tmp_path / "db3").glob("*.db3")
    for path, words in ((bag, "rosbag reindex"), (mcap, "mcap recover"), (db3, "sqlite3")):
        cut = tmp_path / f"cut{path.suffix}"
        cut.write_bytes(path.read_bytes()[:5000])
        with pytest.raises(SourceError, match=f"ROS bag: it is truncated or damaged; .*{words}"):
            sources.open(cut)
    with pytest.raises(SourceError, match="its MCAP profile is 'ros1'; only 'ros2' is supported"):
        sources.open(unlike(mcap, b"ros2", b"ros1"))
    with pytest.raises(SourceError, match=r"format V1.2 is older than 2010; 'rosbag fix'"):
        sources.open(unlike(bag, b"V2.0", b"V1.2"))
    with sqlite3.connect(tmp_path / "contacts.db") as connection:
        connection.execute("CREATE TABLE people (name TEXT)")
    connection.close()
    with pytest.raises(SourceError, match=r"contacts.db .*: it is a database of another program"):
        sources.open(tmp_path / "contacts.db")
    (tmp_path / "folder").mkdir()
    metadata(tmp_path / "folder", ["run_0.db3"])
    with pytest.raises(SourceError, match=r"folder cannot be read as a ROS bag: .*no message file"):
        sources.open(tmp_path / "folder")


def wide(bag, count, beams):
    """Many scans and odometry of a robot that stands in a corner."""
    angles = np.linspace(-1.5, 1.5, beams)
    ranges = 2 / np.maximum(np.abs(np.cos(angles)), np.abs(np.sin(angles)))
    for k in range(count):
        bag.odometry(100 + 0.1 * k, [0.001 * k, 0, 0], child="laser")
        bag.scan(100 + 0.1 * k, ranges, angle_increment=3 / (beams - 1))


@pytest.mark.parametrize("kind", KINDS)
def test_a_large_bag_is_read_in_little_memory(tmp_path, monkeypatch, kind):
    monkeypatch.setattr(disk_buffer, "IN_MEMORY", 1 << 19)
    path = tmp_path / ("run.bag" if kind == "ros1" else "run")
    with Bag(path, kind) as bag:
        wide(bag, 800, 2000)
    assert sum(p.stat().st_size for p in tmp_path.rglob("*") if p.is_file()) > 6e6
    sources.open(path)  # what is imported and made once does not count
    tracemalloc.start()
    source = sources.open(path)
    assert sum(len(reading.scan.ranges) for reading in source) == 1_600_000
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 5e6  # the ranges alone take 13 MB


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """The bytes of small bags by (kind, odometry)."""
    found = {}
    for kind in KINDS:
        for odometry in ("topic", "tf"):
            recording = Recording(
                kind, odometry, count=6, angles=lambda k: np.linspace(-2, 2, 31), turn_time=0.1
            )
            path = recording.write(tmp_path_factory.mktemp("small"))
            files = [path] if kind == "ros1" else [p for p in path.iterdir() if p.suffix != ".yaml"]
            found[kind, odometry] = files[0].read_bytes()
    return found


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=60, deadline=None)
@given(odometry=st.sampled_from(["topic", "tf"]), data=st.data())
def test_a_damaged_bag_raises_nothing_but_a_source_error(
    small, tmp_path_factory, kind, odometry, data
):
    path = tmp_path_factory.mktemp("damaged") / "run"
    whole = small[kind, odometry]
    path.write_bytes(whole[:17] + data.draw(mutated(whole[17:])))  # the format remains
    try:
        source = sources.open(path)
    except SourceError as refused:
        assert "\n" not in str(refused) and len(str(refused)) < 1000
        return
    readings = list(source)
    assert len(readings) == len(source) <= 6
    for reading in readings:
        assert np.isfinite(reading.time)
        assert reading.odometry is None or np.isfinite(reading.odometry).all()
        assert reading.scan.angles.shape == reading.scan.ranges.shape
        assert np.isfinite(reading.scan.angles).all()
