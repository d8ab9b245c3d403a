# SPDX-License-Identifier: Apache-2.0
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

input_dtype: np.dtype
output_dtype: np.dtype
config_dtype: np.dtype
needle_dtype: np.dtype
obstacle_dtype: np.dtype
voxel_dtype: np.dtype
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

class Organ:
    info: OrganInfo
    materials: tuple[Material, ...]
    voxels: NDArray[Any]
    vertices: NDArray[np.float32]
    vertex_materials: NDArray[np.uint8]
    triangles: NDArray[np.uint32]
    @staticmethod
    def read(path: Any) -> Organ: ...
    @staticmethod
    def from_bytes(content: bytes) -> Organ: ...
    def raycast(self, origin_m: Sequence[float], direction: Sequence[float]) -> float | None: ...

class Simulation:
    needles: int
    def __init__(self, *arguments: Any) -> None: ...
    def _set_obstacles(self, obstacles: list[NDArray[Any]]) -> None: ...
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
    def restore(self, snapshot: bytes) -> None: ...
    def difference(self, other: Simulation) -> tuple[str, int] | None: ...

class Batch:
    def __init__(self, simulations: list[Simulation], threads: int) -> None: ...
    def run(self, poses: ArrayLike, valid: ArrayLike | None = None,
            out: NDArray[Any] | None = None) -> NDArray[Any]: ...

def version() -> str: ...
def build() -> str: ...
def state_layout() -> int: ...
def status_name(status: int) -> str: ...
def event_name(kind: int) -> str: ...
def pose_of_tip(tip_m: Sequence[float], direction: Sequence[float],
                length_m: float) -> NDArray[np.float32]: ...
def default_config() -> NDArray[Any]: ...
def default_needle() -> NDArray[Any]: ...
def default_obstacle() -> NDArray[Any]: ...
def box_obstacle(x_m: float, y_m: float, z_m: float) -> NDArray[Any]: ...
def sphere_obstacle(radius_m: float) -> NDArray[Any]: ...
