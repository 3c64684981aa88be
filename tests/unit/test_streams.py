import numpy as np

from repro.streams import Streams

GOLDEN = [-2.2044983501411135, -1.1146374632991198]


def draw(study="radar", role="sensor", trials=(0, 1, 2), seed=7):
    return Streams(seed, study, role, trials).standard_normal(4)


def test_a_stream_depends_on_its_name_alone():
    np.testing.assert_array_equal(draw()[1], draw(trials=(1,))[0])
    np.testing.assert_array_equal(draw(), draw())


def test_every_part_of_the_name_matters():
    drawn = [draw(), draw(study="ungm"), draw(role="process"), draw(trials=(3, 4, 5)), draw(seed=8)]
    numbers = np.concatenate(drawn).ravel()
    assert len(np.unique(numbers)) == len(numbers)


def test_streams_are_what_they_were():
    """Golden: a change of the naming would change every published comparison."""
    np.testing.assert_allclose(draw()[2, :2], GOLDEN, rtol=1e-15)
