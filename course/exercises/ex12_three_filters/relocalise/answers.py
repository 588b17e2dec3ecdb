# %% way: many samples of the guesses, weighed
def relocalise(start, motions, measurements, posts):
    poses, weights, found = start[None], np.ones(1), []
    for motion, z in zip(motions, measurements):
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

# %% way: when in doubt, the last scans are asked again
def relocalise(start, motions, measurements, posts):
    found, pose, past = [], start, []
    rivals = np.zeros((0, 3))
    for motion, z in zip(motions, measurements):
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

# %% pasted: the ready filter
relocalise = track

# %% pasted: the wheels alone
def relocalise(start, motions, measurements, posts):
    poses = [start]
    for motion in motions:
        poses.append(compose(poses[-1], motion))
    return np.array(poses[1:])

# %% pasted: the ready filter, twice a scan
def relocalise(start, motions, measurements, posts):
    pose, found = start[None], []
    for motion, z in zip(motions, measurements):
        pose = corrected(compose(pose, motion), z, posts)
        pose = corrected(pose, z, posts)
        found.append(pose[0])
    return np.array(found)

# %% right: hypotheses in a list, guesses made at every scan, log scores
def relocalise(start, motions, measurements, posts):
    tracks = [(0.0, np.array(start, dtype=float))]
    result = []
    for motion, seen in zip(motions, measurements):
        best = max(s for s, _ in tracks)
        poses = corrected(compose(np.array([x for _, x in tracks]), motion), seen, posts)
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

# %% right: looks back: forward with hypotheses, then follows the winner's ancestors
def relocalise(start, motions, measurements, posts):
    poses, scores = np.array([start], dtype=float), np.zeros(1)
    layers_, parents = [], []
    for motion, seen in zip(motions, measurements):
        moved = corrected(compose(poses, motion), seen, posts)
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

# %% wrong: in every scan the best of all guesses, without motion or memory: the bay is thrown anew each time
def relocalise(start, motions, measurements, posts):
    pose, found = np.array(start), []
    for motion, seen in zip(motions, measurements):
        pose = compose(pose, motion)
        others = guesses(seen, posts) if len(seen) > 1 else np.zeros((0, 3))
        if len(others):
            pose = others[np.argmax(fit(others, seen, posts))]
        found.append(pose)
    return np.array(found)

# %% wrong: a random cloud round the last pose, best fit wins
def relocalise(start, motions, measurements, posts):
    rng = np.random.default_rng(0)
    pose, found = start, []
    for motion, seen in zip(motions, measurements):
        cloud = compose(pose, motion) + rng.normal(0, [0.3, 0.3, 0.2], (300, 3))
        if len(seen):
            cloud = corrected(cloud, seen, posts)
            pose = cloud[np.argmax(fit(cloud, seen, posts))]
        else:
            pose = compose(pose, motion)
        found.append(pose)
    return np.array(found)

# %% wrong: middle of the hall, constant
def relocalise(start, motions, measurements, posts):
    return np.tile([6.0, 2.0, 0.0], (len(motions), 1))

# %% wrong: searches along the hall only by whole bays, same heading
def relocalise(start, motions, measurements, posts):
    pose, found = start[None], []
    for motion, seen in zip(motions, measurements):
        pose = compose(pose, motion)
        three = np.vstack([pose + [dx, 0, 0] for dx in (0, 4, -4)])
        three = corrected(three, seen, posts)
        pose = three[[np.argmax(fit(three, seen, posts))]]
        found.append(pose[0])
    return np.array(found)
