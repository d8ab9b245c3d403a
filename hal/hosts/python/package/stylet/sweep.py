# SPDX-License-Identifier: Apache-2.0
"""Calls one function for many parameters, on all processors or on a cluster, and keeps the results
in one table.

Whatever stops a sweep, it can be resumed from its file: only rows that are not done are run.
"""
from __future__ import annotations

import concurrent.futures
import contextlib
import ctypes
import fcntl
import functools
import os
import pickle
import shlex
import signal
import sys
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from stylet import _stylet
from stylet import hdf5 as h5py
from stylet.given import Array, Path

SAVE_EVERY_S = 1.0  # what a kill may lose
LEFT_OVER_S = 2.0   # processes of a sweep that was killed are gone by then


# A column's unit is the end of its name (CONTRIBUTING.md).
UNITS = {"m": "m", "mm": "mm", "m2": "m2", "m3": "m3", "s": "s", "ms": "ms", "ns": "ns",
         "rad": "rad", "kg": "kg", "n": "N", "nm": "N m", "nm2": "N m2", "pa": "Pa",
         "kpa": "kPa", "j": "J", "hz": "Hz"}

Function = Callable[..., Mapping[str, Any]]
Answer = tuple[int, dict[str, Array] | None, str]  # a row's index, result and error


def sweep(function: Function, parameters: Mapping[str, Any] | Iterable[Mapping[str, Any]],
          workers: int | None = None, client: Any = None, path: Path | None = None,
          attributes: Mapping[str, Any] | None = None,
          progress: Callable[[int, int], object] | None = None) -> dict[str, Array]:
    """Calls function(**row) for each row, and returns a dict of columns.

    `parameters`: columns of equal length by name, or a list of dicts. `function` returns a dict of
    numbers, texts or arrays of one shape, and another process must be able to import it. It runs in
    `workers` processes (None: one for each processor; 0: in this process), or on a Dask `client`.
    The columns are those of the parameters, those of the results, and "error", which is empty or
    says why the row failed: the function raised an exception, ended its process, or returned what
    does not fit the rows before. The results of a failed row are nan, 0 or empty.

    With `path`, everything is kept in an HDF5 file. Rows that it contains are not run again, except
    those that failed. A file is refused if it has other parameters or `attributes`, was written by
    another version or for a function of another name, is being written by another sweep, or was
    changed since a sweep wrote it.

    `progress` is called with the number of rows that are done and the number of all rows, before
    the first row and after each. If it raises an exception, the sweep ends; the rows that are done
    are in the file.

    The file has `attributes`, such as a seed, and the library's version and the name of the
    function. Each column has its unit as an attribute, taken from the end of its name (force_n: N).
    read_table reads the columns."""
    parameters = columns_of(parameters)
    with alone(path):
        table = Table(parameters, path, {**own(attributes), "version": _stylet.version(),
                                         "function": name_of(function)})
        todo = [i for i in range(table.rows) if not table.done[i]]
        done = table.rows - len(todo)
        try:
            if progress:
                progress(done, table.rows)
            for index, result, error in finished(function, table, todo, workers, client):
                table.add(index, result, error)
                done += 1
                if progress:
                    progress(done, table.rows)
        finally:
            table.save()
    return table.columns()


OWN_ATTRIBUTES = ("version", "function", "columns")


def own(attributes: Mapping[str, Any] | None) -> Mapping[str, Any]:
    for name in attributes or {}:
        if name in OWN_ATTRIBUTES:
            raise ValueError(f"attributes: {name}: sweep writes it itself: expected another name")
    return attributes or {}


def name_of(function: Any) -> str:
    """The function's name with that of its module. A script's module is named after its file,
    whether it is run or imported."""
    while isinstance(function, functools.partial):
        function = function.func
    named = function if hasattr(function, "__qualname__") else type(function)
    module = named.__module__
    if module == "__main__":
        file = getattr(sys.modules[module], "__file__", None)
        module = os.path.splitext(os.path.basename(file))[0] if file else module
    return f"{module}.{named.__qualname__}"


@contextlib.contextmanager
def alone(path: Path | None) -> Iterator[None]:
    """Keeps other sweeps from writing the same table, where two would overwrite each other's rows.
    The lock is on a file beside the table, because the table's file is replaced whenever it is
    saved. It ends with its process, however that ends."""
    if path is None:
        yield
        return
    lock = f"{os.fspath(path)}.lock"
    with locked(lock, path):
        try:
            yield
        finally:
            os.unlink(lock)


