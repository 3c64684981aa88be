# What the rules of the fits are written with: `snakemake calibration`.
def searched_fits():
    """A file for each search: of all rows of the tables, and of all rows but one."""
    paper = PAPERS["censored_network"]
    starts, left_out_starts = (paper.calibration[of] for of in ("starts", "left_out_starts"))
    names = [("all", start) for start in range(starts + 1)]
    for study in paper.studies:
        for filter_ in paper.ranking[study].papers:
            names += [(f"{study}-{filter_}", start + 1) for start in range(left_out_starts)]
    return [LAYOUT.calibration("fits", left_out, f"{start}.npz") for left_out, start in names]


def searched_network():
    """Named parameter of the jobs that search: the studies, the search and its seed."""
    paper = PAPERS["censored_network"]
    return {
        "points": {study: plain_points(study)["base"] for study in paper.studies},
        "search": paper.calibration,
        "budget": RUN.budget,
        "seed": RUN.root_seed,
    }


def searched_code(module):
    """Parameter: the code of a module of the search, with the studies and their filters."""
    paper = PAPERS["censored_network"]
    filters = {name for study in paper.studies for name in paper.ranking[study].papers}
    return code(
        f"repro.papers.censored_network.{module}",
        *(f"repro.studies.{study}" for study in paper.studies),
        *(f"repro.filters.{name}" for name in sorted(filters)),
    )
