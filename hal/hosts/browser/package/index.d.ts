// SPDX-License-Identifier: Apache-2.0
// Units: SI. Frame: the organ's at rest, right-handed. Arrays of places are Float32Array with x, y
// and z one after the other. If the library refuses something, a StyletError is thrown.
import type {
  Config, ConstraintParticle, Cube, Energy, Event, Material, Needle, Obstacle, ObstacleTouch,
  OrganInfo, Output, Pose, Refusal, Stats, Vec3, Voxel,
} from "./structs.js";

export * from "./structs.js";

/** Something that the library refused: `refusal` says what, where, and what is accepted. */
export class StyletError extends Error {
  constructor(text: string, refusal?: Partial<Refusal>);
  readonly refusal: Partial<Refusal>;
}

/** Bytes of stylet.wasm, a compiled module, a response with it, or its address. */
export type Source = BufferSource | WebAssembly.Module | Response | URL | string;
export interface LoadOptions {
  /** How many threads share a tick, 1 to 16; default 1. The bits do not depend on it. */
  threads?: number;
  /** stylet-threads.wasm, given like `source`; default: the file beside index.mjs. */
  shared?: Source | Promise<Source>;
}
/** Loads the library; without a source, stylet.wasm beside index.mjs. More than one thread needs
 * shared memory, which a page has only if it is crossOriginIsolated. Without shared memory, or if
 * workers are forbidden, there is one thread. */
export function load(source?: Source | Promise<Source>, options?: LoadOptions): Promise<Stylet>;

export interface SimulationOptions {
  /** Fields that differ from the defaults, which Stylet.config() returns. */
  config?: Partial<Config>;
  /** One to four needles; default: [{}], one needle with default values. */
  needles?: Partial<Needle>[];
  /** Up to 16 bodies that no needle enters. */
  obstacles?: Partial<Obstacle>[];
}

export class Stylet {
  private constructor();
  readonly version: string;
  readonly build: string;
  /** How many threads share a tick. They sleep between runs. */
  readonly threads: number;
  /** Ends all threads except the caller's, which then does everything alone. */
  end_threads(): void;
  status_name(status: number): string;
  event_name(kind: number): string;
  /** The defaults, with the changes in `values`. */
  config(values?: Partial<Config>): Config;
  needle(values?: Partial<Needle>): Needle;
  obstacle(values?: Partial<Obstacle>): Obstacle;
  obstacle_box(half_m: Vec3, values?: Partial<Obstacle>): Obstacle;
  obstacle_sphere(radius_m: number, values?: Partial<Obstacle>): Obstacle;
  /** Reads an organ from the bytes of its file; checks structure, values and checksum. */
  organ(bytes: BufferSource): Organ;
  simulation(organ: Organ, options?: SimulationOptions): Simulation;
  /** The pose at which an unbent needle of this length has its tip at tip_m and points in this
   * direction ([0, 0, 0]: -z). */
  pose_of_tip(tip_m: Vec3, direction: Vec3, length_m: number): Pose;
}

export class Organ {
  private constructor();
  readonly info: OrganInfo;
  material(index: number): Material;
  /** Three vertices for each triangle, counter-clockwise seen from outside. */
  readonly triangles: Uint32Array;
  /** The vertices of the surface at rest. */
  readonly vertices: Float32Array;
  readonly vertex_materials: Uint8Array;
  readonly voxels: Voxel[];
  readonly cubes: Cube[];
  /** Distance along a ray to the surface at rest; null: the ray does not meet it. */
  raycast(origin_m: Vec3, direction: Vec3): number | null;
  /** Simulations that were made from it stay valid. */
  free(): void;
}

export class Simulation {
  private constructor();
  readonly organ: Organ;
  readonly needles: number;
  /** One tick: poses[i] moves needle i; null leaves it where it is, and is counted as a missing
   * input. Returns what the hand feels, for each needle. */
  tick(poses: readonly (Pose | null)[]): Output[];
  /** Many ticks: poses[tick][needle]. Returns outputs[tick][needle]; with `last` only those of the
   * last tick. */
  run(poses: readonly (readonly (Pose | null)[])[], options?: { last?: boolean }): Output[][];
  reset(): void;
  /** Replaces the obstacles given before; only before the first tick. */
  set_obstacles(obstacles: readonly Partial<Obstacle>[]): void;
  /** The deformed surface: a place for each vertex of the organ. */
  surface(): Float32Array;
  /** A needle from handle to tip; empty before its first pose. */
  needle_shape(needle?: number): Float32Array;
  /** The displacement of each particle of the lattice from its place at rest. */
  particles(): Float32Array;
  /** Eight particles for each voxel of the organ. */
  voxel_corners(): Uint32Array;
  constraint_particles(): ConstraintParticle[];
  obstacle_touches(): ObstacleTouch[];
  /** The newest events, oldest first. */
  events(): Event[];
  stats(): Stats;
  energy(): Energy;
  /** The mass of a material, and the mass that the step computes with. */
  mass(material: number): { real_kg: number; stepped_kg: number };
  /** The hash of the whole state, 16 hexadecimal digits: the same on every machine. */
  hash(): string;
  snapshot(): Uint8Array;
  restore(snapshot: BufferSource): void;
  clone(): Simulation;
  /** Name of the first field of the state that differs from another's; null: none does. */
  difference(other: Simulation): string | null;
  free(): void;
}
