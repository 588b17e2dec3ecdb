"""ROS bags, written here with rosbags as a robot would write them, of both versions."""

import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from slamlab import sources
from slamlab.cli import main
from slamlab.geometry import between, compose
from slamlab.sources import SourceError
from tests.laws import assert_same_pose

rosbags = pytest.importorskip("rosbags", reason="rosbags, the extra 'ros', is not installed")
from rosbags import rosbag1, rosbag2  # noqa: E402
from rosbags.typesys import Stores, get_types_from_msg, get_typestore  # noqa: E402

BEAMS = 90
MOUNT = np.array([0.2, -0.1, 0.3])  # of the laser on the robot [m, m, rad]
KINDS = ("ros1", "sqlite3", "mcap")
SCAN, ODOMETRY, TF = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"


class Bag:
    """A small bag to write messages into."""

    def __init__(self, path, kind):
        self.first = kind == "ros1"
        self.store = get_typestore(Stores.ROS1_NOETIC if self.first else Stores.ROS2_HUMBLE)
        if self.first:
            fields = "geometry_msgs/TransformStamped[] transforms"
            self.store.register(get_types_from_msg(fields, TF))
            self._writer = rosbag1.Writer(path)
        else:
            plugin = rosbag2.StoragePlugin[kind.upper()]
            self._writer = rosbag2.Writer(path, version=9, storage_plugin=plugin)
        self._topics = {}

    def __enter__(self):
        self._writer.open()
        return self

    def __exit__(self, *exc):
        self._writer.close()

    def make(self, kind, **fields):
        return self.store.types[kind](**fields)

    def header(self, stamp, frame):
        seconds = int(stamp)
        time = self.make(
            "builtin_interfaces/msg/Time",
            sec=seconds,
            nanosec=round((stamp - seconds) * 1e9),
        )
        extra = {"seq": 0} if self.first else {}
        return self.make("std_msgs/msg/Header", stamp=time, frame_id=frame, **extra)

    def point(self, x, y, z=0.0):
        return self.make("geometry_msgs/msg/Point", x=float(x), y=float(y), z=float(z))

    def turn(self, rotation):
        q = dict(zip("xyzw", map(float, rotation.as_quat()), strict=True))
        return self.make("geometry_msgs/msg/Quaternion", **q)

    def write(self, topic, kind, message, stamp):
        if topic not in self._topics:
            self._topics[topic] = self._writer.add_connection(topic, kind, typestore=self.store)
        serialise = self.store.serialize_ros1 if self.first else self.store.serialize_cdr
        data = serialise(message, kind)
        self._writer.write(self._topics[topic], round(stamp * 1e9), data)

    def scan(self, stamp, ranges, topic="/scan", frame="laser", received=None, **fields):
        ranges = np.asarray(ranges, dtype=np.float32)
        usual = dict(
            angle_min=-1.5,
            angle_max=1.5,
            angle_increment=3 / max(1, len(ranges) - 1),
            time_increment=0.0,
            scan_time=0.1,
            range_min=0.1,
            range_max=20.0,
            ranges=ranges,
            intensities=np.empty(0, np.float32),
        )
        message = self.make(SCAN, header=self.header(stamp, frame), **(usual | fields))
        self.write(topic, SCAN, message, stamp if received is None else received)

    def odometry(self, stamp, pose, topic="/odom", child="base_link"):
        place, covariance = self.point(*pose[:2]), np.zeros(36)
        zero = self.make("geometry_msgs/msg/Vector3", x=0.0, y=0.0, z=0.0)
        twist = self.make("geometry_msgs/msg/Twist", linear=zero, angular=zero)
        at = self.make(
            "geometry_msgs/msg/Pose",
            position=place,
            orientation=self.turn(Rotation.from_euler("z", pose[2])),
        )
        message = self.make(
            ODOMETRY,
            header=self.header(stamp, "odom"),
            child_frame_id=child,
            pose=self.make("geometry_msgs/msg/PoseWithCovariance", pose=at, covariance=covariance),
            twist=self.make(
                "geometry_msgs/msg/TwistWithCovariance", twist=twist, covariance=covariance
            ),
        )
        self.write(topic, ODOMETRY, message, stamp)

    def transform(self, stamp, parent, child, place, rotation, topic="/tf"):
        t = dict(zip("xyz", map(float, [*place, 0.0][:3]), strict=True))
        stamped = self.make(
            "geometry_msgs/msg/TransformStamped",
            header=self.header(stamp, parent),
            child_frame_id=child,
            transform=self.make(
                "geometry_msgs/msg/Transform",
                translation=self.make("geometry_msgs/msg/Vector3", **t),
                rotation=self.turn(rotation),
            ),
        )
        self.write(topic, TF, self.make(TF, transforms=[stamped]), stamp)

    def mount(self, stamp=100.0, parent="base_link", child="laser"):
        turn = Rotation.from_euler("z", MOUNT[2])
        self.transform(stamp, parent, child, MOUNT[:2], turn, topic="/tf_static")


