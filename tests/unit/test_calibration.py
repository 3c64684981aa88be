"""The fits to the papers' numbers on a tiny budget."""

import numpy as np
import pandas as pd
import pytest

from repro.papers.censored_network import calibration_search as searching
from repro.papers.censored_network import calibration_tables as tables
from repro.papers.censored_network.calibration import Network, Printed, misfit
from repro.papers.packet_delays import calibration as table_2
from repro.parameters.load import load_paper
from repro.plot.draw import draw
from repro.runner import run
from repro.simulate import simulated
from repro.studies.wsn_tracking import position_error
from repro.tables.results import Results
from tests.conftest import ROOT, SEED

CENSORED, PACKET = (
    load_paper(ROOT / f"params/{name}.yaml") for name in ("censored_network", "packet_delays")
)
TINY = {"steps_range": [5, 8], "screened": 6, "evaluations": 12, "trials": 4, "particles": 30}
TINY |= {"confirming_trials": 5, "profile_values": 2}
FEW = {"particles": 40, "resampling": "systematic", "coupling_drawn_per": "particle"}


def results(tmp_path, paper):
    described = {study: paper.described(study) for study in paper.studies}
    return Results(tmp_path, {}, 1, described, [], tolerance=3.0)


@pytest.fixture(scope="module")
def network():
    points = {
        study: {
            "parameters": of_study["base"].parameters.plain() | {"steps": 6},
            "filters": dict.fromkeys(of_study["base"].filters, FEW),
        }
        for study, of_study in CENSORED.studies.items()
    }
    return Network(points, CENSORED.calibration | TINY, SEED)


@pytest.fixture(scope="module")
def printed():
    """A row of each table."""
    whole = Printed.read(ROOT / "params/published/censored_network.csv")
    assert whole.values.shape == (8, 3) and whole.trials == 300
    rows = [("deadband", "mapf"), ("saturation", "mapf_nmc")]
    return whole._replace(rows=rows, values=whole.values[[whole.rows.index(r) for r in rows]])


@pytest.fixture(scope="module")
def screened(network, printed, tmp_path_factory):
    path = tmp_path_factory.mktemp("screen") / "screen.csv"
    searching.screen(network, printed, path)
    return pd.read_csv(path).to_numpy()


def test_a_search_lowers_the_misfit_and_repeats_to_the_byte(network, printed, screened, tmp_path):
    files = [tmp_path / "one.npz", tmp_path / "two.npz"]
    for file in files:
        searching.write_fit(searching.fit(network, printed, screened, None, 1), file)
    assert files[0].read_bytes() == files[1].read_bytes()
    found = searching.read_fit(files[0])
    begun, ended = found.searched
    assert ended < begun
    averages = network.searched(network.box.geometry(found.shares), printed.rows)
    assert misfit(averages, printed) == ended
    other = searching.fit(network, printed, screened, None, 2)
    assert not np.array_equal(other.shares, found.shares)


def test_a_search_does_not_see_the_row_that_it_leaves_out(network, printed, screened):
    left_out = printed.rows[1]
    found = searching.fit(network, printed, screened, left_out, 1)
    values = printed.values * np.array([[1.0], [7.0]])  # of the row left out another level
    again = searching.fit(network, printed._replace(values=values), screened, left_out, 1)
    assert np.array_equal(found.shares, again.shares)
    whole = searching.fit(network, printed, screened, None, 1)
    assert not np.array_equal(found.shares, whole.shares)


def test_every_row_is_predicted_by_the_others(network, printed, screened, tmp_path):
    folder = tmp_path / "calibration"
    folder.mkdir()
    fits = [
        searching.fit(network, printed, screened, row, start)
        for row in (None, *printed.rows)
        for start in (1, 2)
    ]
    tables.tabulate_left_out(printed, fits, 3.0, folder / "left_out.csv")
    rows = pd.read_csv(folder / "left_out.csv")
    assert list(rows["component"]) == ["target_1", "target_2", "target_3", "average"] * 2
    assert np.array_equal(rows["printed"].to_numpy().reshape(2, 4)[:, :3], printed.values)
    of_first = [fit.value[0].tolist() for fit in fits if fit.left_out == printed.rows[0]]
    assert rows["predicted"][:3].round(6).tolist() in np.round(of_first, 6).tolist()
    assert (rows["error"] > rows["mcse"]).all()
    assert (rows["within"] == (rows["z"].abs() <= 3)).all()

    tables.tabulate_geometries(network, printed, fits, 3.0, folder / "geometry.csv")
    geometries = pd.read_csv(folder / "geometry.csv")
    assert geometries["misfit"].is_monotonic_increasing and geometries["equal"][0]
    committed = geometries[geometries["fit"] == "committed"].iloc[0]
    assert (committed["speed"], committed["turn_rate"], committed["steps"]) == (1.0, 0.034, 6)
    assert committed["group_2_x_3"] == network.committed.sensors[1, 2, 0]

    tables.tabulate_profile(network, printed, folder / "profile.csv")
    profile = pd.read_csv(folder / "profile.csv")
    own = profile[(profile["parameter"] == "steps") & (profile["value"] == 6)]
    assert own["misfit"].iloc[0] == pytest.approx(committed["misfit"], rel=0.5)
    script = ROOT / "figures/censored_network/calibration.py"
    draw(script, results(tmp_path, CENSORED), tmp_path / "figure.png")


def test_the_local_search_finds_a_minimum_inside_the_cube(network):
    target = np.array([0.3, 0.97, 0.1])
    best, (begun, ended) = searching.local_search(
        lambda at: float(((at - target) ** 2).sum()),
        np.full(3, 0.5),
        np.random.default_rng(0),
        network.search.model_copy(update={"evaluations": 200}),
    )
    assert ended < 1e-4 * begun
    np.testing.assert_allclose(best, target, atol=0.01)
    np.testing.assert_allclose(
        searching.reflected(np.array([-0.2, 0.4, 1.3, 2.1])), [0.2, 0.4, 0.7, 0.1]
    )


def test_the_values_that_gave_a_table_fit_it(tmp_path):
    """A Table 2 of the parameter file's values on the same trials has no misfit to them."""
    grid = {"turn_rate_variances": [0.01, 0.2], "trials": 6}
    grid = table_2.Grid.checked(PACKET.calibration | grid, "grid")
    cells = table_2.printed_cells(ROOT / "params/published/packet_delays.csv")
    assert len(cells) == 15 and cells["n2-arrival=0.9"] == 3.54
    points, printed = {}, {}
    for name in ("n1-arrival=0.95", "n2-arrival=0.9"):
        point = PACKET.studies["wsn_tracking"][name]
        points[name] = {"parameters": point.parameters.plain(), "filters": point.filters}
        trials = grid.first_trial + np.arange(grid.trials)
        log = simulated("wsn_tracking", name, point.parameters, SEED, trials)
        runs = run(log, "emvf", point.filters["emvf"])[1]
        printed[name] = float(position_error(runs)[:, 1:].mean())
    path = tmp_path / "calibration/table_2.csv"
    path.parent.mkdir()
    table_2.tabulate(points, grid, printed, SEED, 3.0, path)
    rows = pd.read_csv(path)
    assert len(rows) == 12 and rows["chosen"].sum() == 1
    assert rows["misfit"][rows["chosen"]].item() == pytest.approx(0.0, abs=1e-12)
    assert (rows["misfit"][~rows["chosen"]] > 0.01).all()
    assert rows["equal"][rows["chosen"]].item()
    script = ROOT / "figures/packet_delays/calibration.py"
    draw(script, results(tmp_path, PACKET), tmp_path / "figure.png")
