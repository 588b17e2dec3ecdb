"""A class of four whose results are reviewed: late, flagged, unreadable, absent."""

import asyncio
import contextlib
import json

from classroom.exercises.verdict import Verdict
from classroom.grading.ledger import contents
from classroom.grading.records import Record
from classroom.reviewing import review_routes
from tests.slamlab.web_server.client import Client, run
from tests.timeouts import PATIENCE

COURSE = """
time_zone = "Europe/Zagreb"
[late]
per_day = 0.25
[exercises.99]
due = 2026-12-01T12:00:00
"""
ROSTER = """id,name,email,section
s1,Ana <b>Kos</b>,ana@uni.hr,Mon
s2,Ben Ivo,ben@uni.hr,Tue
s3,Ćiro Šarić,,Tue
s4,Dea Car,,
"""
LATER = "2026-12-01T11:00:01+00:00"
HOSTILE = "<script>alert(1)</script>\u202ereversed\u202c"


def attempt(student, points, cells=(), **more):
    verdicts = (
        Verdict("99-double", points, 3.5, hint="you squared" if points < 3.5 else None),
        Verdict("99-turn", 2.0, 2.5),
        Verdict("99-total", 0.0, 2.0, problem="not attempted yet"),
    )
    data = contents.packed(json.dumps(list(cells)).encode())
    kept = {"cells": contents.name_of(data)} if cells else {}
    return Record(f"{student}.ipynb", student, "99", verdicts=verdicts, sha256=student * 8,
                  seed="b" * 64, kept=kept, contents={kept["cells"]: data} if cells else {},
                  titles={v.task: v.task for v in verdicts}, **more)  # fmt: skip


@contextlib.asynccontextmanager
async def served(state):
    """A class that is served, a client without a cookie, and the token."""
    address, over = asyncio.get_running_loop().create_future(), asyncio.Event()
    task = asyncio.create_task(review_routes.serve(state, 0, address.set_result, over))
    host, token = (await asyncio.wait_for(address, PATIENCE)).split("/#")
    try:
        yield Client(int(host.rpartition(":")[2])), token
    finally:
        over.set()
        await task


def asked(state, *requests):
    """Responses (status, JSON) to requests (path, content) of a client with the token."""

    async def each():
        async with served(state) as (client, token):
            assert await client.log_in(token) == 200
            for path, message in requests:
                status, _, body = await client.ask("POST" if message else "GET", path, message)
                yield_to.append((status, json.loads(body)))

    yield_to = []
    run(each())
    return yield_to


def change(state, message, row=0, seen=None):
    """The answer to a change of a student's submission as it stands, or as it was ``seen``."""
    if seen is None:
        ((_, reported),) = asked(state, (f"/submission/{row}/99", None))
        seen = reported.get("seen", 0)
    (answer,) = asked(state, (f"/submission/{row}/99", {"seen": seen} | message))
    return answer


def points(value=2, reason="right idea", task="99-double"):
    return {"task": task, "points": value, "text": reason}


def kinds(state):
    return [row["kind"] for row in state.book.rows()]


def result(state, row=0):
    state.refresh()
    return state.exercise_results["99"][row]
