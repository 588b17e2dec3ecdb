"""Zip files of submissions are unpacked with limits, and refused members are reported."""

import io
import stat
import zipfile
from pathlib import Path

import pytest

from classroom.grading import submissions
from classroom.grading.notebooks import SubmissionError
from classroom.grading.submissions import MAX_NOTEBOOK_BYTES
from classroom.grading.term import archives
from classroom.grading.term.zipped_submissions import collect_submissions

PDF = submissions.problem_of([Path("x.pdf")])


def zipped(path, members, method=zipfile.ZIP_DEFLATED):
    with zipfile.ZipFile(path, "w", method) as archive:
        for name, data in members:
            archive.writestr(name, data)
    return path


def in_memory(members):
    stream = io.BytesIO()
    zipped(stream, members)
    return stream.getvalue()


def link(name, to="/etc/passwd"):
    member = zipfile.ZipInfo(name)
    member.external_attr = (stat.S_IFLNK | 0o777) << 16
    return member, to


def test_a_zipped_download_is_read_with_its_students_zips(tmp_path):
    inner = in_memory([("mine/hw.ipynb", "{}"), ("__MACOSX/mine/._hw.ipynb", "x"), ("a.txt", "")])
    file = zipped(
        tmp_path / "04.zip",
        [
            ("Ana Kos_12_assignsubmission_file/hw.ipynb", "{}"),
            ("Ben Ivo_13_assignsubmission_file/work.zip", inner),
            ("kosana_1021_55031_work.zip", inner),
            ("Eva_14_assignsubmission_file/x.pdf", "%PDF"),
        ],
    )
    found = collect_submissions(file, tmp_path / "scratch")
    assert {s.name: (s.student, s.number, s.problem) for s in found} == {
        "Ana Kos_12_assignsubmission_file/hw.ipynb": ("Ana Kos", "12", None),
        "Ben Ivo_13_assignsubmission_file/work.zip/mine/hw.ipynb": ("Ben Ivo", "13", None),
        "kosana_1021_55031_work.zip/mine/hw.ipynb": ("kosana", "1021", None),
        "Eva_14_assignsubmission_file/x.pdf": (
            "Eva",
            "14",
            submissions.problem_of([Path("x.pdf")]),
        ),
    }
    assert all(s.handed_in is None for s in found if s.problem is None)


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_all_files_of_the_same_name_are_kept(tmp_path):
    contents = [str(k) for k in range(100)]
    file = zipped(tmp_path / "x.zip", [("hw.ipynb", text) for text in contents])
    found = collect_submissions(file, tmp_path / "out")
    assert sorted((s.path.read_text() for s in found if not s.problem), key=int) == contents
    assert {"hw.ipynb", "hw (2).ipynb"} <= {s.path.name for s in found}


def test_a_forged_path_in_a_students_zip_does_not_change_the_student(tmp_path):
    members = [("Ana Kos_12_assignsubmission_file/Ben Ivo_13_assignsubmission_file/x.ipynb", "{}")]
    inside = in_memory([("Ben Ivo_13_assignsubmission_file/x.ipynb", "{}")])
    members += [("Ana Kos_12_assignsubmission_file/w.zip", inside), ("anna.zip", inside)]
    found = collect_submissions(zipped(tmp_path / "x.zip", members), tmp_path / "scratch")
    assert [s.student for s in found] == ["Ana Kos", "Ana Kos", "anna"]


