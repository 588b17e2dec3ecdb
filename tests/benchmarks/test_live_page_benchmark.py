"""The live run's own page is measured: its table holds what is promised of it."""

import pytest

from benchmarks import common, live_page


@pytest.mark.slow
def test_its_quickest_run_measures_pictures_and_clicks():
    try:
        rows = live_page.run(quick=True)
    except common.Missing as reason:
        pytest.skip(str(reason))
    told = {row["name"].partition(":")[0] for row in rows}
    assert told == {"click → picture", "pictures a second", "frames on their way, at most"}
    assert all(row["value"] > 0 for row in rows)
    assert all(row["value"] == 1 for row in rows if "on their way" in row["name"])
