"""Devices benchmark: it decodes one second of bytes to whole turns, as stated."""

import pytest

from benchmarks.devices import BAUD, MODES, decode, second


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
def test_a_second_of_bytes_is_one_and_gives_its_turns(mode):
    pieces = second(mode)
    # 85 to 94 % of what the line can carry, and all of it read
    assert sum(map(len, pieces)) * 10 / BAUD == pytest.approx(0.9, abs=0.06)
    one_second = decode(mode, pieces)
    assert sum(one_second() for _ in range(4)) == pytest.approx(39, abs=2)
