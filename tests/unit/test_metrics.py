import numpy as np
import pytest

from repro.statistics import metrics
from repro.statistics.runs import Runs, RunsWriter, read_runs
from repro.statistics.shards import Columns
from repro.tables.results import Results

VALUES = np.random.default_rng(5).gamma(2.0, size=(40, 3))
STATISTICS = (
    metrics.mean,
    metrics.root_mean,
    lambda squared: metrics.statistic(metrics.roots_over_steps(squared)),
)


def test_jackknife_is_the_brute_force_one():
    statistic = metrics.root_mean(columns(VALUES, 1))
    left_out = np.array([np.sqrt(np.delete(VALUES, i, axis=0).mean(axis=0)) for i in range(40)])
    spread = ((left_out - left_out.mean(axis=0)) ** 2).sum(axis=0)
    np.testing.assert_allclose(statistic.mcse, np.sqrt(39 / 40 * spread))
    np.testing.assert_allclose(statistic.value, np.sqrt(VALUES.mean(axis=0)))


def test_standard_errors_cover_the_truth():
    """The mean of gamma(2) is 2: 3 standard errors hold it in all but a few of 400 samples."""
    samples = np.random.default_rng(6).gamma(2.0, size=(50, 400))
    for statistic, truth in (
        (metrics.mean(columns(samples, 1)), 2.0),
        (metrics.root_mean(columns(samples, 1)), np.sqrt(2)),
    ):
        missed = np.abs(statistic.value - truth) > 3 * statistic.mcse
        assert missed.mean() < 0.03


def test_one_trial_has_no_error():
    for of in STATISTICS:
        statistic = of(columns(VALUES[:1], 1))
        assert np.isnan(statistic.mcse).all()
        assert statistic.value == pytest.approx(statistic.median)


def columns(squared, shards):
    """A quantity (trials, steps) in so many shards."""
    parts = np.array_split(squared, shards)
    return Columns(iter(parts), [len(part) for part in parts])


def test_rmse_over_steps_is_the_brute_force_one():
    def rmse(squared):
        return np.sqrt(squared.mean(axis=0)).mean()

    statistic = metrics.statistic(metrics.roots_over_steps(columns(VALUES, 1)))
    left_out = np.array([rmse(np.delete(VALUES, i, axis=0)) for i in range(40)])
    spread = ((left_out - left_out.mean()) ** 2).sum()
    np.testing.assert_allclose(statistic.mcse, np.sqrt(39 / 40 * spread))
    np.testing.assert_allclose(statistic.value, rmse(VALUES))
    np.testing.assert_allclose(statistic.median, np.median(np.sqrt(VALUES).mean(axis=1)))


@pytest.mark.parametrize("block", [1, 100, 10**6])
@pytest.mark.parametrize("shards", [1, 2, 7, 40])
def test_no_bit_depends_on_shards_or_blocks(shards, block, monkeypatch):
    wanted = [list(of(columns(VALUES, 1))) for of in STATISTICS]
    monkeypatch.setattr("repro.statistics.shards.BLOCK", block)
    for of, statistic in zip(STATISTICS, wanted, strict=True):
        for found, value in zip(of(columns(VALUES, shards)), statistic, strict=True):
            np.testing.assert_array_equal(found, value)


def test_mean_over_steps():
    for shards in (1, 3):
        found = columns(VALUES, shards).mean_over_steps()
        np.testing.assert_allclose(found, VALUES.mean(axis=1), rtol=1e-15)


def test_some_of_the_trials():
    few = VALUES[:, 2] > 2.5
    assert 2 < few.sum() < 40
    for shards in (1, 3):
        for of in STATISTICS:
            found, wanted = of(columns(VALUES, shards).only(few)), of(columns(VALUES[few], 1))
            for one, other in zip(found, wanted, strict=True):
                np.testing.assert_array_equal(one, other)


def test_quantities_of_runs_in_shards(tmp_path):
    """Of what a filter's jobs leave, whole and shard by shard."""
    shards = (slice(0, 3), slice(3, 5), slice(5, 40))
    for number, part in enumerate(shards):
        folder = tmp_path / "runs/study/main/filter"
        folder.mkdir(parents=True, exist_ok=True)
        with (folder / f"{number}.npz").open("wb") as stream, RunsWriter(stream) as writer:
            for point in ("another", "point"):
                recorded = {"a": VALUES[part]} if point == "point" else {}
                writer.add(
                    point, Runs(VALUES[part, :, None], None, VALUES[part, 0], recorded=recorded)
                )
    results, where = Results(tmp_path, {}, 3, {}, [], 3.0), ("study", "point", "filter")
    np.testing.assert_array_equal(results.each(*where, lambda runs: runs.degenerate), VALUES[:, 0])
    of_steps = results.each(*where, lambda runs: runs.error[..., 0])
    stored = VALUES.astype(np.float32).astype(float)
    np.testing.assert_array_equal(np.concatenate(list(of_steps.blocks())).T, stored)
    runs = results.runs(*where)
    np.testing.assert_array_equal(runs.error[..., 0], stored)
    np.testing.assert_array_equal(runs.recorded["a"], stored)
    assert results.in_shards(*where).trials == 40


def test_errors_beyond_single_precision_are_kept(tmp_path):
    """Those of a filter that diverges; an infinite one would make every mean infinite."""
    error = np.full((2, 4, 1), 1e70)
    with (tmp_path / "0.npz").open("wb") as stream, RunsWriter(stream) as writer:
        writer.add("point", Runs(error, None, np.zeros(2), recorded={}))
    np.testing.assert_array_equal(read_runs(tmp_path / "0.npz", "point").error, error)


def test_components_that_are_not_kept_are_nan(tmp_path):
    """Nobody can take them for numbers."""
    error = np.arange(24.0).reshape(2, 4, 3)
    with (tmp_path / "0.npz").open("wb") as stream, RunsWriter(stream, components=(0, 2)) as writer:
        writer.add("point", Runs(error, None, np.zeros(2), recorded={}))
    read = read_runs(tmp_path / "0.npz", "point").error
    np.testing.assert_array_equal(read[..., [0, 2]], error[..., [0, 2]])
    assert np.isnan(read[..., 1]).all()
