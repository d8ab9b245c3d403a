# SPDX-License-Identifier: Apache-2.0
from typing import Any, Sequence

import numpy as np
from _typeshed import ReadableBuffer
from numpy.typing import ArrayLike, NDArray

input_dtype: np.dtype
output_dtype: np.dtype
config_dtype: np.dtype
needle_dtype: np.dtype
obstacle_dtype: np.dtype
voxel_dtype: np.dtype
cube_dtype: np.dtype
constraint_particle_dtype: np.dtype
obstacle_touch_dtype: np.dtype
event_dtype: np.dtype

class StyletError(Exception):
    status: int
    status_name: str
    place: str
    index: int
    value: float
    least: float
    most: float
    expected: str
    text: str

class OrganInfo:
    format_version: int
    hash: int
    name: str
    voxel_edge_m: float
    origin_m: tuple[float, float, float]
    size: tuple[int, int, int]
    voxels: int
    vertices: int
    triangles: int
    materials: int
    low_m: tuple[float, float, float]
    high_m: tuple[float, float, float]

class Material:
    name: str
    source: str
    density_kg_per_m3: float
    youngs_modulus_pa: float
    poisson_ratio: float
    relaxing_fraction: float
    relaxation_time_s: float
    puncture_force_n: float
    cutting_force_n: float
    recut_fraction: float
    coulomb_friction_n_per_m: float
    static_friction_n_per_m: float
    stribeck_velocity_m_per_s: float
    viscous_friction_n_s_per_m2: float
    puncture_velocity_exponent: float
    membrane_n_per_m: float
    strain_stiffening: float
    fracture_toughness_j_per_m2: float
    toughness_velocity_exponent: float
    needle_friction_coefficient: float
    fluid_pressure_pa: float
    fluid_conductance_m3_per_pa_s: float
    fluid_viscosity_pa_s: float

class Pool:
    used: int
    used_max: int
    capacity: int

class Stats:
    filter_passes: int
    ticks: int
    constraint_particles: Pool
    coupled_voxels: Pool
    tracks: Pool
    obstacle_contacts: Pool
    input_not_finite: int
    input_clamped: int
    input_missing: int
    cp_pool_full: int
    cp_voxel_pool_full: int
    contact_budget: int
    fault: int
    obstacle_pool_full: int
    needle_unstable: int
    coupling_shortfall: float
    unit_in_voxels: float

class Energy:
    elastic_j: float
    kinetic_j: float
    coupling_j: float
    bending_j: float
    work_by_hand_j: float
    friction_j: float
    cutting_j: float
    relaxation_j: float
    obstacles_j: float
    sliding_j: float

class Organ:
    info: OrganInfo
    materials: tuple[Material, ...]
    voxels: NDArray[Any]
    cubes: NDArray[Any]
    vertices: NDArray[np.float32]
    vertex_materials: NDArray[np.uint8]
    triangles: NDArray[np.uint32]
    @staticmethod
    def read(path: Any) -> Organ: ...
    @staticmethod
    def from_bytes(content: ReadableBuffer) -> Organ: ...
    def raycast(self, origin_m: ArrayLike, direction: ArrayLike) -> float | None: ...

class Simulation:
    needles: int
    def __init__(self, *arguments: Any) -> None: ...
    def _set_obstacles(self, obstacles: list[NDArray[Any]], /) -> None: ...
    def tick(self, poses: ArrayLike | None) -> Any: ...
    def run(self, poses: ArrayLike, valid: ArrayLike | None = None,
            out: NDArray[Any] | None = None) -> Any: ...
    def reset(self) -> None: ...
    def surface(self) -> NDArray[np.float32]: ...
    def needle_shape(self, needle: int = 0) -> NDArray[np.float32]: ...
    def particles(self) -> NDArray[np.float32]: ...
    def voxel_corners(self) -> NDArray[np.uint32]: ...
    def constraint_particles(self) -> NDArray[Any]: ...
    def obstacle_touches(self) -> NDArray[Any]: ...
    def events(self) -> NDArray[Any]: ...
    def stats(self) -> Stats: ...
    def energy(self) -> Energy: ...
    def mass(self, material: int) -> tuple[float, float]: ...
    def hash(self) -> int: ...
    def snapshot(self) -> bytes: ...
    def restore(self, snapshot: ReadableBuffer) -> None: ...
    def difference(self, other: Simulation) -> tuple[str, int] | None: ...