def way(count=12):
    """Stamps, and a robot's poses in its odometry's frame at them; it turns more than once."""
    rng = np.random.default_rng(3)
    poses = [np.array([1.0, -2.0, 2.5])]
    for step in rng.normal([0.3, 0.0, 0.8], 0.1, size=(count - 1, 3)):
        poses.append(compose(poses[-1], step))
    return 100.0 + 0.25 * np.arange(count), np.array(poses)


def ranges_at(k):
    """Ranges of the k-th scan."""
    return np.random.default_rng([4, k]).uniform(0.5, 15, BEAMS).astype(np.float32)


def written(path, kind, how="topic", mounted=True):
    """A bag of a robot on its way, a scan with each odometry."""
    path = path / ("run.bag" if kind == "ros1" else "run")
    with Bag(path, kind) as bag:
        if mounted:
            bag.mount()
        for k, (stamp, pose) in enumerate(zip(*way(), strict=True)):
            if how == "topic":
                bag.odometry(stamp, pose)
            else:
                turn = Rotation.from_euler("z", pose[2])
                bag.transform(stamp, "odom", "base_link", pose[:2], turn)
                bag.transform(stamp, "map", "odom", [k, k], turn)  # somebody's corrections
            bag.scan(stamp, ranges_at(k))
    return path


def assert_is_the_way(source, mount=MOUNT):
    stamps, poses = way()
    laser = compose(poses, mount)
    readings = list(source)
    assert len(source) == len(readings) == len(stamps)
    np.testing.assert_allclose([r.time for r in readings], stamps)
    assert not readings[0].odometry.any()
    told = np.array([r.odometry for r in readings[1:]])
    assert_same_pose(told, between(laser[:-1], laser[1:]), 1e-6)
    for k, reading in enumerate(readings):
        np.testing.assert_array_equal(reading.scan.ranges, ranges_at(k))
        np.testing.assert_allclose(reading.scan.angles, np.linspace(-1.5, 1.5, BEAMS), atol=1e-6)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("how", ["topic", "tf"])
def test_a_bag_tells_scans_and_the_lasers_motion(tmp_path, kind, how):
    source = sources.open(written(tmp_path, kind, how))
    assert_is_the_way(source)
    assert not source.damage and source.skipped == 0
    assert source.sensor.range_max == 20 and source.sensor.field_of_view == pytest.approx(3)


@pytest.mark.parametrize("pattern", ["run/*.db3", "run/*.mcap"])
def test_one_file_of_a_ros2_folder_is_a_bag_too(tmp_path, pattern):
    written(tmp_path, "mcap" if "mcap" in pattern else "sqlite3")
    (path,) = tmp_path.glob(pattern)
    assert_is_the_way(sources.open(path))


@pytest.mark.parametrize("kind", KINDS)
def test_converted_and_read_back_a_bag_gives_equal_readings(tmp_path, kind, capsys):
    path, log = written(tmp_path, kind), tmp_path / "log.gz"
    assert main(["convert", str(path), str(log)]) == 0
    assert "12 readings written" in capsys.readouterr().out
    for a, b in zip(sources.open(path), sources.open(log), strict=True):
        assert a.time == b.time
        np.testing.assert_array_equal(a.odometry, b.odometry)
        np.testing.assert_array_equal(a.scan.ranges, b.scan.ranges)
        np.testing.assert_array_equal(a.scan.angles, b.scan.angles)


@given(st.lists(st.floats(100, 102.75), min_size=2, max_size=8, unique=True))
@settings(max_examples=15)
def test_between_odometry_messages_the_motion_is_interpolated(tmp_path_factory, at):
    path = tmp_path_factory.mktemp("bag") / "run.bag"
    stamps, poses = way()
    at = np.round(at, 6)
    with Bag(path, "ros1") as bag:
        for stamp, pose in zip(stamps, poses, strict=True):
            bag.odometry(stamp, pose, child="laser")
        for stamp in at:
            bag.scan(stamp, ranges_at(0), received=103)
    heading = np.unwrap(poses[:, 2])
    expected = np.column_stack([np.interp(at, stamps, c) for c in (*poses[:, :2].T, heading)])
    told = np.array([reading.odometry for reading in sources.open(path)])
    assert_same_pose(told[1:], between(expected[:-1], expected[1:]), 1e-6)


