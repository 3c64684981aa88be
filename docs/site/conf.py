"""Settings of Sphinx for the site, which needs no server and no network."""

project = "Filtering over unreliable networks"
extensions = ["myst_parser"]
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 3
exclude_patterns = ["static", "extra"]
suppress_warnings = ["myst.header", "ref.python"]
add_module_names = False
python_use_unqualified_type_names = True
toc_object_entries_show_parents = "hide"
maximum_signature_line_length = 88

html_theme = "pydata_sphinx_theme"
html_title = project
html_static_path = ["static"]
html_extra_path = ["extra"]
html_css_files = ["datatables.css", "style.css"]
html_js_files = ["datatables.js", "tables.js"]
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False
# A summary of a found page would be fetched, which a browser refuses from the file system.
html_show_search_summary = False
html_context = {"default_mode": "auto"}
html_sidebars = {page: [] for page in ("index", "leaderboard", "changelog", "papers/*")}
html_theme_options = {
    "header_links_before_dropdown": 8,
    "logo": {"text": "Unreliable networks"},
    "navbar_align": "left",
    "secondary_sidebar_items": {"**": ["page-toc"], "index": [], "leaderboard": []},
    "show_prev_next": False,
    "footer_start": [],
    "footer_end": [],
    "search_bar_text": "Search",
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
