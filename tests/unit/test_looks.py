"""Colours and markers of the filters, those of a reader's own among them."""

import numpy as np
import pytest
from matplotlib import colors, pyplot

from repro.plot import looks, style
from repro.plot.looks import LOOKS, RESERVE, look
from tests.conftest import catalogue

OWN = [f"mine_{i}" for i in range(20)]


def pair(filter_, own=()):
    of = look(filter_, own)
    return of["color"], of["marker"]


def test_every_filter_of_the_catalogue_has_a_colour_and_marker_of_its_own_in_all_studies():
    every = {f for points in catalogue().values() for filters in points.values() for f in filters}
    assert every <= LOOKS.keys()
    assert len({pair(name) for name in every}) == len(every)
    for points in catalogue().values():
        study = {name for filters in points.values() for name in filters}
        assert len({look(name, ())["color"] for name in study}) == len(study)


def test_values_of_a_parameter_are_shades_of_one_hue_from_light_to_dark():
    drawn = [colors.rgb_to_hsv(colors.to_rgb(shade)) for shade in looks.shades(looks.BLUE, 5)]
    brightness = [sum(colors.to_rgb(shade)) for shade in looks.shades(looks.BLUE, 5)]
    assert brightness == sorted(brightness, reverse=True)
    assert np.ptp([hue for hue, *_ in drawn]) < 0.02
    assert looks.shades(looks.BLUE, 1) == [looks.BLUE.lower()]


def test_a_new_filter_changes_no_other_and_shares_with_none():
    names = [*LOOKS]
    for number in range(len(OWN)):
        own, fewer = OWN[: number + 1], OWN[:number]
        for name in (*names, *fewer):
            assert look(name, own) == look(name, fewer)
        assert pair(own[-1], own) not in {pair(name, fewer) for name in (*names, *fewer)}


def test_reserve_colours_are_no_listed_ones():
    reserved = [colour for colour, _ in RESERVE]
    assert not set(reserved) & {colour for colour, _ in LOOKS.values()}
    assert len(set(reserved)) == len(reserved)
    first = [pair(name, OWN)[0] for name in OWN[: len(RESERVE)]]
    assert first == reserved


def test_a_filter_that_a_readers_parameter_file_ranks_has_a_reserved_look():
    assert pair("of_a_study_of_ones_own")[0] in {colour for colour, _ in RESERVE}


def test_what_uses_no_measurement_is_dashed():
    assert [look(name, ())["linestyle"] for name in looks.BASELINES] == ["--", "--"]


@pytest.mark.parametrize("curves", [[[0, 0, 0]], [[np.nan, np.nan]], [[0, 1, 2], [1e30, 1e31]], []])
def test_an_axis_of_errors_takes_zeros_gaps_and_divergence(curves):
    drawn, axes = style.figure()
    for curve in curves:
        axes.plot(range(len(curve)), curve)
    style.error_axis(axes, "y")
    drawn.canvas.draw()
    assert axes.get_ylim()[1] < 1e6
    pyplot.close(drawn)
