"""The static site: sources are written from results, parameters and docstrings, Sphinx builds them.

`build` puts the parts together; each other module writes the pages of one kind.
"""
