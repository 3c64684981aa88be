"""What the built site has: a card for every claim, a row for every statement, no broken link."""

import html
import re

from repro.pages.site.links import broken_links
from repro.pages.site.words import pictures_named
from repro.verdicts.published import read_published
from tests.conftest import ROOT, catalogue
from tests.site.conftest import PAPERS, claims


def test_every_claim_has_its_card_and_every_value_its_cell(site):
    for paper in PAPERS:
        page = (site / f"papers/{paper}.html").read_text()
        cards = set(re.findall(r'<section class="claim-card[^>]* id="([^"]+)"', page))
        assert cards == claims()[paper].keys()
        printed = read_published(ROOT / f"params/published/{paper}.csv").query("kind == 'value'")
        assert len(re.findall(r'class="(?:match|differs)" id=', page)) == len(printed)
        assert 'class="wide diagram"' in page


def test_the_scoreboard_has_every_statement_and_no_link_leads_nowhere(site):
    """The job has checked the links; here, that it looks."""
    home = (site / "index.html").read_text()
    linked = set(re.findall(r'href="papers/(\w+)\.html#([^"]+)"', home))
    rows = sum(len(read_published(ROOT / f"params/published/{p}.csv")) for p in PAPERS)
    assert len(linked) == rows
    page = site / "papers" / f"{PAPERS[0]}.html"
    kept = page.read_text()
    page.write_text(kept.replace('id="mapf-below-mpf"', ""))
    try:
        assert any("#mapf-below-mpf has no such anchor" in line for line in broken_links(site))
    finally:
        page.write_text(kept)


def test_filters_studies_texts_and_code_have_their_pages(site):
    filters = {f for of_study in catalogue().values() for names in of_study.values() for f in names}
    for name in filters:
        page = (site / f"filters/{name}.html").read_text()
        assert "Sees" in page and f"filters/{name}.py" in page
    for name in catalogue():
        page = (site / f"studies/{name}.html").read_text()
        shown = html.unescape(re.sub("<.*?>", "", page))
        assert f"study={name}" in shown and "trials" in shown
    for text in (ROOT / "docs").glob("*.md"):
        assert (site / f"how-to/{text.stem}.html").exists()
    assert "repro.filters.mapf" in (site / "searchindex.js").read_text()


def test_figures_that_a_statement_names():
    drawn = ["fig02", "fig03", "fig04", "fig05a", "fig05b", "fig09", "table01", "table02"]
    assert pictures_named("Figs. 2-4, 9-11", drawn) == ["fig02", "fig03", "fig04", "fig09"]
    assert pictures_named("Figs. 5a, b", drawn) == ["fig05a", "fig05b"]
    assert pictures_named("Tables I-II", drawn) == ["table01", "table02"]
    assert pictures_named("Sec. VI-A", drawn) == []
