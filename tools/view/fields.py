"""Which quantities of blocks the page of `hdem view` can show, and the range of their colours in each frame."""
import numpy as np

STORED = {    # name -> unit; the other known ones follow from these in the page (src/fields.js)
    "velocity_x": "m/s", "velocity_y": "m/s", "angular_velocity": "rad/s", "kinetic_energy": "J", "stress_xx": "Pa", "stress_yy": "Pa", "stress_xy": "Pa",
}
MOTION = {"displacement", "displacement_x", "displacement_y", "rotation", "speed", "velocity_x", "velocity_y", "angular_velocity", "kinetic_energy"}
KNOWN_CELLS = {"id", "material", "displacement", "rotation", "velocity", "speed", "angular_velocity", "kinetic_energy", "regime", "fixed", "detached",
               "next_to_excavation", "stress_xx", "stress_yy", "stress_xy", "stress_magnitude"}


def more_fields(blocks):
    """Cell data of one number a block that a later version of the frames may have."""
    own = {"position", "area", "mass", "part_block", "outer", "points", "offsets", "outline", "outline_excavation"}
    count = len(blocks["id"])
    return sorted(name for name, data in blocks.items() if name not in KNOWN_CELLS | own and isinstance(data, np.ndarray) and data.shape == (count,)
                  and np.issubdtype(data.dtype, np.number))


def all_fields(blocks):
    """name -> value per block, of those that have a range; the page makes them in the same way."""
    displacement, velocity = blocks["displacement"], blocks["velocity"]
    xx, yy, xy = (blocks[f"stress_{c}"].astype(np.float64) for c in ("xx", "yy", "xy"))
    mean, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    fields = {
        "displacement": np.hypot(displacement[:, 0], displacement[:, 1]), "displacement_x": displacement[:, 0], "displacement_y": displacement[:, 1],
        "rotation": blocks["rotation"], "speed": np.hypot(velocity[:, 0], velocity[:, 1]), "velocity_x": velocity[:, 0], "velocity_y": velocity[:, 1],
        "angular_velocity": blocks["angular_velocity"], "kinetic_energy": blocks["kinetic_energy"], "stress_magnitude": blocks["stress_magnitude"],
        "stress_xx": xx, "stress_yy": yy, "stress_xy": xy, "stress_1": mean + radius, "stress_3": mean - radius,
    }
    return fields | {name: blocks[name] for name in more_fields(blocks)}


def range_of(name, values, detached):
    """Low and high, from blocks that stay in place; a few values far beyond the others do not count (as in hdem plot)."""
    values = values[np.isfinite(values) & ~detached] if name in MOTION else values[np.isfinite(values)]
    if not len(values):
        return [0.0, 0.0]
    low, high = float(values.min()), float(values.max())
    usual = float(np.percentile(np.abs(values), 98))
    if max(-low, high) > 5.0 * usual > 0.0:
        low, high = max(low, -usual), min(high, usual)
    return [float(f"{low:.7g}"), float(f"{high:.7g}")]
