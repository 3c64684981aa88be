"""Everything again with other root seeds, on a cut-down copy."""

import pandas as pd


def test_every_seed_runs_by_itself_and_leaves_its_verdicts_alone(paper):
    paper.snakemake("seeds", "--config", "seeds=1 2", "trials=4")
    results = paper.folder / "results"
    ours = [pd.read_csv(results / f"seeds/{seed}.csv").set_index("item")["ours"] for seed in (1, 2)]
    value = "Table 2: N=2 p=0.9"
    assert ours[0]["Table 1: y(1)"] == ours[1]["Table 1: y(1)"]
    assert ours[0][value] != ours[1][value]
    table = pd.read_csv(results / "seeds.csv").set_index("item")
    assert table.loc[value, ["match", "differs"]].sum() == 2
    assert table.loc["omvf-below-nahi", ["holds", "fails", "undecided"]].sum() == 2
    left = sorted(path.name for path in (results / "seeds").iterdir())
    assert left == ["1.csv", "2.csv"] and not (results / "runs").exists()
