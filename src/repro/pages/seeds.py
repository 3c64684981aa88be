"""How often each verdict comes out with other root seeds."""

from collections.abc import Mapping
from typing import Any

import pandas as pd

from repro.atomic import atomic_write
from repro.pages.markdown import markdown_table
from repro.tables.csv_file import write_csv
from repro.verdicts.published import VERDICTS

NAMED = ["paper", "item", "kind", "class", "expect"]
ALL = [verdict for verdicts in VERDICTS.values() for verdict in verdicts]


def write_seeds(diffs: Mapping[str, str], csv: str, markdown: str) -> None:
    """Tabulate the diff of each root seed, its file by seed, as CSV and as a Markdown page."""
    table = over_seeds({seed: pd.read_csv(file) for seed, file in diffs.items()})
    write_csv(table, csv)
    with atomic_write(markdown) as part:
        part.write_text(page(table, list(diffs)), encoding="utf-8")


def over_seeds(diffs: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """A row a published value or claim: with how many seeds it has which verdict.

    `not_as_expected` has the seeds with which `verify` would fail for it.
    """
    together = pd.concat([diff.assign(seed=seed) for seed, diff in diffs.items()])
    rows = []
    for key, of_item in together.groupby(NAMED, sort=False):
        counts = of_item["verdict"].value_counts()
        failed = of_item.loc[~of_item["as_expected"], "seed"]
        rows.append(
            dict(zip(NAMED, key, strict=True))
            | {verdict: int(counts.get(verdict, 0)) for verdict in ALL}
            | {"smallest_margin": of_item["margin"].min()}
            | {"largest_margin": of_item["margin"].max()}
            | {"not_as_expected": " ".join(failed)}
        )
    return pd.DataFrame(rows)


def page(table: pd.DataFrame, seeds: list[str]) -> str:
    """The page results/seeds.md: the verdicts that are not the same with every seed."""
    failed = table.loc[table["not_as_expected"] != ""]
    varied = (table[ALL] > 0).sum(axis=1) > 1
    passed = set(seeds) - {
        seed for of_item in failed["not_as_expected"] for seed in of_item.split()
    }
    shown = table.loc[varied | (table["not_as_expected"] != "")]
    cells = [_cells(row) for row in shown.to_dict("records")]
    head = ("paper", "item", "evidence is", "expected", "verdicts", "margin", "not as expected")
    return "\n".join(
        [
            f"# Verdicts with {len(seeds)} root seeds: {', '.join(seeds)}",
            "",
            f"- {list(varied).count(False)} of {len(table)} verdicts are the same with every seed.",
            f"- `snakemake verify` passes with {len(passed)} of {len(seeds)} seeds.",
            "",
            "The others, and the seeds with which they are not as expected:",
            "",
            markdown_table(head, cells),
            "",
        ]
    )


def _cells(row: Mapping[Any, Any]) -> list[str]:
    verdicts = ", ".join(f"{row[verdict]} {verdict}" for verdict in ALL if row[verdict])
    margins = f"{row['smallest_margin']:.1f} to {row['largest_margin']:.1f}"
    named = [row["paper"], row["item"], row["class"], row["expect"]]
    return [*named, verdicts, margins, row["not_as_expected"]]
