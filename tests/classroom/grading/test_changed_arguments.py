"""Arguments are copies: changes in place are reported, and do not affect other calls."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from classroom.exercises.function_calls import FunctionCall, StudentError
from classroom.exercises.function_calls.changed_arguments import CHANGED, WatchedFunction

ARRAY = hnp.arrays(
    st.sampled_from([np.float64, np.int64, np.bool_]),
    hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=3),
)
LEAF = st.none() | st.integers() | st.floats() | st.text(max_size=3) | ARRAY
VALUE = st.recursive(
    LEAF,
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.lists(inner, max_size=3).map(tuple)
        | st.dictionaries(st.text(max_size=3), inner, max_size=3)
    ),
    max_leaves=6,
)


def changed(function, *arguments):
    watched = WatchedFunction(function)
    watched(*arguments)
    return watched.changed


def arrays_in(value):
    if isinstance(value, np.ndarray):
        return [value]
    items = value.values() if isinstance(value, dict) else value
    return (
        [a for i in items for a in arrays_in(i)] if isinstance(value, dict | list | tuple) else []
    )


def spoil(value):
    """Change all that can be changed in place."""
    for array in arrays_in(value):
        array[...] = ~array if array.dtype == bool else array + 1
    if isinstance(value, dict):
        value["new"] = 0
    elif isinstance(value, list):
        value.append(0)
    elif isinstance(value, tuple):
        for item in value:
            spoil(item)


def as_text(value):
    return repr([(a.shape, a.tobytes()) for a in arrays_in(value)]) + repr(value)


@given(st.lists(VALUE, max_size=3))
def test_commands_that_only_read_change_nothing(arguments):
    def look(*given):
        return [as_text(value) for value in given]

    assert changed(look, *arguments) == set()
    assert WatchedFunction(look)(*arguments) == look(*arguments)


@given(st.lists(VALUE, min_size=1, max_size=3))
def test_whatever_is_done_to_arguments_stays_with_the_copy(arguments):
    before = [as_text(value) for value in arguments]
    changed(lambda *given: [spoil(value) for value in given], *arguments)
    assert [as_text(value) for value in arguments] == before


@given(ARRAY.filter(lambda a: a.size and a.dtype != bool), st.data())
def test_one_number_of_an_array_is_enough_wherever_the_array_stands(array, data):
    place = data.draw(st.integers(0, array.size - 1))

    def change(_first, value):
        (array,) = arrays_in(value)
        array.reshape(-1)[place] = 1 if array.reshape(-1)[place] == 0 else 0

    for value in (array, [array], (array,), {"P": array}, [[], {"x": [(0, array)]}]):
        assert changed(change, 0.5, value) == {1}


def fill_first(m):
    m[1][0] = 7


def reshape(m):
    m[3].shape = (2, 2)


@pytest.mark.parametrize(
    "change",
    [dict.clear, lambda m: m.update({4: 0.5}), lambda m: m[1].sort(), lambda m: m[1].append(3),
     lambda m: m.update({2: 0.25}), fill_first, reshape],
)  # fmt: skip
def test_lists_dicts_and_shapes_are_watched(change):
    assert changed(change, {1: [2, 1], 2: 0.5, 3: np.arange(4.0)}) == {0}


@pytest.mark.parametrize(
    "harmless",
    [lambda x: x, lambda x: x[:2], lambda x: (x.__iadd__(1), x.__isub__(1)), lambda x: x.T],
    ids=["itself", "a view", "changed and undone", "transposed"],
)
def test_returning_an_argument_or_a_view_of_it_is_no_change(harmless):
    assert changed(harmless, np.arange(3.0)) == set()


def test_a_number_that_is_none_and_minus_nought_are_themselves():
    odd = np.array([np.nan, -0.0, np.inf])
    assert changed(lambda x: None, odd) == set()
    assert changed(lambda x: x.__setitem__(1, 0.0), odd) == {0}


def test_generators_and_other_objects_are_passed_as_they_are():
    rng, numbers, robot = np.random.default_rng(1), iter([1, 2, 3]), object()
    watched = WatchedFunction(lambda rng, numbers, *more: (rng.random(), list(numbers), *more))
    first = np.random.default_rng(1).random()
    assert watched(rng, numbers, robot, len) == (first, [1, 2, 3], robot, len)
    assert watched.changed == set()
    assert rng.random() != first  # it is the one that was given


def test_an_exception_goes_through_and_what_was_changed_before_it_is_known():
    def fails(x, y):
        y[0] = 5
        raise ValueError("as told")

    watched = WatchedFunction(fails)
    with pytest.raises(ValueError, match="as told"):
        watched(np.zeros(2), np.zeros(2))
    assert watched.changed == {1}


@pytest.mark.parametrize("count", [0, 1, 3])
def test_a_wrong_count_of_arguments_is_the_functions_own_mistake(count):
    watched = WatchedFunction(lambda a, b: a)
    with pytest.raises(TypeError, match="argument"):
        watched(*np.zeros((count, 2)))
    assert watched.changed == set()


def test_a_call_gets_what_the_last_one_left_alone():
    """A filter's loop that feeds its state back and keeps it: no call reaches into the past."""
    mean = np.zeros(2)

    def step(mean, z):
        mean += z
        return mean

    def loop(functions, inputs):
        kept = [mean]
        for z in inputs["z"]:
            kept.append(functions["step"](kept[-1], z))
        return {"path": np.array(kept)}

    z = np.array([[1.0, 2.0], [3.0, 4.0]])
    outputs = FunctionCall(("step",), loop)({"step": step}, {"z": z})
    np.testing.assert_array_equal(outputs["path"], [[0, 0], [1, 2], [4, 6]])
    np.testing.assert_array_equal(outputs[CHANGED], [0])
    assert not mean.any()


def test_each_function_of_a_call_is_watched_and_wrong_counts_are_reported():
    def run(functions, inputs):
        return {"a": functions["one"](inputs["x"]), "b": functions["other"](0.5, inputs["x"])}

    call, x = FunctionCall(("one", "other"), run), np.ones(2)
    outputs = call({"one": np.sort, "other": lambda a, x: x.fill(a)}, {"x": x})
    np.testing.assert_array_equal(outputs[CHANGED], [1])
    assert x.all()
    with pytest.raises(StudentError) as raised:
        call({"one": np.sort, "other": lambda x: x}, {"x": x})
    assert raised.value.kind == "raised"
    assert "TypeError" in raised.value.message
