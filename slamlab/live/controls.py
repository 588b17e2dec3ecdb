"""Control panel of a live view: buttons, sliders, typed moves."""

from slamlab.extras import needs

with needs("notebook"):
    import ipywidgets

SPEEDS = [1, 2, 5, 10, 20, 50, 100]  # choices of the slider [steps/s]
# labels of the buttons by drive command
DRIVE_BUTTONS = {"left": "◀ left", "forward": "▲ forward", "back": "▼ back", "right": "right ▶"}
KEYBOARD_HINT = "or click the picture and use the arrow keys; Space stops"  # keyboard driving
MOVE_LABEL = "distance, angle"  # of a typed move


class Controls:
    """Widgets that control a run loop, with a button for each of several sources."""

    def __init__(self, loop, runs):
        self.loop, self._runs = loop, runs
        self.source_buttons = [
            _button(title, "Start with this source", self._select_source(title)) for title in runs
        ]
        self.run = _button("▶ run", "Run step by step", self._run, "8em")
        self.step = _button("step", "Make one step, then pause", loop.step, "5em")
        self.reset = _button("reset", "Start again with this seed", self._reset, "5em")
        self.speed = ipywidgets.SelectionSlider(
            options=SPEEDS,
            value=min(SPEEDS, key=lambda each: abs(each - loop.speed)),
            description="steps/s",
            layout={"width": "17em", "max_width": "100%", "margin": "2px 2px 2px 12px"},
            style={"description_width": "initial"},
        )
        self.seed = ipywidgets.BoundedIntText(
            loop.seed,
            min=0,
            max=2**31 - 1,
            description="seed",
            layout={"width": "9em"},
            style={"description_width": "initial"},
        )
        self.drive = [
            _button(text, "Make one step, or steer while it runs", self._drive_command(name))
            for name, text in DRIVE_BUTTONS.items()
        ]
        self.drive.append(_button("■ stop", "Stop the robot", self._drive_command("stop")))
        self.speed.observe(self._set_speed, "value")
        loop.on_change = self._refresh
        hint = [ipywidgets.HTML(KEYBOARD_HINT)] if loop.screen.keys else []
        self.typed = ipywidgets.Text(
            placeholder=f"{MOVE_LABEL} [m, °] | reset | exit",
            description=MOVE_LABEL,
            continuous_update=False,
            layout={"width": "25em", "max_width": "100%"},
            style={"description_width": "initial"},
        )
        self.answer = ipywidgets.Label()  # until the next line or button
        for button in (*self.source_buttons, self.run, self.step, self.reset, *self.drive):
            button.on_click(lambda _: self.answer.set_trait("value", ""))
        self.typed.observe(self._submit_line, "value")
        rows = ([*self.drive, *hint], [self.typed, self.answer])
        self._drive_box = ipywidgets.VBox([ipywidgets.HBox(row, layout=_WRAPPED) for row in rows])
        shown = _WRAPPED if len(runs) > 1 else {"display": "none"}
        source_row = ipywidgets.HBox(self.source_buttons, layout=shown)
        run_row = [self.run, self.step, self.reset, self.speed, self.seed]
        run_row = ipywidgets.HBox(run_row, layout=_WRAPPED)
        self.widget = ipywidgets.VBox([source_row, run_row, self._drive_box])
        self._refresh()

    def _run(self):
        if self.loop.running:
            self.loop.pause()
        else:
            self.loop.run()

    def _reset(self):
        self.loop.reset(self.seed.value)

    def _set_speed(self, change):
        self.loop.speed = change["new"]

    def _submit_line(self, change):
        if not change["new"].strip():
            return
        try:
            self.answer.value = self.loop.drive_control.execute(change["new"])
        except ValueError as error:
            self.answer.value = str(error)
        self.typed.value = ""

    def _select_source(self, title):
        return lambda: self.loop.reset(self.seed.value, self._runs[title])

    def _drive_command(self, name):
        return lambda: self.loop.drive(name)

    def _refresh(self):
        self.run.description = "❚❚ pause" if self.loop.running else "▶ run"
        self._drive_box.layout.display = "flex" if self.loop.pair.drivable else "none"
        for button, run in zip(self.source_buttons, self._runs.values(), strict=True):
            button.button_style = "info" if run is self.loop.pair else ""


_WRAPPED = {"flex_flow": "row wrap", "align_items": "center"}


def _button(text, tooltip, pressed, width="auto"):
    button = ipywidgets.Button(description=text, tooltip=tooltip, layout={"width": width})
    button.on_click(lambda _: pressed())
    return button
