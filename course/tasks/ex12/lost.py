"""Programs of task 12-lost."""

from course.tasks import Edit, Slip, Stumble

TASK = "12-lost"

WAYS = {
    "counted back from the end": """
def lost_since(errors, limit):
    since = len(errors)
    for k in range(len(errors) - 1, -1, -1):
        if errors[k] <= limit:
            break
        since = k
    return since if since < len(errors) else -1
""",
    "by products from behind": """
def lost_since(errors, limit):
    gone = np.cumprod((errors > limit)[::-1])[::-1]
    return np.argmax(gone) if gone.any() else -1
""",
    "forward, with a memory": """
def lost_since(errors, limit):
    since = -1
    for k, error in enumerate(errors):
        if error > limit:
            since = k if since == -1 else since
        else:
            since = -1
    return since
""",
    "the first date that holds": """
def lost_since(errors, limit):
    dates = [k for k in range(len(errors)) if all(errors[k:] > limit)]
    return min(dates, default=-1)
""",
    "by the least error still to come": """
def lost_since(errors, limit):
    least = np.minimum.accumulate(errors[::-1])[::-1]
    if least[-1] <= limit:
        return -1
    return np.searchsorted(least, limit, side="right")
""",
    "a text": """
def lost_since(errors, limit):
    text = "".join("x" if error > limit else "." for error in errors)
    return float(text.rfind(".") + 1) if text.endswith("x") else -1.0
""",
}

NEAR = "errors <= limit"
NONE = "    if len(near) == 0:\n        return 0\n"
END = "near[-1] + 1 if near[-1] < len(errors) - 1 else -1"
FAR = "def lost_since(errors, limit):\n    far = errors > limit\n    "
NOT_YET = "def lost_since(errors, limit):\n    near = np.flatnonzero(errors <= limit)\n    "
WITHIN = "    return since if since < len(errors) else -1"
BACK, MEMORY = "counted back from the end", "forward, with a memory"

