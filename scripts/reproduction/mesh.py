"""Fig. 7: the grid, the grid cut by the level set, and a solution on it."""

import re

from .section import Album, Runs, joined


def mesh(r: Runs, album: Album) -> str:
    run = r["uniform_je"].run
    text = (run.folder / "shapes/shape_0000_mesh.svg").read_text()
    inside, cut, outside = (re.search(rf">(\d+) cells {kind}", text)[1] for kind in ("inside", "cut", "outside"))
    return joined(
        f"The polar grid of the initial wheel, 28 x 384 cells: {inside} lie inside the material, {cut} are cut by its "
        f"boundary, {outside} lie outside. Displacements have degree 2, as in the paper. The second picture shows the "
        "solution in the load position with the largest von Mises stress. The picture says how many times enlarged its "
        "displacements are; where they would carry the tread through the ground, it is drawn on it.\n",
        album.copied(run, "shapes/shape_0000_mesh.svg", "The polar grid, cut by the level set"),
        album.copied(run, "shapes/shape_0000_displacement.svg", "The solution on the deformed wheel"),
    )
