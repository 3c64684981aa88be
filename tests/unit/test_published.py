import jinja2
import numpy as np
import pandas as pd
import pytest
from docutils.core import publish_parts

from repro.errors import ReproError
from repro.pages.markdown import markdown_table
from repro.pages.verdicts import markdown_page, report_page, tally_lines
from repro.verdicts.claims import Part, below, most, overall, possible_overall, smaller
from repro.verdicts.published import COLUMNS, compare, compare_value, read_published, verify


def ours(value, mcse, trials):
    return pd.Series({"value": value, "mcse": mcse, "trials": trials})


@pytest.mark.parametrize(
    ("value", "mcse", "trials", "verdict"),
    [
        (5.00, 0.0, 1, "match"),
        (5.005, 0.0, 1, "match"),  # rounds to 5.00 or 5.01
        (5.006, 0.0, 1, "differs"),
        (
            5.67,
            0.1,
            400,
            "match",
        ),  # their error: 0.1 sqrt(400 / 100); 3 hypot(.1, .2) + .005 = .676
        (5.68, 0.1, 400, "differs"),
        (4.32, 0.1, 400, "differs"),
        (np.nan, 0.1, 400, "differs"),
    ],
)
def test_verdict_of_a_value(value, mcse, trials, verdict):
    assert compare_value(5.0, 2, 100, ours(value, mcse, trials), 3.0)["verdict"] == verdict


def test_their_error_is_our_spread_at_their_number_of_trials():
    row = compare_value(5.0, 2, 100, ours(5.3, 0.1, 400), 3.0)
    assert row["their_error"] == pytest.approx(0.2)
    assert row["z"] == pytest.approx(0.3 / np.hypot(0.1, 0.2))


def test_verdict_of_a_claim():
    assert Part("", -0.31, 0.1).verdict(3) == "holds"
    assert Part("", -0.29, 0.1).verdict(3) == "undecided"
    assert Part("", 0.31, 0.1).verdict(3) == "fails"
    assert Part("", 0.0, 0.0).verdict(3) == "fails"
    assert Part("", np.nan, 0.1).verdict(3) == "undecided"
    assert overall(["holds", "holds"]) == "holds"
    assert overall(["holds", "undecided"]) == "undecided"
    assert overall(["holds", "undecided", "fails"]) == "fails"


def test_a_verdict_on_the_edge_may_be_another_with_another_seed():
    """As many errors of a difference of two seeds' numbers as decide may move it over the limit."""
    assert Part("", -0.73, 0.1).possible(3) == {"holds"}
    assert Part("", -0.31, 0.1).possible(3) == {"holds", "undecided"}
    assert Part("", 0.31, 0.1).possible(3) == {"fails", "undecided"}
    assert below("", 1.0, 2.0).possible(3) == {"holds"}
    assert below("", 2.1, 2.0, seed_error=0.1).possible(3) == {"holds", "fails"}
    edges = [compare_value(5.0, 2, 100, ours(v, 0.1, 400), 3.0)["on_edge"] for v in (5.2, 5.6, 6.2)]
    assert edges == [False, True, False]


def test_the_possible_verdicts_of_a_claim():
    both, sure = {"holds", "undecided"}, {"holds"}
    assert possible_overall([sure, sure]) == {"holds"}
    assert possible_overall([sure, both]) == {"holds", "undecided"}
    assert possible_overall([{"fails"}, both]) == {"fails"}
    assert possible_overall([{"fails", "undecided"}, both]) == {"fails", "undecided"}


def test_a_verdict_on_the_edge_is_no_surprise():
    claims = CLAIMS.assign(verdict="undecided", possible="holds undecided")
    rows = pd.concat([published(), published(item="C1", kind="claim", expect="holds")])
    table = TABLE.assign(value=2.15, mcse=0.02)
    diff = pd.DataFrame(compare("paper", rows, table, claims, 3.0, "file"))
    assert diff["verdict"].tolist() == ["differs", "undecided"]
    assert diff["as_expected"].all() and diff["on_edge"].all()


