"""Names and roles: read the roster of enrolled learners from the LMS."""

from dataclasses import dataclass

from classroom.grading.lti.keys import LtiError

MEDIA = "application/vnd.ims.lti-nrps.v2.membershipcontainer+json"
MAX_MEMBERS = 20_000
_MAX_CHARACTERS = 255
_LEARNER = "Learner"


@dataclass(frozen=True)
class Member:
    """An enrolled learner; fields that the LMS does not send are empty."""

    user_id: str  # in the LMS, for grade passback
    id: str  # at the institution
    name: str
    email: str


def learners(service, url):
    """Return the active learners of the course whose memberships have this URL. Raises LtiError."""
    found = {}
    for page in service.pages(url, MEDIA):
        members = page.get("members") if isinstance(page, dict) else None
        if not isinstance(members, list):
            raise LtiError(f"{url}: the response has no list of members")
        for fields in members:
            if not isinstance(fields, dict):
                continue
            if _is_active_learner(fields) and _text(fields, "user_id"):
                member = _member(fields)
                found[member.user_id] = member
        if len(found) > MAX_MEMBERS:
            raise LtiError(f"{url}: the course has more than {MAX_MEMBERS} members")
    return list(found.values())


def find_member(members, student):
    """Return the only member who matches ``student``, or None if none or several match."""
    for mine, field in ((student.id, "id"), (student.id, "user_id"), (student.id, "email"),
                        (student.email, "email")):  # fmt: skip
        folded = mine.casefold()
        found = [m for m in members if folded and getattr(m, field).casefold() == folded]
        if found:
            return found[0] if len(found) == 1 else None
    return None


def roster_rows(members):
    yield ["id", "name", "email"]
    for member in members:
        id = member.id or member.email or member.user_id
        yield [id, member.name, member.email]


def _is_active_learner(fields):
    roles = fields.get("roles")
    roles = [role for role in roles if isinstance(role, str)] if isinstance(roles, list) else []
    # the full form is a URL that ends with #Learner
    is_learner = any(role.rpartition("#")[2] == _LEARNER for role in roles)
    return is_learner and fields.get("status", "Active") == "Active"


def _member(fields):
    parts = _text(fields, "given_name"), _text(fields, "family_name")
    name = _text(fields, "name") or " ".join(filter(None, parts))
    id = _text(fields, "lis_person_sourcedid")
    return Member(_text(fields, "user_id"), id, name, _text(fields, "email"))


def _text(fields, name):
    value = fields.get(name)
    return value.strip() if isinstance(value, str) and len(value) <= _MAX_CHARACTERS else ""
