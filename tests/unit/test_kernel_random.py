"""The counter-based generator: published vectors, laws, independence."""

import numpy as np
import pytest
from scipy.stats import kstest

from repro.kernels import random
from repro.streams import Streams

TRIALS, COUNT = 6, 40_000


def keys(trials=TRIALS, first=0):
    return Streams(3, "random", "filter:test", range(first, first + trials)).keys()


def words(text):
    return [np.uint64(int(word, 16)) for word in text.split()]


@pytest.mark.parametrize(
    ("counter_and_key", "wanted"),
    [
        (" ".join(6 * ["0"]), "6627e8d5 e169c58d bc57ac4c 9b00dbd8"),
        (" ".join(6 * ["ffffffff"]), "408f276d 41c83b0e a20bc7c6 6d5451fd"),
        (
            "243f6a88 85a308d3 13198a2e 03707344 a4093822 299f31d0",
            "d16cfe09 94fdcceb 5001e420 24126ea1",
        ),
    ],
)
def test_published_vectors(counter_and_key, wanted):
    """Known answers of the authors' library, Random123, for philox4x32 of 10 rounds."""
    assert list(random.philox(*words(counter_and_key))) == words(wanted)


def uniforms(step=1, of=None, count=COUNT):
    of = keys() if of is None else of
    out = np.empty((len(of), count))
    random.uniforms_of(of, step, random.MOTION, out)
    return out


def normals(step=1, of=None, count=2 * COUNT, purpose=random.MOTION):
    of = keys() if of is None else of
    out = np.empty((len(of), count))
    random.normals_of(of, step, purpose, out)
    return out


def test_uniforms():
    drawn = uniforms()
    assert drawn.min() > 0 and drawn.max() < 1
    assert kstest(drawn.ravel(), "uniform").pvalue > 1e-3
    assert kstest(drawn[0] * 2**14 % 1, "uniform").pvalue > 1e-3  # the lower bits


def test_normals():
    drawn = normals()
    assert kstest(drawn.ravel(), "norm").pvalue > 1e-3
    n = drawn.size
    for power, moment, variance in ((1, 0, 1), (2, 1, 2), (3, 0, 15), (4, 3, 96)):
        assert (drawn**power).mean() == pytest.approx(moment, abs=4.5 * np.sqrt(variance / n))


def test_trials_steps_purposes_and_pairs_are_uncorrelated():
    drawn = [normals(step) for step in (1, 2)] + [normals(purpose=random.PRIOR)]
    rows = np.concatenate([d.reshape(-1, COUNT) for d in drawn])
    rows = np.concatenate([rows, np.roll(rows[:4], 1, axis=1)])
    correlation = np.corrcoef(rows) - np.eye(len(rows))
    assert np.abs(correlation).max() < 5 / np.sqrt(COUNT)
    squares = np.corrcoef(rows**2) - np.eye(len(rows))
    assert np.abs(squares).max() < 5 / np.sqrt(COUNT)


def test_nothing_depends_on_the_other_trials():
    together, alone = normals(), normals(of=keys(1, first=4))
    np.testing.assert_array_equal(together[4], alone[0])
    np.testing.assert_array_equal(uniforms(count=12)[:, 3:6], uniforms(count=40)[:, 10:13])
    assert len(np.unique(keys(1000))) == 1000
    assert keys(0).shape == (0,)


def test_golden_values():
    """They change only on purpose, and are the same on every machine."""
    assert keys(2).tolist() == KEYS
    drawn = normals(of=keys(1), count=8)[0]
    assert [value.hex() for value in drawn.tolist()] == NORMALS


KEYS = [16107363376583637969, 12596584535804847665]
NORMALS = [
    "-0x1.94a9fbf5e2558p-3",
    "-0x1.4411b4a8e85efp+0",
    "-0x1.80abb6ebf3c42p-1",
    "-0x1.1b84114c96f4ep-1",
    "-0x1.d48291417f05ap-2",
    "0x1.7cbccec978b6ep-6",
    "-0x1.3cb2f5254c046p-1",
    "0x1.2622171a29809p-1",
]
