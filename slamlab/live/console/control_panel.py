"""Control panel of a live run: commands of pages and the terminal, and the drive lock."""

import asyncio

from slamlab.live.console.drive_lock import DriveLock
from slamlab.live.console.page_screens import PageScreens
from slamlab.live.drive_control import COMMANDS, NOT_DRIVABLE, parse_command
from slamlab.live.run_loop import RunLoop
from slamlab.live.run_scene import still_picture
from slamlab.views.figure_display import png

TICK = 0.05  # [s] between two checks of the drive lock
FRAME_RATE = 60  # frames a second, at most
TERMINAL = "the terminal"
SPEEDS = (1, 2, 5, 10, 20, 50, 100)  # [steps/s]
SIZE = 860, 560  # of the picture [CSS pixels]
STOPPED = "the robot stops"
MESSAGES = {"run": "the run goes on", "step": "one step"}


class ControlPanel:
    """The run, its drive lock, map and film. ``who`` is the client: a name or a page's screen.
    ``run`` must already be reset. Set ``ended`` to end the run. All clients see ``message``.
    """

    def __init__(self, run, title, seed=0, speed=20, map_file=None, lock=None):
        self.run, self.title, self._map_file = run, title, map_file
        self.screens, self.lock, self.ended = PageScreens(), lock or DriveLock(), asyncio.Event()
        self.loop = RunLoop(run, self.screens, seed, speed, play=True, frame_rate=FRAME_RATE)
        self.message, self._saving, self.sockets = "", None, set()
        self.loop.show()

    @property
    def control(self):
        return self.loop.drive_control

    def execute(self, who, text):
        """Execute a typed "distance, angle" [m, degree] or word and return a message. ValueError:
        the command is invalid or cannot be executed.
        """
        word = text.strip().lower()
        if word == "" or word in COMMANDS or word in self._buttons:
            return self.press(who, word or "stop")
        parsed = parse_command(text)
        self.lock.acquire(who)
        if parsed == "exit":
            self.ended.set()
            return "ended"
        message = self.control.execute(text)
        self._renewed()
        return message

    def press(self, who, name):
        """Press a button and return a message. ValueError: the button cannot be used."""
        if name in ("stop", "pause"):  # any client may stop the robot
            self.stop()
            if name == "pause":
                self.loop.pause()
            return STOPPED if name == "stop" else "paused"
        if name in COMMANDS:
            return self._drive(who, name)
        if name not in self._buttons:
            raise ValueError(f"there is no button {name[:20]!r}")
        if self.lock.holder not in (None, who):
            self.lock.acquire(who)  # raises LockTaken
        return self._buttons[name]() or MESSAGES[name]

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
        if speed in SPEEDS and self.lock.holder in (None, who):
            self.loop.speed = speed

    def renew(self, who):
        if self.lock.renew(who):
            self._renewed()

    def leave(self, who):
        """Remove a client; if it drives, stop the robot."""
        if self.lock.holder == who:
            self.lock.release(who)
            self.stop()

    def stop(self):
        self.control.set_velocity(None)

    def changed(self):
        for socket in tuple(self.sockets):
            socket.send_state()

    def tick(self):
        """Stop the robot if the drive lock has expired; called periodically."""
        if not self.control.moving:
            self.lock.release(self.lock.holder)
        elif self.lock.holder == TERMINAL:  # as long as this program runs
            self.renew(TERMINAL)
        elif self.lock.holder is None:
            self.stop()

    def state(self, who):
        holder = self.lock.holder
        driver = {None: "", who: "you", TERMINAL: "the terminal"}.get(holder, "another page")
        return {
            "kind": "state",
            "title": self.title,
            "size": SIZE,
            "running": self.loop.running,
            "drivable": bool(self.run.drivable),
            "driver": driver,
            "speed": self.loop.speed,
            "speeds": SPEEDS,
            "map": None if self._map_file is None else self._map_file.name,
            "film": self.run.filming if self.run.filmed else None,
            "message": self.message,
        }

    def save_map(self):
        if self._map_file is None:
            raise ValueError("to save the map, start with --map FILE.png")
        if self._saving is not None and not self._saving.done():
            raise ValueError("the map is already being saved")
        scene = self.run.scene()
        self._saving = asyncio.get_running_loop().create_task(self._write_map(scene))
        return "saving the map"

    async def save_last_map(self):
        """Write the map at the end of a run, unless it was saved before."""
        if self._map_file is not None and self._saving is None:
            self.save_map()
        if self._saving is not None:
            await self._saving

    async def _write_map(self, scene):
        def write():
            self._map_file.write_bytes(png(still_picture(scene, self.title, SIZE)))

        try:
            await asyncio.to_thread(write)
        except OSError as error:
            self.message = f"{self._map_file.name} cannot be written: {error.strerror}"
        else:
            self.message = f"the map of step {self.run.count} is in {self._map_file.name}"

    def _toggle_film(self):
        if not self.run.filmed:
            raise ValueError("to film the run, start with --film FILE")
        self.run.filming = not self.run.filming
        return "the film continues" if self.run.filming else "the film is paused"

    def _drive(self, who, name):
        run = self.run
        if not run.drivable:
            raise ValueError(NOT_DRIVABLE)
        if not run.played:
            raise ValueError(f"you can drive after the last of {len(run.source)} recorded readings")
        self.lock.acquire(who)
        if not self.loop.running:
            self.loop.run()
        self.loop.drive(name)
        self._renewed()
        return ""

    def _renewed(self):
        if self.run.source is not None:
            self.run.source.renew()
