"""What the paper compares: its filters, and PF-ROSS-EH at the points of its sweeps."""

from typing import NamedTuple

from repro import plugins
from repro.studies.families.harvesting_sensors import HarvestingStudy
from repro.tables.results import Results

PROPOSED = "pf_ross_eh"
RIVALS = ("pf_ross", "pf_eh", "spf")  # on the same measurements as the proposed filter
IDEAL = "spf_im"  # on unimpaired measurements
PAPERS_FILTERS = (PROPOSED, *RIVALS, IDEAL)
EXTENSIONS = ("pf_ross_eh_exact", "pf_ross_eh_joint")  # of this project

SWEPT_STUDY = "rss_2d"


class Sweep(NamedTuple):
    """Points of the study in the plane that differ in one parameter, in the paper's order."""

    parameter: str
    points: tuple[str, ...]
    matrices: tuple[str, ...] = ()  # symbols of its values, where these are matrices

    def values(self, results: Results) -> dict[str, str]:
        """The parameter's value at each point, as text."""
        if self.matrices:
            return dict(zip(self.points, self.matrices, strict=True))
        found = {point: results.parameters(SWEPT_STUDY, point) for point in self.points}
        return {point: f"{getattr(found[point], self.parameter):g}" for point in self.points}


SATURATIONS = Sweep("saturation_probability", ("base", "gamma=0.5", "gamma=0.8"))
SENSORS = Sweep("sensors", ("sensors=2", "base", "sensors=6"))
HARVESTS = Sweep("harvest_transition", ("base", "harvest=pi_2"), matrices=("Pi_1", "Pi_2"))


def study_of(name: str) -> HarvestingStudy:
    """The study of a name, which must be one of this paper."""
    study = plugins.study(name)
    assert isinstance(study, HarvestingStudy)
    return study
