"""Stepper: runs an estimator over a source one reading at a time, and describes the scene."""

import numpy as np

from slamlab.views.live.frame_packing import Scene
from slamlab.views.live.reading_thread import background_reader
from slamlab.views.live.run_scene import run_layers, step_line
from slamlab.views.live.thinning import Thinning


class Stepper:
    """Pair of source and estimator, stepped one reading at a time; both made anew from a seed.

    Nothing is imported that estimates: estimators are handed in, those drawn beside, too.

    Parameters
    ----------
    make_source : callable(rng) -> Source, or a Source
    make_estimator : callable(source) -> Estimator, or an Estimator
    beside : dict or None, name to callable(source) -> Estimator that takes in the same readings;
        its track is drawn under that name
    extra : callable(pair) -> layers, drawn beneath the estimator's, or None
    note : callable(pair) -> str, more for the status line, or None
    curves : dict or None, title of a panel to a dict of a line's name to callable(pair) -> float
    truth : bool, whether the true track is drawn where it is known
    colours : dict or None, name to colour where it is not the usual one

    What is called with the pair may look at ``source``, ``estimator``, ``others`` (by name),
    ``count`` (readings taken in) and ``time``.
    """

    def __init__(
        self,
        make_source,
        make_estimator,
        beside=None,
        extra=None,
        note=None,
        curves=None,
        truth=True,
        colours=None,
    ):
        self._make_source, self._make_estimator = make_source, make_estimator
        self._beside, self._extra, self._note = dict(beside or {}), extra, note
        self._curves = curves or {}
        self._truth, self._colours, self._thinned = truth, colours, Thinning()
        self.runs, self.count, self.time, self._used = 0, 0, 0.0, False
        self.source, self._reader, self._curve_values = None, None, {}

    def reset(self, seed, timeout=None):
        """Reset: make source and estimators anew from a seed and process the first reading.

        Parameters
        ----------
        seed : int
        timeout : float, for that reading [s], or None to wait until it comes

        Raises
        ------
        ValueError : the estimator was handed in ready-made and has been used
        """
        if not callable(self._make_estimator) and self._used:
            raise ValueError("a ready-made estimator cannot start again: hand in what makes one")
        self.close()
        self.runs, self.count, self.time, self.command = self.runs + 1, 0, 0.0, None
        self._curve_values = {
            panel: {name: [] for name in of} for panel, of in self._curves.items()
        }
        self.source = self._reader = None  # stays so where the source cannot be had
        self.source = _make(self._make_source, np.random.default_rng(seed))
        self.estimator = _make(self._make_estimator, self.source)
        self.others = {name: make(self.source) for name, make in self._beside.items()}
        self._reader, self._used = background_reader(self.source), True
        self.step(timeout)

    def close(self):
        """Close the source, if it was made here; one handed in ready-made is its owner's."""
        if self.source is not None and callable(self._make_source):
            self.source.close()

    @property
    def drivable(self):
        """bool, whether the robot can be driven, now or when its recorded part is over."""
        return getattr(self.source, "drivable", False)

    @property
    def played(self):
        """bool, whether every reading that the source has was processed."""
        return self.count >= len(self.source)

    @property
    def exhausted(self):
        """bool, whether the source is exhausted: no more readings come by themselves."""
        return self._reader is None or self._reader.ended or 0 < len(self.source) <= self.count

    @property
    def live(self):
        """bool, whether readings come in real time: a device does not wait for a frame."""
        return self.source is not None and not len(self.source) and not self.exhausted

    @property
    def waited(self):
        """Waiting time, float: for how long a reading has been waited for [s]; 0 when none is."""
        return 0.0 if self._reader is None else self._reader.waited

    def step(self, timeout=None):
        """Process the next reading: the source's own, else drive on by the last command.

        Parameters
        ----------
        timeout : float, how long to wait for the source [s], or None; what comes later is taken
            in by the next step

        Returns
        -------
        bool, whether there was one
        """
        self._require_source()
        reading = self._reader.next_reading(timeout)
        if self._reader.ended and self.drivable and self.command is not None:
            reading = self.source.drive(self.command)
        if reading is not None:
            self._process(reading)
        return reading is not None

    def drive(self, command):
        """Drive the robot for one step (teleoperation).

        Parameters
        ----------
        command : (2,) speed, turn rate [m/s, rad/s]

        Raises
        ------
        ValueError : a recording, or one that is not over yet
        """
        self._require_source()
        if not self.drivable:
            raise ValueError(f"{self.source.name} is a recording: it cannot be driven")
        if not self.played:
            raise ValueError(f"drive when all {len(self.source)} recorded readings are played")
        reading = self.source.drive(command)
        if reading is not None:  # a real robot's readings come in their own time
            self._process(reading)

    def _require_source(self):
        if self._reader is None:
            raise ValueError("there is no source to read: reset tries again")

    def _process(self, reading):
        self.count, self.time = self.count + 1, reading.time
        for estimator in (self.estimator, *self.others.values()):
            estimator.step(reading)
        for panel, measures in self._curves.items():
            for name, measure in measures.items():
                self._curve_values[panel][name].append((self.time, measure(self)))

    def scene(self):
        """Scene to draw now: layers, curves, status line.

        Returns
        -------
        Scene
        """
        return Scene(
            self._thinned(self._layers()) if self.count else [],
            self.status(),
            run=self.runs,
            colours=self._colours,
            curves=self._curve_values,
            **({} if self.source is None else {"radius": self.source.robot.radius}),
        )

    def _layers(self):
        beneath = [] if self._extra is None else list(self._extra(self))
        return beneath + run_layers(
            self.source, self.estimator, self.others, self.count, self._truth
        )

    def status(self):
        """Status line: step, time, the estimator's status, the note.

        Returns
        -------
        str
        """
        late = f"no reading for {self.waited:.0f} s" if self.waited >= 1 else ""
        if not self.count:
            return late or "no reading yet"
        note = self._note(self) if self._note is not None else ""
        more = self.estimator.status, note, late
        return step_line(self.count, len(self.source), self.time, *more)


def _make(maker, material):
    return maker(material) if callable(maker) else maker
