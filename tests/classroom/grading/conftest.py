"""Fixtures: notebooks of the fake exercise, a catalogue that contains it, terms, databases."""

import csv
import functools
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import sqlalchemy as sa

from classroom.exercises import catalogue
from classroom.grading import database, isolation, sandbox
from classroom.grading.gradebook import Gradebook
from classroom.grading.worker_pool import WorkerPool
from tests.classroom.grading import fake

HTML = "<script>alert(1)</script><img src=x onerror=y>"
posix = pytest.mark.skipif(os.name != "posix", reason="folders and rights of POSIX")


@functools.cache
def workers():
    """Return workers at the highest isolation level of this machine, shared within a process."""
    return WorkerPool(
        next(level for level in reversed(sandbox.LEVELS) if not lacks(level)), warm=False
    )


@functools.cache
def lacks(level):
    """Return what this machine lacks for an isolation level, or None."""
    return None if level == sandbox.NONE else isolation.missing_requirement(level)


@pytest.fixture(autouse=True, scope="session")
def _no_zygote_stays():
    yield
    workers().close()


@pytest.fixture(autouse=True)
def _fake_exercise_is_known(monkeypatch):
    know_the_fake(monkeypatch)


def know_the_fake(monkeypatch):
    """Put the fake exercise into the catalogue."""
    known = {id: catalogue.EXERCISES for id in catalogue.EXERCISES}
    monkeypatch.setattr(catalogue, "EXERCISES", _Known(known))


class _Known(dict):
    """The true catalogue, imported as late as ever, and the fake."""

    def __init__(self, true):
        super().__init__(true | {"99": None})

    def __getitem__(self, id):
        true = super().__getitem__(id)
        return fake.EXERCISE if id == "99" else true[id]


def table(path):
    """The rows of a CSV file, by its titles."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def slamlab(*words, **more):
    """A running command."""
    start = "import sys; from slamlab.cli import main; sys.exit(main())"
    return subprocess.Popen([sys.executable, "-c", start, *words], **more)


def notebook(*cells, exercise="99", **more):
    """A notebook of code cells as the text of its file."""
    metadata = {"slamlab": {"exercise": exercise}} if exercise else {}
    plain = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    made = [plain | {"source": cell} for cell in cells]
    content = {"cells": made, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(content | more)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The folder of a term, from which commands are given."""
    from tests.classroom.grading import term_folder  # which needs this module

    monkeypatch.chdir(tmp_path)
    term_folder.begin(tmp_path)
    return tmp_path


def programs_of_postgres():
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"))
    at = shutil.which("initdb") or (found[-1] if found else None)
    return Path(at).parent if at else None


@pytest.fixture(scope="session")
def server(tmp_path_factory):
    """A server of PostgreSQL that runs for these tests: its URL, and what starts and stops it."""
    programs = programs_of_postgres()
    if programs is None:
        pytest.skip("no PostgreSQL server here (initdb not found)")
    folder = tmp_path_factory.mktemp("postgres")
    # it refuses to run as root
    user = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
    if user:
        folder = Path("/tmp") / f"slamlab-postgres-{os.getpid()}"
        folder.mkdir(mode=0o700)
        os.chown(folder, 65534, 65534)
    run = {"check": True, "capture_output": True, "cwd": "/", **user}
    try:
        subprocess.run(
            [programs / "initdb", "-D", folder / "data", "-U", "me", "-A", "trust"], **run
        )
        options = f"-k {folder} -c listen_addresses= -c fsync=off"
        control = [programs / "pg_ctl", "-D", folder / "data", "-w", "-l", folder / "log"]
        words = {"start": ["-o", options, "start"], "stop": ["-m", "immediate", "stop"]}

        def does(word):
            subprocess.run([*control, *words[word]], **run)

        does("start")
    except (OSError, subprocess.CalledProcessError) as error:
        pytest.skip(f"PostgreSQL does not start here: {getattr(error, 'stderr', error)}")
    yield f"postgresql+psycopg://me@/postgres?host={folder}", does
    does("stop")
    shutil.rmtree(folder, ignore_errors=True)


@pytest.fixture(scope="session")
def postgres(server):
    return server[0]


def forget(url):
    """Drop the gradebook's tables."""
    engine = sa.create_engine(url)
    database.TABLES.drop_all(engine)
    engine.dispose()


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request, tmp_path):
    """The address of an empty gradebook, with each database."""
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path / 'grades.db'}"
    forget(request.getfixturevalue("postgres"))
    return request.getfixturevalue("postgres")


@pytest.fixture
def book(url):
    with Gradebook(url) as opened:
        yield opened
