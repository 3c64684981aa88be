"""The page of a paper's verdicts, as committed and as written."""

import re
from importlib import import_module

import pandas as pd
import pytest

from repro.pages.beyond_the_paper import beyond_the_paper
from repro.pages.markdown import markdown_cell
from repro.pages.paper_verdicts import write_paper_verdicts
from repro.verdicts.published import DIFF_COLUMNS, ON_EDGE, read_published
from tests.conftest import ROOT

PAPERS = sorted(path.stem for path in (ROOT / "params/published").glob("*.csv"))
PAGES = ROOT / "docs/verdicts"


@pytest.mark.parametrize("paper", PAPERS)
def test_the_committed_page_has_every_claim_and_shows_figures_that_exist(paper):
    page = (PAGES / f"{paper}.md").read_text()
    for claim in import_module(f"repro.papers.{paper}.claims").CLAIMS:
        assert f"| **{markdown_cell(claim.statement)}" in page
    for picture in re.findall(r"\]\((\.\./[^)]+)\)|src=\"([^\"]+)\"", page):
        assert (PAGES / "".join(picture)).resolve().exists()
    for figure in read_published(ROOT / f"params/published/{paper}.csv")["figure"]:
        assert not figure or f"figure={paper}/{figure}`" in page


@pytest.mark.parametrize("page", ["README.md", *(f"docs/verdicts/{p}.md" for p in PAPERS)])
def test_counts_of_the_pages_are_those_of_the_readme(page):
    counts = re.findall(r"^- (\d+ (?:values|claims): [^;]*);", (ROOT / page).read_text(), re.M)
    assert all(f"| {text} |" in (ROOT / "README.md").read_text() for text in counts)


SENTENCES = [
    (
        "holds",
        ON_EDGE,
        "3 comparisons: 3 holds; least favourable: x",
        -4.5,
        "All 3 comparisons hold, the ",
    ),
    (
        "holds",
        "",
        "2 comparisons: 2 holds; least favourable: x",
        -float("inf"),
        "Both comparisons hold ex",
    ),
    (
        "fails",
        "",
        "2 comparisons: 1 holds, 1 fails; least favourable: x",
        9.0,
        "Of 2 comparisons 1 hold, 1 fail.",
    ),
    ("fails", "as Fig. 4 has it, 1.5; but", "", 9.0, "As Fig. 4 has it, 1.5. |"),
    ("fails", "see Sec. IV. More", "", 9.0, "See Sec. IV. |"),
]


@pytest.mark.parametrize(("verdict", "reason", "evidence", "margin", "sentence"), SENTENCES)
def test_one_sentence_says_why(verdict, reason, evidence, margin, sentence, tmp_path):
    row = dict.fromkeys(DIFF_COLUMNS, "") | {"paper": "p", "item": "a", "kind": "claim"}
    row |= {"verdict": verdict, "reason": reason, "evidence": evidence, "margin": margin}
    row |= {"class": "predicted", "statement": "a | b", "figure": "fig01", "on_edge": False}
    pd.DataFrame([row]).to_csv(tmp_path / "diff.csv", index=False)
    pd.DataFrame(columns=["table"]).to_csv(tmp_path / "joint.csv", index=False)
    (tmp_path / "fig01.py").write_text('CAPTION = "shown"\n')
    diff, joint, script = (tmp_path / name for name in ("diff.csv", "joint.csv", "fig01.py"))
    pd.DataFrame(columns=["paper", "topic", "sentence"]).to_csv(tmp_path / "f.csv", index=False)
    further = (tmp_path / "f.csv", None)
    write_paper_verdicts("p", "A paper", diff, joint, [str(script)], *further, tmp_path / "page.md")
    (line,) = [line for line in (tmp_path / "page.md").read_text().split("\n") if "**a" in line]
    assert 'width="160" alt="fig01"></a><br>`snakemake draw --config figure=p/fig01` | ' in line
    assert rf"**a \| b.**<br>{sentence}" in line and line.count(" | ") == 2


def test_sentences_beyond_the_paper(tmp_path):
    findings = pd.DataFrame({"topic": ["mismatch", "tails"], "sentence": ["A <b>.", "C."]})
    (tmp_path / "p.md").write_text("Of 2.\n\n- D.\n")
    text = beyond_the_paper(findings, tmp_path / "p.md", {"bounds", "tails"}, "figures/p")
    section = "\n".join(text)
    assert section.index("- D.") < section.index("- A &lt;b") < section.index("- C.")
    assert "best possible?** [bounds](figures/p/bounds.png)" in section
    assert "[mismatch](" not in section and "[tails](figures/p/tails.png)" in section
