"""Exercise 14, the task of eMIR's commands: a frame that the robot does not drop."""

import numpy as np

from slamlab.exercises.drives.ex14 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

MOVE = 1
EACH, BEYOND = 5, 4


def inputs(rng):
    """Speeds and turns of every pair of signs, some too large, one whose bytes make 256.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"speed", "turn": (n,) whole numbers [%]}
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


def texts(o):
    """The commands as texts, cut off where the drive cut them off."""
    return ["".join(map(chr, row[row > 0].astype(int))) for row in o["codes"]]


def four(text):
    """The four bytes of a frame, None where it is no frame."""
    digits = text[1:-1]
    whole = len(text) == 10 and text[0] == "#" and text[-1] == "/"
    if not whole or any(digit not in "0123456789abcdefABCDEF" for digit in digits):
        return None
    return bytes.fromhex(digits)


def _limited(i):
    return np.clip(i["speed"], -100, 100), np.clip(i["turn"], -100, 100)


def _form(i, o):
    return [len(t) == n and four(t) is not None for t, n in zip(texts(o), o["length"], strict=True)]


def _arguments(i, o):
    pairs = zip(*(each % 256 for each in _limited(i)), strict=True)
    wanted = [f"#{MOVE:02X}{speed:02X}{turn:02X}" for speed, turn in pairs]
    return [text[:7].upper() == want for text, want in zip(texts(o), wanted, strict=True)]


def _sum(i, o):
    return [four(text) is not None and sum(four(text)) % 256 == 0 for text in texts(o)]


def _came_out(formula, limited=True):
    """Whether each text is a formula of speed and turn, large or small letters."""

    def matches(i, o):
        pairs = _limited(i) if limited else (i["speed"], i["turn"])
        want = [formula(int(speed), int(turn)) for speed, turn in zip(*pairs, strict=True)]
        return [text.upper() for text in texts(o)] == [text.upper() for text in want]

    return matches


def framed(checksum, swapped=False):
    """The frame with a checksum of the two bytes."""

    def text(speed, turn):
        T, R = (turn % 256, speed % 256) if swapped else (speed % 256, turn % 256)
        return f"#01{T:02x}{R:02x}{checksum(T, R):02x}/"

    return text


def right(T, R):
    return -(MOVE + T + R) % 256


def _signed(byte):
    return byte - 256 if byte > 127 else byte


def _mistake(name, hint, *formulas, limited=True):
    return Diagnosis(name, hint, lambda i, o: any(_came_out(f, limited)(i, o) for f in formulas))


COMMAND = Task(
    id="14-command",
    title="A command with its checksum",
    drive=DRIVES["14-command"],
    inputs=inputs,
    shapes={"codes": (4 * EACH + BEYOND, None), "length": (4 * EACH + BEYOND,)},
    laws=(
        Law("form", 1, "a command is #, eight hexadecimal digits, /", _form),
        Law(
            "arguments",
            1,
            "its first three bytes are 01, speed and turn, cut off at ±100, as two's complement",
            _arguments,
        ),
        Law("checksum", 2, "its four bytes add up to 0 modulo 256", _sum),
    ),
    diagnoses=(
        _mistake(
            "as printed",
            "256 − 1 − T − R is the thesis' rule: below zero when the bytes add to more than 255, "
            "and then '-1' stands in the frame. Take the remainder: % 256.",
            framed(lambda T, R: 255 - T - R),
        ),
        _mistake(
            "256 left",
            "256 − sum % 256 is 256 where the sum is a multiple of 256, which takes three digits. "
            "−sum % 256 is 0 there.",
            framed(lambda T, R: 256 - (MOVE + T + R) % 256),
        ),
        _mistake(
            "of signed numbers",
            "The checksum is computed from negative numbers: it passes 255 and takes three digits. "
            "Take the remainder: % 256.",
            framed(lambda T, R: 255 - _signed(T) - _signed(R)),
        ),
        _mistake(
            "xor",
            "This is the lidar's rule, XOR. eMIR's bytes are added.",
            framed(lambda T, R: MOVE ^ T ^ R),
        ),
        _mistake(
            "one's complement",
            "Your sum is one short of 256: 255 − sum is the complement. −sum % 256 makes it 0.",
            framed(lambda T, R: 255 - (MOVE + T + R) % 256),
        ),
        _mistake(
            "opcode left out",
            "The opcode, 01, is one of the bytes that are added up.",
            framed(lambda T, R: -(T + R) % 256),
        ),
        _mistake(
            "sum for checksum",
            "You send the sum itself. The checksum is what is missing to 0: its negative, % 256.",
            framed(lambda T, R: (MOVE + T + R) % 256),
        ),
        _mistake(
            "modulo 255",
            "A byte has 256 values: the remainder is % 256, not % 255.",
            framed(lambda T, R: -(MOVE + T + R) % 255),
        ),
        _mistake(
            "not cut off",
            "Speeds beyond ±100 are not cut off: 200 % would arrive as another number.",
            framed(right),
            limited=False,
        ),
        _mistake(
            "swapped",
            "Speed and turn have changed places: the speed comes first.",
            framed(right, swapped=True),
        ),
        _mistake(
            "sign lost",
            "Negative speeds come out as positive ones: a byte holds −50 as 256 − 50.",
            lambda speed, turn: framed(right)(abs(speed), abs(turn)),
        ),
        _mistake(
            "sign bit",
            "A negative number is not its size with the top bit set: −50 is 256 − 50 (two's "
            "complement).",
            lambda speed, turn: framed(right)(
                *(128 - each if each < 0 else each for each in (speed, turn))
            ),
        ),
        _mistake(
            "minus sign sent",
            "A minus stands among your digits: a byte is 0 to 255, −50 goes as 256 − 50. % 256 "
            "does that.",
            lambda speed, turn: f"#01{speed:02x}{turn:02x}{right(speed, turn):02x}/",
            lambda speed, turn: f"#01{speed:02x}{turn:02x}{255 - speed - turn:02x}/",
        ),
        _mistake(
            "decimal",
            "The digits are decimal; eMIR reads hexadecimal ones: format with 02X.",
            lambda speed, turn: (
                f"#01{speed % 256:02d}{turn % 256:02d}{right(speed % 256, turn % 256):02d}/"
            ),
        ),
        _mistake(
            "digits missing",
            "A byte below 16 takes two digits, too, with a zero ahead: format with 02X.",
            lambda speed, turn: (
                f"#1{speed % 256:x}{turn % 256:x}{right(speed % 256, turn % 256):x}/"
            ),
            lambda speed, turn: (
                f"#01{speed % 256:x}{turn % 256:x}{right(speed % 256, turn % 256):x}/"
            ),
        ),
    ),
)
