// SPDX-License-Identifier: Apache-2.0
// Units: SI. Frame: the organ's at rest, right-handed. Arrays of places are Float32Array with x, y,
// z one after the other. What is refused is thrown as a StyletError.
import type {
  Config, ConstraintParticle, Cube, Energy, Event, Material, Needle, Obstacle, ObstacleTouch, OrganInfo,
  Output, Pose, Refusal, Stats, Vec3, Voxel,
} from "./structs.js";

export * from "./structs.js";

/** What the library refused: `refusal` says where and which values it accepts. */
export class StyletError extends Error {
  constructor(text: string, refusal?: Partial<Refusal>);
  readonly refusal: Partial<Refusal>;
}

/** Bytes of stylet.wasm, a compiled module, a response with it, or its address. */
export type Source = BufferSource | WebAssembly.Module | Response | URL | string;
export interface LoadOptions {
  /** How many share a tick, 1 to 16; 1 without. The bits do not depend on it. */
  threads?: number;
  /** stylet-threads.wasm, as `source`; without, that beside index.mjs. */
  shared?: Source | Promise<Source>;
}
/** Loads the library; without a source, stylet.wasm beside index.mjs. More threads than one need
 * memory that is shared, in a page crossOriginIsolated: else, and where workers are forbidden,
 * there is one. */
export function load(source?: Source | Promise<Source>, options?: LoadOptions): Promise<Stylet>;

export interface SimulationOptions {
  /** What differs from the defaults, which Stylet.config() returns. */
  config?: Partial<Config>;
  /** One to four; [{}], one default needle, without. */
  needles?: Partial<Needle>[];
  /** Up to 16 bodies that no needle enters. */
  obstacles?: Partial<Obstacle>[];
}

export class Stylet {
  private constructor();
  readonly version: string;
  readonly build: string;
  /** How many share a tick. They sleep between runs. */
  readonly threads: number;
  /** Ends all but the caller's, which then does all by itself. */
  end_threads(): void;
  status_name(status: number): string;
  event_name(kind: number): string;
  /** The defaults, with what `values` changes. */
  config(values?: Partial<Config>): Config;
  needle(values?: Partial<Needle>): Needle;
  obstacle(values?: Partial<Obstacle>): Obstacle;
  obstacle_box(half_m: Vec3, values?: Partial<Obstacle>): Obstacle;
  obstacle_sphere(radius_m: number, values?: Partial<Obstacle>): Obstacle;
  /** An organ file's bytes; checks structure, values and the sum that the file holds of itself. */
  organ(bytes: BufferSource): Organ;
  simulation(organ: Organ, options?: SimulationOptions): Simulation;
  /** The pose whose unbent needle has its tip here and points there; -z for [0, 0, 0]. */
  pose_of_tip(tip_m: Vec3, direction: Vec3, length_m: number): Pose;
}

export class Organ {
  private constructor();
  readonly info: OrganInfo;
  material(index: number): Material;
  /** Corners, three a triangle, counter-clockwise seen from outside. */
  readonly triangles: Uint32Array;
  /** The surface at rest. */
  readonly vertices: Float32Array;
  readonly vertex_materials: Uint8Array;
  readonly voxels: Voxel[];
  readonly cubes: Cube[];
  /** Distance along a ray to the surface at rest; null: it does not meet it. */
  raycast(origin_m: Vec3, direction: Vec3): number | null;
  /** Simulations that were made from it go on. */
  free(): void;
}

export class Simulation {
  private constructor();
  readonly organ: Organ;
  readonly needles: number;
  /** One tick: poses[i] moves needle i; null leaves it where it is (and is counted). Returns what
   * the hand feels, for each needle. */
  tick(poses: readonly (Pose | null)[]): Output[];
  /** Many ticks: poses[tick][needle]. Returns outputs[tick][needle], or of the last tick alone. */
  run(poses: readonly (readonly (Pose | null)[])[], options?: { last?: boolean }): Output[][];
  reset(): void;
  /** Instead of those given before; before the first tick only. */
  set_obstacles(obstacles: readonly Partial<Obstacle>[]): void;
  /** The deformed surface: a place for each vertex of the organ. */
  surface(): Float32Array;
  /** A needle from handle to tip; empty before its first pose. */
  needle_shape(needle?: number): Float32Array;
  /** How far each particle of the lattice is from its place at rest. */
  particles(): Float32Array;
  /** Eight particles for each voxel of the organ. */
  voxel_corners(): Uint32Array;
  constraint_particles(): ConstraintParticle[];
  obstacle_touches(): ObstacleTouch[];
  /** The newest events, oldest first. */
  events(): Event[];
  stats(): Stats;
  energy(): Energy;
  mass(material: number): { real_kg: number; stepped_kg: number };
  /** Of the whole state, 16 hexadecimal digits: the same on every machine. */
  hash(): string;
  snapshot(): Uint8Array;
  restore(snapshot: BufferSource): void;
  clone(): Simulation;
  /** Name of the first field of the state that differs from another's; null: none does. */
  difference(other: Simulation): string | null;
  free(): void;
}
