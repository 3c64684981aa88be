"""Texts of others in the report and in the pages: shown as they are, and nothing happens."""

import html
import re

import jinja2
import pandas as pd
import pytest
from docutils.core import publish_parts

from repro import plugins
from repro.pages.gallery import write_gallery
from repro.pages.leaderboard import write_leaderboard
from repro.pages.markdown import markdown_line, markdown_table
from repro.pages.verdict_tables import verdict_tables
from repro.pages.verdicts import markdown_page, report_page, sections

SECRET = "in the file"
TEXTS = [
    "ends\n\n.. raw:: html\n\n   <script>alert(1)</script>",
    ".. include:: {file}",
    "x\n\n.. include:: {file}",
    "{{% for x in y %}} {{# {{{{ 1 + 1 }}}} #}}",
    "a\\| b | *c* `d`_ |e|_ _f _`g` [h]_ \\",
    "[a](javascript:alert) <b onclick=x> ![c](http://x) \x1b[31mred",
]


@pytest.fixture(params=TEXTS)
def text(request, tmp_path):
    (tmp_path / "secret").write_text(SECRET)
    return request.param.format(file=tmp_path / "secret")


def assert_shown(template, text, **given):
    """The page of the report that Snakemake makes of a template has the text as it is."""
    rst = jinja2.Environment().from_string(template).render(**given)
    page = publish_parts(rst, writer="html", settings_overrides={"halt_level": 1})["html_body"]
    shown = " ".join(html.unescape(re.sub("<.*?>", "", page)).split())
    assert " ".join(text.split()) in shown
    assert SECRET not in page and "<script" not in page


def table(text):
    row = {"paper": "p", "kind": "claim", "item": text, "statement": text, "evidence": "e"}
    row |= {"verdict": "fails", "reason": text, "as_expected": True, "on_edge": False}
    row |= {"class": "predicted", "standing": text, "seed_risk": 0.0}
    return pd.DataFrame([row])


NO_JOINT = pd.DataFrame(columns=["paper"])


def test_the_first_page_of_the_report_shows_names_of_papers(text):
    assert_shown(report_page(table(text).assign(paper=text)), text)


def test_the_verdicts_of_the_report_show_items_and_reasons(text):
    page = verdict_tables("title", [text], sections(table(text), NO_JOINT))
    shown = " ".join(html.unescape(re.sub("<.*?>", "", page)).split())
    assert shown.count(" ".join(text.split())) > 3
    assert "<script" not in page and "<b " not in page


def assert_harmless(line):
    assert "\n" not in line and "](" not in line and line.isprintable()
    assert "<script" not in line and "<b" not in line


def test_a_row_of_a_markdown_page_stays_one_row(text):
    *_, row, end = markdown_page(table(text), NO_JOINT).split("\n")
    assert_harmless(row)
    cells = row.replace("\\\\", "").replace(r"\|", "").split("|")
    assert end == "" and len(cells) == len(
        ["", "item", "claim", "evidence", "class", "verdict", "standing", "reason", ""]
    )


def test_captions_and_titles_of_the_gallery_are_one_paragraph(text, tmp_path):
    script = tmp_path / "paper/fig.py"
    script.parent.mkdir()
    script.write_text(f"CAPTION = {text!r}\n")
    write_gallery([str(script)], {"paper": text}, tmp_path / "README.md")
    lines = (tmp_path / "README.md").read_text().split("\n")
    title, picture, caption = lines[6], lines[8], lines[10]
    assert picture == "![fig](paper/fig.png)" and lines[11:] == [""] and title == caption
    assert_harmless(caption)


@pytest.mark.parametrize("text", ["# head", "- item", "> quote", "```", "=== x"])
def test_a_paragraph_begins_no_block(text):
    assert markdown_line(text) == f"\\{text}"


def test_numbers_and_comparisons_stay_readable():
    assert "| -0.3 | p < 1, a<2 |" in markdown_table(("a", "b"), [("-0.3", "p < 1, a<2")])


def test_the_label_of_a_filter_stays_in_its_cell(tmp_path, monkeypatch):
    monkeypatch.setattr(plugins.filter_module("ekf"), "LABEL", "a|b <script>")
    row = {"study": "radar", "family": "f", "point": "p", "filter": "ekf", "whose": "paper"}
    row |= {"error": 1.0, "median": 1.0, "lost": 0.0, "verdict": "best"}
    row |= {"relative_to_informed": 1.0, "relative_to_nothing": 1.0}
    pd.DataFrame([row]).to_csv(tmp_path / "r.csv")
    page = tmp_path / "board.md"
    write_leaderboard({"radar": str(tmp_path / "r.csv")}, str(tmp_path / "b.csv"), str(page))
    assert r"| a\|b &lt;script>" in page.read_text()
