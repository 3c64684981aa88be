"""Where each result is, under results/. Rules, jobs and pages take every path from here."""

from pathlib import Path

# Study -> point -> the filters that run on it, in the order of their rules.
Catalogue = dict[str, dict[str, list[str]]]
Number = int | str  # of a shard or trial; a wildcard in the rules


class Layout:
    """Paths below a root folder. A part that is not given stays a wildcard of the rules."""

    def __init__(self, root: str | Path):
        self.root = Path(root)

    def _at(self, *parts: object) -> str:
        return "/".join((str(self.root), *map(str, parts)))  # joinpath takes ten times as long

    def log(self, study="{study}", point="{point}", shard: Number = "{shard}") -> str:
        """Truth and impaired measurements of a shard of trials."""
        return self._at("logs", study, point, f"{shard}.mcap")

    def run(
        self, study="{study}", batch="{batch}", filter_="{filter}", shard: Number = "{shard}"
    ) -> str:
        """Errors of a filter on the logs of a batch of points."""
        return self._at("runs", study, batch, filter_, f"{shard}.npz")

    def table(self, name="{study}") -> str:
        """Table of a study, or one computed without trials."""
        return self._at("tables", f"{name}.csv")

    def curves(self, study="{study}") -> str:
        """Statistics of a study over the steps."""
        return self._at("curves", f"{study}.csv")

    def ranking(self, study="{study}") -> str:
        """How the filters of a study rank, on every point."""
        return self._at("ranking", study, "table.csv")

    def error_over_k(self, study="{study}") -> str:
        """The errors by which a study ranks, over the steps."""
        return self._at("ranking", study, "over_k.csv")

    def error_shares(self, study="{study}") -> str:
        """The distribution of those errors over the runs."""
        return self._at("ranking", study, "shares.csv")

    def consistency(self, name="{study}") -> str:
        """Whether the filters' own covariances are true, in a study."""
        return self._at("consistency", f"{name}.csv")

    def consistency_summary(self, paper="{paper}") -> str:
        """The same of a paper, in sentences."""
        return self._at("consistency", f"{paper}.md")

    def bounds(self, name="{study}") -> str:
        """Lower bounds of the errors of a study, beside those of its filters."""
        return self._at("bounds", f"{name}.csv")

    def claims(self, paper="{paper}") -> str:
        """Every comparison behind the claims of a paper."""
        return self._at("claims", f"{paper}.csv")

    def robustness(self, paper="{paper}") -> str:
        """The verdicts of a paper under every reading."""
        return self._at("robustness", f"{paper}.csv")

    def facts(self, paper="{paper}") -> str:
        """Numbers that the reasons for the verdicts of a paper state."""
        return self._at("facts", f"{paper}.csv")

    def joint(self, paper="{paper}") -> str:
        """Each printed table of a paper against ours as a whole."""
        return self._at("joint", f"{paper}.csv")

    def tails(self, study="{study}") -> str:
        """What the means of a study hide: lost runs, quantiles, the weight of the worst runs."""
        return self._at("tails", f"{study}.csv")

    def convergence(self, study="{study}") -> str:
        """Errors of a study over the number of particles."""
        return self._at("convergence", f"{study}.csv")

    def mismatch(self, study="{study}") -> str:
        """Errors of a study whose filters take a parameter for another than it is."""
        return self._at("mismatch", f"{study}.csv")

    def cost(self, study="{study}", ending="csv") -> str:
        """Errors of a study over the CPU time that they took on this machine."""
        return self._at("cost", f"{study}.{ending}")

    def of_seed(self, seed: Number = "{seed}") -> str:
        """The diff with another root seed; without its ending, the folder that it is made in."""
        return self._at("seeds", f"{seed}.csv")

    def calibration(self, *parts: str) -> str:
        """What the search for fitted parameters of a paper has found."""
        return self._at("calibration", *parts)

    def view(self, study="{study}", point="{point}", trial: Number = "{trial}") -> str:
        """One trial to look into, without its ending."""
        return self._at("views", study, point, f"trial-{trial}")

    def user_estimates(self, filter_="{filter}") -> str:
        """Estimates of a filter on a log recorded elsewhere."""
        return self._at("user_log", f"{filter_}.csv")

    def verdicts(self, paper="{paper}") -> str:
        """Page of a paper: what of it holds, figure by figure; docs/verdicts has it as well."""
        return self._at("verdicts", f"{paper}.md")

    def page(self, name: str) -> str:
        """A single file of the whole run: diff.csv, manifest.json ..."""
        return self._at(name)

    def job_log(self, *parts: str) -> str:
        """Log of a job: its usage, or its error in one line."""
        return self._at("job_logs", *parts) + ".log"

    def timing(self, *parts: str) -> str:
        """Snakemake's benchmark file of a job; the same parts give its `job_log`."""
        return self._at("timings", *parts) + ".tsv"

    def timed_jobs(self) -> list[tuple[str, ...]]:
        """Parts of every job that has left a `timing`, the name of its rule first."""
        files = sorted(Path(self._at("timings")).rglob("*.tsv"))
        return [file.relative_to(self._at("timings")).with_suffix("").parts for file in files]
