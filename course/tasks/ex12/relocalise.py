"""Programs of the open task: a filter that notices that it is lost and finds itself again."""

from course.tasks import Slip, Stumble

TASK = "12-relocalise"
MUTANTS = 24  # a run takes long

WAYS = {
    "many samples of the guesses, weighed": """
def relocalise(start, motions, sights, posts):
    poses, weights, found = start[None], np.ones(1), []
    for motion, z in zip(motions, sights):
        poses = corrected(compose(poses, motion), z, posts)
        fits = fit(poses, z, posts)
        if len(z) > 1 and fits[np.argmax(weights)] < -5:
            more = guesses(z, posts)
            how = fit(more, z, posts)
            more, order = more[np.argsort(-how)], []
            for k, pose in enumerate(more):
                if len(order) < 40 and all(np.abs(pose - more[j]).max() > 0.2 for j in order):
                    order.append(k)
            more = corrected(more[order], z, posts)
            poses = np.append(poses, more, axis=0)
            weights = np.append(weights, np.full(len(more), 1e-5 * weights.max()))
            fits = np.append(fits, fit(more, z, posts))
        weights = weights * np.exp(fits - fits.max())
        weights /= weights.max()
        kept = weights > 1e-12
        poses, weights = poses[kept], weights[kept]
        found.append(poses[np.argmax(weights)])
    return np.array(found)
""",
    "when in doubt, the last scans are asked again": """
def relocalise(start, motions, sights, posts):
    found, pose, past = [], start, []
    rivals = np.zeros((0, 3))
    for motion, z in zip(motions, sights):
        pose = corrected(compose(pose, motion)[None], z, posts)[0]
        rivals = corrected(compose(rivals, motion), z, posts) if len(rivals) else rivals
        past.append(fit(np.concatenate([pose[None], rivals]), z, posts))
        if len(rivals):
            total = total + past[-1]
            best = np.argmax(total)
            if best and total[best] > total[0] + 12:
                order = np.argsort(-total)
                everybody = np.concatenate([pose[None], rivals])[order]
                pose, rivals, total = everybody[0], everybody[1:], total[order]
            keep = np.append(0, 1 + np.flatnonzero(total[1:] > total.max() - 30))
            rivals, total = np.concatenate([pose[None], rivals])[keep][1:], total[keep]
        if past[-1][0] < -1.4 * len(z):
            more = guesses(z, posts)
            cells, first = np.unique(np.round(more * 4), axis=0, return_index=True)
            more = more[first]
            how = fit(more, z, posts)
            more, how = more[np.argsort(-how)[:40]], np.sort(how)[::-1][:40]
            if not len(rivals):
                total = past[-1][:1]
            rivals = np.concatenate([rivals, corrected(more, z, posts)])
            total = np.append(total, total[0] - past[-1][0] + how)
        found.append(pose)
    return found
""",
}

TRACK = """
def relocalise(start, motions, sights, posts):
    pose, found = start[None], []
    for motion, z in zip(motions, sights):
        pose = corrected(compose(pose, motion), z, posts)
{more}        found.append(pose[0])
    return np.array(found)
"""


def tracked(*lines):
    """The usual filter with some lines more in each step."""
    return TRACK.format(more="".join(f"        {line}\n" for line in lines))


def jumping(better):
    """A filter that goes wherever one scan fits better by so much."""
    return tracked(
        "places = np.concatenate([pose, guesses(z, posts)])",
        f"pose = places[[np.argmax(fit(places, z, posts) + {better} * np.eye(len(places))[0])]]",
    )


WHEELS = """
def relocalise(start, motions, sights, posts):
    poses = [start]
    for motion in motions:
        poses.append(compose(poses[-1], motion))
    return np.array(poses[1:])
"""

PASTED = {
    "the ready filter": "relocalise = track",
    "the wheels alone": WHEELS,
    "the ready filter, twice a scan": tracked("pose = corrected(pose, z, posts)"),
}

PENALTY = "scores[0] - 12"
BEST = "[:20]"

# which of many places fits best hangs on rounding: poses differ from machine to machine
SLIPS = (
    Slip(
        "usual-filter",
        "This is the usual filter: after the lift nearly all it sees is near no post, and it does not mind. "
        "What could it compute from that?",
        tracked(),
    ),
    Slip(
        "wheels-alone",
        "No sight is used: the wheels notice nothing of the lift, and drift besides.",
        WHEELS,
    ),
    Slip(
        "best-of-each-scan",
        "Each scan decides alone where the robot is. Many places explain one scan; what was seen before has to "
        "count as well.",
        jumping(0),
        jumping(3),
        shaky=True,
    ),
    Slip(
        "one-scan-decides",
        "One scan is enough for a jump, and then nothing is known any more of the other places that fitted "
        "it. In which bay is it, if two look alike from there?",
        jumping(12),
        tracked(
            "lost = len(z) > 1 and fit(pose, z, posts)[0] < -3 * len(z)",
            "places = np.concatenate([pose, guesses(z, posts)]) if lost else pose",
            "pose = places[[np.argmax(fit(places, z, posts))]]",
        ),
        shaky=True,
    ),
    Slip(
        "no-memory",
        "Scores are those of the present scan alone. Add up what all scans since then say of a place.",
        ("scores = scores + fits", "scores = fits"),
        shaky=True,
    ),
    Slip(
        "newcomers-equal",
        "A place that was just guessed counts as much as one that explained all scans so far. To be lifted is "
        "rare: a newcomer has to earn its lead.",
        (PENALTY, "scores[0]"),
        (PENALTY, "0.0"),
        shaky=True,
    ),
    Slip(
        "one-rival",
        "Too few of the guesses are followed: the right one is often not among the very best of one scan.",
        (BEST, "[:1]"),
        shaky=True,
    ),
    Slip(
        "worst-first",
        "You keep the places that fit worst: a logarithm of a likelihood is best where it is largest.",
        ("np.argsort(-scores)", "np.argsort(scores)"),
        shaky=True,
    ),
    Slip(
        "start-told",
        "The start stands first and the last pose is missing: asked for is the pose after each motion.",
        [
            (
                "scores, found = start[None], np.zeros(1), []",
                "scores, found = start[None], np.zeros(1), [start]",
            ),
            ("return np.array(found)", "return np.array(found[:-1])"),
        ],
        shaky=True,
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("return np.array(found)", "return np.array(found)[:, :2]"),
        ("return np.array(found)", "return poses"),
        ("return np.array(found)", "pass"),
        ("found.append(poses[0])", "found.append(np.nan * poses[0])"),
    ),
    Stumble("raised", ("scores = scores + fits", "scores = scores + fit(poses, z)")),
)

EQUIVALENT = {"": "any method goes: what still finds the robot is as right as the solution"}