@pytest.mark.parametrize("kind", ["ros1", "mcap"])
def test_a_laser_upside_down_turns_the_other_way(tmp_path, kind):
    path = tmp_path / ("run.bag" if kind == "ros1" else "run")
    with Bag(path, kind) as bag:
        for stamp, pose in zip(*way(3), strict=True):
            # told again with every message, as ROS 1 did it
            bag.transform(
                stamp, "base_link", "laser", [0.2, 0, 0.3], Rotation.from_euler("x", np.pi)
            )
            bag.odometry(stamp, pose)
            bag.scan(stamp, ranges_at(0))
    readings = list(sources.open(path))
    laser = compose(way(3)[1], [0.2, 0, 0])
    told = np.array([reading.odometry for reading in readings])
    assert_same_pose(told[1:], between(laser[:-1], laser[1:]), 1e-6)
    np.testing.assert_allclose(readings[0].scan.angles, np.linspace(1.5, -1.5, BEAMS), atol=1e-6)


def test_where_topic_and_tf_disagree_the_topic_is_believed(tmp_path):
    with Bag(tmp_path / "run.bag", "ros1") as bag:
        bag.mount()
        for k, (stamp, pose) in enumerate(zip(*way(), strict=True)):
            bag.transform(stamp, "odom", "base_link", 2 * pose[:2], Rotation.identity())
            bag.odometry(stamp, pose)
            bag.scan(stamp, ranges_at(k))
    assert_is_the_way(sources.open(tmp_path / "run.bag"))


def test_frames_with_a_slash_are_the_same_frames(tmp_path):
    with Bag(tmp_path / "run.bag", "ros1") as bag:
        bag.mount(parent="/base_link", child="/laser")
        for k, (stamp, pose) in enumerate(zip(*way(), strict=True)):
            bag.odometry(stamp, pose)
            bag.scan(stamp, ranges_at(k), frame="/laser")
    assert_is_the_way(sources.open(tmp_path / "run.bag"))


def test_without_a_mount_the_laser_is_the_robot_and_that_is_said(tmp_path):
    source = sources.open(written(tmp_path, "ros1", mounted=False))
    assert_is_the_way(source, mount=np.zeros(3))
    assert source.damage == {
        "no transform to the laser, which is taken to be at the robot's centre": 1
    }


def test_returns_that_are_none_are_nan_and_limits_hold(tmp_path):
    with Bag(tmp_path / "run.bag", "ros1") as bag:
        bag.odometry(100, np.zeros(3), child="laser")
        bag.odometry(101, np.zeros(3), child="laser")
        bag.scan(100.5, [np.inf, np.nan, -1, 0.05, 3, 25])
        bag.scan(100.6, [1, 2], range_max=0.0, range_min=np.nan)
        bag.scan(100.7, [1, 2], angle_increment=np.nan)
        bag.scan(100.8, [])
    source = sources.open(tmp_path / "run.bag")
    first, second, empty = (reading.scan for reading in source)
    assert first.valid.tolist() == [False] * 4 + [True, False]
    assert second.valid.all() and not len(empty.ranges)
    assert source.damage == {"scans without directions": 1} and source.skipped == 1


def test_scans_outside_the_odometrys_time_are_left_out_and_counted(tmp_path):
    stamps, poses = way()
    with Bag(tmp_path / "run.bag", "ros1") as bag:
        bag.mount()
        for stamp, pose in zip(stamps, poses, strict=True):
            bag.odometry(stamp, pose)
        for stamp in (90.0, 101.0, 102.0, 101.5, 200.0):
            bag.scan(stamp, ranges_at(0), received=101)
    source = sources.open(tmp_path / "run.bag")
    assert [reading.time for reading in source] == [101, 102, 101.5]
    assert source.skipped == 2
    assert source.damage == {"scans outside the odometry's time": 2, "stamps that run backwards": 1}


def test_a_scan_without_a_stamp_has_the_time_it_was_received(tmp_path):
    with Bag(tmp_path / "run.bag", "ros1") as bag:
        for stamp in (100, 102):
            bag.odometry(stamp, np.zeros(3), child="laser")
        bag.scan(0, ranges_at(0), received=101.25)
    (reading,) = sources.open(tmp_path / "run.bag")
    assert reading.time == 101.25


