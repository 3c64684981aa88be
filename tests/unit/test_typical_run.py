"""The run that a figure shows: the median of those that qualify."""

import numpy as np

from repro.statistics.typical_run import typical_run

ERROR = np.array([5.0, 1.0, 4.0, 2.0, 3.0])


def test_it_is_the_median_of_all_runs():
    shown = typical_run([ERROR])
    assert (shown.trial, shown.ranks, shown.among) == (4, (3,), 5)
    assert shown.words == "run 4, rank 3 of 5 by error"


def test_only_runs_that_qualify_count():
    shown = typical_run([ERROR], np.array([True, False, True, False, True]))
    assert (shown.trial, shown.ranks, shown.among) == (2, (2,), 3)


def test_all_runs_count_where_none_qualifies():
    assert typical_run([ERROR], np.zeros(5, dtype=bool)) == typical_run([ERROR])


def test_of_several_curves_no_one_is_far_from_its_middle():
    other = np.array([3.0, 1.0, 2.5, 2.0, 9.0])  # its median is that of run 2, next in ERROR
    shown = typical_run([ERROR, other])
    assert (shown.trial, shown.ranks) == (2, (4, 3))
    assert shown.words == "run 2, ranks 3 to 4 of 5 by error"


def test_a_run_that_was_lost_is_no_median():
    assert typical_run([np.array([np.nan, 2.0, 1.0, 3.0, np.inf])]).trial == 3