class Batch:
    def __init__(self, simulations: tuple[Simulation, ...], threads: int, /) -> None: ...
    def run(self, poses: ArrayLike, valid: ArrayLike | None = None,
            out: NDArray[Any] | None = None) -> NDArray[Any]: ...

class GuardReport:
    mode: int
    fault: int
    fault_number: int
    arming: int
    falls: bool
    force_n: list[float]
    torque_nm: list[float]
    energy_j: float
    samples_used: int
    samples_missing: int
    samples_repeated: int
    samples_lost: int
    samples_old: int
    samples_not_finite: int
    samples_absurd: int
    samples_jumped: int
    force_not_finite: int
    force_limited: int
    slew_limited: int
    force_warm: int
    force_damped: int
    faults: int
    rearms: int

class Guard:
    def __init__(self, config: NDArray[Any], /) -> None: ...
    def sample(self, pose: Sequence[float] | None, now_ns: int, seq: int | None = None,
               buttons: int = 0) -> bool: ...
    def force(self, force_n: Sequence[float]) -> list[float]: ...
    def torque(self, torque_nm: Sequence[float]) -> list[float]: ...
    def end(self, now_ns: int) -> bool: ...
    def trip(self, fault: int) -> None: ...
    def rearm(self, fault_seen: int) -> bool: ...
    def report(self) -> GuardReport: ...

class Device:
    @staticmethod
    def open(uri: str, patience_s: float = 10.0) -> Device: ...
    @staticmethod
    def simulated(travel_m: float, speed_m_per_s: float, hold_s: float = 0.0) -> Device: ...
    def close(self) -> None: ...

class HandReport:
    mode: int
    fault: int
    fault_number: int
    sent_force_n: list[float]
    answered: bool

class LoopReport:
    runs: bool
    ticks: int
    missed_ticks: int
    lost_events: int
    tick_p50_ns: int
    tick_p999_ns: int
    tick_max_ns: int
    late_p50_ns: int
    late_p999_ns: int
    late_max_ns: int
    lacks: str

class Loop:
    def __init__(self, simulation: Simulation, devices: list[Device], hands: list[NDArray[Any]],
                 guards: list[NDArray[Any]], config: NDArray[Any], /) -> None: ...
    def start(self) -> None: ...
    def run(self) -> None: ...
    def stop(self) -> None: ...
    def wait(self) -> None: ...
    def pause(self, paused: bool = True) -> None: ...
    def close(self) -> None: ...
    def take(self) -> bool: ...
    def output(self, needle: int = 0) -> Any: ...
    def hand(self, needle: int = 0) -> HandReport: ...
    def surface(self) -> NDArray[np.float32]: ...
    def needle_shape(self, needle: int = 0) -> NDArray[np.float32]: ...
    def events(self) -> NDArray[Any]: ...
    def _acknowledge(self, needle: int, fault: int, fault_number: int, /) -> None: ...
    def report(self) -> LoopReport: ...
    def trouble(self, needle: int = 0) -> str: ...

def refuse_second_init(object: Any) -> None: ...
def version() -> str: ...
def build() -> str: ...
def state_layout() -> int: ...
def status_name(status: int, /) -> str: ...
def event_name(kind: int, /) -> str: ...
def pose_of_tip(tip_m: ArrayLike, direction: ArrayLike,
                length_m: float) -> NDArray[np.float32]: ...
def default_config() -> NDArray[Any]: ...
def default_needle() -> NDArray[Any]: ...
def preset_needle(name: str, /) -> NDArray[Any]: ...
def needle_presets() -> list[str]: ...
def default_obstacle() -> NDArray[Any]: ...
def box_obstacle(x_m: float, y_m: float, z_m: float, /) -> NDArray[Any]: ...
def sphere_obstacle(radius_m: float, /) -> NDArray[Any]: ...
def default_guard_config() -> NDArray[Any]: ...
def guard_config_for(model: str, /) -> NDArray[Any]: ...
def device_models() -> list[str]: ...
def default_loop_config() -> NDArray[Any]: ...
def default_hand() -> NDArray[Any]: ...
def fault_name(fault: int, /) -> str: ...