@contextlib.contextmanager
def locked(lock: str, path: Path) -> Iterator[None]:
    end = time.monotonic() + LEFT_OVER_S
    while True:
        with open(lock, "ab") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                if time.monotonic() > end:
                    raise RuntimeError(f"{path}: another sweep is writing it: expected its end, or "
                                       "another path") from None
                time.sleep(0.05)
                continue
            except OSError as error:  # some file systems of clusters have no locks
                warnings.warn(f"{path}: {error}: nothing keeps another sweep from writing it")
            try:
                # Else the one before has taken this file away since it was opened.
                if is_still(lock, file):
                    yield
                    return
            finally:
                with contextlib.suppress(OSError):  # not only closed: forked processes have it, too
                    fcntl.flock(file, fcntl.LOCK_UN)


def is_still(path: str, file: Any) -> bool:
    try:
        return os.path.samestat(os.stat(path), os.fstat(file.fileno()))
    except FileNotFoundError:
        return False


def finished(function: Function, table: Table, todo: list[int], workers: int | None,
             client: Any) -> Iterator[Answer]:
    """Each row's index, result and error, in the order in which rows end."""
    if client is None and workers == 0:
        for index in todo:
            yield index, *attempt(function, table.row(index))
    elif client is None:
        require_importable(function)
        yield from in_processes(function, table, todo, workers)
    else:
        from dask.distributed import as_completed
        from distributed.scheduler import KilledWorker
        futures = {client.submit(attempt, function, table.row(i), pure=False): i for i in todo}
        for future in as_completed(futures):
            try:
                result, error = future.result()
            except KilledWorker as killed:  # by this row, again and again: not the others' fault
                result, error = None, f"KilledWorker: {killed}"
            index = futures.pop(future)
            future.release()  # else Dask would run it again when the worker that ran it dies
            yield index, result, error


def require_importable(function: Function) -> None:
    """Refuses a function that cannot be sent to another process, before there are any: their pool
    would wait for it for ever."""
    try:
        pickle.dumps(function)
    except Exception as error:
        raise TypeError(f"function: {error}: expected one that another process can import, at the "
                        "top of a module; or workers=0") from None


def in_processes(function: Function, table: Table, todo: list[int],
                 workers: int | None) -> Iterator[Answer]:
    workers = workers or os.cpu_count() or 1
    while todo:
        left = set(todo)
        for answer in of_pool(function, table, todo, workers):
            left.discard(answer[0])
            yield answer
        todo = [index for index in todo if index in left]
        # A process ended. The rows that were under way are the first ones that have no answer, as
        # many as there are processes and places in their queue; each now runs in a pool of its own.
        under_way, todo = todo[:2 * workers + 1], todo[2 * workers + 1:]
        for index in under_way:
            answer = index, None, "its process ended"
            for answer in of_pool(function, table, [index], 1):
                pass
            yield answer


def of_pool(function: Function, table: Table, todo: list[int], workers: int) -> Iterator[Answer]:
    """Each row's index, result and error, for all rows or until a process ends."""
    pool = concurrent.futures.ProcessPoolExecutor(workers, initializer=end_with_parent,
                                                  initargs=(os.getpid(),))
    try:
        futures = {pool.submit(attempt, function, table.row(i)): i for i in todo}
        for future in concurrent.futures.as_completed(futures):
            yield futures[future], *future.result()
    except concurrent.futures.BrokenExecutor:
        pass
    finally:
        pool.shutdown(cancel_futures=True)


def end_with_parent(parent: int) -> None:
    """Ends this process with its parent, so that nothing computes on for a sweep that was killed
    (Linux: prctl, PR_SET_PDEATHSIG)."""
    prctl = getattr(ctypes.CDLL(None), "prctl", None)
    if prctl is not None:
        prctl(1, signal.SIGKILL)
        if os.getppid() != parent:  # it has ended before
            os._exit(1)


def attempt(function: Function, row: dict[str, Any]) -> tuple[dict[str, Array] | None, str]:
    """The row's result, or why there is none: one failure must not end thousands of other rows."""
    try:
        return {name: number_or_text(name, value)
                for name, value in dict(function(**row)).items()}, ""
    except (Exception, SystemExit) as error:
        return None, told(error)


def told(error: BaseException) -> str:
    """The error as a text that every file accepts, whatever it contains."""
    try:
        text = f"{type(error).__name__}: {error}"
    except Exception:
        text = type(error).__name__
    return text.encode("utf-8", "backslashreplace").decode().replace("\0", "\\0")


