"""The container image, which cannot be built here: what its file promises."""

import re
import shutil
import subprocess

import pytest

from tests.course.setup import ROOT

TEXT = (ROOT / "Dockerfile").read_text("utf-8")
LAST = TEXT.rpartition("\nFROM ")[2]


def names(lock):
    text = (ROOT / lock).read_text("utf-8")
    return dict(re.findall(r"^([\w.-]+)==(\S+)", text, re.M))


def test_the_last_stage_has_only_the_installation_and_runs_as_a_user_without_rights():
    assert re.findall(r"^COPY (.+)$", LAST, re.M) == [
        "--from=build /opt/slam-course /opt/slam-course"
    ]
    assert re.findall(r"^USER (.+)$", LAST, re.M) == ["1000"]
    assert "chown" not in LAST and "ADD " not in TEXT
    assert re.search(r'^CMD \["python", "-m", "classroom.hub.student_server"\]$', LAST, re.M)


def test_every_image_has_a_version_and_the_build_is_a_target_of_make():
    images = re.findall(r"^FROM (\S+)", TEXT, re.M)
    assert images and all(re.search(r":\d", image) for image in images)
    (target,) = re.findall(r"^RUN make (\S+)", TEXT, re.M)
    assert re.search(rf"^{target}:", (ROOT / "Makefile").read_text("utf-8"), re.M)


def test_the_hub_has_the_students_packages_in_the_same_versions():
    assert names("requirements.lock").items() <= names("requirements-hub.lock").items()
    assert {"jupyterhub", "jupyter-server-proxy"} <= names("requirements-hub.lock").keys()


@pytest.mark.skipif(not shutil.which("hadolint"), reason="hadolint is not installed")
def test_hadolint_finds_nothing():
    assert subprocess.run(["hadolint", ROOT / "Dockerfile"]).returncode == 0
