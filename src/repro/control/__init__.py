"""Controllers, and the loops that they close on an estimate."""
