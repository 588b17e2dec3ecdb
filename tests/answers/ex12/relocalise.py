"""Independent answers to 12-relocalise: right ones, and students' mistakes."""

RIGHT = [
    (
        "12-relocalise",
        "hypotheses in a list, guesses made at every scan, log scores",
        """
def relocalise(start, motions, sights, posts):
    tracks = [(0.0, np.array(start, dtype=float))]
    result = []
    for told, seen in zip(motions, sights):
        best = max(s for s, _ in tracks)
        poses = corrected(compose(np.array([x for _, x in tracks]), told), seen, posts)
        scores = np.array([s for s, _ in tracks]) + fit(poses, seen, posts)
        if len(seen) >= 2:
            new = guesses(seen, posts)
            if len(new):
                f = fit(new, seen, posts)
                new = new[np.argsort(f)[-150:]]
                new = corrected(new, seen, posts)
                poses = np.vstack([poses, new])
                scores = np.concatenate([scores, best - 12 + fit(new, seen, posts)])
        tracks = []
        for i in np.argsort(-scores):
            far = [np.hypot(*(poses[i] - x)[:2]) > 0.15 or abs(wrap(poses[i] - x)[2]) > 0.2
                   for _, x in tracks]
            if all(far):
                tracks.append((scores[i], poses[i]))
            if len(tracks) == 25:
                break
        result.append(tracks[0][1])
    return np.array(result)
""",
    ),
    (
        "12-relocalise",
        "looks back: forward with hypotheses, then follows the winner's ancestors",
        """
def relocalise(start, motions, sights, posts):
    poses, scores = np.array([start], dtype=float), np.zeros(1)
    layers_, parents = [], []
    for told, seen in zip(motions, sights):
        moved = corrected(compose(poses, told), seen, posts)
        value = scores + fit(moved, seen, posts)
        parent = np.arange(len(moved))
        if len(seen) > 1:
            new = guesses(seen, posts)
            if len(new):
                new = new[np.argsort(-fit(new, seen, posts))[:100]]
                new = corrected(new, seen, posts)
                moved = np.vstack([moved, new])
                value = np.append(value, scores.max() - 13 + fit(new, seen, posts))
                parent = np.append(parent, np.full(len(new), np.argmax(scores)))
        order, keep, taken = np.argsort(-value), [], set()
        for i in order:
            cell = tuple(np.round(moved[i] / 0.2).astype(int))
            if cell not in taken:
                taken.add(cell)
                keep.append(i)
            if len(keep) == 30:
                break
        poses, scores = moved[keep], value[keep]
        layers_.append(poses)
        parents.append(parent[keep])
    track_back, i = [], int(np.argmax(scores))
    for layer, parent in zip(layers_[::-1], parents[::-1]):
        track_back.append(layer[i])
        i = parent[i]
    return np.array(track_back[::-1])
""",
    ),
]

