"""A line that stands for a lesson's folded code on a slide says what the code does."""

import json
import shutil
import subprocess

import pytest

from course.source import ROOT

STATIC = ROOT / "labextension/share/jupyter/labextensions/slamlab/static"
# the rule is the deck's own; cells come in by stdin
ASK = """
import { isFolded, tellingLine } from "./lecture/telling.js";
import { readFileSync } from "node:fs";
const cells = JSON.parse(readFileSync(0, "utf-8"));
console.log(JSON.stringify(cells.map((cell) => isFolded(cell) && !tellingLine(cell.source))));
"""


@pytest.fixture(scope="module")
def says_nothing(tmp_path_factory):
    """Of cells, which are folded to a line that says nothing."""
    if not shutil.which("node"):
        pytest.skip("Node.js, which runs the deck's rule, is missing")
    static = shutil.copytree(STATIC, tmp_path_factory.mktemp("deck") / "static")
    (static / "package.json").write_text('{"type": "module"}')
    command = ["node", "--input-type=module", "--eval", ASK]

    def asked(cells):
        told = json.dumps(cells)
        done = subprocess.run(command, cwd=static, input=told, capture_output=True, text=True)
        assert not done.returncode, done.stderr
        return json.loads(done.stdout)

    return asked


def without_output(lesson):
    """Sources and tags of a lesson's code that is on slides and shows nothing but itself."""
    for cell in json.loads(lesson.read_text("utf-8"))["cells"]:
        metadata = cell["metadata"]
        hidden = metadata.get("jupyter", {}).get("source_hidden", False)
        skipped = metadata.get("slideshow", {}).get("slide_type") in ("notes", "skip")
        if cell["cell_type"] == "code" and not (cell["outputs"] or hidden or skipped):
            yield {"source": "".join(cell["source"]), "tags": metadata.get("tags", [])}


def test_no_cell_of_any_lesson_is_folded_to_a_line_that_says_nothing(says_nothing):
    lessons = sorted((ROOT / "notebooks").glob("*.ipynb"))
    cells = [(path.stem, cell) for path in lessons for cell in without_output(path)]
    silent = says_nothing([cell for _, cell in cells])
    wrong = [
        f"{lesson}: begin this cell with a comment that says what it does:\n{cell['source']}"
        for (lesson, cell), nothing in zip(cells, silent, strict=True)
        if nothing
    ]
    assert len(cells) > len(lessons) and wrong == []


MADE = "made = {\n" + 7 * "    'name': 1,\n" + "}\nfor one in made:\n    made[one] += 1"


def test_a_table_and_a_loop_say_nothing_without_a_comment_before_them(says_nothing):
    cells = [MADE, f"# one more for each\n{MADE}", f"total = sum(made)\n{MADE}", "made = {\n}"]
    assert says_nothing([{"source": cell} for cell in cells]) == [True, False, False, False]


def test_the_name_alone_of_what_is_shown_says_nothing(says_nothing):
    cells = [f"{MADE}\nmade", f"total = sum(made)\n{MADE}\nmade"]
    assert says_nothing([{"source": cell} for cell in cells]) == [True, False]
