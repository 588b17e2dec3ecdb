"""Zips: what is in them is found; what would harm is refused in a line, and nothing is lost."""

import io
import stat
import zipfile

import pytest

from slamlab.grading.notebooks import SubmissionError
from slamlab.grading.submissions import MAX_NOTEBOOK_BYTES
from slamlab.grading.term import archives
from slamlab.grading.term.hand_ins import find_hand_ins


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


def test_a_download_is_read_from_its_zip_with_students_zips_opened(tmp_path):
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
    found = find_hand_ins(file, tmp_path / "scratch")
    assert {s.name: (s.student, s.number, s.problem) for s in found} == {
        "Ana Kos_12_assignsubmission_file/hw.ipynb": ("Ana Kos", "12", None),
        "Ben Ivo_13_assignsubmission_file/work.zip/mine/hw.ipynb": ("Ben Ivo", "13", None),
        "kosana_1021_55031_work.zip/mine/hw.ipynb": ("kosana", "1021", None),
        "Eva_14_assignsubmission_file": ("Eva", "14", "a folder without a notebook in it"),
    }
    assert all(s.handed_in is None for s in found if s.problem is None)


def test_a_place_that_a_student_made_up_in_his_own_makes_nobody_else(tmp_path):
    members = [("Ana Kos_12_assignsubmission_file/Ben Ivo_13_assignsubmission_file/x.ipynb", "{}")]
    inside = in_memory([("Ben Ivo_13_assignsubmission_file/x.ipynb", "{}")])
    members += [("Ana Kos_12_assignsubmission_file/w.zip", inside), ("anna.zip", inside)]
    found = find_hand_ins(zipped(tmp_path / "x.zip", members), tmp_path / "scratch")
    assert [s.student for s in found] == ["Ana Kos", "Ana Kos", "anna"]


def test_a_students_zip_in_a_folder_keeps_its_time(tmp_path):
    (tmp_path / "class" / "anna").mkdir(parents=True)
    zipped(tmp_path / "class" / "anna" / "work.zip", [("hw.ipynb", "{}")])
    (found,) = find_hand_ins(tmp_path / "class", tmp_path / "scratch")
    assert (found.name, found.student) == ("anna/work.zip/hw.ipynb", "anna")
    assert found.handed_in.endswith("+00:00")


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("/etc/cron.d/x.ipynb", "absolute"),
        ("C:\\x.ipynb", "absolute"),
        ("\\\\host\\x.ipynb", "absolute"),
        ("../x.ipynb", "leads out"),
        ("a/../../x.ipynb", "leads out"),
        ("a\\..\\..\\x.ipynb", "leads out"),
        ("/".join("a" * 12) + "/x.ipynb", "folders in folders"),
        ("x" * 300 + ".ipynb", "too long"),
    ],
)
def test_a_path_that_leads_elsewhere_is_refused_and_the_rest_is_kept(tmp_path, name, said):
    file = zipped(tmp_path / "work.zip", [("good.ipynb", "{}"), (name, "evil")])
    found = find_hand_ins(file, tmp_path / "in" / "scratch")
    good, bad = sorted(found, key=lambda s: s.problem or "")
    assert (good.name, good.problem) == ("good.ipynb", None)
    assert bad.problem.startswith("refused: ") and said in bad.problem
    kept = [p for p in tmp_path.rglob("*") if p.is_file()]
    assert sorted(p.name for p in kept) == ["good.ipynb", "work.zip"]


def test_a_link_is_refused(tmp_path):
    file = zipped(tmp_path / "w.zip", [link("a.ipynb"), link("b"), ("b/c.ipynb", "{}")])
    found = {s.name: s.problem for s in find_hand_ins(file, tmp_path / "scratch")}
    assert found == {
        "a.ipynb": "refused: a link, not a file",
        "b": "refused: a link, not a file",
        "b/c.ipynb": None,
    }


def test_a_bomb_is_refused_whoever_handed_it_in(tmp_path, monkeypatch):
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
    found = {s.name: s.problem for s in find_hand_ins(file, tmp_path / "scratch")}
    assert found["anna/hw.ipynb"] is None
    assert "more than 1 MB unpacked" in found["bomb/work.zip"]
    assert "more than 1 MB unpacked" in found["total/work.zip"]
    assert "zips in zips are not opened" in found["nest/work.zip"]
    assert sum(name.startswith("many/") for name in found) == archives.MAX_STUDENT_MEMBERS + 1


def test_a_notebook_too_large_in_a_zip_is_refused_alone(tmp_path):
    large = b"\0" * (MAX_NOTEBOOK_BYTES + 1)
    file = zipped(tmp_path / "04.zip", [("a.ipynb", large), ("b.ipynb", "{}")])
    found = {s.name: s.problem for s in find_hand_ins(file, tmp_path / "scratch")}
    assert found == {"a.ipynb": "refused: more than 20 MB unpacked", "b.ipynb": None}


