# What logs and runs are made with: by it a job knows a stale one (src/repro/origin.py).
from functools import cache

from repro.origin import digest, of_shard, origin


def filtered_points(wildcards):
    """What a filter's job needs of each point of its batch: see `FilteredPoint`."""
    study, shard = wildcards.study, int(wildcards.shard)
    points = {}
    for point, made in in_batch(wildcards.filter, study, wildcards.batch).items():
        trials = of_shard(made["trials"], shard, RUN.shards)
        points[point] = {
            "log": LAYOUT.log(study, made["log_of"], shard),
            "log_of": made["log_of"],
            "settings": made["settings"],
            "consistency": made["consistency"],
            "log_origin": origin(made["log"], trials),
            "origin": origin(made["runs"], trials),
        }
    return points


def filtered_logs(wildcards):
    """Logs of those points, some of which may share one."""
    batch = in_batch(wildcards.filter, wildcards.study, wildcards.batch)
    of_points = dict.fromkeys(made["log_of"] for made in batch.values())
    return [LAYOUT.log(wildcards.study, point, wildcards.shard) for point in of_points]


@cache
def in_batch(name, study, batch):
    """Of each point of a batch that the filter runs on: what is the same in all of its shards."""
    return {
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


def origins(study, requested=False):
    """What the results of each point of a study must come from."""
    return {
        point: {
            "trials": STUDIES[study][point].parameters.trials,
            "log_of": REGISTRY.log_of(study, point),
            "log": log_made_with(study, point),
            "filters": {name: runs_made_with(name, study, point) for name in filters},
        }
        for point, filters in REGISTRY.catalogue(study, requested=requested)[study].items()
    }


def simulated_points(study, points, shard):
    """Parameters, trials and origin of a shard of the points."""
    simulated = {}
    for point in points:
        parameters = plain_parameters(study, point)
        trials = of_shard(parameters["trials"], shard, RUN.shards)
        simulated[point] = {
            "parameters": parameters,
            "trials": trials,
            "origin": origin(log_made_with(study, point), trials),
        }
    return simulated


@cache
def plain_parameters(study, point):
    """Parameters of a point, the same object in all of its shards."""
    return STUDIES[study][point].parameters.plain()
