# SPDX-License-Identifier: Apache-2.0
"""The hand's side: devices, the loop that holds one, and the guard between force and hand.

The loop runs in a thread of the library with its own period. Python looks at the newest state, and
nothing that Python does is felt by the hand.
"""
from __future__ import annotations

import enum
from collections.abc import Iterable
from typing import Any

import numpy as np

from stylet import _stylet
from stylet._stylet import Device
from stylet.given import Array
from stylet.simulation import rows_of, Simulation
from stylet.structs import Struct, restored


class Fault(enum.IntEnum):
    """Why a guard lets no force through."""
    NONE = 0
    FORCE_NOT_FINITE = 1
    STALE_SAMPLES = 2
    DEVICE_SILENT = 3
    TOO_LATE = 4
    KERNEL = 5
    TOO_FAST = 6
    BUZZ = 7
    ENERGY = 8
    FORCE_EXPIRED = 9


class GuardMode(enum.IntEnum):
    LET_GO = 0
    UNARMED = 1
    RAMP = 2
    LIVE = 3
    RELEASE = 4
    FADING = 5
    FAULT = 6


class GuardConfig(Struct):
    """Limits of a guard; `for_model` gives those of a known device."""
    _defaults = _stylet.default_guard_config
    period_s: float
    max_force_n: float
    max_slew_n_per_s: float
    ramp_s: float
    watchdog_s: float
    max_speed_m_per_s: float
    buzz_n: float
    continuous_force_n: float
    thermal_s: float
    dead_man_button: int
    acknowledge_button: int
    device_mass_kg: float
    device_damping_n_s_per_m: float
    device_friction_n: float
    device_resolution_m: float
    device_delay_s: float
    stored_energy_j: float
    passivity_damping_n_s_per_m: float
    max_torque_nm: float

    @classmethod
    def for_model(cls, model: str, **fields: Any) -> GuardConfig:
        """The limits of a known model, such as "touch" or "omega.7"; `_stylet.device_models()`
        lists all."""
        return restored(cls, _stylet.guard_config_for(model)).replace(**fields)


class Guard(_stylet.Guard):
    """For a device that your own loop drives: in each tick call `sample`, then `force`, and send
    the force that it returns."""

    def __init__(self, config: GuardConfig | None = None) -> None:
        _stylet.refuse_second_init(self)
        super().__init__(*rows_of(GuardConfig() if config is None else config, GuardConfig))


    def __repr__(self) -> str:
        now = self.report()
        return (f"<stylet.Guard: {GuardMode(now.mode).name}, fault {Fault(now.fault).name}, "
                f"samples {now.samples_used}>")


class LoopConfig(Struct):
    """How the loop runs; with `ticks` 0 it runs until it is stopped."""
    _defaults = _stylet.default_loop_config
    processor: int
    priority: int
    helpers: int
    ticks: int
    virtual_time: int
    lock_memory: int
    show_every_ticks: int


class Hand(Struct):
    """How a device holds a needle: `start` is the needle's pose where the device is at its origin.

    The device's axes are x right, y up, z toward the operator; the needle points along -z."""
    _defaults = _stylet.default_hand
    clutch_button: int
    position_m: Array
    rotation_wxyz: Array
    motion_scale: float
    force_scale: float
    coupling_stiffness_n_per_m: float

    @classmethod
    def at(cls, pose: Array, **fields: Any) -> Hand:
        """The needle begins with its handle at this pose, such as `pose_of_tip` returns."""
        return cls(position_m=pose[:3], rotation_wxyz=pose[3:]).replace(**fields)


class Loop(_stylet.Loop):
    """Devices that hold the needles of a simulation, with a guard for each.

    Until the loop is closed, it alone uses the simulation and the devices; it closes the devices.
    In a with statement it is closed at the end. `take` says whether there is a newer tick;
    `output`, `hand`, `surface` and `needle_shape` show the tick that was taken last.
    """

    def __init__(self, simulation: Simulation, devices: Device | Iterable[Device],
                 hands: Hand | Iterable[Hand], config: LoopConfig | None = None,
                 guards: GuardConfig | Iterable[GuardConfig] = ()) -> None:
        _stylet.refuse_second_init(self)
        devices = [devices] if isinstance(devices, Device) else list(devices)
        super().__init__(simulation, devices, rows_of(hands, Hand), rows_of(guards, GuardConfig),
                         *rows_of(LoopConfig() if config is None else config, LoopConfig))

    def __repr__(self) -> str:
        try:
            now = self.report()
        except RuntimeError:
            return "<stylet.Loop: closed>"
        return f"<stylet.Loop: {'runs' if now.runs else 'does not run'}, tick {now.ticks}>"

    def __enter__(self) -> Loop:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def acknowledge(self, needle: int = 0) -> None:
        """Says that somebody has seen the fault of a hand, so that the force may come back."""
        hand = self.hand(needle)
        self._acknowledge(needle, hand.fault, hand.fault_number)
