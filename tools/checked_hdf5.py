"""Opens HDF5 files that somebody else may have made or damaged: the one way in which hdem's scripts read them.

Whatever is not as asked for is a ResultError of one line. Sizes are tested before memory is asked for: elements may not take more than what
the file stores for them, deflated ones not more than 1100 times that. Only what lies in the file itself is read: soft and external links, virtual
datasets, elements in other files, and packers other than hdem's are refused.
"""
import os
from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np

GREATEST_COMPRESSION = 1100    # deflate cannot pack better than about 1 : 1032
LONGEST_ATTRIBUTE = 1 << 20    # bytes
GREATEST_RANK = 4
PACKERS = {h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE, h5py.h5z.FILTER_FLETCHER32}
LAYOUTS = (h5py.h5d.COMPACT, h5py.h5d.CONTIGUOUS, h5py.h5d.CHUNKED)
ANY = -1    # of an extent


class ResultError(Exception):
    """A file that is missing, damaged, or not written by hdem."""


def _text(value):
    return bytes(value).split(b"\0", 1)[0].decode("utf-8", "replace")


class MissingFile(ResultError):
    """It is not there."""


class CheckedFile:
    """To be used with `with`. Paths are those of io/hdf5_format.md."""

    def __init__(self, file):
        self.file = Path(file)
        if not self.file.is_file():
            raise MissingFile(f"{file}: no such file. Give the folder of a run, or a file of its results.")
        try:
            self.bytes = os.stat(file).st_size
            self._opened = h5py.File(file, "r")
        except Exception as error:    # of what the library raises, all means the same
            raise ResultError(f"{file}: cannot be read ({error})") from None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._opened.close()
        except Exception:    # a damaged file may not even be closed; there is nothing to be lost
            pass

    def fail(self, what, why):
        raise ResultError(f"{self.file}: {what}: {why}. The file is damaged: run the case again, or take a copy.") from None

    @contextmanager
    def _reading(self, what):
        """h5py raises nearly any exception over a damaged object."""
        try:
            yield
        except ResultError:
            raise
        except Exception as error:
            self.fail(what, f"cannot be read ({error})")

    def has(self, path):
        """Reached by hard links alone."""
        links, name = self._opened.id.links, ""
        with self._reading(path):
            for part in path.strip("/").split("/"):
                name += "/" + part
                if part and not (links.exists(name.encode(errors="surrogateescape"))
                                 and links.get_info(name.encode(errors="surrogateescape")).type == h5py.h5l.TYPE_HARD):
                    return False
            return True

    def _object(self, path, kind, what):
        if not self.has(path):
            self.fail(path, "not in this file")
        with self._reading(path):
            found = h5py.h5o.open(self._opened.id, path.encode(errors="surrogateescape"))
        if not isinstance(found, kind):
            self.fail(path, f"not a {what}")
        return found

    def children(self, path):
        """Names in a group, sorted."""
        group = self._object(path, h5py.h5g.GroupID, "group")
        with self._reading(path):
            return sorted(name.decode(errors="surrogateescape") for name in group)

    def _shape(self, what, space, expected):
        if space.get_simple_extent_type() == h5py.h5s.NULL or space.get_simple_extent_ndims() > GREATEST_RANK:
            self.fail(what, "an extent that hdem does not write")
        shape = space.get_simple_extent_dims()
        if expected is not None and (len(shape) != len(expected) or any(want not in (ANY, have) for have, want in zip(shape, expected))):
            self.fail(what, f"shape {list(shape)}, expected {['any' if want == ANY else want for want in expected]}".replace("'", ""))
        return shape

    def _check_storage(self, path, dataset, shape, size):
        """Before anything is read: what the dataset says of itself against what the file holds."""
        plan = dataset.get_create_plist()
        layout = plan.get_layout()
        if layout not in LAYOUTS or plan.get_external_count() != 0:
            self.fail(path, "its elements are not in this file")
        packers = [plan.get_filter(i)[0] for i in range(plan.get_nfilters())]
        if not PACKERS.issuperset(packers) or len(set(packers)) != len(packers):
            self.fail(path, "packed in a way that hdem does not use")
        if layout == h5py.h5d.CHUNKED and not all(chunk <= extent for chunk, extent in zip(plan.get_chunk(), shape)):
            self.fail(path, "a chunk that is larger than the data")
        stored = dataset.get_storage_size()
        if stored > self.bytes:    # the library would take memory for it before it finds out
            self.fail(path, f"{stored} stored bytes in a file of {self.bytes}")
        count = 1
        for extent in shape:    # Python's whole numbers do not overflow
            count *= extent
        if count * size > stored * (GREATEST_COMPRESSION if h5py.h5z.FILTER_DEFLATE in packers else 1):
            self.fail(path, f"shape {list(shape)} is too large for {stored} stored bytes")

    def array(self, path, kind, expected):
        """Elements of this numpy type ("f8"; None: any number), in this shape, in which ANY matches all."""
        dataset = self._object(path, h5py.h5d.DatasetID, "dataset")
        with self._reading(path):
            stored_type, shape = dataset.get_type(), self._shape(path, dataset.get_space(), expected)
            if not isinstance(stored_type, (h5py.h5t.TypeIntegerID, h5py.h5t.TypeFloatID)) or kind and stored_type.dtype != np.dtype(kind):
                self.fail(path, "another type of element than expected")
            self._check_storage(path, dataset, shape, stored_type.get_size())
            values = np.empty(shape, stored_type.dtype)
            if values.size:
                dataset.read(h5py.h5s.ALL, h5py.h5s.ALL, values)
            return values

    def texts(self, path, count=ANY, most=None):
        """A list of texts, of at most this many bytes in all."""
        dataset = self._object(path, h5py.h5d.DatasetID, "dataset")
        with self._reading(path):
            stored_type, shape = dataset.get_type(), self._shape(path, dataset.get_space(), (count,))
            self._check_text(path, stored_type)
            self._check_storage(path, dataset, shape, stored_type.get_size())
            if most is not None and shape[0] * stored_type.get_size() > most:
                self.fail(path, f"{shape[0]} texts of {stored_type.get_size()} bytes: too large, hdem writes at most {most} bytes")
            values = np.empty(shape, f"S{stored_type.get_size()}")
            if values.size:
                dataset.read(h5py.h5s.ALL, h5py.h5s.ALL, values, stored_type)
            return [_text(value) for value in values]

    def _check_text(self, what, stored_type):
        if not isinstance(stored_type, h5py.h5t.TypeStringID) or stored_type.is_variable_str():
            self.fail(what, "not a text of fixed length")

    def attributes(self, path, wanted):
        """name -> value; `wanted` maps names to "text", a numpy type, or (numpy type, count). Others come too when they are texts or numbers."""
        holder = self._object(path, (h5py.h5g.GroupID, h5py.h5d.DatasetID), "group or dataset")
        with self._reading(path):
            names = [h5py.h5a.open(holder, index=i).name.decode(errors="surrogateescape") for i in range(h5py.h5a.get_num_attrs(holder))]
        for name in wanted:
            if name not in names:
                self.fail(f"{path}@{name}", "not in this file")
        return {name: self._attribute(holder, path, name, wanted.get(name)) for name in names}

    def _attribute(self, holder, path, name, wanted):
        what = f"{path}@{name}"
        with self._reading(what):
            attribute = h5py.h5a.open(holder, name.encode(errors="surrogateescape"))
            stored_type = attribute.get_type()
            shape = self._shape(what, attribute.get_space(), None if wanted is None else (wanted[1],) if isinstance(wanted, tuple) else ())
            count = int(np.prod(shape, dtype=object))
            if count * stored_type.get_size() > LONGEST_ATTRIBUTE:
                self.fail(what, "too long")
            if wanted == "text" or wanted is None and isinstance(stored_type, h5py.h5t.TypeStringID):
                self._check_text(what, stored_type)
                value = np.empty(shape, f"S{stored_type.get_size()}")
                attribute.read(value, stored_type)
                return _text(value[()]) if shape == () else [_text(one) for one in value.flat]
            kind = np.dtype(wanted[0] if isinstance(wanted, tuple) else wanted) if wanted else None
            if not isinstance(stored_type, (h5py.h5t.TypeIntegerID, h5py.h5t.TypeFloatID)) or kind is not None and stored_type.dtype != kind:
                self.fail(what, "another type of value than expected")
            value = np.empty(shape, stored_type.dtype)
            attribute.read(value)
            return value[()] if shape == () else value


def open_checked(file, filetype, holder, major):
    """A file of this type that hdem wrote in this version of its format."""
    opened = CheckedFile(file)
    try:
        if not opened.has(holder):
            raise ResultError(f"{file}: not a file of type {filetype}")
        head = opened.attributes(holder, {})
        if head.get("filetype") != filetype:
            raise ResultError(f"{file}: not a file of type {filetype}")
        version = opened.attributes(holder, {"version": ("i8", 2)})["version"]
        if version[0] != major:
            raise ResultError(f"{file}: written in version {version[0]} of its format; this program knows version {major}")
        return opened
    except ResultError:
        opened.__exit__()
        raise
