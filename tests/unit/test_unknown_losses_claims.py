"""What the claims of unknown_losses are made of."""

import numpy as np
import pandas as pd
import pytest

from repro.network.losses import inferred_rightly
from repro.papers.unknown_losses.claims import inference, particles

RNG = np.random.default_rng(5)


def test_a_share_of_right_inferences_leaves_out_the_start():
    recorded = {
        "arrived": np.array([[0, 1, 0, 1], [1, 0, 0, 0]], dtype=bool),
        "gamma": np.array([[1, 1, 0, 0], [0, 0, 0, 1]], dtype=bool),
    }
    np.testing.assert_allclose(inferred_rightly(recorded), [2 / 3, 2 / 3])


def test_a_difference_of_deviations_and_its_jackknife_error():
    first, second = RNG.gamma(2.0, size=40), RNG.gamma(2.0, size=40) + 1.0
    part = inference.deviation("name", first, second)
    left = np.array([np.delete(first, i).std() - np.delete(second, i).std() for i in range(40)])
    assert part.difference == pytest.approx(first.std() - second.std())
    assert part.mcse == pytest.approx(np.sqrt(39 / 40 * ((left - left.mean()) ** 2).sum()))


@pytest.mark.parametrize(("fast", "factor", "verdict"), [(4.0, 2, "holds"), (6.0, 2, "fails")])
def test_greatly_faster_is_by_its_factor(fast, factor, verdict, tmp_path, monkeypatch):
    times = pd.DataFrame(
        [("rbpf_fast", 1000, 0.5, fast, 0.01, "m"), ("rbpf", 1000, 0.5, 10.0, 0.01, "m")],
        columns=["filter", "particles", "loss", "microseconds", "error", "machine"],
    )
    times.to_csv(tmp_path / "times.csv", index=False)
    monkeypatch.setattr(particles, "TIMES", tmp_path / "times.csv")
    (part,) = particles.faster("rbpf_fast", "rbpf", {0.5: {2: "a", 1000: "b"}}, max, factor)
    assert part.verdict(3.0) == verdict
