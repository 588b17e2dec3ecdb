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
const caption = (cell) => isFolded(cell) ? summaryLine(cell.source) ?? "" : null;
console.log(JSON.stringify(cells.map(caption)));
"""


@pytest.fixture(scope="module")
def captions(tmp_path_factory):
    """Return the captions of cells: None if a cell is not folded, empty if nothing describes it."""
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


def test_no_cell_of_any_lesson_is_folded_to_an_empty_caption(captions):
    lessons = sorted((ROOT / "notebooks").glob("*.ipynb"))
    cells = [(path.stem, cell) for path in lessons for cell in without_output(path)]
    found = captions([cell for _, cell in cells])
    wrong = [
        f"{lesson}: begin this cell with a comment that says what it does:\n{cell['source']}"
        for (lesson, cell), caption in zip(cells, found, strict=True)
        if caption == ""
    ]
    assert len(cells) > len(lessons) and wrong == []


MADE = "made = {\n" + 7 * "    'name': 1,\n" + "}\nfor one in made:\n    made[one] += 1"


def test_a_comment_at_the_beginning_goes_before_a_statement_and_a_loop_is_no_caption(captions):
    expected = {
        MADE: "",
        f"{MADE}\nmade": "",
        f"# one more for each\n{MADE}": "# one more for each",
        f"total = sum(made)\n{MADE}\nassert made\nprint(total)\nmade": "total = sum(made)",
        f"# all of them\ntotal = sum(made)\n{MADE}": "# all of them",
        "made = {\n}": None,
    }
    assert captions([{"source": cell} for cell in expected]) == list(expected.values())
