"""Live page benchmark: its table has the stated rows."""

import pytest

from benchmarks import common, live_page


@pytest.mark.slow
def test_its_quickest_run_measures_pictures_and_clicks():
    try:
        rows = live_page.run(quick=True)
    except common.Missing as reason:
        pytest.skip(str(reason))
    reported = {row["name"].partition(":")[0] for row in rows}
    assert reported == {"click → picture", "pictures a second", "frames in transit, at most"}
    assert all(row["value"] > 0 for row in rows)
    assert all(row["value"] == 1 for row in rows if "in transit" in row["name"])
