"""Changes by hand as stored in the ledger: points that replace the autograder's, and graders'
remarks to a student (comments, and answers to regrade requests). Each belongs to one attempt: to a
submission's name and content.
"""

OVERRIDE, COMMENT, REQUEST, ANSWER = KINDS = "override", "comment", "request", "answer"
"""Kinds of rows in the ledger."""
ANY = ""
"""In place of the content's hash in rows of older versions, which belong to the name alone."""


def attempt_of(body):
    """Return the attempt to which a row belongs, (submission, hash of the content)."""
    return body["submission"], body.get("sha256", ANY)


def overrides_of(bodies):
    """Return the newest overrides as a dict from (submission, hash, task) to (points, reason);
    points are None where the autograder's points count again.
    """
    return {(*attempt_of(body), body["task"]): (body["points"], body["reason"]) for body in bodies}


def of_attempts(comments, requests, answers):
    """Return texts for students by attempt: the newest comment, and answers to requests. An attempt
    whose comment was deleted has an empty tuple.
    """
    found = {}
    for body in {attempt_of(body): body for body in comments}.values():
        found[attempt_of(body)] = (body["text"],) if body["text"] else ()
    asked = {body["request"]: body["text"] for body in requests}
    for body in {body["request"]: body for body in answers}.values():
        if body["request"] in asked:  # the request is missing if its student was erased
            remark = f"You asked: {asked[body['request']]}\nAnswer: {body['text']}"
            found[attempt_of(body)] = (*found.get(attempt_of(body), ()), remark)
    return found


def of_record(found, record):
    """Return those values of a dict by attempt that belong to a record."""
    places = dict.fromkeys((record.submission, hash) for hash in (ANY, record.sha256))
    return [found[place] for place in places if place in found]
