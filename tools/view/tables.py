"""Histories and energies of a run, thinned to what a screen can show. For run_pack.py."""
import numpy as np

from coding import Chunk

MOST_ROWS = 1500    # of a history; both extremes of each interval are kept


def thinned(time, columns, most=MOST_ROWS):
    """Rows to keep: first, last, and where a column is least or greatest in its interval."""
    if len(time) <= most:
        return np.arange(len(time))
    kept = {0, len(time) - 1}
    share = max(1, most // (2 * max(1, len(columns))))
    for begin, end in zip(*(np.linspace(0, len(time), share + 1).astype(int)[s] for s in (slice(None, -1), slice(1, None)))):
        for column in columns:
            values = np.nan_to_num(column[begin:end])
            if len(values):
                kept.update((begin + int(values.argmin()), begin + int(values.argmax())))
    return np.array(sorted(kept))


def add_table(chunk, tables, name, table, wanted):
    names = [column for column in table if column not in ("cycle", "time") and (wanted is None or column in wanted)]
    if not len(table["time"]) or not names:
        return
    rows = thinned(table["time"], [table[column] for column in names])
    number = len(tables)
    chunk.add(f"{number}/time", "f8", table["time"][rows])
    for column in names:
        values = np.where(np.abs(table[column][rows]) < 3e38, table[column][rows], np.nan)    # of a run that blew up
        chunk.add(f"{number}/{column}", "f4", values)
    tables.append({"name": name, "columns": [[column, table.unit[column]] for column in names]})


ENERGIES = {"kinetic_energy", "unbalanced_force_ratio", "greatest_speed", "elastic_normal", "elastic_shear", "friction"}


def tables_of(run):
    """The chunk, and what it holds."""
    chunk, tables = Chunk(), []
    for name in run.histories:
        add_table(chunk, tables, name, run.history(name), None)
    add_table(chunk, tables, "energies" if "energies" not in run.histories else "energies of the run", run.energy(), ENERGIES)
    return chunk.close(), tables
