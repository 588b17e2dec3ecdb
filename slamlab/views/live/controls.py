"""Control panel of a live view: run, pause, step, reset, speed, seed, source, teleoperation."""

import ipywidgets

SPEEDS = [1, 2, 5, 10, 20, 50, 100]  # choices of the slider [steps/s]
# labels of the buttons by drive command
DRIVE_BUTTONS = {"left": "◀ left", "forward": "▲ forward", "back": "▼ back", "right": "right ▶"}
KEYBOARD_HINT = "or click the picture, then arrow keys; space stops"  # keyboard driving
MOVE_LABEL = "distance, angle"  # of a typed move


class Controls:
    """Widgets (buttons, sliders, text field) that control a run loop and show its state.

    Parameters
    ----------
    loop : RunLoop
    steppers : dict, title to Stepper; one button each where there are several
    """

    def __init__(self, loop, steppers):
        self.loop, self._steppers = loop, steppers
        self.source_buttons = [
            _button(title, "start with this one", self._select_source(title)) for title in steppers
        ]
        self.run = _button("▶ run", "step after step", self._run, "8em")
        self.step = _button("step", "one step, then pause", loop.step, "5em")
        self.reset = _button("reset", "from the start, with this seed", self._reset, "5em")
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
            _button(text, "one step, or where to while it runs", self._drive_command(name))
            for name, text in DRIVE_BUTTONS.items()
        ]
        self.drive.append(_button("■ stop", "stand still", self._drive_command("stop")))
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
        self.answer = ipywidgets.Label()
        self.typed.observe(self._submit_line, "value")
        rows = ([*self.drive, *hint], [self.typed, self.answer])
        self._drive_box = ipywidgets.VBox([ipywidgets.HBox(row, layout=_WRAPPED) for row in rows])
        first = ipywidgets.HBox(
            self.source_buttons, layout=_WRAPPED if len(steppers) > 1 else _GONE
        )
        second = [self.run, self.step, self.reset, self.speed, self.seed]
        second = ipywidgets.HBox(second, layout=_WRAPPED)
        self.widget = ipywidgets.VBox([first, second, self._drive_box])
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
        return lambda: self.loop.reset(self.seed.value, self._steppers[title])

    def _drive_command(self, name):
        return lambda: self.loop.drive(name)

    def _refresh(self):
        self.run.description = "❚❚ pause" if self.loop.running else "▶ run"
        self._drive_box.layout.display = "flex" if self.loop.pair.drivable else "none"
        for button, stepper in zip(self.source_buttons, self._steppers.values(), strict=True):
            button.button_style = "info" if stepper is self.loop.pair else ""


_WRAPPED = {"flex_flow": "row wrap", "align_items": "center"}
_GONE = {"display": "none"}


def _button(text, tooltip, pressed, width="auto"):
    button = ipywidgets.Button(description=text, tooltip=tooltip, layout={"width": width})
    button.on_click(lambda _: pressed())
    return button
