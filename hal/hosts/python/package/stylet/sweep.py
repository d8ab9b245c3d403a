# SPDX-License-Identifier: Apache-2.0
"""One function for many parameters, on all processors or on a cluster; results in one table.

Resumed from its file after anything that stopped it: only rows that are not done are run.
"""
import concurrent.futures
import os
import time

import numpy as np

from stylet import _stylet
from stylet import hdf5 as h5py

SAVE_EVERY_S = 1.0  # what a kill may lose


# A column's unit is the end of its name (CONTRIBUTING.md).
UNITS = {"m": "m", "mm": "mm", "m2": "m2", "m3": "m3", "s": "s", "ms": "ms", "ns": "ns",
         "rad": "rad", "kg": "kg", "n": "N", "nm": "N m", "nm2": "N m2", "pa": "Pa",
         "kpa": "kPa", "j": "J", "hz": "Hz"}


def sweep(function, parameters, workers=None, client=None, path=None, attributes=None):
    """Calls function(**row) for each row, and returns a dict of columns.

    `parameters`: columns of one length by name, or a list of dicts. `function` returns a dict of
    numbers, texts or arrays of one shape, and can be imported by another process. It runs in
    `workers` processes (None: one a processor; 0: in this one), or on a Dask `client`. The columns
    are the parameters', the results', and "error": empty, or why a row failed; a failed row's
    results are nan, 0 or empty. With `path`, all is kept in an HDF5 file, and rows that are there
    are not run again, but for those that failed; a file of other parameters, of other `attributes`
    or of another version is refused.

    The file's attributes are `attributes`, such as a seed, and the library's version; a column's
    attribute is its unit, as its name ends (force_n: N). read_table gives the columns again."""
    table = Table(columns_of(parameters), path, attributes)
    todo = [i for i in range(table.rows) if not table.done[i]]
    try:
        for index, result, error in finished(function, table, todo, workers, client):
            table.add(index, result, error)
    finally:
        table.save()
    return table.columns()


def finished(function, table, todo, workers, client):
    """Each row's index, result and error, as it ends."""
    if client is None and workers == 0:
        for index in todo:
            yield index, *attempt(function, table.row(index))
    elif client is None:
        pool = concurrent.futures.ProcessPoolExecutor(workers)
        try:
            futures = {pool.submit(attempt, function, table.row(i)): i for i in todo}
            for future in concurrent.futures.as_completed(futures):
                yield futures[future], *future.result()
        finally:
            pool.shutdown(cancel_futures=True)
    else:
        from dask.distributed import as_completed
        from distributed.scheduler import KilledWorker
        futures = {client.submit(attempt, function, table.row(i), pure=False): i for i in todo}
        for future in as_completed(futures):
            try:
                answer = future.result()
            except KilledWorker as error:  # by this row, again and again: not the others' fault
                answer = None, f"KilledWorker: {error}"
            index = futures.pop(future)
            future.release()  # else Dask would run it again when the worker that ran it dies
            yield index, *answer


def attempt(function, row):
    """The row's result, or why there is none: one failure must not end thousands of others."""
    try:
        return dict(function(**row)), ""
    except Exception as error:
        return None, f"{type(error).__name__}: {error}"


def columns_of(parameters):
    if not isinstance(parameters, dict):
        rows = list(parameters)
        names = rows[0].keys() if rows else ()
        if any(row.keys() != names for row in rows):
            raise ValueError("parameters: every row needs the same names")
        parameters = {name: [row[name] for row in rows] for name in names}
    columns = {name: np.asarray(values) for name, values in parameters.items()}
    if len({len(column) for column in columns.values()}) > 1:
        raise ValueError("parameters: columns of different lengths")
    return columns


