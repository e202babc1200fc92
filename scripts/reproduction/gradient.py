"""Figs 5 and 6: what is done to the shape gradient, and how a shape is represented."""

from .family import over
from .section import Album, Runs, joined


def gradient(r: Runs, album: Album) -> str:
    one, rules, ours = r["one_position"], r["rules_je"], r["uniform_je"]
    shares = over(lambda a, b: a.first["strain_energy"] / b.first["strain_energy"], one, ours)
    return joined(
        "The paper treats the shape gradient in three steps. The first two pictures belong to the initial wheel in one "
        f"load position, which has {shares.percent()} of the strain energy of all 8: the density G of the shape "
        "derivative in the cells that the boundary cuts, and its harmonic extension to the whole ring. Where G is "
        "positive, material goes; where it is negative, it comes. Strain "
        "energy falls wherever material comes, and most of all on the holes above the contact, which is on the right.\n",
        album.copied(one.run, "shapes/shape_0000_gradient.svg", "One load position: the shape gradient in cut cells"),
        album.copied(one.run, "shapes/shape_0000_extension.svg", "One load position: its harmonic extension"),
        "Summed over all load positions, the gradient is the same in every sector. The correction for the volume is "
        "the constant lambda_k, which is zero for the first shape, so that shape 20 of the run by the paper's rules is "
        "shown: its gradient, and its extension with the correction.\n",
        album.copied(rules.run, "shapes/shape_0020_gradient.svg", "All positions, the paper's rules, shape 20"),
        album.copied(rules.run, "shapes/shape_0020_corrected.svg", "The same, extended, with lambda_k"),
        "With the volume held, the gradient is extended by its H1 representative, and the correction makes the "
        "integral of the velocity along the boundary vanish. The holes of the first shape grow at their "
        "inner ends and become narrower:\n",
        album.copied(ours.run, "shapes/shape_0000_corrected.svg", "All positions, volume held, first shape"),
    )


def level_set(r: Runs, album: Album) -> str:
    return joined(
        "The shape is a level set on the same polar grid (Fig. 7) as the displacement, of degree 2: the signed distance "
        "to the edges of the holes, negative in the material. Rim and tread are no part of it.\n",
        album.copied(r["uniform_je"].run, "shapes/shape_0000_level_set.svg", "The level set of the initial wheel"),
    )
