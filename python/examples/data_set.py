"""A data set of random wheels, computed by Dask on all processors.

usage: data_set.py [WHEELS] [FILE]; with Dask's distributed
"""

import sys

import numpy as np
from dask.distributed import Client, LocalCluster

import wheelwright as ww


def row(parameters):
    """The numbers of one wheel; NaN if it cannot be computed."""
    center_radius, radius, load = parameters
    case = ww.Case.preset("paper16").replace(
        {
            "grid.radial_cells": 14,
            "grid.angular_cells": 192,
            "optimizer.rim_band": "1 cm",
            "optimizer.tread_band": "2 cm",
            "holes.ring[1].center_radius": center_radius,
            "holes.ring[1].radius": radius,
            "load.mass": load,
        }
    )
    try:
        with ww.limit_threads(1):
            evaluation = ww.Study(case).evaluate()
    except ww.ComputationError:
        return [*parameters, np.nan, np.nan, np.nan]
    measures = evaluation.measures
    return [*parameters, evaluation.objective, measures["mean_travel"], measures["peak_pressure"]]


def main():
    wheels = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    file = sys.argv[2] if len(sys.argv) > 2 else "wheels.csv"
    random = np.random.default_rng(1)
    parameters = random.uniform([0.262, 0.025, 200], [0.272, 0.035, 400], (wheels, 3))
    with LocalCluster(threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        rows = client.gather(client.map(row, parameters.tolist()))
    header = "center_radius [m],radius [m],mass [kg],strain_energy [J/m],mean_travel [m],peak_pressure [Pa]"
    np.savetxt(file, rows, delimiter=",", header=header, comments="")
    print(f"{len(rows)} wheels in {file}")


if __name__ == "__main__":
    main()