def test_a_students_zip_in_a_folder_keeps_its_time(tmp_path):
    (tmp_path / "class" / "anna").mkdir(parents=True)
    zipped(tmp_path / "class" / "anna" / "work.zip", [("hw.ipynb", "{}")])
    (found,) = collect_submissions(tmp_path / "class", tmp_path / "scratch")
    assert (found.name, found.student) == ("anna/work.zip/hw.ipynb", "anna")
    assert found.handed_in.endswith("+00:00")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("/etc/cron.d/x.ipynb", "absolute"),
        ("C:\\x.ipynb", "absolute"),
        ("\\\\host\\x.ipynb", "absolute"),
        ("../x.ipynb", "leads out"),
        ("a/../../x.ipynb", "leads out"),
        ("a\\..\\..\\x.ipynb", "leads out"),
        ("/".join("a" * 12) + "/x.ipynb", "nested in more than"),
        ("x" * 300 + ".ipynb", "too long"),
    ],
)
def test_a_path_out_of_the_zip_is_refused_and_the_rest_is_unpacked(tmp_path, name, message):
    file = zipped(tmp_path / "work.zip", [("good.ipynb", "{}"), (name, "evil")])
    found = collect_submissions(file, tmp_path / "in" / "scratch")
    good, bad = sorted(found, key=lambda s: s.problem or "")
    assert (good.name, good.problem) == ("good.ipynb", None)
    assert bad.problem.startswith("the file was refused: ") and message in bad.problem
    kept = [p for p in tmp_path.rglob("*") if p.is_file()]
    assert sorted(p.name for p in kept) == ["good.ipynb", "work.zip"]


def problems(file, scratch):
    """What is wrong with each submission of a zip."""
    return {s.name: s.problem for s in collect_submissions(file, scratch)}


def test_a_symbolic_link_and_a_notebook_that_is_too_large_are_refused(tmp_path):
    large = ("c.ipynb", b"\0" * (MAX_NOTEBOOK_BYTES + 1))
    members = [link("a.ipynb"), link("b"), ("b/c.ipynb", "{}"), large]
    refused = "the file was refused: "
    assert problems(zipped(tmp_path / "w.zip", members), tmp_path / "scratch") == {
        "a.ipynb": f"{refused}it is a symbolic link, not a file",
        "b": f"{refused}it is a symbolic link, not a file",
        "b/c.ipynb": None,
        "c.ipynb": f"{refused}{submissions.too_large(MAX_NOTEBOOK_BYTES + 1)}",
    }


def test_a_file_that_is_too_large_is_one_attempt(tmp_path):
    large = b"\0" * (MAX_NOTEBOOK_BYTES + 1)
    file = zipped(tmp_path / "w.zip", [("Ana Kos_12_assignsubmission_file/hw.ipynb", large)])
    (found,) = collect_submissions(file, tmp_path / "scratch")
    assert (found.student, found.number) == ("Ana Kos", "12")


def test_a_zip_bomb_of_a_student_is_refused(tmp_path, monkeypatch):
    large = b"\0" * (MAX_NOTEBOOK_BYTES + 1)
    bomb = in_memory([("x.ipynb", large), ("y.ipynb", "{}")])
    many = in_memory([(f"{i}.ipynb", "") for i in range(archives.MAX_STUDENT_MEMBERS + 1)])
    monkeypatch.setattr(archives, "OF_A_STUDENT", archives.Limits(600, 1 << 20))
    total = in_memory([(f"{i}.ipynb", b"\0" * (1 << 19)) for i in range(4)])
    file = zipped(
        tmp_path / "04.zip",
        [
            ("anna/hw.ipynb", "{}"),
            ("bomb/work.zip", bomb),
            ("many/work.zip", many),
            ("total/work.zip", total),
            ("nest/work.zip", in_memory([("in.zip", bomb)])),
        ],
    )
    found = problems(file, tmp_path / "scratch")
    assert found["anna/hw.ipynb"] is None
    assert "more than 1 MB when unpacked" in found["bomb/work.zip"]
    assert "more than 1 MB when unpacked" in found["total/work.zip"]
    assert "a zip within a zip: submit the notebook itself" in found["nest/work.zip"]
    assert sum(name.startswith("many/") for name in found) == archives.MAX_STUDENT_MEMBERS + 1


