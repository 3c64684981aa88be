"""What several tests share: the parameters, the registered filters, small logs in memory."""

import ast
import re
from functools import cache
from pathlib import Path

import numpy as np

from repro.logs import Log
from repro.parameters.load import Point, load_paper
from repro.simulate import simulated
from repro.workflow.registry import matching_points

ROOT = Path(__file__).parent.parent
SCHEMAS = ROOT / "workflow" / "schemas"
SEED = 1


@cache
def points() -> dict[str, dict[str, Point]]:
    """Resolved points of every study of every paper."""
    files = sorted(f for f in (ROOT / "params").glob("*.yaml") if f.name != "run.yaml")
    return {
        study: found for file in files for study, found in load_paper(file, SCHEMAS).studies.items()
    }


def registered() -> list[tuple[str, str, str]]:
    """(filter, study, first point it runs on) of every runs(...) in the catalogue of rules."""
    text = (ROOT / "workflow" / "rules" / "filters.smk").read_text()
    found = []
    for call in re.findall(r"^ +(runs\(.*?\))", text, re.DOTALL | re.MULTILINE):
        node = ast.parse(call, mode="eval").body
        options = {keyword.arg: ast.literal_eval(keyword.value) for keyword in node.keywords}
        for study in options["studies"]:
            matching = matching_points(
                points()[study], options.get("points", "*"), options.get("skip", ())
            )
            found.append((ast.literal_eval(node.args[0]), study, matching[0]))
    return found


@cache
def small_log(study: str, point: str, trials: int = 5, steps: int = 12, first: int = 0) -> Log:
    """A short log of a point, in memory."""
    parameters = dict(points()[study][point].parameters)
    if "steps" in parameters:
        parameters["steps"] = min(parameters["steps"], steps)
    return simulated(study, point, parameters, SEED, np.arange(first, first + trials))
