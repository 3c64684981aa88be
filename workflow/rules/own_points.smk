# What the rules of the tables beyond the papers are written with.
def own_points(study, table):
    """Points of a study that are for a table of its own; for `convergence` also others that sweep
    the number of particles.
    """
    return [
        name
        for name, point in STUDIES[study].items()
        if own_table(name) == table
        or (table == "convergence" and is_plain(name) and ".particles" in str(point.swept))
    ]


def studies_of(table):
    """Studies that have such points."""
    return [study for study in STUDIES if own_points(study, table)]


def printed_particles(study):
    """The particles of each filter on the paper's own points."""
    first = next(iter(STUDIES[study].values()))
    return {name: values.get("particles") for name, values in first.filters.items()}


def sizes_of(point):
    """Family, trials and steps of a point, as `filter_times` asks for them."""
    parameters = point.parameters
    return {"family": point.family, "trials": parameters.trials, "steps": parameters.steps}


# Studies in which a run can lose its target.
HEAVY_TAILED = [study for study in STUDIES if "lost_above" in DESCRIBED[study]["analysis"]]
CONVERGENCE, MISMATCH = studies_of("convergence"), studies_of("mismatch")
