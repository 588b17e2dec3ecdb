"""Scenes for films: tables that grow, and one with every kind of layer."""

import gzip

import numpy as np

from slamlab.layers import Boxes, Ellipses, Particles, Points, Poses, Segments
from slamlab.live.films import FilmRecorder
from slamlab.live.films.film_file import FrameEncoder, header_line
from slamlab.live.frame_packing import Scene


def every_kind(rng, count):
    """A scene after some steps: map, track, walls, ellipses, boxes, samples and a curve."""
    t = np.arange(count) / 10
    track = np.column_stack([np.cos(t), np.sin(t), t + np.pi / 2])
    spread = np.einsum("nij,nkj->nik", *[rng.normal(size=(3, 2, 2))] * 2)
    layers = [
        Points("map", rng.normal(size=(5 * count, 2))),
        Points("scan", rng.normal(size=(400, 2))),
        Segments("walls", 3 * rng.normal(size=(4, 4))),
        Boxes("box", [[0, 1, 0, 2 + count / 9]]),
        Particles("sample", rng.normal(size=(20, 2)), np.full(20, 1 / 20)),
        Ellipses("landmark", rng.normal(size=(3, 2)), spread),
        Poses("truth", track),
        Poses("corrected", track + 0.02),
    ]
    error = np.column_stack([t, 0.01 * t**2])
    curves = {"error [m]": {"corrected": error}}
    return Scene(layers, f"step {count} · {'many ' * (count % 7)}", curves=curves)


def scenes(count=30, seed=0):
    """The scenes of a short run; a map that grows is there from the first frame."""
    rng = np.random.default_rng(seed)
    return [every_kind(rng, n) for n in range(1, count + 1)]


def record(path, made, title="A run", alt="A robot drives round."):
    """Write a film of scenes; its path."""
    with FilmRecorder(path, title, alt) as film:
        for scene in made:
            film.add(scene)
    return path


def content(made):
    """A film of scenes, not packed yet."""
    encoder = FrameEncoder()
    header = header_line("A run", "A robot drives round.", (720, 480), 0.15)
    return header + b"".join(encoder.encode(scene) for scene in made)


def damaged(made):
    """Damaged films (bytes), each with part of what the command says, and of what the page says."""
    whole = content(made)
    packed = gzip.compress(whole)
    flipped = bytearray(packed)
    flipped[len(packed) // 2] ^= 0x55

    def changed(old, new):
        assert old in whole
        return gzip.compress(whole.replace(old, new, 1))

    first = "frame 1 is damaged"
    return [
        (packed[:-20], "incomplete", "incomplete"),
        (packed[: len(packed) // 2], "incomplete", "incomplete"),
        (bytes(flipped), "damaged", "damaged"),
        (b"", "is not a film", "incomplete"),
        (b"P6 no film at all", "is not a film", "damaged"),
        (gzip.compress(b"# CARMEN log\n" * 50), "is not a film", "is not a film"),
        (gzip.compress(b"[" * 100_000), "is not a film", "is not a film"),
        (changed(b'"version":1', b'"version":2'), "has version 2", "has version 2"),
        (changed(b'"size":[720,480]', b'"size":[720]'), "header is damaged", "damaged"),
        (changed(b'"title":"A run"', b'"title":17'), "header is damaged", "damaged"),
        (gzip.compress(whole[:-7]), "frame 30 is damaged", "damaged"),
        (gzip.compress(whole[: whole.index(b'{"status"')]), "without frames", "no frames"),
        (changed(b"[0,0,5]", b"[9,0,5]"), first, "damaged"),
        (changed(b"[0,0,5]", b"[0,7,5]"), first, "damaged"),
        (changed(b"[0,0,5]", b"[0,0,-5]"), first, "damaged"),
        (changed(b'"kind":"points"', b'"kind":"clouds"'), first, "damaged"),
        (changed(b"#005fa3", b"url(a)"), first, "damaged"),
        (changed(b"[0.001,0.001]", b"[0.001,-1]"), first, "damaged"),
    ]
