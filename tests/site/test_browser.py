"""The site in a Chromium without a window, from the file system."""

import shutil

import pytest

from tests.site.conftest import PAPERS, claims

BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
PAGES = (
    *("index", "leaderboard", "gallery/index", "gallery/packet_delays/fig02", "filters/mapf"),
    *("studies/radar", "api/filters", "how-to/add-a-filter", "search"),
    *(f"papers/{paper}" for paper in PAPERS),
)
PHONE, DESK = {"width": 390, "height": 844}, {"width": 1280, "height": 900}


@pytest.fixture(scope="module")
def browser():
    playwright = pytest.importorskip(
        "playwright.sync_api",
        reason="playwright missing: pip install -c constraints.txt -e '.[site]'",
    )
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        pytest.skip("no Chromium: apt-get install chromium-headless-shell")
    with playwright.sync_playwright() as running:
        opened = running.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield opened
        opened.close()


@pytest.fixture
def page(browser):
    """A page that fails the test for what it writes to the console, and for what it asks for."""
    context = browser.new_context(viewport=DESK)
    opened, faults = context.new_page(), []
    opened.on("console", lambda said: faults.append(said.text) if said.type == "error" else None)
    opened.on("pageerror", lambda error: faults.append(str(error)))
    opened.on("requestfailed", lambda request: faults.append(f"failed: {request.url}"))
    opened.on(
        "request",
        lambda request: (
            None if request.url.startswith(("file:", "data:")) else faults.append(request.url)
        ),
    )
    yield opened
    context.close()
    assert faults == []


def test_every_page_stays_within_a_phones_width_and_asks_for_nothing(site, page):
    page.set_viewport_size(PHONE)
    for name in PAGES:
        page.goto((site / f"{name}.html").as_uri())
        assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"], name


def test_every_claims_card_is_shown(site, page):
    for paper in PAPERS:
        page.goto((site / f"papers/{paper}.html").as_uri())
        page.evaluate("document.querySelectorAll('details').forEach((d) => (d.open = true))")
        for item in claims()[paper]:
            assert page.locator(f"section#{item} h4").is_visible(), item
            assert page.locator(f"section#{item} details td").first.is_visible(), item


def test_the_scoreboard_sorts_and_filters(site, page):
    page.goto((site / "index.html").as_uri())
    rows = page.locator("#scoreboard tbody tr")
    page.get_by_label("filter by paper").select_option("Packet delays")
    page.get_by_label("filter by verdict").select_option("fails")
    shown = rows.all_inner_texts()
    assert shown and all("Packet delays" in row and "fails" in row for row in shown)
    page.get_by_label("filter by verdict").select_option("")
    page.get_by_label("filter by paper").select_option("")
    head = page.locator("#scoreboard thead th").nth(1)
    where = page.locator("#scoreboard tbody td:nth-child(2)")
    orders = []
    for direction in ("ascending", "descending"):
        head.click()
        page.locator(f"#scoreboard th[aria-sort={direction}]").wait_for()
        orders.append(where.all_inner_texts())
    assert orders[0] == sorted(orders[0], key=str.lower) and orders[0] != orders[1]
    page.get_by_placeholder("search this table").fill("mapf dead reckoning")
    page.wait_for_function("document.querySelectorAll('#scoreboard tbody tr').length < 5")
    assert all("dead reckoning" in row for row in rows.all_inner_texts())
    page.locator("#scoreboard tbody a").first.click()
    assert "papers/censored_network.html#" in page.url


def test_the_search_finds_a_filter_and_the_theme_turns_dark(site, page):
    page.goto((site / "search.html").as_uri() + "?q=auxiliary")
    page.locator("ul.search li", has_text="MAPF").first.wait_for()  # they come one by one
    page.emulate_media(color_scheme="dark")
    page.goto((site / "index.html").as_uri())
    light = "getComputedStyle(document.body).backgroundColor"
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    assert sum(map(int, page.evaluate(light).strip("rgb()").split(","))) < 150
