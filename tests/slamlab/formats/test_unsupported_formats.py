"""A file that is no log is refused with what it looks like, its first line, and what to do."""

import gzip
import io
import pickle
import struct
import tarfile
import zipfile

import numpy as np
import pytest
from PIL import Image

from slamlab import sources
from slamlab.sources import SourceError


def archive(kind):
    buffer = io.BytesIO()
    if kind == "zip":
        with zipfile.ZipFile(buffer, "w") as packed:
            packed.writestr("drive.log", "FLASER 1 1.0")
    else:
        member, content = tarfile.TarInfo("drive.log"), b"FLASER 1 1.0 0 0 0 0 0 0 1 host 1\n"
        member.size = len(content)
        with tarfile.open(fileobj=buffer, mode=kind) as packed:
            packed.addfile(member, io.BytesIO(content))
    return buffer.getvalue()


def image(kind):
    buffer = io.BytesIO()
    Image.new("L", (8, 8)).save(buffer, kind)
    return buffer.getvalue()


def array():
    buffer = io.BytesIO()
    np.save(buffer, np.zeros(4))
    return buffer.getvalue()


UNKNOWN = {
    "zip": (archive("zip"), "a zip archive: unpack it"),
    "tar": (archive("w"), "a tar archive: unpack it"),
    "zstd": (b"\x28\xb5\x2f\xfd1234", "Zstandard: unpack it with unzstd"),
    "PNG": (image("PNG"), r"an image \(PNG\): it contains no sensor data"),
    "JPEG": (image("JPEG"), r"an image \(JPEG\)"),
    "PGM": (b"P5\n# map\n2 2\n255\n1234", r"an image \(PNM\)"),
    "BMP": (image("BMP"), r"an image \(BMP\)"),
    "PDF": (b"%PDF-1.7\n", "a PDF document"),
    "program": (b"\x7fELF\2\1\1\0", "a program"),
    "PCAP": (struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 1), r"capture \(PCAP\)"),
    "PCAPNG": (b"\n\r\r\n\x1c\0\0\0", r"capture \(PCAPNG\)"),
    "NumPy": (array(), "a NumPy array: convert it"),
    "pickle": (pickle.dumps({"a": 1}, 4), "a Python pickle"),
    "HDF5": (b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
    "rawlog": (b"\x80\0\0\0CActionRobotMovement2D\0", "a rawlog of MRPT"),
    "binary": (bytes(range(256)) * 5, "has an unknown binary format"),
    "g2o": ("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n", r"pose graph .*g2o.load"),
    "TORO": ("VERTEX2 0 0 0 0\nEDGE2 0 1 1 0 0 1 0 1 1 0 0\n", "pose graph"),
    "GTSAM": ("ODOMETRY 0 1 1 0 0 1 0 0 1 0 1\n", "graph of GTSAM's examples"),
    "TUM": ("# t x y z qx qy qz qw\n" + "1.5 0 0 0 0 0 0 1\n" * 5, r"trajectory \(TUM\)"),
    "KITTI": ("1 0 0 0 0 1 0 0 0 0 1 0\n" * 5, r"trajectory \(KITTI\)"),
    "EuRoC": ("#timestamp [ns],p_RS_R_x [m]\n1403636580838555648,4.6\n", "a table of EuRoC"),
    "rostopic": ("header: \n  seq: 1\nranges: [1.0, 2.0]\n---\n", "messages printed by rostopic"),
    "rostopic CSV": ("%time,field.header.seq,field.angle_min\n1,2,3\n", "topic written as CSV"),
    "bag's metadata": (
        "rosbag2_bagfile_information:\n  version: 5\n",
        "open the folder of the bag",
    ),
    "map": (
        "image: map.pgm\nresolution: 0.05\n",
        "the YAML file of a map .*: load it with slamlab.gridmap",
    ),
    "PCD": ("# .PCD v0.7 - Point Cloud Data\nVERSION 0.7\n", r"point cloud \(PCD\)"),
    "PLY": ("ply\nformat ascii 1.0\n", r"point cloud \(PLY\)"),
    "Git LFS": ("version https://git-lfs.github.com/spec/v1\noid sha256:1\n", "git lfs pull"),
    "web page": ("<!DOCTYPE html>\n<html><body>Sign in</body></html>\n", "the download failed"),
    "XML": ("<?xml version='1.0'?>\n<robot/>\n", "an XML file"),
    "JSON": ('{\n  "ranges": [1, 2]\n}\n', "JSON"),
    "Beesoft": ("@SENS 12-02-99 10:00:00.1\n#ROBOT 1 2 3\n", "a log of Beesoft"),
    "Player": ("## Player version 2.0\n", "a log of Player"),
    "NMEA": ("$GPGGA,123519,4807.038,N\n", "a GPS receiver"),
    "Python": ("import numpy\nprint(1)\n", "source code of a program"),
    "numbers": ("1.5 2.5 3.5\n" * 30, "a table of numbers without column names"),
    "scan a row": ("1.5," + "2.5," * 360 + "3\n", "a table with a scan in each row"),
    "prose": ("The robot drove through the hall.\n" * 9, "text of an unknown format"),
}


@pytest.mark.parametrize("packed", [bytes, gzip.compress])
@pytest.mark.parametrize("kind", UNKNOWN)
def test_an_unsupported_file_is_described_with_what_to_do(tmp_path, kind, packed):
    content, reported = UNKNOWN[kind]
    text = isinstance(content, str)
    path = tmp_path / "what"
    path.write_bytes(packed(content.encode() if text else content))
    with pytest.raises(SourceError, match=reported) as refused:
        sources.open(path)
    message = str(refused.value)
    assert message.startswith(f"{path} has no format that slamlab can read") and "\n" not in message
    if text:
        assert f"line 1 is {content.splitlines()[0].strip()[:20]!r}"[:-1] in message


@pytest.mark.parametrize("content", [b"", b"\n\n", b"\xef\xbb\xbf", gzip.compress(b"", mtime=0)])
def test_an_empty_file_is_reported_as_empty(tmp_path, content):
    path = tmp_path / "empty"
    path.write_bytes(content)
    with pytest.raises(SourceError, match="is empty and contains no readings"):
        sources.open(path)


def test_a_line_is_quoted_no_longer_than_needed(tmp_path):
    path = tmp_path / "long"
    path.write_text("word " * 9000)
    with pytest.raises(SourceError) as refused:
        sources.open(path)
    assert len(str(refused.value)) < 600
