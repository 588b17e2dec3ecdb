"""Task 14-command: encode a drive command of eMIR with its checksum."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex14_devices_and_live_slam.calls import CALLS, LONGEST

MOVE = 1
EACH, BEYOND = 5, 4
DIGITS = "0123456789ABCDEF"


def inputs(rng):
    """All combinations of signs, some numbers beyond ±100, one with a byte sum of 256:
    {"speed", "turn": (n,) whole numbers [%]}.
    """
    size = rng.integers(20, 100, (4 * EACH, 2))
    size[:, 1] = np.where(size[:, 0] == size[:, 1], size[:, 1] - 5, size[:, 1])
    signs = np.repeat([[1, 1], [1, -1], [-1, 1], [-1, -1]], EACH, axis=0)
    beyond = rng.integers(130, 300, (BEYOND, 2)) * signs[::EACH][rng.permutation(4)[:BEYOND]]
    beyond[::2, 1] = rng.integers(20, 90, len(beyond[::2]))
    size, rest = size * signs, rng.integers(20, 90)
    size[2 * EACH] = -rest, rest - 1
    speed, turn = rng.permutation(np.concatenate([size, beyond])).T
    return {"speed": speed, "turn": turn}


def _of(*pairs):
    speed, turn = np.array(pairs).T
    return lambda rng: {"speed": speed, "turn": turn}


def texts(o):
    """Return the commands in upper case, truncated as the function call truncates them."""
    return ["".join(chr(int(code)) for code in row if code > 0).upper() for row in o["codes"]]


def four(text):
    """Return the four bytes of a frame; None if the text is not a frame."""
    whole = len(text) == 10 and text[0] == "#" and text[-1] == "/"
    if not whole or any(digit not in DIGITS for digit in text[1:-1]):
        return None
    return bytes.fromhex(text[1:-1])


def limited(i):
    """Return (n, 2) speeds and turns, limited to ±100."""
    return np.clip(np.column_stack([i["speed"], i["turn"]]).astype(int), -100, 100)


def _frames(i):
    data = [[MOVE, *(pair % 256).tolist()] for pair in limited(i)]
    return ["#" + bytes([*row, -sum(row) % 256]).hex().upper() + "/" for row in data]


def _wanted(i):
    codes = np.zeros((len(i["speed"]), LONGEST))
    for row, text in zip(codes, _frames(i), strict=True):
        row[: len(text)] = [ord(character) for character in text]
    return {"codes": codes}


def _arguments(i, o):
    return [text[:7] == want[:7] for text, want in zip(texts(o), _frames(i), strict=True)]


def _sum(i, o):
    return [four(text) is not None and sum(four(text)) % 256 == 0 for text in texts(o)]


def parts(i, o):
    """Return the characters before the arguments, those of the arguments, and the rest."""
    codes = np.zeros_like(o["codes"])
    for row, text in zip(codes, texts(o), strict=True):
        row[: len(text)] = [ord(character) for character in text]
    return {"opcode": codes[:, :3], "arguments": codes[:, 3:7], "rest": codes[:, 7:]}


def _bytes(i):
    speed, turn = (limited(i) % 256).T
    return {"speed's byte": speed, "turn's byte": turn, "1 + both": MOVE + speed + turn}


COMMAND = Task(
    id="14-command",
    title="Encode a drive command",
    call=CALLS["14-command"],
    inputs=inputs,
    shapes=lambda i: {"codes": (len(i["speed"]), LONGEST)},
    laws=(
        Law(
            "form",
            1,
            "a command consists of #, eight hexadecimal digits and /",
            lambda i, o: [four(text) is not None for text in texts(o)],
            _wanted,
            asks="How many digits does each byte need, also the smallest and the largest one?",
            step=_bytes,
        ),
        Law(
            "arguments",
            1,
            "the first three bytes are 01, speed and turn, limited to ±100, as two's complement",
            _arguments,
            _wanted,
            asks="Which byte encodes −1, which −100, and which 300?",
            step=_bytes,
            after=("form",),
        ),
        Law(
            "checksum",
            2,
            "the sum of the four bytes is 0 modulo 256",
            _sum,
            _wanted,
            asks="What must be added to the sum of the first three bytes to reach a multiple of "
            "256? What if the sum already is one?",
            step=_bytes,
            after=("form",),
        ),
    ),
    probes=(
        Probe("speed and turn both 0", _of((0, 0))),
        Probe("small numbers", _of((1, 2), (15, 9), (-1, -2), (16, -15), (0, 7), (7, 0), (-5, 0))),
        Probe("both at ±100", _of((100, 99), (-100, 100), (100, -100), (-100, -99))),
        Probe("numbers just beyond ±100", _of((101, 60), (-101, 7), (8, 101), (-3, -101))),
        Probe("numbers far beyond ±100", _of((1000, 4), (5, -1000), (-300, 300), (256, -512))),
        Probe("bytes whose sum is a multiple of 256", _of((-40, 39), (90, -91), (-1, 0), (0, -1))),
        Probe("a checksum of one digit", _of((-50, 45), (-7, 4), (92, -100), (-9, 0))),
    ),
    parts=parts,
    begins=(
        "Which four bytes does the command for speed 50 and turn 0 have?",
        "Which two hexadecimal digits encode the byte 10?",
    ),
)
