"""How often a verdict comes out with other root seeds."""

import pandas as pd
import pytest

from repro.errors import ReproError
from repro.pages.seeds import over_seeds, page, write_seeds
from repro.workflow.other_seed import LINKED, run_seed


def diff(verdicts, margins, as_expected):
    rows = pd.DataFrame({"paper": "p", "item": ["T1", "C1"], "kind": ["value", "claim"]})
    expect = ["match", "holds"]
    return rows.assign(verdict=verdicts, margin=margins, as_expected=as_expected, expect=expect)


DIFFS = {
    seed: of_seed.assign(**{"class": "predicted"})
    for seed, of_seed in {
        "1": diff(["match", "holds"], [0.1, -4.0], [True, True]),
        "2": diff(["match", "undecided"], [-2.1, -2.9], [True, True]),
        "33": diff(["match", "fails"], [1.0, 3.5], [True, False]),
    }.items()
}


def test_verdicts_are_counted_and_seeds_that_fail_are_named():
    table = over_seeds(DIFFS).set_index("item")
    counts = ["match", "differs", "holds", "fails", "undecided"]
    assert table.loc["T1", counts].tolist() == [3, 0, 0, 0, 0]
    assert table.loc["C1", counts].tolist() == [0, 0, 1, 1, 1]
    assert table["not_as_expected"].tolist() == ["", "33"]
    assert table.loc["T1", ["smallest_margin", "largest_margin"]].tolist() == [-2.1, 1.0]


def test_the_page_has_what_varies_and_how_many_seeds_pass():
    text = page(over_seeds(DIFFS), list(DIFFS))
    assert "1 of 2 verdicts are the same with every seed" in text
    assert "passes with 2 of 3 seeds" in text
    rows = [[cell.strip() for cell in line.split("|")][1:-1] for line in text.splitlines()]
    assert [row for row in rows if row[:1] == ["p"]] == [
        ["p", "C1", "predicted", "holds", "1 holds, 1 fails, 1 undecided", "-4.0 to 3.5", "33"]
    ]


def test_seeds_are_told_apart_also_from_files(tmp_path):
    files = {seed: str(tmp_path / f"{seed}.csv") for seed in DIFFS}
    for seed, file in files.items():
        DIFFS[seed].to_csv(file, index=False)
    write_seeds(files, str(tmp_path / "seeds.csv"), str(tmp_path / "seeds.md"))
    table = pd.read_csv(tmp_path / "seeds.csv", dtype=str, keep_default_na=False)
    assert table["not_as_expected"].tolist() == ["", "33"]


def test_a_run_with_another_seed_that_fails_shows_its_output(tmp_path):
    for name in LINKED[1:]:
        tmp_path.joinpath(name).mkdir()
    (tmp_path / "Snakefile").write_text("import sys\nsys.exit(f\"seed {config['root_seed']}!\")\n")
    with pytest.raises(
        ReproError, match=r"7\.csv: Snakemake has failed with root_seed=7$"
    ) as error:
        run_seed(tmp_path, {"root_seed": 7, "trials": None}, 1, tmp_path / "seeds/7.csv")
    assert "seed 7!" in error.value.details
