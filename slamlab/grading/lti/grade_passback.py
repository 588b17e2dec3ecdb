"""Grade passback: what was released goes into the LMS's gradebook, a score a learner."""

from collections import Counter
from urllib.parse import quote, urlsplit, urlunsplit

from slamlab.grading.lti.keys import LtiError
from slamlab.grading.lti.names_and_roles import find_member

LINE_ITEM = "application/vnd.ims.lis.v2.lineitem+json"
LINE_ITEMS = "application/vnd.ims.lis.v2.lineitemcontainer+json"
SCORE = "application/vnd.ims.lis.v1.score+json"


def line_item(service, url, exercise):
    """The URL of an exercise's column in the LMS's gradebook; where there is none it is made.

    Parameters
    ----------
    service : Service
    url : str, of the line items
    exercise : Exercise

    Returns
    -------
    str

    Raises
    ------
    LtiError
    """
    name = f"slamlab-{exercise.id}"
    asked = f"{url}{'&' if urlsplit(url).query else '?'}resource_id={quote(name)}"
    found = []
    for page in service.pages(asked, LINE_ITEMS):
        if not isinstance(page, list):
            raise LtiError(f"{asked}: no list of line items")
        found += [
            told for told in page if isinstance(told, dict) and told.get("resourceId") == name
        ]
    if len(found) > 1:
        raise LtiError(
            f"the LMS has {len(found)} columns with the resource {name}: delete all but one"
        )
    if not found:
        label = f"{exercise.id} {exercise.title}"
        body = {"label": label, "scoreMaximum": exercise.points, "resourceId": name}
        found = [service.post(url, LINE_ITEM, body)]
    made = found[0].get("id") if isinstance(found[0], dict) else None
    if not isinstance(made, str):
        raise LtiError(f"{url}: a line item without an id")
    return made


def send_scores(service, url, members, roster, released, now):
    """Send the scores of a release; one that is refused does not stop the others.

    Parameters
    ----------
    service : Service
    url : str, of the line item
    members : list of Member
    roster : Roster
    released : list of dict, of :func:`slamlab.grading.term.releases.released_scores`
    now : datetime, with its zone; the LMS keeps what it has where that is later

    Returns
    -------
    int, how many were sent
    list of str, who was left out, and why
    """
    parts = urlsplit(url)
    scores = urlunsplit(parts._replace(path=f"{parts.path.rstrip('/')}/scores"))
    sent, said = 0, []
    known = {id: find_member(members, student) for id, student in roster.students.items()}
    claimed = Counter(member.user_id for member in known.values() if member)
    for row in released:
        member = known.get(row["student"])
        if member is None or claimed[member.user_id] > 1:
            said.append(
                f"{row['student']}: in roster and LMS together there is not one of that name"
            )
            continue
        body = {
            "userId": member.user_id,
            "scoreGiven": row["score"],
            "scoreMaximum": row["of"],
            "comment": row["note"],
            "timestamp": now.isoformat(timespec="milliseconds"),
            "activityProgress": "Completed",
            "gradingProgress": "FullyGraded",
        }
        try:
            service.post(scores, SCORE, body)
            sent += 1
        except LtiError as error:
            said.append(f"{row['student']}: {error}")
    return sent, said