def number_or_text(name: str, value: Any) -> Array:
    array = np.asarray(value)
    if not isinstance(name, str) or array.dtype.kind not in "biufcUS":
        raise TypeError(f"result {name} = {value!r}: expected a name, and numbers or texts in an "
                        "array")
    return array


def columns_of(parameters: Mapping[str, Any] | Iterable[Mapping[str, Any]]) -> dict[str, Array]:
    if not isinstance(parameters, Mapping):
        rows = list(parameters)
        names = list(rows[0]) if rows else []
        for i, row in enumerate(rows):
            if row.keys() != rows[0].keys():
                raise ValueError(f"parameters[{i}]: {', '.join(row)}: expected the names of the "
                                 f"first row: {', '.join(names)}")
        parameters = {name: [row[name] for row in rows] for name in names}
    columns = {name: np.asarray(values) for name, values in parameters.items()}
    if len({len(column) for column in columns.values()}) > 1:
        raise ValueError("parameters: " + ", ".join(
            f"{name} has {len(column)}" for name, column in columns.items())
            + ": expected columns of one length")
    return columns


class Table:
    """Parameters and the results so far. Its file is written as a whole or not at all."""

    def __init__(self, parameters: dict[str, Array], path: Path | None,
                 attributes: Mapping[str, Any]) -> None:
        self.parameters, self.path, self.attributes = parameters, path, attributes
        self.rows = len(next(iter(parameters.values()), ()))
        self.done = np.zeros(self.rows, bool)
        self.error = np.full(self.rows, "", object)
        self.results: dict[str, Array] = {}
        self.loaded: tuple[str, ...] = ()
        self.saved_at = time.monotonic()
        if path is not None and os.path.exists(path):
            self.load(path)

    def row(self, index: int) -> dict[str, Any]:
        return {name: plain(column[index]) for name, column in self.parameters.items()}

    def add(self, index: int, result: dict[str, Array] | None, error: str) -> None:
        if result and self.loaded and not any(name in self.loaded for name in result):
            raise ValueError(f"{self.path}: has the results {', '.join(self.loaded)}, and the "
                             f"function gives {', '.join(result)}: expected the "
                             "function that wrote it")
        result = result or {}
        try:
            columns = {name: self.with_room_for(name, value) for name, value in result.items()}
        except ValueError as refused:
            columns, error = {}, told(refused)
        for name, column in columns.items():
            value = result[name]
            column[index] = value.item() if column.dtype == object and not value.ndim else value
        self.results.update(columns)
        self.done[index], self.error[index] = True, error
        if time.monotonic() - self.saved_at > SAVE_EVERY_S:
            self.save()

    def with_room_for(self, name: str, value: Array) -> Array:
        """The column, of a type that also holds this value: a first row of integers must not round
        later rows."""
        if name in self.parameters or name == "error":
            raise ValueError(f"result {name} has the name of another column")
        column = self.results.get(name)
        if column is None:
            return empty_column(self.rows, value)
        texts = column.dtype == object
        if value.shape != column.shape[1:] or (value.dtype.kind in "US") != texts:
            raise ValueError(f"result {name}: {value.dtype} of shape {value.shape}: expected what "
                             f"earlier rows gave, {column.dtype} of shape {column.shape[1:]}")
        if texts or np.can_cast(value.dtype, column.dtype):
            return column
        if {column.dtype.kind, value.dtype.kind} == {"i", "u"}:  # numpy would round both
            if (column < 0).any() or (value < 0).any():
                raise ValueError(f"result {name}: integers below 0 and from 2^63 on: expected "
                                 "numbers that one type holds")
            return column.astype(np.uint64)
        wider = column.astype(np.result_type(column, value))
        if wider.dtype.kind in "fc" and column.dtype.kind not in "fc":
            wider[~self.done | (self.error != "")] = np.nan
        return wider

    def columns(self) -> dict[str, Array]:
        return {**self.parameters, **{name: column.astype(str) if column.dtype == object else column
                                      for name, column in self.results.items()},
                "error": self.error.astype(str)}

    def save(self) -> None:
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

    def load(self, path: Path) -> None:
        with h5py.File(path, "r") as file:
            require_table(path, file)
            if "function" not in file.attrs:
                raise ValueError(nameless(path, self.attributes["function"]))
            for name, value in self.attributes.items():
                if not np.array_equal(file.attrs.get(name), value):
                    raise ValueError(f"{path}: {name} is {file.attrs.get(name)}, and here "
                                     f"{value}: expected the same")
            kept = {name: got(column) for name, column in file.get("parameters", {}).items()}
            same = kept.keys() == self.parameters.keys() and all(
                np.array_equal(kept[name], self.parameters[name]) for name in kept)
            if not same:
                raise ValueError(f"{path}: holds the results of other parameters")
            self.error = got(file["rows/error"]).astype(object)
            self.done = got(file["rows/done"]).astype(bool) & (self.error == "")
            for name, column in file.get("results", {}).items():
                values = got(column)
                self.results[name] = values.astype(object) if values.dtype.kind == "U" else values
            self.loaded = tuple(self.results)


