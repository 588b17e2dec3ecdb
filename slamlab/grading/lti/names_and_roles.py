"""Names and roles: who is enrolled, from the LMS itself."""

from dataclasses import dataclass

from slamlab.grading.lti.keys import LtiError

MEDIA = "application/vnd.ims.lti-nrps.v2.membershipcontainer+json"
MOST_MEMBERS = 20_000
_MOST_LETTERS = 255
_LEARNER = "Learner"


@dataclass(frozen=True)
class Member:
    """Somebody who is enrolled as a learner.

    Parameters
    ----------
    user_id : str, the LMS's own, which grades go back to
    id : str, the institution's; empty where the LMS does not tell
    name, email : str, empty where the LMS does not tell
    """

    user_id: str
    id: str
    name: str
    email: str


def learners(service, url):
    """The learners of a course who are active.

    Parameters
    ----------
    service : Service
    url : str, of its memberships

    Returns
    -------
    list of Member

    Raises
    ------
    LtiError
    """
    found = {}
    for page in service.pages(url, MEDIA):
        members = page.get("members") if isinstance(page, dict) else None
        if not isinstance(members, list):
            raise LtiError(f"{url}: a list of members has no members in it")
        for told in members:
            if isinstance(told, dict) and _is_active_learner(told) and _text(told, "user_id"):
                member = _member(told)
                found[member.user_id] = member
        if len(found) > MOST_MEMBERS:
            raise LtiError(f"{url}: more than {MOST_MEMBERS} members")
    return list(found.values())


def find_member(members, student):
    """The only member who is a student of the roster; None for nobody or several.

    Parameters
    ----------
    members : list of Member
    student : roster.Student

    Returns
    -------
    Member or None
    """
    for mine, field in ((student.id, "id"), (student.id, "user_id"), (student.id, "email"),
                        (student.email, "email")):  # fmt: skip
        folded = mine.casefold()
        found = [m for m in members if folded and getattr(m, field).casefold() == folded]
        if found:
            return found[0] if len(found) == 1 else None
    return None


def roster_rows(members):
    """The table of a roster, the titles first.

    Parameters
    ----------
    members : list of Member

    Yields
    ------
    list of str
    """
    yield ["id", "name", "email"]
    for member in members:
        id = member.id or member.email or member.user_id
        yield [id, member.name, member.email]


def _is_active_learner(told):
    roles = told.get("roles")
    roles = [role for role in roles if isinstance(role, str)] if isinstance(roles, list) else []
    # in full it is a URL that ends with #Learner
    is_learner = any(role.rpartition("#")[2] == _LEARNER for role in roles)
    return is_learner and told.get("status", "Active") == "Active"


def _member(told):
    name = _text(told, "name")
    name = name or " ".join(filter(None, (_text(told, "given_name"), _text(told, "family_name"))))
    return Member(
        _text(told, "user_id"), _text(told, "lis_person_sourcedid"), name, _text(told, "email")
    )


def _text(told, name):
    value = told.get(name)
    return value.strip() if isinstance(value, str) and len(value) <= _MOST_LETTERS else ""