def test_two_members_of_one_name_both_stay(tmp_path):
    with pytest.warns(UserWarning, match="Duplicate name"):
        file = zipped(tmp_path / "04.zip", [("a.ipynb", "1"), ("a.ipynb", "2")])
    found = find_hand_ins(file, tmp_path / "scratch")
    assert sorted(s.path.read_text() for s in found) == ["1", "2"]


@pytest.mark.parametrize("cut", [0, 10, 60, -30])
def test_a_damaged_zip_is_told_in_a_line(tmp_path, cut):
    data = in_memory([("a.ipynb", "x" * 100)])
    (tmp_path / "04.zip").write_bytes(data[:cut])
    with pytest.raises(SubmissionError, match=r"04\.zip: not a zip, or a part of one"):
        find_hand_ins(tmp_path / "04.zip", tmp_path / "scratch")
    (tmp_path / "class" / "anna").mkdir(parents=True)
    (tmp_path / "04.zip").rename(tmp_path / "class" / "anna" / "w.zip")
    (found,) = find_hand_ins(tmp_path / "class", tmp_path / "scratch")
    assert found.problem.startswith("not a zip")


def test_a_member_with_a_wrong_sum_is_refused_alone(tmp_path):
    data = bytearray(in_memory([("a.ipynb", "x" * 100), ("b.ipynb", "{}")]))
    data[38] ^= 0xFF
    (tmp_path / "04.zip").write_bytes(data)
    found = {s.name: s.problem for s in find_hand_ins(tmp_path / "04.zip", tmp_path / "scratch")}
    assert found["b.ipynb"] is None
    assert "damaged" in found["a.ipynb"]


def test_an_encrypted_member_is_refused(tmp_path):
    data = bytearray(in_memory([("a.ipynb", "{}")]))
    data[6] |= 1
    data[data.index(b"PK\x01\x02") + 8] |= 1
    (tmp_path / "04.zip").write_bytes(data)
    (found,) = find_hand_ins(tmp_path / "04.zip", tmp_path / "scratch")
    assert "refused: damaged" in found.problem and "encrypted" in found.problem


@pytest.mark.parametrize(
    "name",
    ["a\0/../../x.ipynb", "line\nbreak.ipynb", "\u202egnp.ipynb", "./x.ipynb", " .ipynb",
     "-rf.ipynb", "~/x.ipynb", "con.ipynb", "%2e%2e/x.ipynb", "x" * 240 + ".ipynb"],
)  # fmt: skip
def test_a_name_of_any_kind_stays_within_and_is_graded(tmp_path, name):
    file = zipped(tmp_path / "w.zip", [("anna.ipynb", "{}"), (name, "{}")])
    found = find_hand_ins(file, tmp_path / "in" / "scratch")
    assert [s.problem for s in found] == [None] * len(found)
    kept = [p for p in tmp_path.rglob("*") if p.is_file() and p != file]
    assert all(p.is_relative_to(tmp_path / "in" / "scratch") for p in kept)
    assert "anna.ipynb" in {s.name for s in found} and len(found) == (1 if "\0" in name else 2)


@pytest.mark.parametrize(
    ("one", "other"),
    [("A.ipynb", "a.ipynb"), ("e\u0301.ipynb", "\u00e9.ipynb"), ("a/x.ipynb", "a")],
)
def test_names_that_some_systems_take_for_one_lose_nothing(tmp_path, one, other):
    file = zipped(tmp_path / "w.zip", [(one, "{}"), (other, "{}")])
    found = find_hand_ins(file, tmp_path / "scratch")
    assert one in {s.name for s in found if s.problem is None}
    kept = {p.name for p in (tmp_path / "scratch").rglob("*") if p.is_file()}
    assert len(kept) == 2 or any(s.problem for s in found)


def test_members_that_overlap_are_refused(tmp_path):
    data = in_memory([("a.ipynb", b"\0" * 10_000), ("b.ipynb", "{}")])
    second = data.rindex(b"PK\x01\x02")
    twice = data[: second + 42] + bytes(4) + data[second + 46 :]
    (tmp_path / "w.zip").write_bytes(twice)  # the second begins where the first does
    found = {s.name: s.problem for s in find_hand_ins(tmp_path / "w.zip", tmp_path / "scratch")}
    assert found["b.ipynb"] and "damaged" in found["b.ipynb"]


def test_a_size_that_lies_is_refused(tmp_path):
    data = bytearray(in_memory([("a.ipynb", b"x" * 10_000)]))
    place = data.index(b"PK\x01\x02") + 24
    data[place : place + 4] = (4).to_bytes(4, "little")
    (tmp_path / "w.zip").write_bytes(data)
    (found,) = find_hand_ins(tmp_path / "w.zip", tmp_path / "scratch")
    assert "damaged" in found.problem or (found.problem is None and found.path.stat().st_size <= 4)


def test_a_name_five_hundred_times_ends_soon_and_is_told(tmp_path):
    with pytest.warns(UserWarning, match="Duplicate name"):
        file = zipped(tmp_path / "w.zip", [("a.ipynb", "{}")] * 500)
    found = find_hand_ins(file, tmp_path / "scratch")
    assert len(found) == 500
