"""Random pseudonyms of the students on a leaderboard."""

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


def draw_pseudonyms(students, kept, choose):
    """Draw a unique random pseudonym for each student, which cannot be derived from the name.

    kept : pseudonyms drawn before, by student. choose : draws one element of a sequence."""
    given = dict(kept)
    for student in students:
        if student not in given:
            taken = set(given.values())
            free = [n for n in (f"{t} {a}" for t in TRAITS for a in ANIMALS) if n not in taken]
            given[student] = choose(free) if free else f"Robot {len(given) + 1}"
    return given
