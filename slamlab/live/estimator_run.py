"""Run of an estimator on a source, reading by reading, and its scene."""

import numpy as np

from slamlab.live.frame_packing import Scene
from slamlab.live.reading_thread import background_reader
from slamlab.live.run_scene import run_layers, step_line
from slamlab.live.voxel_filter import CloudDownsampling


class EstimatorRun:
    """Run of an estimator on a source, both created from a seed; see ``live.watch``."""

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
        self._truth, self._colours, self._downsample = truth, colours, CloudDownsampling()
        self.runs, self.count, self.time, self._used = 0, 0, 0.0, False
        self.source, self._reader, self._curve_values = None, None, {}

    def reset(self, seed, timeout=None):
        """Create a new source and estimators, and process the first reading within a timeout [s].
        ValueError: a ready-made estimator was already used.
        """
        if not callable(self._make_estimator) and self._used:
            raise ValueError("this estimator was already used: pass a function that creates one")
        self.close()
        self.runs, self.count, self.time, self.command = self.runs + 1, 0, 0.0, None
        self._curve_values = {
            panel: {name: [] for name in of} for panel, of in self._curves.items()
        }
        self.source = self._reader = None  # it stays None if the source cannot be opened
        self.source = _make(self._make_source, np.random.default_rng(seed))
        self.estimator = _make(self._make_estimator, self.source)
        self.others = {name: make(self.source) for name, make in self._beside.items()}
        self._reader, self._used = background_reader(self.source), True
        self.step(timeout)

    def close(self):
        if self.source is not None and callable(self._make_source):
            self.source.close()

    @property
    def drivable(self):
        return getattr(self.source, "drivable", False)

    @property
    def played(self):
        return self.count >= len(self.source)

    @property
    def exhausted(self):
        """Whether the source yields no more readings unless it is driven."""
        return self._reader is None or self._reader.ended or 0 < len(self.source) <= self.count

    @property
    def live(self):
        """Whether readings arrive in real time."""
        return self.source is not None and not len(self.source) and not self.exhausted

    @property
    def waited(self):
        """Time since the beginning of the wait for a reading [s]."""
        return 0.0 if self._reader is None else self._reader.waited

    def step(self, timeout=None):
        """Process the next reading within a timeout [s], or drive the robot; return whether there
        was a reading.
        """
        self._require_source()
        reading = self._reader.next_reading(timeout)
        if self._reader.ended and self.drivable and self.command is not None:
            reading = self.source.drive(self.command)
        if reading is not None:
            self._process(reading)
        return reading is not None

    def drive(self, command):
        """Drive one step at (speed, turn rate) [m/s, rad/s]. ValueError: the source cannot be
        driven now.
        """
        self._require_source()
        if not self.drivable:
            raise ValueError(f"{self.source.name} is a recording: there is no robot to drive")
        if not self.played:
            raise ValueError(
                f"you can drive after the last of {len(self.source)} recorded readings"
            )
        reading = self.source.drive(command)
        if reading is not None:  # a real robot's readings arrive later
            self._process(reading)

    def _require_source(self):
        if self._reader is None:
            raise ValueError("the source is closed: reset opens it again")

    def _process(self, reading):
        self.count, self.time = self.count + 1, reading.time
        for estimator in (self.estimator, *self.others.values()):
            estimator.step(reading)
        for panel, measures in self._curves.items():
            for name, measure in measures.items():
                self._curve_values[panel][name].append((self.time, measure(self)))

    def scene(self):
        return Scene(
            self._downsample(self._layers()) if self.count else [],
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
        late = f"no reading for {self.waited:.0f} s" if self.waited >= 1 else ""
        if not self.count:
            return late or "no reading yet"
        note = self._note(self) if self._note is not None else ""
        notes = getattr(self.source, "notes", ()) if self.live else ()
        more = self.estimator.status, note, late, *notes
        return step_line(self.count, len(self.source), self.time, *more)


def _make(maker, material):
    return maker(material) if callable(maker) else maker
