"""What the site is made from: files of the results, parameter files, captions and docstrings."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from repro.layout import Catalogue, Layout
from repro.parameters.load import Paper, load_paper
from repro.workflow.code import constants

Row = dict[str, Any]


class Content(NamedTuple):
    """Tables as rows of a dictionary each; empty cells are empty texts or NaN as the files have."""

    layout: Layout
    project: Path  # the folder that holds docs/, params/ and src/
    figures: Path  # the folder of the pictures
    papers: dict[str, Paper]
    catalogue: Catalogue
    diff: list[Row]
    robustness: list[Row]
    comparisons: list[Row]  # every comparison behind the claims
    joint: list[Row]
    parameters: list[Row]
    leaderboard: pd.DataFrame
    times: pd.DataFrame

    def paper_of(self, study: str) -> Paper:
        """The paper that a study is of."""
        return next(paper for paper in self.papers.values() if study in paper.studies)

    def label(self, filter_: str) -> str:
        """A filter's name in tables and figures."""
        return str(self.filter_constants(filter_).get("LABEL", filter_))

    def filter_constants(self, filter_: str) -> Mapping[str, Any]:
        """Literal constants of a filter's module."""
        return constants(str(self.project / "src/repro/filters" / f"{filter_}.py"))

    def drawn(self, group: str) -> list[str]:
        """Names of the figures of a paper, or of `overview`, whose picture is there."""
        scripts = sorted((self.project / "figures" / group).glob("*.py"))
        return [s.stem for s in scripts if (self.figures / group / f"{s.stem}.png").exists()]

    def filters(self) -> list[str]:
        """Every filter that runs, in the order of the studies."""
        found = (f for of in self.catalogue.values() for names in of.values() for f in names)
        return list(dict.fromkeys(found))

    def studies_with(self, filter_: str) -> list[str]:
        """The studies that a filter runs on."""
        return [s for s, of in self.catalogue.items() if any(filter_ in f for f in of.values())]


def read_content(
    root: str | Path, catalogue: Catalogue, project: str | Path, figures: str | Path
) -> Content:
    """Read what a run has left under `root` and `figures`; raises ReproError for bad parameters."""
    layout, folder = Layout(root), Path(project)
    files = sorted(f for f in (folder / "params").glob("*.yaml") if f.name != "run.yaml")
    papers = {file.stem: load_paper(file) for file in files}
    judged = [name for name in papers if Path(layout.claims(name)).exists()]
    return Content(
        layout,
        folder,
        Path(figures),
        papers,
        catalogue,
        diff=_rows(layout.page("diff.csv")),
        robustness=_rows(layout.page("robustness.csv")),
        comparisons=[row for name in judged for row in _rows(layout.claims(name))],
        joint=[row for name in judged for row in _rows(layout.joint(name))],
        parameters=_rows(layout.page("parameters.csv"), keep_default_na=False),
        leaderboard=pd.read_csv(layout.page("leaderboard.csv")),
        times=pd.read_csv(layout.page("leaderboard_times.csv")),
    )


TEXTS = {"standing", "evidence", "reason", "statement", "filter", "point", "study", "changes"}


def _rows(path: str, **options: Any) -> list[Row]:
    table = pd.read_csv(path, **options)
    for name in TEXTS & set(table.columns):
        table[name] = table[name].astype(object).where(table[name].notna(), "")
    return [{str(k): v for k, v in row.items()} for row in table.to_dict("records")]