WRONG = [
    (
        "12-relocalise",
        "the usual filter",
        """
def relocalise(start, motions, sights, posts):
    return track(start, motions, sights, posts)
""",
    ),
    (
        "12-relocalise",
        "dead reckoning",
        """
def relocalise(start, motions, sights, posts):
    pose, found = start, []
    for told in motions:
        pose = compose(pose, told)
        found.append(pose)
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "always the pose that fits this scan best, no memory",
        """
def relocalise(start, motions, sights, posts):
    pose, found = start, []
    for told, seen in zip(motions, sights):
        pose = compose(pose, told)
        if len(seen) >= 2:
            many = guesses(seen, posts)
            if len(many):
                many = corrected(many, seen, posts)
                pose = many[np.argmax(fit(many, seen, posts))]
        found.append(pose)
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "jumps to the best guess at the first scan that fits badly, one pose only",
        """
def relocalise(start, motions, sights, posts):
    pose, found = start[None], []
    for told, seen in zip(motions, sights):
        pose = corrected(compose(pose, told), seen, posts)
        if len(seen) >= 2 and fit(pose, seen, posts)[0] < -1.0 * len(seen):
            many = guesses(seen, posts)
            if len(many):
                pose = many[[np.argmax(fit(many, seen, posts))]]
        found.append(pose[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "hypotheses of one scan only, and the old pose thrown away at the first odd scan",
        """
def relocalise(start, motions, sights, posts):
    poses, scores, found = start[None], np.zeros(1), []
    for told, seen in zip(motions, sights):
        poses = corrected(compose(poses, told), seen, posts)
        scores = scores + fit(poses, seen, posts)
        if len(seen) > 2 and fit(poses, seen, posts).max() < -4.0:
            poses = guesses(seen, posts)
            scores = fit(poses, seen, posts)
        found.append(poses[np.argmax(scores)])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "a scan with fewer than two sights is left out: too few poses come back",
        """
def relocalise(start, motions, sights, posts):
    poses, scores, found = start[None], np.zeros(1), []
    for told, seen in zip(motions, sights):
        poses = compose(poses, told)
        if len(seen) < 2:
            continue
        new = guesses(seen, posts)
        scores = np.append(scores, np.full(len(new), scores.max() - 12))
        poses = corrected(np.vstack([poses, new]), seen, posts)
        scores = scores + fit(poses, seen, posts)
        best = np.argsort(-scores)[:60]
        poses, scores = poses[best], scores[best]
        found.append(poses[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "motion composed the wrong way round",
        """
def relocalise(start, motions, sights, posts):
    poses, scores, found = start[None], np.zeros(1), []
    for told, seen in zip(motions, sights):
        poses = corrected(compose(told, poses), seen, posts)
        best = scores.max()
        scores = scores + fit(poses, seen, posts)
        if len(seen) >= 2:
            new = guesses(seen, posts)
            new = corrected(new, seen, posts)
            poses = np.vstack([poses, new])
            scores = np.append(scores, best - 12 + fit(new, seen, posts))
        keep = np.argsort(-scores)[:60]
        poses, scores = poses[keep], scores[keep]
        found.append(poses[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "a random cloud round the last pose, best fit wins",
        """
def relocalise(start, motions, sights, posts):
    rng = np.random.default_rng(0)
    pose, found = start, []
    for told, seen in zip(motions, sights):
        cloud = compose(pose, told) + rng.normal(0, [0.3, 0.3, 0.2], (300, 3))
        if len(seen):
            cloud = corrected(cloud, seen, posts)
            pose = cloud[np.argmax(fit(cloud, seen, posts))]
        else:
            pose = compose(pose, told)
        found.append(pose)
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "new poses cost nothing: it jumps between the bays",
        """
def relocalise(start, motions, sights, posts):
    poses, scores, found = start[None], np.zeros(1), []
    for told, seen in zip(motions, sights):
        poses = corrected(compose(poses, told), seen, posts)
        if len(seen) >= 2:
            poses = np.vstack([poses, guesses(seen, posts)])
        scores = fit(poses, seen, posts)
        keep = np.argsort(-scores, kind="stable")[:50][::-1]
        poses = poses[keep]
        found.append(poses[-1])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "does not move the other hypotheses",
        """
def relocalise(start, motions, sights, posts):
    pose, others, scores, found = start[None], np.zeros((0, 3)), np.zeros(0), []
    own = 0.0
    for told, seen in zip(motions, sights):
        pose = corrected(compose(pose, told), seen, posts)
        own += fit(pose, seen, posts)[0]
        if len(seen) >= 2:
            new = guesses(seen, posts)
            others = np.vstack([others, new])
            scores = np.append(scores, np.full(len(new), own - 15.0))
        scores = scores + fit(others, seen, posts)
        if len(scores) and scores.max() > own:
            pose, own = others[[np.argmax(scores)]], scores.max()
        found.append(pose[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "middle of the hall, constant",
        """
def relocalise(start, motions, sights, posts):
    return np.tile([6.0, 2.0, 0.0], (len(motions), 1))
""",
    ),
    (
        "12-relocalise",
        "returns the start as well: one pose too many",
        """
def relocalise(start, motions, sights, posts):
    found = [start]
    for told, seen in zip(motions, sights):
        pose = corrected(compose(found[-1][None], told), seen, posts)
        found.append(pose[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "searches along the hall only by whole bays, same heading",
        """
def relocalise(start, motions, sights, posts):
    pose, found = start[None], []
    for told, seen in zip(motions, sights):
        pose = compose(pose, told)
        three = np.vstack([pose + [dx, 0, 0] for dx in (0, 4, -4)])
        three = corrected(three, seen, posts)
        pose = three[[np.argmax(fit(three, seen, posts))]]
        found.append(pose[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "moves the caller's start along",
        """
def relocalise(start, motions, sights, posts):
    found = []
    for told, seen in zip(motions, sights):
        start[:] = corrected(compose(start, told)[None], seen, posts)[0]
        found.append(start.copy())
    return np.array(found)
""",
    ),
]
