# SPDX-License-Identifier: Apache-2.0
"""What `stylet run --record` wrote: every tick of a run, as arrays and curves, and to be run
again."""
from __future__ import annotations

import math
from typing import Any, NoReturn, TypeVar

import numpy as np

from stylet import _stylet
from stylet import hdf5 as h5py
from stylet._stylet import Organ
from stylet.given import Array, Path
from stylet.names import Event
from stylet.simulation import Simulation
from stylet.structs import Config, Needle, Obstacle, Struct

Kind = TypeVar("Kind", bound=Struct)

FORMAT = "stylet-recording"
FORMAT_VERSION = 6  # hal/record/recording_format.h
MOST_TEXT_BYTES = 1 << 24  # as the programs (hal/record/recording_format.cpp)
MOST_CHUNK_BYTES = 16 * 4096 * 4 * 8  # as the programs (hal/record/hdf5_table.cpp)
TICKS_OF_PART = 100_000  # of a replay at a time: 3.6 MB of inputs a needle

TICK_GROUPS = ["input", "output", "device", "guard", "loop"]
# Of an output, what flows through the needle.
FLOW = ("opening_pa", "hub_pa", "flow_m3_per_s", "injected_m3", "plunger_m", "plunger_m_per_s",
        "filled")
CAUSES = ["stiffness", "cutting", "friction", "clamping", "obstacle"]
# Of each cause, as in every other figure (hal/palette.csv).
COLOURS = ["#0072b2", "#c24e00", "#009e73", "#a8478a", "#5c3d00"]
TOTAL = "#1d2733"
SEEN = 1e-3  # of the largest force: less than a line is wide


class Recording:
    """A recording in a file. `recording["output/force_n"]` is a column of the first needle;
    hal/record/README.md lists the columns. An unfinished recording (NAME.PROCESS.tmp) can be read,
    but not replayed."""
    scene_text: str
    scene_file: str
    organ_file: str
    organ_name: str
    stylet_version: str

    def __init__(self, path: Path) -> None:
        self.path = str(path)
        self._columns: dict[str, Array] = {}
        with self._file() as file:
            self._check(file)
            for name in ("scene_text", "scene_file", "organ_file", "organ_name", "stylet_version"):
                setattr(self, name, text_of(file, name))
            self.organ_hash = int(file.attrs["organ_hash"])
            self.final_state_hash = int(file.attrs["final_state_hash"])
            self.lost_records = int(file.attrs["lost_records"])
            self.config = Config(**{key[len("config_"):]: value.tolist()
                                    for key, value in file.attrs.items()
                                    if key.startswith("config_")})
            self.needles = bodies(file["needles"], Needle, _stylet.needle_dtype)
            self.obstacles = bodies(file["obstacles"], Obstacle, _stylet.obstacle_dtype)
            self.directions = file["needles/direction"][:]
            self.entries_m = file["needles/entry_m"][:]
            self.ticks = self._whole_ticks(file)
            self.events = table(file["events"], _stylet.event_dtype,
                                whole=int(file.attrs["ticks"]) > 0)
            lines = text_of(file, "marks").splitlines() if "marks" in file else []
            self.marks = [(int(tick), words) for tick, words in
                          (line.split("\t", 1) for line in lines)]

    def __repr__(self) -> str:
        return (f"<stylet.Recording {self.path!r}: {self.ticks} ticks of {1e3 * self.period_s:g} ms"
                f" in {self.organ_name!r}, needles {len(self.needles)}>")

    def _file(self) -> Any:
        try:
            return h5py.File(self.path, "r")
        except FileNotFoundError:
            raise
        except OSError:
            return h5py.File(self.path, "r", swmr=True)  # that of a running or killed run

    def _check(self, file: Any) -> None:
        kind = text_of(file, "format") if "format" in file else ""
        version = int(file.attrs.get("format_version", 0))
        if kind != FORMAT or version != FORMAT_VERSION:
            raise ValueError(f"{self.path}: {kind or 'no recording'} {version}: expected {FORMAT} "
                             f"{FORMAT_VERSION}; record again")

    def _whole_ticks(self, file: Any) -> int:
        """The number of ticks that all columns have; in a file that still grows they differ by some
        rows."""
        told = int(file.attrs["ticks"])
        places = ["", *(f"needle{i}/" for i in range(1, len(self.needles)))]
        columns = [column for place in places for name in TICK_GROUPS
                   for column in file[place + name].values()]
        rows = [stored_rows(column, whole=told > 0) for column in columns]
        for column, count in zip(columns, rows):
            if told > 0 and count != told:
                raise ValueError(f"{self.path}: {column.name[1:]}: {count} rows: expected {told}")
        return min(rows)

    @property
    def period_s(self) -> float:
        return self.config.period_s

    @property
    def time_s(self) -> Array:
        """The time since the start, at the end of each tick."""
        return self.period_s * np.arange(1, self.ticks + 1)

    def column(self, name: str, needle: int = 0) -> Array:
        """A column of one needle, with a row for each tick. It is read from the file once."""
        if not 0 <= needle < len(self.needles):
            raise IndexError(f"{self.path}: needle {needle}: expected 0 to {len(self.needles) - 1}")
        place = name if needle == 0 else f"needle{needle}/{name}"
        if place not in self._columns:
            with self._file() as file:
                group = place.rpartition("/")[0]
                if place not in file or place == group:
                    known = sorted(file[group]) if group in file else TICK_GROUPS
                    raise KeyError(f"{self.path}: {place}: no such column: expected one of "
                                   f"{', '.join(known)}")
                self._columns[place] = file[place][:self.ticks]
        return self._columns[place]

    def __getitem__(self, name: str) -> Array:
        return self.column(name)

    def outputs(self, needle: int = 0) -> Any:
        """The answers of all ticks, as `Simulation.run` returns them."""
        rows = np.zeros(self.ticks, _stylet.output_dtype)
        for name in _stylet.output_dtype.names or ():
            rows[name] = self.column(f"{'flow' if name in FLOW else 'output'}/{name}", needle)
        return rows.view(np.recarray)

    def inputs(self) -> Array:
        """The inputs of the kernel, as `Simulation.run` takes them: (ticks, needles)."""
        rows = np.empty((self.ticks, len(self.needles)), _stylet.input_dtype)
        rows["struct_bytes"] = _stylet.input_dtype.itemsize
        for i in range(len(self.needles)):
            for name in ("valid", "position_m", "rotation_wxyz"):
                rows[name][:, i] = self.column(f"input/{name}", i)
            rows["plunger_n"][:, i] = self.column("flow/plunger_n", i)
        return rows

    def force_n(self, cause: str | None = None, needle: int = 0) -> Array:
        """Force along the direction of insertion; it is positive if it resists the insertion.
        `cause`: one of CAUSES, for that part of the force."""
        column = "output/force_n" if cause is None else f"output/{cause}_n"
        return -self.column(column, needle) @ self.directions[needle]

    def replay(self, organ: Organ, check: bool = True) -> Simulation:
        """Runs all ticks again, and returns the simulation as it is at the end.

        Raises ValueError if the organ is another, the recording is incomplete, or the state at the
        end has other bits."""
        if organ.info.hash != self.organ_hash:
            raise ValueError(f"{self.path}: recorded in organ {self.organ_hash:016x}, and this is "
                             f"{organ.info.hash:016x}")
        if self.lost_records or not self.final_state_hash:
            raise ValueError(f"{self.path}: it is incomplete, so it cannot be replayed")
        simulation = Simulation(organ, self.needles, self.config, self.obstacles)
        inputs = self.inputs()
        for first in range(0, self.ticks, TICKS_OF_PART):
            simulation.run(inputs[first:first + TICKS_OF_PART])
        if check and simulation.hash() != self.final_state_hash:
            raise ValueError(f"{self.path}: state {simulation.hash():016x} after {self.ticks} ticks"
                             f", recorded was {self.final_state_hash:016x}")
        return simulation

    def plot(self, needle: int = 0, figure: Any = None) -> Any:
        """Draws the force by cause over time, and over depth, in a figure of matplotlib, and
        returns the figure."""
        if figure is None:
            import matplotlib.pyplot  # only who plots needs it
            figure = matplotlib.pyplot.figure(figsize=(7.5, 7), constrained_layout=True)
        over_time, over_depth = figure.subplots(2, 1)
        depth_mm = 1e3 * self.column("output/depth_m", needle)
        total = self.force_n(None, needle)
        for cause, colour in zip(CAUSES, COLOURS):
            force = self.force_n(cause, needle)
            if np.abs(force).max(initial=0) > SEEN * np.abs(total).max(initial=0):
                over_time.plot(self.time_s, force, color=colour, label=cause, linewidth=1)
        over_time.plot(self.time_s, total, color=TOTAL, label="total", linewidth=1.2)
        for event in self.events[self.events["needle"] == needle]:
            if event["kind"] in (Event.PUNCTURE, Event.EXIT):
                over_time.axvline(event["tick"] * self.period_s, color="0.7", linewidth=0.8)
        over_time.set(xlabel="time (s)", ylabel="axial force (N)", title=self.organ_name)
        over_time.legend(loc="best")
        over_depth.plot(depth_mm, total, color=TOTAL, linewidth=1)
        over_depth.set(xlabel="depth of the tip (mm)", ylabel="axial force (N)")
        return figure