SLIPS = (
    Slip(
        "first-time",
        "This is the first time that the run strayed. It may have come back: lost is who stays away to "
        "the end.",
        FAR + "return np.argmax(far) if far.any() else -1",
        FAR + "return np.argmax(far) if far[-1] else -1",
        Edit(MEMORY, (("        else:\n            since = -1\n", ""),)),
    ),
    Slip(
        "last-crossing",
        "This is the last time that the run strayed, but it may have come back after that. Lost is only "
        "who is still too far off at the last reading.",
        FAR + "c = np.flatnonzero(np.diff(far.astype(int), prepend=0) == 1)\n"
        "    return c[-1] if len(c) else -1",
    ),
    Slip(
        "start-forgotten",
        "A run that is beyond the limit from its first reading on has no crossing, and no near reading "
        "before it, and is lost all the same: since 0.",
        (NONE, "    if len(near) == 0:\n        return -1\n"),
        (NONE, "    if len(near) == 0:\n        return len(errors)\n"),
        FAR + "c = np.flatnonzero(np.diff(far.astype(int)) == 1)\n"
        "    return c[-1] + 1 if far[-1] and len(c) else -1",
    ),
    Slip(
        "one-early",
        "One reading too early: this is the last near one. Lost begins with the next.",
        (END, "near[-1] if near[-1] < len(errors) - 1 else -1"),
        NOT_YET + "since = near[-1] if len(near) else 0\n" + WITHIN,
    ),
    Slip(
        "one-late",
        "One reading too late: counted from 0, or the reading after the first one that never came back.",
        (END, END.replace("+ 1", "+ 2")),
        [(NONE, NONE.replace("0\n", "1\n")), (END, END.replace("+ 1", "+ 2"))],
        NOT_YET + "since = near[-1] + 2 if len(near) else 0\n" + WITHIN,
    ),
    Slip(
        "last-reading-missed",
        "A run that is lost with its very last reading counts as well.",
        (END, END.replace("len(errors) - 1", "len(errors) - 2")),
        FAR + "far = far[:-1]\n    k = len(far) - np.argmin(np.append(far[::-1], False))\n"
        "    return k if k < len(far) else -1",
    ),
    Slip(
        "longest-time",
        "This is where the longest time beyond the limit began. It may have ended: asked for is the one that "
        "reaches to the end, however short.",
        *(
            FAR
            + f"""runs, since = [], None
    for k, out in enumerate([*far, False]):
        since = (k if since is None else since) if out else since
        if not out and since is not None:
            runs.append((k - since, -since))
            since = None
    return -max(runs)[1] if {lost} else -1"""
            for lost in ("far[-1]", "runs")
        ),
    ),
    Slip(
        "last-far",
        "This is the last reading that was too far off. Asked for is the first of those that reach to the "
        "end.",
        FAR + "return np.flatnonzero(far)[-1] if far.any() else -1",
        FAR + "return len(far) - 1 if far[-1] else -1",
    ),
    Slip(
        "largest",
        "This is where the error is largest, not where the loss began.",
        FAR + "return np.argmax(errors) if far.any() else -1",
        FAR + "return np.argmax(errors) if far[-1] else -1",
    ),
    Slip(
        "counted",
        "This is how many readings were too far off, not since when.",
        FAR + "return far.sum() if far[-1] else -1",
        FAR + "return far.sum()",
    ),
    Slip(
        "from-the-end",
        "This counts from the end: so many readings were lost. Asked for is the number of the first of "
        "them, counted from 0.",
        (END, "len(errors) - 1 - near[-1] if near[-1] < len(errors) - 1 else -1"),
        [
            (NONE, NONE.replace("0\n", "len(errors)\n")),
            (END, "len(errors) - 1 - near[-1] if near[-1] < len(errors) - 1 else -1"),
        ],
        FAR + "gone = np.cumprod(far[::-1])\n    return np.argmin(gone) if far[-1] else -1",
    ),
    Slip(
        "zero-for-never",
        "A run that is not lost gives 0, which is a date. Return −1 for it.",
        (END, END.replace("else -1", "else 0")),
    ),
    Slip(
        "length-for-never",
        "A run that is not lost gives the number of its readings. Return −1 for it.",
        (END, "near[-1] + 1"),
    ),
    Slip(
        "yes-or-no",
        "This says whether the run is lost. Asked for is since when, or −1.",
        FAR + "return bool(far[-1])",
        FAR + "return 1 if far[-1] else -1",
    ),
    Slip(
        "limit-itself",
        "An error that equals the limit is not beyond it.",
        (NEAR, "errors < limit"),
        Edit(BACK, (("<= limit", "< limit"),)),
        Edit(MEMORY, (("> limit", ">= limit"),)),
    ),
    Slip(
        "near-for-far",
        "The comparison is the wrong way round: this is since when the run is *near* for good.",
        (NEAR, "errors > limit"),
        (NEAR, "errors >= limit"),
    ),
    Slip(
        "in-order-of-size",
        "The errors were sorted. Their order in time is what is asked about.",
        (NEAR, "np.sort(errors) <= limit"),
    ),
    Slip(
        "mean-for-last",
        "Whether a run is lost is decided by its last reading, not by its mean or its median.",
        FAR + "near = np.flatnonzero(~far)\n    if errors.mean() <= limit:\n        return -1\n"
        "    return near[-1] + 1 if len(near) else 0",
        FAR + "near = np.flatnonzero(~far)\n    if np.median(errors) <= limit:\n        return -1\n"
        "    return near[-1] + 1 if len(near) else 0",
    ),
    Slip(
        "fixed-length",
        "This run has forty readings in your function. How many there are is in the array.",
        (END, END.replace("len(errors) - 1", "39")),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (f"return {END}", "pass"),
        (END, "near + 1"),
        (END, "near[-1] + 1 if near[-1] < len(errors) - 1 else None"),
        (END, "near[-1] + 1 if near[-1] < len(errors) - 1 else np.inf"),
    ),
    Stumble("raised", (NEAR, "error <= limit"), (NONE, "")),
)

EQUIVALENT = {}