def test_parts_are_paired():
    common = np.random.default_rng(0).normal(scale=100, size=50)
    part = smaller("", common + np.linspace(0, 1, 50), common + 1.0)
    assert part.difference == pytest.approx(-0.5)
    assert part.mcse == pytest.approx(np.linspace(0, 1, 50).std(ddof=1) / np.sqrt(50))
    assert below("", 1.0, 2.0).verdict(3) == "holds"
    assert most("", np.array([True] * 90 + [False] * 10)).verdict(3) == "holds"
    assert most("", np.array([True] * 52 + [False] * 48)).verdict(3) == "undecided"
    assert most("", np.array([], dtype=bool)).verdict(3) == "undecided"


def published(**changes):
    row = dict.fromkeys(COLUMNS, "") | {
        "item": "T1",
        "study": "s",
        "point": "p",
        "filter": "f",
        "metric": "rmse",
        "component": "x",
        "value": "2.0",
        "digits": "1",
        "kind": "value",
        "class": "predicted",
        "trials": "100",
        "expect": "match",
    }
    return pd.DataFrame([row | changes], columns=COLUMNS)


TABLE = pd.DataFrame(
    [{"study": "s", "point": "p", "filter": "f", "metric": "rmse", "component": "x"}]
).assign(value=2.2, mcse=0.01, trials=100)
CLAIMS = pd.DataFrame(
    {"item": ["C1"], "statement": ["A < B"], "part": ["a"], "difference": [1.0]}
).assign(mcse=0.1, margin=10.0, verdict="fails", possible="fails", **Part("", 1.0, 0.1).risks(3))
JOINT = pd.DataFrame(
    [("paper", "Table 1", 4, 300, 3.21, 0.52, "T1", 1.6)],
    columns=["paper", "table", "cells", "trials", "chi_square", "p_value", "farthest", "z"],
)
READINGS = pd.DataFrame(
    [("T1", "reading-a", "match"), ("T1", "reading-b", "not run"), ("C1", "reading-a", "fails")],
    columns=["item", "reading", "verdict"],
).assign(margin=5.0)


def test_rows_of_the_diff_and_the_tally():
    rows = pd.concat([published(), published(item="C1", kind="claim", expect="fails", reason="r")])
    diff = pd.DataFrame(compare("paper", rows, TABLE, CLAIMS, 3.0, "file", READINGS))
    assert diff["verdict"].tolist() == ["differs", "fails"]
    assert diff["as_expected"].tolist() == [False, True]
    assert diff["standing"].tolist() == ["reversed under a", "robust (1 reading)"]
    assert diff["margin"].tolist() == pytest.approx([0.2 / np.hypot(0.01, 0.01), 10.0])
    assert tally_lines(diff) == [
        "paper values: predicted 1 differs; 0 on the edge",
        "paper claims: predicted 1 fails; 0 on the edge",
        "paper under other readings: values 1 reversed; claims 1 robust",
        "all papers: 1 verdicts not as expected; "
        "a fresh root seed fails `snakemake verify` with probability at most 1",
    ]


def test_the_tally_keeps_classes_of_evidence_apart_and_adds_the_risks():
    rows = [published(**{"class": name}) for name in ("identity", "fitted", "fitted")]
    rows.append(published(value="2.2", **{"class": "predicted"}))
    rows = pd.concat([*rows, published(item="C1", kind="claim", expect="fails", reason="r")])
    diff = pd.DataFrame(compare("paper", rows, TABLE, CLAIMS, 3.0, "file"))
    diff["seed_risk"] = [0.001, 0.01, 0.1, 0.0, 0.0]
    values, _, readings, total = tally_lines(diff)
    assert values == (
        "paper values: identity 1 differs; fitted 2 differs; predicted 1 match; 0 on the edge"
    )
    assert readings.endswith("values 4 without reading; claims 1 without reading")
    assert total.endswith("at most 0.11")
    assert tally_lines(diff[diff["kind"] == "claim"])[0] == "paper values: none printed"


