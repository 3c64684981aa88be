import numpy as np
import pytest

from repro.seed_sequences import seeds
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


@pytest.mark.parametrize("root_seed", [0, 7, 2**32, 2**70 + 3, 2**140 + 5])
@pytest.mark.parametrize("words", [3, 4])
def test_seeds_are_those_of_numpy(root_seed, words):
    keys = np.array([[0, 1, 2, 1], [2**32 - 1, 0, 0, 1], [5, 6, 2**32 - 1, 1]])[:, :words]
    sequences = [np.random.SeedSequence(root_seed, spawn_key=key) for key in keys.tolist()]
    for count in (1, 4):
        expected = [sequence.generate_state(count, np.uint64) for sequence in sequences]
        np.testing.assert_array_equal(seeds(root_seed, keys, count), expected)
