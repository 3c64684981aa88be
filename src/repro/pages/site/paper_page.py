"""A page for each paper: what it does, its model, its claims, tables and assumptions."""

from collections.abc import Iterator

from repro.pages.markdown import markdown_line
from repro.pages.site.assumed import assumptions
from repro.pages.site.cards import card
from repro.pages.site.content import Content
from repro.pages.site.diagram import with_diagrams
from repro.pages.site.fragments import link, raw, tag
from repro.pages.site.further import further_results
from repro.pages.site.printed_tables import printed_tables
from repro.pages.site.words import in_words


def paper_page(content: Content, name: str) -> str:
    """The page papers/<name>.md."""
    paper = content.papers[name]
    cited = f"{markdown_line(paper.authors)}: *{markdown_line(paper.title)}*; here `{name}`.\n"
    text = [f"# {in_words(name)}\n", cited]
    abstract = content.project / "docs/papers" / f"{name}.md"
    if abstract.exists():
        # Its heading is the page's already.
        written = abstract.read_text(encoding="utf-8").partition("\n")[2]
        text.append(with_diagrams(written, str(abstract)))
    text += [raw(_parts(content, name)), *_claims(content, name), *_tables(content, name)]
    if any(row["paper"] == name for row in content.parameters):
        text += ["## What the paper leaves open\n", *assumptions(content, name)]
    text += further_results(content, name)
    return "\n".join(text)


def _parts(content: Content, name: str) -> str:
    """Links to the studies and filters of the paper."""
    studies = list(content.papers[name].studies)
    filters = [f for f in content.filters() if set(content.studies_with(f)) & set(studies)]
    of_studies = ", ".join(link(study, f"../studies/{study}.html") for study in studies)
    of_filters = ", ".join(link(content.label(f), f"../filters/{f}.html") for f in filters)
    text = f"Studies: {of_studies}. Filters: {of_filters}."
    if content.drawn(name):
        text += f" {link('All its figures', f'../gallery/{name}.html')}."
    return tag("p", text)


def _claims(content: Content, name: str) -> Iterator[str]:
    """Those that do not hold first."""
    rows = [r for r in content.diff if r["paper"] == name and r["kind"] == "claim"]
    for verdict, title in (
        ("fails", "Claims that fail"),
        ("undecided", "Claims that are undecided"),
        ("holds", "Claims that hold"),
    ):
        of_verdict = [row for row in rows if row["verdict"] == verdict]
        if of_verdict:
            yield f"## {title}\n"
            yield from (card(content, row) for row in of_verdict)


def _tables(content: Content, name: str) -> list[str]:
    tables = list(printed_tables(content, name))
    note = "In each cell the printed number, and below it ours; a cell that differs is marked.\n"
    return ["## Printed tables\n", note, *tables] if tables else []
