"""Grade passback: send released scores to the gradebook of the LMS."""

from collections import Counter
from urllib.parse import quote, urlsplit, urlunsplit

from classroom.grading.lti.keys import LtiError
from classroom.grading.lti.names_and_roles import find_member

LINE_ITEM = "application/vnd.ims.lis.v2.lineitem+json"
LINE_ITEMS = "application/vnd.ims.lis.v2.lineitemcontainer+json"
SCORE = "application/vnd.ims.lis.v1.score+json"


def line_item(service, url, exercise):
    """Return the URL of an exercise's line item (column), created if missing. Raises LtiError."""
    name = f"slamlab-{exercise.id}"
    asked = f"{url}{'&' if urlsplit(url).query else '?'}resource_id={quote(name)}"
    found = []
    for page in service.pages(asked, LINE_ITEMS):
        if not isinstance(page, list):
            raise LtiError(f"{asked}: the response is not a list of line items")
        found += [
            item for item in page if isinstance(item, dict) and item.get("resourceId") == name
        ]
    if len(found) > 1:
        raise LtiError(
            f"the LMS has {len(found)} columns with the resource {name}; delete all but one"
        )
    if not found:
        label = f"{exercise.id} {exercise.title}"
        body = {"label": label, "scoreMaximum": exercise.points, "resourceId": name}
        found = [service.post(url, LINE_ITEM, body)]
    made = found[0].get("id") if isinstance(found[0], dict) else None
    if not isinstance(made, str):
        raise LtiError(f"{url}: the line item has no id")
    return made


def send_scores(service, url, members, roster, released, now):
    """Send released scores, continuing after a refused score. Return the number of sent scores, and
    lines about students whose scores were not sent.
    """
    parts = urlsplit(url)
    scores = urlunsplit(parts._replace(path=f"{parts.path.rstrip('/')}/scores"))
    sent, left_out = 0, []
    known = {id: find_member(members, student) for id, student in roster.students.items()}
    claimed = Counter(member.user_id for member in known.values() if member)
    for row in released:
        member = known.get(row["student"])
        if member is None or claimed[member.user_id] > 1:
            left_out.append(f"{row['student']}: no or several LMS members have this id or e-mail")
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
            left_out.append(f"{row['student']}: {error}")
    return sent, left_out
