# What logs and runs are made with: by it a job knows a stale one (src/repro/origin.py).
# Snakemake evaluates the parameters of all jobs at its start and keeps them: what is large is the
# same object in all shards. It records what a job was made with, whole, for each of its outputs,
# unless it comes from a function of `output`: what is large does, and `made_with` is its digest.


def filtered_points(wildcards, output):
    """What a filter's job needs besides its shard: arguments of `repro.runner.in_shard`."""
    return of_batch(wildcards.filter, wildcards.study, wildcards.batch)


def filtered_with(wildcards):
    """Digest of that."""
    return digest_of_batch(wildcards.filter, wildcards.study, wildcards.batch)


def filtered_logs(wildcards):
    """Of each job that makes logs of those points: the one that stands for all of them."""
    name, study, batch = wildcards.filter, wildcards.study, wildcards.batch
    points, first = logged_points(name, study, batch)
    logs, named = (
        [LAYOUT.log(study, point, wildcards.shard) for point in some] for some in (points, first)
    )
    if workflow.is_main_process:  # as with --forcerun
        unseen = unseen_changes(logs, named, LAYOUT.run(study, batch, name, wildcards.shard))
        workflow.dag.forcefiles.update(unseen)
    return named


@cache
def logged_points(name, study, batch):
    """Points whose logs a filter reads for a batch, and those that stand for them."""
    points = REGISTRY.in_batch(name, study, batch)
    logged = [REGISTRY.log_of(study, point) for point in points]
    return [*dict.fromkeys(logged)], REGISTRY.first_logged(study, points)


@cache
def of_batch(name, study, batch):
    """What the jobs of a filter on a batch share."""
    points = {
        point: {
            "trials": STUDIES[study][point].parameters.trials,
            "settings": REGISTRY.settings(name, study, point),
            "consistency": point in DESCRIBED[study]["consistency"],
            "log_of": REGISTRY.log_of(study, point),
            "log": log_made_with(study, point),
            "runs": runs_made_with(name, study, point),
        }
        for point in REGISTRY.in_batch(name, study, batch)
    }
    return {"root": str(LAYOUT.root), "shards": RUN.shards, "points": points}


@cache
def digest_of_batch(name, study, batch):
    return digest(of_batch(name, study, batch))


@cache
def log_made_with(study, point):
    """Digest of what the trials of a point are simulated with."""
    simulation = or_exit(code_digest, "repro.simulate", f"repro.studies.{study}")
    logged = REGISTRY.log_of(study, point)
    return digest(study, logged, plain_parameters(study, logged), RUN.root_seed, simulation)


@cache
def runs_made_with(name, study, point):
    """Digest of what a filter's runs on a point are made with."""
    estimation = or_exit(code_digest, "repro.runner", f"repro.filters.{name}")
    settings = REGISTRY.settings(name, study, point)
    kept = ["consistency"] if point in DESCRIBED[study]["consistency"] else []
    return digest(log_made_with(study, point), settings, estimation, *kept)


@cache
def origins(study, requested=False, table=""):
    """What the results of each point of a study must come from."""
    catalogue = REGISTRY.catalogue(study, requested=requested, table=table)[study]
    return {
        point: {
            "trials": STUDIES[study][point].parameters.trials,
            "log_of": REGISTRY.log_of(study, point),
            "log": log_made_with(study, point),
            "filters": {name: runs_made_with(name, study, point) for name in filters},
        }
        for point, filters in catalogue.items()
    }


@cache
def simulated_points(study, points):
    """Parameters of points, and what their logs are made with."""
    return {
        point: {
            "parameters": plain_parameters(study, point),
            "made_with": log_made_with(study, point),
        }
        for point in points
    }


@cache
def simulated_with(study, points):
    """Digest of that, and of how the trials are split."""
    return digest(simulated_points(study, points), RUN.shards)


@cache
def plain_parameters(study, point):
    """Parameters of a point, the same object in all of its shards."""
    return STUDIES[study][point].parameters.plain()
