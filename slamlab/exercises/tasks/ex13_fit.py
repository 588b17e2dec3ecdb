"""Tasks of exercise 13 about paired points: the best motion, and why it must not be a mirror."""

import numpy as np

from slamlab.exercises.drives.ex13 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex13_clouds import carried, either_sign, is_best, is_rigid, motion


def paired_clouds(rng, count=16, n=9):
    """Pairs that fit exactly (even rows) or up to 5 cm of noise (odd rows)."""
    source = rng.uniform(-2, 2, (count, n, 2)) + either_sign(rng, 1, 3, (count, 1, 2))
    T = motion(*either_sign(rng, 0.5, 3, (2, count)), either_sign(rng, 0.5, 2.6, count))
    noise = rng.normal(0, 0.05, source.shape) * (np.arange(count) % 2)[:, None, None]
    return {"source": source, "target": carried(T, source) + noise}


def noisy_walls(rng, count=12, n=10):
    """One straight wall seen twice, its noise such that a mirror would fit it best."""
    along = rng.uniform(-1.2, 1.2, (count, n))
    across = rng.normal(0, 0.02, (2, count, n))
    walls = np.stack(np.broadcast_arrays(along, across), axis=-1)
    # turning one wall's noise over turns the determinant's sign
    walls[1, np.linalg.det(cross_covariance(*walls)) > 0, :, 1] *= -1
    places = motion(
        *either_sign(rng, 0.5, 3, (2, 2, count)), either_sign(rng, 0.3, 2.8, (2, count))
    )
    source, target = carried(places, walls)
    return {"source": source, "target": target}


def cross_covariance(source, target, centred=True):
    """(k, 2, 2) H = Σ p qᵀ of paired clouds (k, n, 2), their centroids taken off or not."""
    if centred:
        source = source - source.mean(axis=1, keepdims=True)
        target = target - target.mean(axis=1, keepdims=True)
    return np.einsum("kni,knj->kij", source, target)


def factors(H):
    """U and V of H = U S Vᵀ, as stacks."""
    U, _, Vt = np.linalg.svd(H)
    return U, turned_over(Vt)


def turned_over(M):
    """The transpose of each matrix of a stack."""
    return np.swapaxes(M, -1, -2)


def rotation(U, V):
    """The rotation nearest to V Uᵀ: V diag(1, det V Uᵀ) Uᵀ, as a stack."""
    least = V[..., 1] * np.linalg.det(V @ turned_over(U))[..., None]
    return np.stack([V[..., 0], least], axis=-1) @ turned_over(U)


def assembled(R, t):
    """Homogeneous matrices (k, 3, 3) of blocks R (k, 2, 2) and t (k, 2)."""
    T = np.zeros((len(R), 3, 3))
    T[:, :2, :2], T[:, :2, 2], T[:, 2, 2] = R, t, 1
    return T


def about_centroids(R, source, target):
    """The motion that turns by R and lays the centroids over each other."""
    p, q = source.mean(axis=1), target.mean(axis=1)
    return assembled(R, q - np.einsum("kij,kj->ki", R, p))


def fit(source, target):
    """The best motion of paired clouds, as one of the right ways computes it."""
    return about_centroids(rotation(*factors(cross_covariance(source, target))), source, target)


# ---- mistakes: the wrong formula, computed on the same clouds -------------------------------


def rotation_transposed(source, target):
    U, V = factors(cross_covariance(source, target))
    return about_centroids(U @ turned_over(V), source, target)


def not_centred(source, target):
    U, V = factors(cross_covariance(source, target, centred=False))
    return about_centroids(V @ turned_over(U), source, target)


def not_centred_never_mirrored(source, target):
    U, V = factors(cross_covariance(source, target, centred=False))
    return about_centroids(rotation(U, V), source, target)


def centroid_not_turned(source, target):
    T = fit(source, target)
    return assembled(T[:, :2, :2], target.mean(axis=1) - source.mean(axis=1))


def centroids_swapped(source, target):
    T = fit(source, target)
    turned = np.einsum("kij,kj->ki", T[:, :2, :2], target.mean(axis=1))
    return assembled(T[:, :2, :2], source.mean(axis=1) - turned)


def inverted(source, target):
    return np.linalg.inv(fit(source, target))


def for_rows(source, target):
    return turned_over(fit(source, target))


def mirrored(source, target):
    U, V = factors(cross_covariance(source, target))
    return about_centroids(V @ turned_over(U), source, target)


def v_for_vt(source, target):
    U, V = factors(cross_covariance(source, target))
    return about_centroids(turned_over(V) @ turned_over(U), source, target)


def negated(source, target):
    U, V = factors(cross_covariance(source, target))
    return about_centroids(-V @ turned_over(U), source, target)


