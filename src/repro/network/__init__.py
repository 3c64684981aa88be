"""What the network does to measurements: one file an impairment."""
