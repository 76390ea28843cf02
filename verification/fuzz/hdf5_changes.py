"""Changes HDF5 files as damage or malice would: bytes, or one object through the library so that every checksum is right. JSON likewise."""
import json

import h5py
import numpy as np

TOKENS = [b"\xff" * 8, b"\0" * 8, b"\xff\xff\xff\x7f", b"\0\0\0\0\0\0\xf8\x7f", b"\x80"]
NUMBERS = [0.0, 1.0, -1.0, 2.0, 3.0, 255.0, 1e9, -2147483648.0, 2147483647.0, 9e18, 1e308, -1e308, np.nan, np.inf]
ELSEWHERE = "/etc/passwd"    # a file that is there, and none of the run's business


def changed_bytes(random, content):
    """Bytes flipped, overwritten by numbers that hurt, or cut off."""
    content = bytearray(content)
    if random.random() < 0.1:
        del content[random.randrange(len(content)):]
    for _ in range(random.randint(1, 4)):
        if not content:
            break
        at = random.randrange(len(content))
        token = random.choice(TOKENS) if random.random() < 0.5 else bytes([random.randrange(256)])
        content[at:at + len(token)] = token[:len(content) - at]
    return bytes(content)


def change_json(random, file, content):
    """One value of a JSON file, which stays JSON; what was done."""
    document = json.loads(content)
    places = []

    def note(holder):
        for key, value in holder.items() if isinstance(holder, dict) else enumerate(holder):
            places.append((holder, key))
            if isinstance(value, (dict, list)):
                note(value)
    note(document)
    holder, key = random.choice(places)
    holder[key] = random.choice([None, True, -1, 0, 1e308, -1e308, float("nan"), float("inf"), 10 ** 400, "", "x", "\x1b[31m<b>", "9" * 30000, [], [[]], [1e308] * 3, {}, {"a": 1}])
    if random.random() < 0.2 and isinstance(holder, dict):
        del holder[key]
    file.write_text(json.dumps(document), encoding="utf-8")
    return f"change_json {key}"


def objects_of(file):
    """Paths of datasets, groups and attributes ("/group@name")."""
    datasets, groups, attributes = [], ["/"], []

    def note(name, item):
        (datasets if isinstance(item, h5py.Dataset) else groups).append("/" + name)
        attributes.extend(f"/{name}@{key}" for key in item.attrs)
    with h5py.File(file, "r") as opened:
        attributes.extend(f"/@{key}" for key in opened.attrs)
        opened.visititems(note)
    return datasets, groups, attributes


def change_object(random, file, objects):
    """What was done, in a few words."""
    datasets, groups, attributes = objects
    with h5py.File(file, "r+") as opened:
        if random.random() < 0.3:
            name = random.choice(attributes)
            change = random.choice(ATTRIBUTE_CHANGES)
            change(random, opened, *name.split("@"))
        else:
            name = random.choice(datasets if random.random() < 0.9 else groups[1:])
            change = random.choice(OBJECT_CHANGES if name in datasets else LINK_CHANGES)
            change(random, opened, name)
    return f"{change.__name__} {name}"


def delete(random, opened, name):
    del opened[name]


def link_outside(random, opened, name):
    del opened[name]
    opened[name] = h5py.ExternalLink(random.choice([ELSEWHERE, "frames/blocks_000000.hdf", "nowhere.h5"]), random.choice(["/", "/VTKHDF", "/hdem/names"]))


def link_inside(random, opened, name):
    del opened[name]
    opened[name] = h5py.SoftLink(random.choice(["/", "/nowhere", name, "/frames/time"]))


def other_kind(random, opened, name):
    is_group = isinstance(opened[name], h5py.Group)
    del opened[name]
    if is_group:
        opened[name] = np.zeros(3)
    else:
        opened.create_group(name)


