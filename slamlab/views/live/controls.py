"""The buttons of a live view: run, pause, step, reset, speed, seed, which source, drive, a line."""

import ipywidgets

SPEEDS = [1, 2, 5, 10, 20, 50, 100]  # steps a second
ARROWS = {"left": "◀ left", "forward": "▲ forward", "back": "▼ back", "right": "right ▶"}
HINT = "or click the picture, then arrow keys; space stops"
TYPED = "distance, angle"


class Controls:
    """Widgets that tell a loop what to do and show what it does.

    Parameters
    ----------
    loop : Loop
    pairs : dict, title to Pair; one button each where there are several
    """

    def __init__(self, loop, pairs):
        self.loop, self._pairs = loop, pairs
        self.which = [_button(title, "start with this one", self._chosen(title)) for title in pairs]
        self.run = _button("▶ run", "step after step", self._run, "8em")
        self.step = _button("step", "one step, then pause", loop.step, "5em")
        self.reset = _button("reset", "from the start, with this seed", self._reset, "5em")
        self.speed = ipywidgets.SelectionSlider(
            options=SPEEDS,
            value=min(SPEEDS, key=lambda each: abs(each - loop.speed)),
            description="steps/s",
            layout={"width": "17em", "margin": "2px 2px 2px 12px"},
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
            _button(text, "one step, or where to while it runs", self._driven(name))
            for name, text in ARROWS.items()
        ]
        self.drive.append(_button("■ stop", "stand still", self._driven("stop")))
        self.speed.observe(self._faster, "value")
        loop.on_change = self._changed
        hint = [ipywidgets.Label(HINT)] if loop.screen.keys else []
        self.typed = ipywidgets.Text(
            placeholder=f"{TYPED} [m, °] | reset | exit",
            description=TYPED,
            continuous_update=False,
            layout={"width": "25em"},
            style={"description_width": "initial"},
        )
        self.answer = ipywidgets.Label()
        self.typed.observe(self._told, "value")
        rows = ([*self.drive, *hint], [self.typed, self.answer])
        self._wheel = ipywidgets.VBox([ipywidgets.HBox(row, layout=_WRAPPED) for row in rows])
        first = ipywidgets.HBox(self.which, layout=_WRAPPED if len(pairs) > 1 else _GONE)
        second = [self.run, self.step, self.reset, self.speed, self.seed]
        second = ipywidgets.HBox(second, layout=_WRAPPED)
        self.widget = ipywidgets.VBox([first, second, self._wheel])
        self._changed()

    def _run(self):
        if self.loop.running:
            self.loop.pause()
        else:
            self.loop.run()

    def _reset(self):
        self.loop.reset(self.seed.value)

    def _faster(self, change):
        self.loop.speed = change["new"]

    def _told(self, change):
        if not change["new"].strip():
            return
        try:
            self.answer.value = self.loop.wheel.tell(change["new"])
        except ValueError as error:
            self.answer.value = str(error)
        self.typed.value = ""

    def _chosen(self, title):
        return lambda: self.loop.reset(self.seed.value, self._pairs[title])

    def _driven(self, name):
        return lambda: self.loop.drive(name)

    def _changed(self):
        self.run.description = "❚❚ pause" if self.loop.running else "▶ run"
        self._wheel.layout.display = "flex" if self.loop.pair.drivable else "none"
        for button, pair in zip(self.which, self._pairs.values(), strict=True):
            button.button_style = "info" if pair is self.loop.pair else ""


_WRAPPED = {"flex_flow": "row wrap", "align_items": "center"}
_GONE = {"display": "none"}


def _button(text, tooltip, pressed, width="auto"):
    button = ipywidgets.Button(description=text, tooltip=tooltip, layout={"width": width})
    button.on_click(lambda _: pressed())
    return button
