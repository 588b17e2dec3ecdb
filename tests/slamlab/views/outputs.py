"""Displays of a cell that nobody sees: what a notebook would keep of it."""

ALT = "two walls that meet"


class Displays:
    """Stands for IPython: remembers what is displayed, and the widgets that modules show."""

    def __init__(self, monkeypatch, *modules):
        self.widgets, self.bundles, outer = [], [], self

        class Handle:
            """Stands for IPython's DisplayHandle."""

            def display(self, data, raw):
                assert raw
                self.place = len(outer.bundles)
                outer.bundles.append(data)

            def update(self, data, raw):
                assert raw
                outer.bundles[self.place] = data

        monkeypatch.setattr("IPython.display.DisplayHandle", Handle)
        for module in modules:
            monkeypatch.setattr(module, "show_controls", self.widgets.append)