def require_table(path: Path, file: Any) -> None:
    """Refuses a file that was changed since sweep wrote it: its list must have all columns, and
    each column as many rows."""
    listed = file.attrs.get("columns")
    if listed is None or "rows/done" not in file or "rows/error" not in file:
        raise ValueError(f"{path}: not a table of sweep: expected one, or a new path")
    columns = {name: file[group][name] for group in ("parameters", "results")
               for name in file.get(group, {})}
    for name in listed:
        if name not in columns and name != "error":
            raise ValueError(f"{path}: column {name} is missing: expected the table that sweep "
                             "left")
    rows = len(file["rows/done"])
    for name, column in {**columns, "error": file["rows/error"]}.items():
        if name not in listed:
            raise ValueError(f"{path}: column {name} is not of this table: expected the table "
                             "that sweep left")
        texts = isinstance(column, h5py.Dataset) and h5py.check_string_dtype(column.dtype)
        if not isinstance(column, h5py.Dataset) or not (texts or column.dtype.kind in "biufc") or (
                column.shape[:1] != (rows,)):
            raise ValueError(f"{path}: column {name}: expected {rows} rows of numbers or texts")


def nameless(path: Path, function: str) -> str:
    """The message about a table of an old version, which has no name of a function: only its author
    knows which function it belongs to."""
    name = f"h5py.File({os.fspath(path)!r}, 'r+').attrs['function'] = {function!r}"
    return (f"{path}: does not say which function wrote it, as tables of earlier versions do not: "
            f"expected another path; or, if it was {function}, its name in the file: "
            f"python3 -c {shlex.quote('import h5py; ' + name)}")


def plain(value: Any) -> Any:
    """A number or text of Python's own types, which every function accepts."""
    return value.item() if isinstance(value, np.generic) else value


def empty_column(rows: int, value: Array) -> Array:
    """Room for such a value in every row; integers stay integers."""
    if value.dtype.kind in "US":
        return np.full((rows, *value.shape), "", object)
    missing = np.nan if value.dtype.kind in "fc" else 0
    return np.full((rows, *value.shape), missing, value.dtype)


def put(file: Any, place: str, column: Array) -> None:
    texts = column.dtype.kind in "UO"
    made = file.create_dataset(place, data=column.astype(object) if texts else column,
                               dtype=h5py.string_dtype() if texts else None)
    if not texts and unit_of(place):
        made.attrs["unit"] = unit_of(place)


def unit_of(name: str) -> str:
    """The unit that ends a name, as in "N/m" for stiffness_n_per_m; empty if there is none."""
    words = name.rpartition("/")[2].split("_")
    first = len(words)
    while first > 1 and (words[first - 1] in UNITS or words[first - 1] == "per"):
        first -= 1
    over, _, under = " ".join(words[first:]).partition("per")
    above, below = (" ".join(UNITS.get(word, word) for word in part.split())
                    for part in (over, under))
    return f"{above or 1}/{below}" if below else above


def read_table(path: Path) -> tuple[dict[str, Array], dict[str, Any]]:
    """The columns in a file of sweep, and its attributes. For a row that has not been run yet,
    "error" says so."""
    with h5py.File(path, "r") as file:
        columns = {name: got(file[group][name]) for group in ("parameters", "results")
                   for name in file.get(group, {})}
        columns["error"] = np.where(got(file["rows/done"]), got(file["rows/error"]), "not run yet")
        return {name: columns[name] for name in file.attrs["columns"]}, dict(file.attrs)


def got(column: Any) -> Array:
    texts = h5py.check_string_dtype(column.dtype) is not None
    return column.asstr()[:].astype(str) if texts else column[:]
