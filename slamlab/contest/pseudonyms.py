"""Pseudonyms: a board shows no names unless it is asked to; each student is told the own one."""

TRAITS = (
    "Amber", "Bold", "Brisk", "Calm", "Clever", "Copper", "Coral", "Dapper", "Eager", "Fair",
    "Gentle", "Golden", "Happy", "Hazel", "Ivory", "Jolly", "Keen", "Lively", "Lucky", "Merry",
    "Mellow", "Nimble", "Noble", "Olive", "Patient", "Proud", "Quiet", "Rapid", "Ruby", "Silver",
    "Steady", "Witty",
)  # fmt: skip
ANIMALS = (
    "Badger", "Beaver", "Bison", "Crane", "Curlew", "Dolphin", "Eagle", "Falcon", "Finch", "Fox",
    "Gecko", "Hare", "Heron", "Ibex", "Jackdaw", "Kestrel", "Lark", "Lemur", "Lynx", "Marten",
    "Newt", "Otter", "Owl", "Panda", "Plover", "Puffin", "Raven", "Seal", "Stork", "Swift",
    "Tapir", "Wren",
)  # fmt: skip


def pseudonyms(students, kept, choose):
    """Give pseudonyms to those who have none; they are drawn, so that nobody can work one out.

    Parameters
    ----------
    students : iterable of str
    kept : dict, student to pseudonym, given before
    choose : callable that draws one of a sequence, such as ``secrets.choice``

    Returns
    -------
    dict, student to pseudonym, no two alike
    """
    given = dict(kept)
    for student in students:
        if student not in given:
            taken = set(given.values())
            free = [n for n in (f"{t} {a}" for t in TRAITS for a in ANIMALS) if n not in taken]
            given[student] = choose(free) if free else f"Robot {len(given) + 1}"
    return given