def store_elsewhere(random, opened, name):
    shape, dtype = opened[name].shape, opened[name].dtype
    del opened[name]
    opened.create_dataset(name, shape, dtype, external=[(ELSEWHERE, 0, h5py.h5f.UNLIMITED)])


def make_virtual(random, opened, name):
    shape, dtype = opened[name].shape, opened[name].dtype
    del opened[name]
    layout = h5py.VirtualLayout(shape, dtype)
    if shape and 0 not in shape:
        layout[...] = h5py.VirtualSource(random.choice(["other.h5", "."]), "/hdem/block_area", shape)
    opened.create_virtual_dataset(name, layout)


def other_shape(random, opened, name):
    """Nothing stored: a small file that claims much."""
    dtype = opened[name].dtype
    del opened[name]
    extents = tuple(1 << random.randrange(bits) for bits in (40, 20, 3)[:random.randrange(4)])
    chunks = tuple(min(extent, limit) for extent, limit in zip(extents, (1 << 16, 1 << 6, 1))) if extents and random.random() < 0.7 else None
    opened.create_dataset(name, extents, dtype, chunks=chunks, compression=random.choice([None, 1]) if chunks else None)


def other_rows(random, opened, name):
    """Some more or fewer, stored."""
    values = opened[name][...]
    del opened[name]
    opened[name] = np.resize(values, (max(0, (values.shape[0] if values.shape else 1) + random.choice([-1, 1, 2, 100])), *values.shape[1:]))


def packed_zeros(random, opened, name):
    """Stored in truth, and a thousand times as large in memory."""
    dtype = opened[name].dtype
    del opened[name]
    count, part = random.choice([1000, 1 << 20, 1 << 22]), max(1, (1 << 24) // dtype.itemsize)    # in parts: what the change takes is not counted
    packed = opened.create_dataset(name, (count,), dtype, chunks=True, compression=random.choice(["gzip", "lzf"]))
    for first in range(0, count, part):
        packed[first:first + part] = np.zeros(min(part, count - first), dtype)


def other_type(random, opened, name):
    shape = opened[name].shape
    del opened[name]
    dtype = random.choice(["f8", "f4", "i8", "i4", "u1", "u8", ">f8", ">i4", "f2", "S3", "c16", bool, h5py.string_dtype(), h5py.vlen_dtype("i4"),
                           h5py.enum_dtype({"A": 1}, "i4"), h5py.ref_dtype, np.dtype([("x", "f8")]), np.dtype(("f8", (3,)))])
    opened.create_dataset(name, shape, dtype)


def change_element(random, opened, name):
    data = opened[name]
    if not data.size:
        return
    values = data[...]
    at = random.randrange(values.size)
    if values.dtype.kind == "S":
        values.flat[at] = bytes(random.randrange(256) for _ in range(values.dtype.itemsize))
    else:
        with np.errstate(all="ignore"):
            values.flat[at] = np.float64(random.choice(NUMBERS)).astype(values.dtype)
            if random.random() < 0.2:
                values[...] = values.flat[at]
    data[...] = values


def delete_attribute(random, opened, holder, name):
    del opened[holder].attrs[name]


def replace_attribute(random, opened, holder, name):
    del opened[holder].attrs[name]
    opened[holder].attrs[name] = random.choice([1.0, np.int64(-1), np.int8(3), np.zeros((2, 3)), np.zeros(5000), np.nan, np.bytes_("x"), "variable", h5py.Empty("f8"),
                                                np.array([1, 0]), np.bytes_(b"\xff\xfe"), np.float64(1e308), np.int64(1 << 62), np.bytes_("x" * 30000)])


OBJECT_CHANGES = [delete, link_outside, link_inside, other_kind, store_elsewhere, make_virtual, other_shape, other_rows, packed_zeros, other_type, change_element,
                  change_element, change_element, change_element]
LINK_CHANGES = [delete, link_outside, link_inside, other_kind]
ATTRIBUTE_CHANGES = [delete_attribute, replace_attribute, replace_attribute]
