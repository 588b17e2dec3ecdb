"""The caption of a lesson's folded code on a slide describes the code."""

import json
import shutil
import subprocess

import pytest

from course.source import ROOT

STATIC = ROOT / "labextension/share/jupyter/labextensions/slamlab/static"
# the rule is the deck's own; cells come in by stdin
ASK = """
import { isFolded, summaryLine } from "./lecture/code_summary.js";
import { readFileSync } from "node:fs";
const cells = JSON.parse(readFileSync(0, "utf-8"));
console.log(JSON.stringify(cells.map((cell) => isFolded(cell) && !summaryLine(cell.source))));
"""


@pytest.fixture(scope="module")
def is_empty_caption(tmp_path_factory):
    """Return the cells that are folded to an empty caption."""
    if not shutil.which("node"):
        pytest.skip("Node.js, which runs the deck's rule, is missing")
    static = shutil.copytree(STATIC, tmp_path_factory.mktemp("deck") / "static")
    (static / "package.json").write_text('{"type": "module"}')
    command = ["node", "--input-type=module", "--eval", ASK]

    def asked(cells):
        answer = json.dumps(cells)
        done = subprocess.run(command, cwd=static, input=answer, capture_output=True, text=True)
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


def test_no_cell_of_any_lesson_is_folded_to_an_empty_caption(is_empty_caption):
    lessons = sorted((ROOT / "notebooks").glob("*.ipynb"))
    cells = [(path.stem, cell) for path in lessons for cell in without_output(path)]
    silent = is_empty_caption([cell for _, cell in cells])
    wrong = [
        f"{lesson}: begin this cell with a comment that says what it does:\n{cell['source']}"
        for (lesson, cell), nothing in zip(cells, silent, strict=True)
        if nothing
    ]
    assert len(cells) > len(lessons) and wrong == []


MADE = "made = {\n" + 7 * "    'name': 1,\n" + "}\nfor one in made:\n    made[one] += 1"


def test_a_table_a_loop_and_the_bare_name_of_an_output_are_no_caption(is_empty_caption):
    silent = [MADE, f"{MADE}\nmade"]
    telling = [f"# one more for each\n{MADE}", f"total = sum(made)\n{MADE}\nmade", "made = {\n}"]
    assert is_empty_caption([{"source": cell} for cell in silent]) == [True] * 2
    assert is_empty_caption([{"source": cell} for cell in telling]) == [False] * 3