def first_flipped(source, target):
    U, V = factors(cross_covariance(source, target))
    V[..., 0] *= -1
    return about_centroids(V @ turned_over(U), source, target)


def product_flipped(axis, row):
    def wrong(source, target):
        U, V = factors(cross_covariance(source, target))
        R = V @ turned_over(U)
        np.moveaxis(R, axis, 1)[:, row] *= -1
        return about_centroids(R, source, target)

    return wrong


def answers_with(*formulas):
    """Whether the answer is what one of these formulas gives."""

    def matches(inputs, outputs):
        clouds = inputs["source"], inputs["target"]
        return any(np.allclose(outputs["result"], wrong(*clouds), atol=1e-6) for wrong in formulas)

    return matches


def _exact(inputs, outputs):
    off = carried(outputs["result"], inputs["source"]) - inputs["target"]
    return np.abs(off[::2]).max(axis=(1, 2)) < 1e-6


def _best(inputs, outputs):
    return is_best(outputs["result"], inputs["source"], inputs["target"])


def _rigid(inputs, outputs):
    return is_rigid(outputs["result"])


def _rotation(inputs, outputs):
    return is_rigid(outputs["result"]) & (np.linalg.det(outputs["result"][:, :2, :2]) > 0)


BEST_MOTION = Task(
    id="13-best-motion",
    title="The best motion of paired points",
    drive=DRIVES["13-best-motion"],
    inputs=paired_clouds,
    shapes={"result": (3, 3)},
    laws=(
        Law("rigid", 1, "T is a rigid motion: RᵀR = I, last row 0 0 1", _rigid),
        Law("exact", 1, "where the pairs fit exactly, T lands each point on its partner", _exact),
        Law("best", 2, "no turn and no small shift lowers the sum of squares", _best),
    ),
    diagnoses=(
        Diagnosis(
            "rotation-transposed",
            "R turns the wrong way: it is the transpose of the right one. With H = Σ a′ b′ᵀ "
            "= U S Vᵀ (source on the left) R = V Uᵀ, not U Vᵀ.",
            answers_with(rotation_transposed),
        ),
        Diagnosis(
            "not-centred",
            "Take the centroids off both clouds before H is summed: turning is about the centroid, "
            "not about the origin.",
            answers_with(not_centred, not_centred_never_mirrored),
        ),
        Diagnosis(
            "centroid-not-turned",
            "The source's centroid has to be turned before it is taken off: t = b̄ − R ā, "
            "not b̄ − ā.",
            answers_with(centroid_not_turned),
        ),
        Diagnosis(
            "centroids-swapped",
            "The centroids have changed places in t: it carries the source, so t = b̄ − R ā.",
            answers_with(centroids_swapped),
        ),
        Diagnosis(
            "inverted",
            "This is the inverse motion: it lays the target over the source. T has to carry "
            "the source.",
            answers_with(inverted),
        ),
        Diagnosis(
            "for-rows",
            "T is transposed: matrices act on column vectors here, so t stands in the last column.",
            answers_with(for_rows),
        ),
    ),
)

MIRROR = Task(
    id="13-mirror",
    title="A rotation, never a mirror",
    drive=DRIVES["13-mirror"],
    inputs=noisy_walls,
    shapes={"result": (3, 3)},
    laws=(
        Law("rotation", 1, "T's block R is a rotation: RᵀR = I and det R = +1", _rotation),
        Law("best", 1, "no turn and no small shift lowers the sum of squares", _best),
    ),
    diagnoses=(
        Diagnosis(
            "mirrored",
            "det R = −1: this lays the wall over itself by turning it inside out. Where det(V Uᵀ) "
            "is negative, change the sign of V's last column, that of the least singular value.",
            answers_with(mirrored),
        ),
        Diagnosis(
            "v-for-vt",
            "numpy's svd returns U, S and Vᵀ, not V, so R = Vt.T @ U.T. In the plane V may be its "
            "own transpose, which hid the mistake until now.",
            answers_with(v_for_vt),
        ),
        Diagnosis(
            "negated",
            "In the plane det(−R) = det R: negating the whole matrix leaves a mirror a mirror. "
            "Negate only V's last column.",
            answers_with(negated),
        ),
        Diagnosis(
            "first-flipped",
            "The wrong column was negated: the first one has the largest singular value, the "
            "wall's own direction. Give up the last one, which costs least.",
            answers_with(first_flipped),
        ),
        Diagnosis(
            "product-flipped",
            "A row or column of R itself was negated: that is a rotation, but not the best one. "
            "Negate V's last column and multiply again.",
            answers_with(*(product_flipped(axis, row) for axis in (1, 2) for row in (0, 1))),
        ),
    ),
    needs=("13-best-motion",),
)
