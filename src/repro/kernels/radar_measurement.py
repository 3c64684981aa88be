"""Range and bearing of targets, and their derivatives [unknown_losses Sec. VI-B]."""

import numpy as np

from repro.kernels.compiled import kernel
from repro.kernels.elementary import arctan2


@kernel
def measure(p1, p2, printed, distance, bearing):
    """Range and bearing of positions (p1, p2); as printed, the bearing is arctan(p2 / p1)."""
    for s in range(p1.size):
        distance[s] = np.sqrt(p1[s] * p1[s] + p2[s] * p2[s])
    if printed:
        for s in range(p1.size):
            bearing[s] = arctan2(p2[s] / p1[s], 1.0)
    else:
        for s in range(p1.size):
            bearing[s] = arctan2(p2[s], p1[s])


@kernel
def linearise(p1, p2, floor, entries):
    """Derivatives of range and bearing by p1 and p2, (4, systems); of ranges below `floor`, its."""
    along_1, along_2, across_1, across_2 = entries[0], entries[1], entries[2], entries[3]
    for s in range(p1.size):
        distance = np.sqrt(p1[s] * p1[s] + p2[s] * p2[s])
        inverse = 1.0 / (floor if distance < floor else distance)
        cosine, sine = p1[s] * inverse, p2[s] * inverse
        along_1[s], along_2[s] = cosine, sine
        across_1[s], across_2[s] = -sine * inverse, cosine * inverse
