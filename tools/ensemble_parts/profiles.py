"""Mean stress of the blocks along straight profiles from an opening into the rock, and how far two runs differ there."""
import numpy as np

from hdem_io import open_run

ANGLES_DEG = (0.0, 90.0, 180.0)    # to the right, above, to the left
LENGTH = 10.0    # from the opening's boundary [m]


def crossings(centre, angle_deg, edges):
    """Distance from the centre at which the ray meets each edge (n, 2, 2) [m]; nan where it does not."""
    angle = np.radians(angle_deg)
    along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    side = (edges - centre) @ across
    reach = (edges - centre) @ along
    meets = (side[:, 0] > 0.0) != (side[:, 1] > 0.0)
    share = np.divide(side[:, 0], side[:, 0] - side[:, 1], out=np.zeros(len(edges)), where=meets)
    distance = reach[:, 0] + share * (reach[:, 1] - reach[:, 0])
    return np.where(meets & (distance > 0.0), distance, np.nan)


def blocks_along(blocks, angle_deg):
    """Positions of the blocks that the ray from the opening's middle crosses, from its boundary on."""
    corners = blocks["outline"].reshape(-1, 2)
    centre = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    boundary = np.nanmax(crossings(centre, angle_deg, blocks["outline"]))
    distance = crossings(centre, angle_deg, blocks["edges"])
    return np.unique(blocks["edge_block"][(distance >= boundary) & (distance <= boundary + LENGTH)])


def major_stress(blocks):
    """Greater principal stress of each block's mean stress, compression positive [Pa]."""
    xx, yy, xy = (blocks[f"stress_{axes}"].astype(float) for axes in ("xx", "yy", "xy"))
    return 0.5 * (xx + yy) + np.hypot(0.5 * (xx - yy), xy)


def stress_difference(reference, other):
    """Median relative difference of the major principal stress, over the blocks of the profiles that stand in both runs."""
    first, second = (open_run(outcome.folder).blocks("last") for outcome in (reference, other))
    stress = dict(zip(second["name"], major_stress(second)))
    fallen = reference.detached | other.detached
    found = np.unique(np.concatenate([blocks_along(first, angle) for angle in ANGLES_DEG]))
    differences = [abs(stress[first["name"][i]] - value) / value for i, value in zip(found, major_stress(first)[found])
                   if value > 0.0 and first["name"][i] not in fallen]
    return float(np.median(differences)) if differences else None