def refuse(item: Any, why: str) -> NoReturn:
    raise ValueError(f"{item.file.filename}: {item.name[1:]}: {why}")


def text_of(file: Any, name: str) -> str:
    text = file[name]
    kind = h5py.check_string_dtype(text.dtype)
    if text.shape != () or kind is None or not 0 < (kind.length or 0) <= MOST_TEXT_BYTES:
        refuse(text, "text of another type: expected one string of at most 16 MiB")
    return text[()].decode("utf-8").rstrip("\0")


def stored_rows(column: Any, whole: bool = True) -> int:
    """The number of rows of a column for which the file holds numbers. A damaged file may claim
    more, which would be read as zeros until memory is full: in a `whole` file that is refused."""
    row = math.prod(column.shape[1:])
    if column.is_virtual or column.external:
        stored = 0  # in other files
    elif column.chunks is None:
        stored = column.id.get_storage_size() // (row * column.dtype.itemsize)
    elif math.prod(column.chunks) * column.dtype.itemsize > MOST_CHUNK_BYTES:
        refuse(column, f"chunks of {' x '.join(map(str, column.chunks))} numbers: expected at most "
                       f"{MOST_CHUNK_BYTES} bytes in a chunk")
    else:
        stored = column.id.get_num_chunks() * math.prod(column.chunks) // row
    if whole and stored < len(column):
        refuse(column, f"{len(column)} rows, of which the file holds {stored}: file damaged")
    return min(stored, len(column))


def table(group: Any, dtype: Any, whole: bool = True) -> Array:
    """Columns of a group as the fields of a dtype; columns that the dtype lacks are left out."""
    rows = np.zeros(min(stored_rows(column, whole) for column in group.values()), dtype)
    for name in dtype.names:
        rows[name] = group[name][:len(rows)].reshape(rows[name].shape)
    return rows


def bodies(group: Any, kind: type[Kind], dtype: Any) -> list[Kind]:
    return [kind(**{name: row[name].tolist() for name in dtype.names})
            for row in table(group, dtype)]
