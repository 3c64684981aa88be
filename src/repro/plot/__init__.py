"""Drawing: one look for all figures. A figure script gives NEEDS, CAPTION and draw(results).

NEEDS names what the figure reads, as literals: `tables`, `convergence` and `mismatch` (studies),
`points` (study -> points), `measured` (files of params/measured), `diff` (True); `on_request`
(True) excludes the figure from the ordinary run.
"""
