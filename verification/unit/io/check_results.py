#!/usr/bin/python3
"""Compares the files of a run with the tables of io/hdf5_format.md, both ways, and with what ParaView 5.11 needs.

    check_results.py PAGE FOLDER

Fails when a dataset or attribute is missing, not described, or of another type, shape or unit. The run in FOLDER must hold
histories with all quantities.
"""
import re
import sys
from pathlib import Path

import h5py
import numpy as np

MOST_IN_HEADER = 32 * 1024    # bytes
LEAST_DEFLATED = 128 * 1024    # bytes
ROW = re.compile(r"^\| `([^`]+)` \| (\w+) \| (scalar|\[[^\]]*\]) \| ([^|]*) \|")
HEADING = re.compile(r"^## .*: (\S+)$")


def rows_of(page):
    """file name pattern -> object -> (type, shape, unit)"""
    tables, current = {}, None
    for line in page.read_text(encoding="utf-8").splitlines():
        if heading := HEADING.match(line):
            current = tables.setdefault(heading[1], {})
        elif current is not None and (row := ROW.match(line)):
            current[row[1]] = (row[2], row[3], row[4].strip())
    return tables


def type_name(dtype):
    text = h5py.check_string_dtype(dtype)
    if text is not None:
        if text.length is None:
            return "text of variable length"
        return {"utf-8": "text", "ascii": "ascii"}[text.encoding]
    assert h5py.check_enum_dtype(dtype) is None, "an enumeration (ParaView 5.11 cannot read it)"
    return dtype.name


def fits(shape, described, letters):
    """Same rank and numbers; a letter stands for the same number everywhere."""
    if described == "scalar":
        return shape == ()
    words = [word.strip() for word in described.strip("[]").split(",")]
    if len(words) != len(shape):
        return False
    for word, extent in zip(words, shape):
        letter, plus = (word[:-2], 1) if word.endswith("+1") else (word, 0)
        wanted = int(word) if word.isdigit() else letters.setdefault(letter, extent - plus) + plus
        if wanted != extent:
            return False
    return True


def objects_of(opened):
    """(path, dataset or attribute, type name), through hard links only; histories of all names as NAME."""
    def attributes(path, holder):
        for name in holder.attrs:
            if name == "unit" and isinstance(holder, h5py.Dataset):
                continue
            attribute = h5py.h5a.open(holder.id, name.encode())
            yield f"{path}@{name}", attribute.shape, type_name(attribute.dtype), None

    def visit(path, group):
        yield from attributes(path or "/", group)
        for name in group:
            below = f"{path}/{name}"
            if isinstance(group.get(name, getlink=True), h5py.ExternalLink):
                continue
            if isinstance(group[name], h5py.Group):
                yield from visit(below, group[name])
                continue
            yield from attributes(below, group[name])
            yield below, group[name].shape, type_name(group[name].dtype), group[name]
    yield from visit("", opened)


def compare(file, table):
    problems, letters, seen = [], {}, set()
    with h5py.File(file, "r") as opened:
        for path, shape, kind, dataset in objects_of(opened):
            name = re.sub(r"^/history/[^/@]+", "/history/NAME", path)
            name = re.sub(r"^/case/files/\d+", "/case/files/NUMBER", name)
            seen.add(name)
            if name not in table:
                problems.append(f"{path} is not described")
                continue
            wanted_kind, wanted_shape, unit = table[name]
            if kind != wanted_kind:
                problems.append(f"{path} is of type {kind}, described as {wanted_kind}")
            if not fits(shape, wanted_shape.replace("H", path.rsplit("/", 1)[0]), letters):
                problems.append(f"{path} has shape {shape}, described as {wanted_shape} with {letters}")
            if dataset is None:
                continue
            if "unit" in dataset.attrs and dataset.attrs["unit"].decode() != unit:
                problems.append(f"{path} has the unit {dataset.attrs['unit'].decode()}, described as {unit}")
            deflated = dataset.shuffle and dataset.compression == "gzip"
            plain = kind != "text" if file.name.startswith("checkpoint") else kind.startswith("float")
            plain = plain or dataset.size * dataset.dtype.itemsize < LEAST_DEFLATED
            is_in_header = dataset.id.get_create_plist().get_layout() == h5py.h5d.COMPACT
            is_small = dataset.size * dataset.id.get_type().get_size() <= MOST_IN_HEADER
            if dataset.size and (is_in_header != is_small or not (is_in_header or (dataset.fletcher32 and deflated != plain))):
                problems.append(f"{path} is not packed as described")
    problems += [f"{name} is described but not there" for name in table if name not in seen]
    return [f"{file.name}: {problem}" for problem in problems]


def check_grid(file, cell_type, corners):
    """What ParaView 5.11 needs of an unstructured grid, and that cells are what they say."""
    with h5py.File(file, "r") as opened:
        grid = opened["VTKHDF"]
        kind = h5py.h5a.open(grid.id, b"Type").get_type()
        assert not kind.is_variable_str() and kind.get_size() == 16 and kind.get_cset() == h5py.h5t.CSET_ASCII
        assert grid.attrs["Type"] == b"UnstructuredGrid" and list(grid.attrs["Version"]) == [1, 0]
        points, offsets = grid["Points"][...], grid["Offsets"][...]
        cells = int(grid["NumberOfCells"][0])
        assert grid["NumberOfPoints"][0] == len(points) == grid["NumberOfConnectivityIds"][0] == len(grid["Connectivity"])
        assert len(offsets) == cells + 1 and offsets[0] == 0 and offsets[-1] == len(points)
        assert np.array_equal(grid["Connectivity"][...], np.arange(len(points)))
        assert np.all(grid["Types"][...] == cell_type) and np.all(np.isin(np.diff(offsets), corners))
        assert points.shape[1] == 3 and np.all(points[:, 2] == 0.0)
        for data in grid["CellData"].values():
            assert len(data) == cells and data.dtype.kind in "iuf" and np.all(np.isfinite(data[...])), data.name


def main(page, folder):
    tables = rows_of(page)
    problems = []
    for pattern, table in tables.items():
        files = sorted(folder.glob(pattern.replace("NNNNNN", "*")))
        assert files, f"no {pattern} in {folder}"
        for file in files:
            problems += compare(file, table)
    for file in (folder / "frames").glob("blocks_*.hdf"):
        check_grid(file, 7, [3, 4, 5, 6, 7, 8])
    for kind in ("contacts", "bolts", "liners"):
        for file in (folder / "frames").glob(f"{kind}_*.hdf"):
            check_grid(file, 3, [2])
    with h5py.File(folder / "results.h5", "r") as results:
        for kind in ("blocks", "contacts", "bolts", "liners"):
            for number in results["frames/number"][...]:
                link = results[f"frames/{kind}"].get(f"{number:06d}", getlink=True)
                assert isinstance(link, h5py.ExternalLink) and link.path == "/VTKHDF"
                assert results[f"frames/{kind}/{number:06d}/CellData"].file.filename.endswith(f"frames/{kind}_{number:06d}.hdf")
    print("\n".join(problems + [f"{len(tables)} tables, {sum(map(len, tables.values()))} rows, {len(problems)} problems"]))
    return 1 if problems or len(tables) != 6 else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