def test_the_pages_have_every_row_and_the_report_page_is_valid():
    row = published(item="C1", kind="claim", expect="fails", reason="|x_1| *and* `y`_ {{{{ z }}}}")
    rows = pd.concat([published(), row])
    diff = pd.DataFrame(compare("paper", rows, TABLE, CLAIMS, 3.0, "file"))
    cells = [
        [cell.strip() for cell in line.split("|")]
        for line in markdown_page(diff, JOINT).split("\n")
    ]
    assert any(row[1:3] == ["C1", "A < B"] for row in cells if len(row) > 2)
    assert any("2.2" in row for row in cells)
    assert ["Table 1", "4", "300", "3.2", "0.52", "T1", "+1.6"] in [row[1:-1] for row in cells]
    page = jinja2.Template(report_page(diff)).render()
    html = publish_parts(page, writer="html", settings_overrides={"halt_level": 1})["body"]
    assert "values: 1 differs; claims: 1 fails" in html and len(page.splitlines()) < 20


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (published(metric="mse"), "T1: no table has a row for s, p, f, mse, x"),
        (published(item="C2", kind="claim", expect="holds"), "C2: no claim of this name is tested"),
        (published(), "the tested claim 'C1' has no row here"),
    ],
)
def test_rows_without_a_result_are_refused(rows, message):
    with pytest.raises(ReproError, match=message):
        list(compare("paper", rows, TABLE, CLAIMS, 3.0, "file"))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"kind": "number"}, "line 2 .T1.: kind 'number' is not one of value, claim"),
        ({"expect": "holds"}, "expect 'holds' is not one of match, differs"),
        ({"expect": "differs"}, "expect 'differs' needs a reason"),
        ({"digits": "two"}, "digits must be a number"),
        ({"class": "guessed"}, "class 'guessed' is not one of identity, fitted, predicted"),
    ],
)
def test_faults_of_a_published_file(changes, message, tmp_path):
    published(**changes).to_csv(tmp_path / "p.csv", index=False)
    with pytest.raises(ReproError, match=message):
        read_published(tmp_path / "p.csv")


def test_what_a_value_is_allowed_is_stated_in_percent():
    assert compare_value(5.0, 2, 100, ours(5.3, 0.1, 400), 3.0)["allowed_percent"] == pytest.approx(
        100 * (3 * np.hypot(0.1, 0.2) + 0.005) / 5.0
    )
    assert np.isnan(compare_value(0.0, 2, 100, ours(5.3, 0.1, 400), 3.0)["allowed_percent"])


def test_reasons_state_computed_numbers(tmp_path):
    rows = published(reason="ours is {ratio:.2f} of theirs")
    none = CLAIMS.iloc[:0]
    (row,) = compare("paper", rows, TABLE, none, 3.0, "file", facts={"ratio": 1.0999})
    assert row["reason"] == "ours is 1.10 of theirs"
    missing = r"file: T1: reason: there is no fact 'ratio'; known are other$"
    with pytest.raises(ReproError, match=missing):
        list(compare("paper", rows, TABLE, none, 3.0, "file", facts={"other": 1.0}))
    with pytest.raises(ReproError, match=r"^file: T1: reason: [^\n]*; write {name:.2f}$"):
        list(compare("paper", published(reason="a {"), TABLE, none, 3.0, "file"))


def test_verify_names_every_surprise(tmp_path):
    rows = pd.concat([published(), published(item="T2", value="2.2")])
    diff = pd.DataFrame(compare("paper", rows, TABLE, CLAIMS.iloc[:0], 3.0, "file"))
    diff.to_csv(tmp_path / "diff.csv", index=False)
    with pytest.raises(ReproError) as error:
        verify(tmp_path / "diff.csv")
    assert str(error.value).endswith(
        "paper, T1: differs, expected match (predicted, margin +14.1 standard errors)"
    )
    diff[1:].to_csv(tmp_path / "diff.csv", index=False)
    verify(tmp_path / "diff.csv")


def test_cells_of_a_markdown_table_are_escaped_and_numbers_stay_as_they_are():
    table = markdown_table(("a|b", "c"), [("2.20", "x\ny | z")])
    head, rule, row = table.split("\n")
    assert [cell.strip() for cell in row.replace(r"\|", "/").split("|")] == [
        "",
        "2.20",
        "x y / z",
        "",
    ]
    assert r"a\|b" in head and set(rule) <= set("|-: ")
