"""Exercise 01, the task of one pose seen from another."""

import numpy as np

from slamlab.exercises.drives.ex01 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks import ex01_inputs as make
from slamlab.exercises.tasks.ex01_laws import (
    DEGREES,
    SWAPPED,
    place_of,
    same_angle,
    same_direction,
    small,
    towards,
    wrapped,
)


def _from_pair(position):
    """Diagnosis of a seen_from whose position follows a wrong formula of (d, θa, θb)."""

    def matches(i, o):
        d = place_of(i["b"]) - place_of(i["a"])
        formula = position(d, i["a"][:, 2], i["b"][:, 2])
        return small(place_of(o["result"]) - formula).all()

    return matches


def _from_headings(heading):
    """Diagnosis of a seen_from whose heading follows a wrong formula of (θa, θb)."""
    return lambda i, o: same_angle(o["result"][:, 2], heading(i["a"][:, 2], i["b"][:, 2])).all()


SEEN_FROM = Task(
    id="01-seen-from",
    title="One pose seen from another",
    drive=DRIVES["01-seen-from"],
    inputs=make.two_poses,
    shapes={"result": (3,)},
    laws=(
        Law(
            "distance",
            1,
            "b is as far from a as they are apart in the world",
            lambda i, o: small(
                np.abs(place_of(o["result"])) - np.abs(place_of(i["b"]) - place_of(i["a"]))
            ),
        ),
        Law(
            "direction",
            2,
            "whoever looks from a in that direction looks at b",
            lambda i, o: same_direction(
                place_of(o["result"]) * towards(i["a"][:, 2]), place_of(i["b"]) - place_of(i["a"])
            ),
        ),
        Law(
            "heading",
            1,
            "whoever turns from a by the heading found looks where b looks",
            lambda i, o: same_angle(i["a"][:, 2] + o["result"][:, 2], i["b"][:, 2]),
        ),
        Law(
            "wrapped",
            1,
            "the heading lies between -π and π",
            lambda i, o: wrapped(o["result"][:, 2]),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "only subtracted",
            "The difference of the positions is measured along the world's axes. Turn it into a's "
            "frame.",
            _from_pair(lambda d, ta, tb: d),
        ),
        Diagnosis(
            "turned the wrong way",
            "You turn from a's frame into the world. Here the way is back: turn by minus a's "
            "heading.",
            _from_pair(lambda d, ta, tb: d * towards(ta)),
        ),
        Diagnosis(
            "turned by the other heading",
            "You turn by b's heading. It is a who looks: turn by minus a's heading.",
            _from_pair(lambda d, ta, tb: d * towards(-tb)),
        ),
        Diagnosis(
            "the wrong way round",
            "You tell where a is. Asked is where b is, seen from a: position of b minus position "
            "of a.",
            lambda i, o: any(
                _from_pair(formula)(i, o)
                for formula in (
                    lambda d, ta, tb: -d * towards(-tb),
                    lambda d, ta, tb: -d * towards(-ta),
                )
            ),
        ),
        Diagnosis(
            "degrees",
            DEGREES,
            lambda i, o: any(
                _from_pair(lambda d, ta, tb, unit=unit: d * towards(-unit(ta)))(i, o)
                for unit in (np.degrees, np.radians)
            ),
        ),
        Diagnosis(
            "sine and cosine swapped",
            SWAPPED,
            _from_pair(lambda d, ta, tb: -1j * d * towards(ta)),
        ),
        Diagnosis(
            "heading not relative",
            "You give b's heading in the world. Seen from a it is what a has to turn.",
            _from_headings(lambda ta, tb: tb),
        ),
        Diagnosis(
            "headings added",
            "The headings are added. What a has to turn to look where b looks is a difference.",
            _from_headings(lambda ta, tb: tb + ta),
        ),
        Diagnosis(
            "heading backwards",
            "The turn goes the wrong way: it leads from b's heading to a's.",
            _from_headings(lambda ta, tb: ta - tb),
        ),
        Diagnosis(
            "not wrapped",
            "The heading leaves the range from -π to π: a robot that has to turn by 350° would do "
            "better to turn by -10°. Wrap the difference.",
            lambda i, o: not wrapped(o["result"][:, 2]).all(),
        ),
    ),
)
