"""Remarks: what is written to a student by hand: a comment, the answer to a request."""

COMMENT, REQUEST, ANSWER = KINDS = "comment", "request", "answer"
"""Rows of the ledger; each names the submission that it is about."""


def of_submissions(comments, requests, answers):
    """What students read: of each submission the newest comment, and the requests answered.

    Parameters
    ----------
    comments, requests, answers : lists of dict, what the rows of these kinds say, in order

    Returns
    -------
    dict, submission to tuple of str
    """
    found = {}
    for body in {body["submission"]: body for body in comments}.values():
        if body["text"]:  # an empty one takes the one before away
            found[body["submission"]] = (body["text"],)
    asked = {body["request"]: body["text"] for body in requests}
    for body in {body["request"]: body for body in answers}.values():
        if body["request"] in asked:  # of a submission that was forgotten nothing is said
            said = f"You asked: {asked[body['request']]}\nAnswer: {body['text']}"
            found[body["submission"]] = (*found.get(body["submission"], ()), said)
    return found
