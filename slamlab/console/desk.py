"""Desk of a live run: what pages and the terminal may do with it, and who drives."""

import asyncio

from slamlab.console.lease import Lease
from slamlab.console.watchers import Watchers
from slamlab.views.live.drive_commands import COMMANDS, parse_command
from slamlab.views.live.live_view import still_picture
from slamlab.views.live.run_loop import RunLoop
from slamlab.views.showing import png

TICK = 0.05  # [s] between looks whether somebody drives
FRAME_RATE = 60  # frames a second, at most
TERMINAL = "the terminal"
SPEEDS = (1, 2, 5, 10, 20, 50, 100)  # [steps/s]
SIZE = 860, 560  # of the picture [CSS pixels]
STANDS = "the robot stands"


class Desk:
    """The run, its lease, its map and film; each who acts is known by a word or a page.

    Parameters
    ----------
    stepper : FilmedStepper, reset already
    title : str
    seed : int, of the stepper as it stands
    speed : float, steps a second
    map_file : Path or None, where to save the map
    lease : Lease

    ``over`` is set when the run is to end, ``said`` is what everybody is to know.
    """

    def __init__(self, stepper, title, seed=0, speed=20, map_file=None, lease=None):
        self.stepper, self.title, self._map_file = stepper, title, map_file
        self.watchers, self.lease, self.over = Watchers(), lease or Lease(), asyncio.Event()
        self.loop = RunLoop(stepper, self.watchers, seed, speed, play=True, frame_rate=FRAME_RATE)
        self.said, self._saving, self.sockets = "", None, set()
        self.loop.show()

    @property
    def control(self):
        """The loop's DriveControl."""
        return self.loop.drive_control

    def execute(self, who, text):
        """Do what a typed line says.

        Parameters
        ----------
        who : hashable, by whom
        text : str, ``distance, angle`` [m, degree], ``reset``, ``exit``, or a word of a button

        Returns
        -------
        str, what is done

        Raises
        ------
        ValueError : it means nothing or cannot be done now; the text says why
        """
        word = text.strip().lower()
        if word == "" or word in COMMANDS or word in self._buttons:
            return self.press(who, word or "stop")
        parsed = parse_command(text)
        self.lease.take(who)
        if parsed == "exit":
            self.over.set()
            return "ended: the robot stands"
        said = self.control.execute(text)
        self._renewed()
        return said

    def press(self, who, name):
        """Press a button by its name.

        Parameters
        ----------
        who : hashable, by whom
        name : str

        Returns
        -------
        str, what is done

        Raises
        ------
        ValueError : there is no such button, or it cannot be used now
        """
        if name in ("stop", "pause"):  # whoever sees danger ends it
            self.stand()
            if name == "pause":
                self.loop.pause()
            return STANDS if name == "stop" else "paused"
        if name in COMMANDS:
            return self._drive(who, name)
        if name not in self._buttons:
            raise ValueError(f"there is no button {name[:20]!r}")
        if self.lease.holder not in (None, who):
            self.lease.take(who)  # says why not
        return self._buttons[name]() or ""

    @property
    def _buttons(self):
        return {
            "run": self.loop.run,
            "pause": self.loop.pause,
            "step": self.loop.step,
            "map": self.save_map,
            "film": self._toggle_film,
        }

    def set_speed(self, who, speed):
        """Set how many steps a second are made; only what is on offer."""
        if speed in SPEEDS and self.lease.holder in (None, who):
            self.loop.speed = speed

    def renew(self, who):
        """Who drives is still there; the robot may go on."""
        if self.lease.renew(who):
            self._renewed()

    def leave(self, who):
        """Somebody has gone: if it was the driver, the robot stands."""
        if self.lease.holder == who:
            self.lease.release(who)
            self.stand()

    def stand(self):
        """The robot stands."""
        self.control.set_velocity(None)

    def changed(self):
        """Tell every page what has changed beside the picture."""
        for socket in tuple(self.sockets):
            socket.tell_state()

    def tick(self):
        """Look whether somebody drives; without, the robot stands. To be called all the time."""
        if not self.control.moving:
            self.lease.release(self.lease.holder)
        elif self.lease.holder == TERMINAL:  # lives as long as this program
            self.renew(TERMINAL)
        elif self.lease.holder is None:
            self.stand()

    def state(self, who):
        """What a page shows beside the picture.

        Returns
        -------
        dict
        """
        holder = self.lease.holder
        drives = {None: "", who: "you", TERMINAL: "the terminal"}.get(holder, "another page")
        return {
            "kind": "state",
            "title": self.title,
            "size": SIZE,
            "running": self.loop.running,
            "drivable": bool(self.stepper.drivable),
            "drives": drives,
            "speed": self.loop.speed,
            "speeds": SPEEDS,
            "map": None if self._map_file is None else self._map_file.name,
            "film": self.stepper.filming if self.stepper.filmed else None,
            "said": self.said,
        }

    def save_map(self):
        """Save the picture as it is now; a thread draws it."""
        if self._map_file is None:
            raise ValueError("say --map FILE.png when you start: then the map can be saved")
        if self._saving is not None and not self._saving.done():
            raise ValueError("the map is being saved already")
        scene = self.stepper.scene()
        self._saving = asyncio.get_running_loop().create_task(self._write_map(scene))
        return "saving the map"

    async def _write_map(self, scene):
        def write():
            self._map_file.write_bytes(png(still_picture(scene, self.title, SIZE)))

        try:
            await asyncio.to_thread(write)
        except OSError as error:
            self.said = f"{self._map_file.name} cannot be written: {error.strerror}"
        else:
            self.said = f"the map of step {self.stepper.count} is in {self._map_file.name}"

    def _toggle_film(self):
        if not self.stepper.filmed:
            raise ValueError("say --film FILE when you start: then the run is filmed")
        self.stepper.filming = not self.stepper.filming
        return "the film goes on" if self.stepper.filming else "the film pauses"

    def _drive(self, who, name):
        pair = self.stepper
        if not pair.drivable:
            raise ValueError("there is no robot here that could be driven: a recording plays")
        if not pair.played:
            raise ValueError(f"drive when all {len(pair.source)} recorded readings are played")
        self.lease.take(who)
        if not self.loop.running:
            self.loop.run()
        self.loop.drive(name)
        self._renewed()
        return ""

    def _renewed(self):
        if self.stepper.source is not None:
            self.stepper.source.renew()
