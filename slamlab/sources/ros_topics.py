"""Choice of the ROS topics to read: one topic of scans, at most one of odometry, transforms."""

from slamlab.files import SourceError
from slamlab.sources.ros_decoding import OLD_TF, TF

# message types of ROS
SCAN, MULTI_ECHO = "sensor_msgs/msg/LaserScan", "sensor_msgs/msg/MultiEchoLaserScan"
ODOMETRY = "nav_msgs/msg/Odometry"
SCANS, TRANSFORMS = (SCAN, MULTI_ECHO), (TF, OLD_TF)
# what to do about other types of messages
POINTS = "the package pointcloud_to_laserscan converts it to scans"
CONVERSIONS = {
    "sensor_msgs/msg/PointCloud2": POINTS,
    "sensor_msgs/msg/PointCloud": POINTS,
    "velodyne_msgs/msg/VelodyneScan": "the packages velodyne and pointcloud_to_laserscan convert "
    "it to scans",
    "livox_ros_driver/msg/CustomMsg": POINTS,
    "livox_ros_driver2/msg/CustomMsg": POINTS,
    "sensor_msgs/msg/Image": "the package depthimage_to_laserscan converts depth images to scans",
    "sensor_msgs/msg/Range": "it has a single beam",
}


def choose(path, counts, topics):
    """Choose the topics of scans and odometry (or None); also return the (topic, type) set to read.

    counts : {(topic, type): number of messages}; topics : the user's choice. Raises SourceError.
    """
    wanted = {f"/{topic.strip('/')}" for topic in topics}
    names = {f"/{topic.strip('/')}": topic for topic, _ in counts}
    for topic in wanted:
        if topic not in names:
            raise SourceError(f"{path} has no topic {topic}; available: {_listed(counts)}")
    kinds = {f"/{topic.strip('/')}": kind for topic, kind in counts}
    odd = sorted(t for t in wanted if kinds[t] not in (*SCANS, ODOMETRY, *TRANSFORMS))
    if odd:
        what = f"topic {odd[0]} has the type {_short(kinds[odd[0]])}"
        raise SourceError(f"{path}: {what}, {_instead(kinds[odd[0]])}")
    scan = _choose_scan(path, counts, wanted)
    odometry = _choose_one(path, counts, (ODOMETRY,), wanted, _namespaces(scan))
    transforms = {key for key in counts if key[1] in TRANSFORMS}
    near = next(
        (
            mine
            for space in _namespaces(scan)
            if (mine := {k for k in transforms if k[0].strip("/") in _of_tf(space)})
        ),
        transforms,
    )
    named = {key for key in transforms if f"/{key[0].strip('/')}" in wanted}
    keys = {key for key in counts if key[0] in (scan, odometry) and key[1] in (*SCANS, ODOMETRY)}
    return scan, odometry, keys | (named or near)


def _choose_scan(path, counts, wanted):
    scan = _choose_one(path, counts, SCANS, wanted)
    if scan is not None:
        return scan
    empty = sorted(topic for topic, kind in counts if kind in SCANS)
    if empty:
        what = f"its topic {empty[0]} has no message. Check whether the lidar's driver runs, and "
        what += "whether the quality of service of the recorder matches"
        raise SourceError(f"{path} contains no scan: {what}")
    what = f"it has no {_short(SCAN)} message; its topics: {_listed(counts)}"
    for (topic, kind), count in counts.items():
        if kind in CONVERSIONS and count:
            what += f"; {topic} has the type {_short(kind)}, {_instead(kind)}"
            break
    else:
        what += "; record the topic of the lidar as well"
    raise SourceError(f"{path} contains no scan: {what}")


def _choose_one(path, counts, kinds, wanted, namespaces=()):
    """Choose a topic with messages of given types: by name, by namespace, or the only one."""
    found = {topic for topic, kind in counts if kind in kinds and counts[topic, kind]}
    named = {topic for topic in found if f"/{topic.strip('/')}" in wanted}
    chosen = named or found
    for space in namespaces:
        if len(chosen) > 1:
            mine = {each for each in chosen if each.strip("/").rpartition("/")[0] == space}
            chosen = mine if len(mine) == 1 else chosen
    if len(chosen) > 1:
        several = {key: count for key, count in counts.items() if key[0] in chosen}
        rest = sorted(wanted - {f"/{topic.strip('/')}" for topic in chosen})
        example = ",".join([*rest, f"/{min(chosen).strip('/')}"])
        what = f"{_short(kinds[0])} on several topics: {_listed(several)}"
        raise SourceError(f"{path} has {what}; choose one, as in {path}#{example}")
    return next(iter(chosen), None)


def _namespaces(topic):
    """Return the namespaces of a topic, innermost first: robot/front, robot, then the empty one."""
    parts = topic.strip("/").split("/")[:-1]
    return ["/".join(parts[:count]) for count in range(len(parts), -1, -1)]


def _of_tf(namespace):
    return {f"{namespace}/{name}".strip("/") for name in ("tf", "tf_static")}


def _instead(kind):
    return f"not {_short(SCAN)}" + (f": {CONVERSIONS[kind]}" if kind in CONVERSIONS else "")


def _short(kind):
    return kind.replace("/msg/", "/")


def _listed(counts):
    """List topics with their types and numbers of messages."""
    rows = sorted(f"{topic} ({_short(kind)}, {count})" for (topic, kind), count in counts.items())
    return ", ".join(rows) or "none"