class Table:
    """Parameters and what is known of their results; the file appears as a whole or not at all."""

    def __init__(self, parameters, path, attributes=None):
        self.parameters, self.path = parameters, path
        self.attributes = {**(attributes or {}), "version": _stylet.version()}
        self.rows = len(next(iter(parameters.values()), ()))
        self.done = np.zeros(self.rows, bool)
        self.error = np.full(self.rows, "", object)
        self.results = {}
        self.saved_at = time.monotonic()
        if path is not None and os.path.exists(path):
            self.load()

    def row(self, index):
        return {name: plain(column[index]) for name, column in self.parameters.items()}

    def add(self, index, result, error):
        for name, value in (result or {}).items():
            value = np.asarray(value)
            if name in self.parameters or name == "error":
                raise ValueError(f"result {name} has the name of another column")
            if name not in self.results:
                self.results[name] = empty_column(self.rows, value)
            column = self.results[name] = self.with_room_for(self.results[name], value)
            column[index] = value.item() if column.dtype == object and not value.ndim else value
        self.done[index], self.error[index] = True, error
        if time.monotonic() - self.saved_at > SAVE_EVERY_S:
            self.save()

    def with_room_for(self, column, value):
        """A first row of whole numbers must not round the others."""
        if column.dtype == object or np.can_cast(value.dtype, column.dtype):
            return column
        wider = column.astype(np.result_type(column, value))
        if wider.dtype.kind in "fc" and column.dtype.kind not in "fc":
            wider[~self.done | (self.error != "")] = np.nan
        return wider

    def columns(self):
        return {**self.parameters, **{name: column.astype(str) if column.dtype == object else column
                                      for name, column in self.results.items()},
                "error": self.error.astype(str)}

    def save(self):
        if self.path is None:
            return
        partial = f"{self.path}.{os.getpid()}.tmp"
        with h5py.File(partial, "w") as file:
            file.attrs.update(self.attributes)
            file.attrs["columns"] = list(self.columns())
            for group, columns in (("parameters", self.parameters), ("results", self.results),
                                   ("rows", {"done": self.done, "error": self.error})):
                for name, column in columns.items():
                    put(file, f"{group}/{name}", column)
        os.replace(partial, self.path)
        self.saved_at = time.monotonic()

    def load(self):
        with h5py.File(self.path, "r") as file:
            for name, value in self.attributes.items():
                if not np.array_equal(file.attrs.get(name), value):
                    raise ValueError(f"{self.path}: {name} is {file.attrs.get(name)}, and here "
                                     f"{value}: expected the same")
            kept = {name: got(column) for name, column in file.get("parameters", {}).items()}
            same = kept.keys() == self.parameters.keys() and all(
                np.array_equal(kept[name], self.parameters[name]) for name in kept)
            if not same:
                raise ValueError(f"{self.path}: holds the results of other parameters")
            self.error = got(file["rows/error"]).astype(object)
            self.done = got(file["rows/done"]).astype(bool) & (self.error == "")
            for name, column in file.get("results", {}).items():
                values = got(column)
                self.results[name] = values.astype(object) if values.dtype.kind == "U" else values


def plain(value):
    """A number or text of Python's own, which every function takes."""
    return value.item() if isinstance(value, np.generic) else value


def empty_column(rows, value):
    """Room for such a value in every row; whole numbers keep their kind."""
    if value.dtype.kind in "US":
        return np.full((rows, *value.shape), "", object)
    missing = np.nan if value.dtype.kind in "fc" else 0
    return np.full((rows, *value.shape), missing, value.dtype)


def put(file, place, column):
    texts = column.dtype.kind in "UO"
    made = file.create_dataset(place, data=column.astype(object) if texts else column,
                               dtype=h5py.string_dtype() if texts else None)
    if not texts and unit_of(place):
        made.attrs["unit"] = unit_of(place)


def unit_of(name):
    """The unit that ends a name, as in "N/m" for stiffness_n_per_m; empty if there is none."""
    words = name.rpartition("/")[2].split("_")
    first = len(words)
    while first > 1 and (words[first - 1] in UNITS or words[first - 1] == "per"):
        first -= 1
    over, _, under = " ".join(words[first:]).partition("per")
    above, below = (" ".join(UNITS.get(word, word) for word in part.split())
                    for part in (over, under))
    return f"{above or 1}/{below}" if below else above


def read_table(path):
    """The columns in a file of sweep, and its attributes."""
    with h5py.File(path, "r") as file:
        columns = {name: got(file[group][name]) for group in ("parameters", "results")
                   for name in file.get(group, {})}
        columns["error"] = got(file["rows/error"])
        return {name: columns[name] for name in file.attrs["columns"]}, dict(file.attrs)


def got(column):
    texts = h5py.check_string_dtype(column.dtype) is not None
    return column.asstr()[:].astype(str) if texts else column[:]