@pytest.mark.parametrize("cut", [0, 60, -30])
def test_a_damaged_zip_is_reported_in_a_line(tmp_path, cut):
    data = in_memory([("a.ipynb", "x" * 100)])
    (tmp_path / "04.zip").write_bytes(data[:cut])
    with pytest.raises(SubmissionError, match=r"04\.zip: the file is not a complete zip"):
        collect_submissions(tmp_path / "04.zip", tmp_path / "scratch")
    (tmp_path / "class" / "anna").mkdir(parents=True)
    (tmp_path / "04.zip").rename(tmp_path / "class" / "anna" / "w.zip")
    (found,) = collect_submissions(tmp_path / "class", tmp_path / "scratch")
    assert found.problem.startswith("the file is not a complete zip")


def damaged(tmp_path, damage, first):
    """What is wrong with two members of a zip whose bytes were changed."""
    data = bytearray(in_memory([("a.ipynb", first), ("b.ipynb", "{}")]))
    damage(data)
    (tmp_path / "w.zip").write_bytes(data)
    found = problems(tmp_path / "w.zip", tmp_path / "scratch")
    return found.get("a.ipynb"), found.get("b.ipynb")


def checksum(data):
    data[38] ^= 0xFF


def encrypted(data):
    data[6] |= 1
    data[data.index(b"PK\x01\x02") + 8] |= 1


def overlapping(data):
    second = data.rindex(b"PK\x01\x02")
    data[second + 42 : second + 46] = bytes(4)  # the second begins where the first does


@pytest.mark.parametrize(
    ("damage", "refused", "message"),
    [(checksum, 0, "damaged"), (encrypted, 0, "encrypted"), (overlapping, 1, "damaged")],
)
def test_only_a_damaged_member_is_refused(tmp_path, damage, refused, message):
    found = damaged(tmp_path, damage, "x" * 100)
    assert found[refused].startswith("the file was refused: damaged") and message in found[refused]
    assert found[1 - refused] is None or damage is overlapping


def test_a_wrong_size_is_refused(tmp_path):
    def shorter(data):
        position = data.index(b"PK\x01\x02") + 24
        data[position : position + 4] = (4).to_bytes(4, "little")

    problem, _ = damaged(tmp_path, shorter, b"x" * 10_000)
    (kept,) = (tmp_path / "scratch").rglob("a.ipynb") if problem is None else (None,)
    assert kept.stat().st_size <= 4 if kept else "damaged" in problem


@pytest.mark.parametrize(
    "name",
    ["a\0/../../x.ipynb", "line\nbreak.ipynb", "\u202egnp.ipynb", "./x.ipynb", " .ipynb",
     "-rf.ipynb", "~/x.ipynb", "con.ipynb", "%2e%2e/x.ipynb", "x" * 240 + ".ipynb"],
)  # fmt: skip
def test_a_name_of_any_kind_stays_within_and_is_graded(tmp_path, name):
    file = zipped(tmp_path / "w.zip", [("anna.ipynb", "{}"), (name, "{}")])
    found = collect_submissions(file, tmp_path / "in" / "scratch")
    assert [s.problem for s in found] == [None] * len(found)
    kept = [p for p in tmp_path.rglob("*") if p.is_file() and p != file]
    assert all(p.is_relative_to(tmp_path / "in" / "scratch") for p in kept)
    assert "anna.ipynb" in {s.name for s in found} and len(found) == (1 if "\0" in name else 2)


@pytest.mark.parametrize(
    ("one", "other"),
    [("A.ipynb", "a.ipynb"), ("e\u0301.ipynb", "\u00e9.ipynb"), ("a/x.ipynb", "a")],
)
def test_names_that_differ_only_in_case_are_both_unpacked_or_reported(tmp_path, one, other):
    file = zipped(tmp_path / "w.zip", [(one, "{}"), (other, "{}")])
    found = collect_submissions(file, tmp_path / "scratch")
    assert one in {s.name for s in found if s.problem is None}
    kept = {p.name for p in (tmp_path / "scratch").rglob("*") if p.is_file()}
    assert len(kept) == 2 or any(s.problem for s in found)
