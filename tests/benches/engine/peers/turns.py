"""What the peers share: the problem as it was written, and fitting when told to.

Told a count, a peer fits that many tightenings and answers [seconds per fit, [[m, c, k], ...]] on one line. Seconds are
those that its thread had on a core, so that others on the machine do not matter.
"""
import json
import pathlib
import sys
import time

import numpy as np


class Problem:
    """Torque [Nm] and angle [rad] of every tightening, one row each, and the rig."""

    def __init__(self, folder):
        folder = pathlib.Path(folder)
        index = json.loads((folder / "index.json").read_text())
        shape = index["tightenings"], index["samples"]
        self.torque = np.fromfile(folder / "torque.f64", "<f8").reshape(shape)
        self.angle = np.fromfile(folder / "angle.f64", "<f8").reshape(shape)
        self.interval = index["interval_s"]
        self.square = index["lever_arm_m"] ** 2
        self.known_inertia = index["known_inertia_kg_m2"]
        self.start = np.array(index["start"])

    def normalised(self, number, parameters):
        """b1 = 1/I, b2 = K/I, b3 = C/I of theta'' + b3 theta' + b2 theta = b1 T."""
        m, c, k = parameters
        inertia = self.known_inertia[number] + m * self.square
        return np.array([1.0, k * self.square, c * self.square]) / inertia

    def parameters(self, number, normalised):
        """m, c, k from b1, b2, b3."""
        b1, b2, b3 = normalised
        inertia = 1.0 / b1
        return np.array([inertia - self.known_inertia[number], b3 * inertia, b2 * inertia]) / self.square


def take(make_fit):
    """make_fit(problem) gives fit(number) -> (m, c, k)."""
    problem = Problem(sys.argv[1])
    fit = make_fit(problem)
    for line in sys.stdin:
        numbers = range(int(line))
        start = time.thread_time()
        parameters = [fit(number) for number in numbers]
        seconds = (time.thread_time() - start) / len(numbers)
        print(json.dumps([seconds, [list(map(float, p)) for p in parameters]]), flush=True)