def test_of_several_topics_one_is_named_behind_the_path(tmp_path):
    path = tmp_path / "C# bags" / "run.bag"
    path.parent.mkdir()
    with Bag(path, "ros1") as bag:
        for stamp, x in ((100, 0.0), (102, 2.0)):
            bag.odometry(stamp, [x, 0, 0], topic="/odom", child="laser")
            bag.odometry(stamp, [3 * x, 0, 0], topic="/wheels", child="laser")
        for stamp in (100.5, 101.5):
            bag.scan(stamp, [1, 2], topic="/front")
            bag.scan(stamp, [3, 4], topic="/rear")
    with pytest.raises(SourceError, match=r"LaserScan on several topics: /front, /rear; say which"):
        sources.open(path)
    with pytest.raises(SourceError, match=r"Odometry on several topics: /odom, /wheels; say which"):
        sources.open(f"{path}#/rear")
    with pytest.raises(SourceError, match=r"no topic /side; there are: /front, /odom"):
        sources.open(f"{path}#/side")
    _, second = sources.open(f"{path}#/rear,/wheels")
    np.testing.assert_array_equal(second.scan.ranges, [3, 4])
    np.testing.assert_allclose(second.odometry, [3, 0, 0])


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("fill", "says"),
    [
        (lambda bag: bag.odometry(100, np.zeros(3)), "holds no scan: .* its topics: /odom"),
        (lambda bag: bag.scan(100, [1, 2]), "no odometry: neither"),
        (lambda bag: (bag.mount(), bag.scan(100, [1, 2])), "no odometry: neither"),
        (
            lambda bag: [bag.scan(90, [1, 2]), *(bag.odometry(k, [k, 0, 0]) for k in (99, 100))],
            "no usable scan",
        ),
        (
            lambda bag: (
                bag.transform(
                    100, "base_link", "laser", [0, 0], Rotation.from_euler("y", 1.5), "/tf_static"
                ),
                bag.odometry(100, np.zeros(3)),
                bag.scan(100, [1, 2]),
            ),
            "laser is tilted",
        ),
    ],
)
def test_what_a_bag_lacks_is_said_in_one_line(tmp_path, kind, fill, says):
    path = tmp_path / ("run.bag" if kind == "ros1" else "run")
    with Bag(path, kind) as bag:
        fill(bag)
    with pytest.raises(SourceError, match=says) as refused:
        sources.open(path)
    assert "\n" not in str(refused.value)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A bag of each kind, by the ending of its file."""
    found = {}
    for kind in KINDS:
        folder = tmp_path_factory.mktemp(kind)
        path = written(folder, kind)
        files = [path] if kind == "ros1" else [p for p in path.iterdir() if p.suffix != ".yaml"]
        found[files[0].suffix] = files[0]
    return found


@pytest.mark.parametrize("ending", [".bag", ".db3", ".mcap"])
@settings(max_examples=40)
@given(share=st.floats(0, 1, exclude_max=True))
def test_a_bag_cut_short_is_refused_in_one_line_or_read_in_part(
    whole, tmp_path_factory, ending, share
):
    path = tmp_path_factory.mktemp("cut") / f"run{ending}"
    content = whole[ending].read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    try:
        source = sources.open(path)
    except SourceError as refused:
        assert "\n" not in str(refused)
        return
    assert len(list(source)) <= 12
    assert source.damage or len(source) == 12


@pytest.mark.slow
@pytest.mark.parametrize("ending", [".bag", ".db3", ".mcap"])
@settings(max_examples=40)
@given(data=st.data())
def test_flipped_bytes_raise_nothing_but_a_source_error(whole, tmp_path_factory, ending, data):
    content = bytearray(whole[ending].read_bytes())
    at = data.draw(st.integers(16, len(content) - 1))
    content[at] ^= data.draw(st.integers(1, 255))
    path = tmp_path_factory.mktemp("flip") / f"run{ending}"
    path.write_bytes(content)
    try:
        list(sources.open(path))
    except SourceError as refused:
        assert "\n" not in str(refused)


def test_without_rosbags_it_is_said_what_to_install(tmp_path, monkeypatch, capsys):
    path = written(tmp_path, "ros1")
    monkeypatch.setitem(sys.modules, "rosbags", None)
    assert main(["run", str(path)]) == 2
    assert "pip install 'slamlab[ros]'" in capsys.readouterr().err


def test_a_folder_without_metadata_and_other_databases_are_no_bags(tmp_path):
    with pytest.raises(SourceError, match="is a folder"):
        sources.open(tmp_path)
    (tmp_path / "metadata.yaml").write_text("other: 1\n")
    with pytest.raises(SourceError, match="cannot be read as a ROS bag"):
        sources.open(tmp_path)
    (tmp_path / "x.db3").write_bytes(b"SQLite format 3\0" + bytes(100))
    with pytest.raises(SourceError, match="cannot be read as a ROS bag"):
        sources.open(tmp_path / "x.db3")
