"""What the tables beyond the papers show, in sentences that are computed from them."""

from collections.abc import Collection, Iterator, Mapping
from typing import Any

import pandas as pd

from repro import plugins
from repro.tables.csv_file import write_csv
from repro.tables.results import Results


def write_findings(
    results: Results, papers: Mapping[str, Mapping[str, Collection[str]]], decidable: str, path: str
) -> None:
    """Write the sentences: one row a paper, topic and sentence.

    `papers` gives for each paper its studies that have tails, convergence and mismatch.
    """
    claims = pd.read_csv(decidable)
    rows = []
    for paper, studies in papers.items():
        sentences = [
            *(("tails", _tail(results, study)) for study in studies["tails"]),
            *(("convergence", s) for of in studies["convergence"] for s in _particles(results, of)),
            *(("mismatch", _mismatch(results, study)) for study in studies["mismatch"]),
            *(("decidable", s) for s in _decided(claims.loc[claims["paper"] == paper])),
        ]
        rows += [{"paper": paper, "topic": topic, "sentence": text} for topic, text in sentences]
    write_csv(pd.DataFrame(rows, columns=["paper", "topic", "sentence"]), path)


def _label(filter_: str) -> str:
    return plugins.filter_module(filter_).LABEL


def _tail(results: Results, study: str) -> str:
    """Of the paper's filters, the one whose mean rests the most on its worst runs."""
    table = results.tails(study)
    own = table.loc[table["filter"].isin(results.ranking(study).papers)]
    wide = own.pivot(index=["point", "filter"], columns="metric", values="value")
    at = wide.loc[wide["worst_share"].idxmax()]
    point, filter_ = at.name
    return (
        f"{study}: the mean error rests the most on few runs for {_label(filter_)} at {point}: "
        f"there the worst 5 % of the runs make up {at['worst_share']:.0%} of it "
        f"({at['worst_share_of_squares']:.0%} of the mean square), {at['lost']:.1%} are lost, and "
        f"the median is {at['q50'] / at['mean']:.2g} times the mean."
    )


def _particles(results: Results, study: str) -> Iterator[str]:
    """What the printed number of particles costs against the largest."""
    table = results.convergence(study).dropna(subset=["printed"])
    groups: Any = table.groupby(["where", "filter"], sort=False)
    for (where, filter_), rows in groups:
        few = rows.loc[rows["particles"] >= rows["printed"]].iloc[0]
        excess, error = few["excess"], results.tolerance * few["excess_mcse"]
        best = few["error"] - excess
        cost = (
            f"{excess / best:.0%} above that with {few['reference']}"
            if excess > error
            else f"not told apart from that with {few['reference']}"
        )
        lost = "" if pd.isna(few["lost"]) else f"; {few['lost']:.1%} of the runs are lost"
        text = f"{study}, {where}: with {few['particles']} particles"
        if few["particles"] != few["printed"]:
            text += f" (the paper has {few['printed']:.0f})"
        text += f" the error of {_label(filter_)} is {cost}{lost}."
        if not pd.isna(few["rate_beyond"]):
            rate = f"{few['rate_beyond']:.2f} ± {few['rate_beyond_mcse']:.2f}"
            text += f" From there on its squared distance from it falls as D^-r, r = {rate}."
        yield text


def _mismatch(results: Results, study: str) -> str:
    """The wrong value that costs the most of those that surely cost anything."""
    table = results.mismatch(study)
    worse = table.loc[table["verdict"] == "worse"]
    better = table.loc[table["verdict"] == "better"]
    text = f"{study}: no wrong value makes a filter surely worse."
    if len(worse):
        worst = _wrong(worse.loc[worse["relative"].idxmax()])
        text = f"{study}: the costliest wrong value is {worst}."
    if len(better):
        text += f" One makes it surely better: {_wrong(better.loc[better['relative'].idxmin()])}."
    return text


def _wrong(row: Any) -> str:
    parameter = row["parameter"].replace("_", " ")
    values = [v if isinstance(v, str) else f"{v:.3g}" for v in (row["assumed"], row["true"])]
    return (
        f"{parameter} {values[0]} in place of {values[1]}, for {_label(row['filter'])}: "
        f"{row['relative']:.3g} times the error"
    )


def _decided(claims: pd.DataFrame) -> Iterator[str]:
    """How many claims as many runs as the paper's decide as ours do."""
    ours = claims.loc[claims["verdict"] != "undecided"]
    if len(ours):
        too_few = ours.loc[ours["verdict_as_printed"] == "undecided", "item"]
        text = f"Of {len(ours)} claims that our runs decide by a standard error, "
        text += f"the paper's number of runs would have decided {len(ours) - len(too_few)}"
        yield text + (f"; not {', '.join(too_few)}." if len(too_few) else ".")
