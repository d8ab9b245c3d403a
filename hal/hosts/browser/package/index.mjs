// SPDX-License-Identifier: Apache-2.0
// Stylet in JavaScript: organs, needles in them, the force on the hand. The functions are those of
// the interface in C (stylet.h), as methods; structs are objects with the same names of fields.
//
// Units: SI. Frame: the organ's at rest, right-handed. Arrays of places are Float32Array with x, y
// and z one after the other. Arrays and objects that a method returns belong to the caller.
import { constants, structs } from "./layout.mjs";
import { hash_text, Memory, number, StyletError } from "./memory.mjs";
import { Helpers, may_share } from "./threads.mjs";

export { constants, StyletError };

const ORGAN = 0, SIMULATION = 1; // what a handle in memory is

// The bytes of an ArrayBuffer, or of a view of one.
function bytes_of(value, name) {
  if (ArrayBuffer.isView(value)) {
    return new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
  }
  if (value instanceof ArrayBuffer || (typeof SharedArrayBuffer !== "undefined" &&
      value instanceof SharedArrayBuffer)) {
    return new Uint8Array(value);
  }
  throw new TypeError(`${name}: expected an ArrayBuffer or a view of one`);
}

function list_of(value, most, name) {
  if (!Array.isArray(value) || value.length > most) {
    const limit = most < Infinity ? ` of at most ${most}` : "";
    throw new TypeError(`${name}: expected an array${limit}`);
  }
  return value;
}

// Handles that the library holds and the page should free. What the garbage collector finds unused
// is freed, too, and everything goes with its page.
const forgotten = new FinalizationRegistry(({ exports, kind, handle }) => {
  if (kind === ORGAN) exports.stylet_organ_free(handle);
  else exports.stylet_simulation_free(handle);
});

class Handle {
  #at;
  constructor(library, kind, handle) {
    this.library = library;
    this.#at = handle;
    forgotten.register(this, { exports: library.exports, kind, handle }, this);
  }

  get at() {
    if (this.#at === 0) throw new StyletError("this organ or simulation was freed");
    return this.#at;
  }

  release(free) {
    if (this.#at === 0) return;
    forgotten.unregister(this);
    free(this.#at);
    this.#at = 0;
  }
}

// ---- the library -------------------------------------------------------------------------------

const PAGES = { initial: 256, maximum: 16384, shared: true }; // of 64 KiB: 1 GiB at most

/** Loads the library: `source` is the bytes of stylet.wasm, a compiled module, a Response or its
 * address; without it, the file beside this one. With more threads than one `shared` is loaded
 * instead, stylet-threads.wasm, if threads may share memory here; else there is one thread. */
export async function load(source = new URL("./stylet.wasm", import.meta.url),
  { threads = 1, shared = new URL("./stylet-threads.wasm", import.meta.url) } = {}) {
  if (!Number.isInteger(threads) || threads < 1 || threads > constants.MAX_HELPERS + 1) {
    throw new TypeError(`threads: ${threads}: expected 1 to ${constants.MAX_HELPERS + 1}`);
  }
  if (threads > 1 && may_share()) {
    try {
      const module = await module_of(await shared);
      const memory = new WebAssembly.Memory(PAGES);
      const exports = await instantiate(module, memory);
      const helpers = await Helpers.start(threads - 1, module, memory, exports);
      return new Stylet(exports, helpers);
    } catch {
      // A page may forbid workers, a machine lack room: `threads` of the library tells.
    }
  }
  return new Stylet(await instantiate(await module_of(await source)));
}

// The exports of a new instance, and its memory.
async function instantiate(module, shared) {
  const wasi = { proc_exit: (code) => { throw new StyletError(`the library ended (${code})`); } };
  let memory;
  const texts = [];
  wasi.fd_write = (_fd, list, count, written) => { // what an assertion says before it ends
    let sum = 0;
    for (let i = 0; i < count; ++i) {
      const at = memory.view.getUint32(list + 8 * i, true);
      const bytes = memory.view.getUint32(list + 8 * i + 4, true);
      texts.push(memory.decoder.decode(memory.bytes(at, bytes).slice()));
      sum += bytes;
    }
    if (texts.join("").endsWith("\n")) console.error(texts.splice(0).join("").trimEnd());
    memory.view.setUint32(written, sum, true);
    return 0;
  };
  wasi.fd_close = wasi.fd_seek = () => 0;
  const instance = await WebAssembly.instantiate(module, {
    wasi_snapshot_preview1: wasi,
    env: { emscripten_notify_memory_growth: () => {}, memory: shared },
  });
  const exports = shared ? { ...instance.exports, memory: shared } : instance.exports;
  memory = new Memory(exports);
  exports._initialize();
  return exports;
}

async function module_of(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) {
    return WebAssembly.compile(source);
  }
  if (typeof Response !== "undefined" && source instanceof Response) {
    return WebAssembly.compile(await source.arrayBuffer());
  }
  const address = new URL(source, import.meta.url);
  if (address.protocol === "file:" && typeof process !== "undefined") {
    const { readFile } =
      await import(/* @vite-ignore */ /* webpackIgnore: true */ "node:fs/promises");
    return WebAssembly.compile(await readFile(address));
  }
  const answer = await fetch(address);
  if (!answer.ok) throw new StyletError(`${address}: ${answer.status} ${answer.statusText}`);
  return WebAssembly.compile(await answer.arrayBuffer());
}

export class Stylet {
  #helpers;
  constructor(exports, helpers = null) {
    this.exports = exports;
    this.memory = new Memory(exports);
    this.#helpers = helpers;
  }

  /** How many threads share a tick. */
  get threads() {
    return 1 + (this.#helpers?.count ?? 0);
  }

  /** Ends all threads except the caller's, which then does everything alone. */
  end_threads() {
    this.#helpers?.end();
    this.#helpers = null;
  }

  get version() {
    return this.memory.text(this.exports.stylet_version_text());
  }

  get build() {
    return this.memory.text(this.exports.stylet_build_text());
  }

  status_name(status) {
    return this.memory.text(this.exports.stylet_status_name(status));
  }

  event_name(kind) {
    return this.memory.text(this.exports.stylet_event_name(kind));
  }

  /** The defaults, with the changes in `values`. */
  config(values = {}) {
    return this.#defaults("stylet_config", "stylet_config_init", values);
  }

  needle(values = {}) {
    return this.#defaults("stylet_needle", "stylet_needle_init", values);
  }

  obstacle(values = {}) {
    return this.#defaults("stylet_obstacle", "stylet_obstacle_init", values);
  }

  obstacle_box(half_m, values = {}) {
    return this.#shaped("stylet_obstacle_box", half_m, values);
  }

  obstacle_sphere(radius_m, values = {}) {
    return this.#shaped("stylet_obstacle_sphere", radius_m, values);
  }

  /** Reads an organ from the bytes of its file; checks structure, values and checksum. */
  organ(bytes) {
    const data = bytes_of(bytes, "organ");
    const { memory, exports } = this;
    const at = memory.allocate(data.length);
    try {
      memory.bytes(at, data.length).set(data);
      return new Organ(this, this.create((out, why) =>
        exports.stylet_organ_from_bytes(at, data.length, out, why)));
    } finally {
      memory.free(at);
    }
  }

  /** A simulation of an organ: `needles` are up to four, `obstacles` up to 16. */
  simulation(organ, { config = {}, needles = [{}], obstacles = [] } = {}) {
    if (!(organ instanceof Organ) || organ.library !== this) {
      throw new TypeError("organ: expected one of this library");
    }
    list_of(needles, Infinity, "needles");
    list_of(obstacles, Infinity, "obstacles");
    const made = this.with_struct("stylet_config", "stylet_config_init", config, (c) =>
      this.with_array("stylet_needle", "stylet_needle_init", needles, (n) =>
        this.create((out, why) => this.exports.stylet_simulation_create(organ.handle.at, c, n,
          needles.length, out, why))));
    const simulation = new Simulation(this, organ, made);
    if (obstacles.length > 0) {
      try {
        simulation.set_obstacles(obstacles);
      } catch (why) {
        simulation.free();
        throw why;
      }
    }
    return simulation;
  }

  /** The pose at which an unbent needle has its tip at tip_m and points in this direction. */
  pose_of_tip(tip_m, direction, length_m) {
    const { memory } = this;
    const part = structs.stylet_vec3.bytes;
    return memory.with_room(structs.stylet_pose.bytes + 2 * part, (at) => {
      const tip = at + structs.stylet_pose.bytes;
      memory.write_one("stylet_vec3", tip, tip_m, "tip_m");
      memory.write_one("stylet_vec3", tip + part, direction, "direction");
      this.exports.stylet_pose_of_tip(at, tip, tip + part, number(length_m, "length_m"));
      return memory.read("stylet_pose", at);
    });
  }

  // ---- for Organ and Simulation

  // Calls run(), which ticks a simulation, with the help of all threads.
  together(simulation, run) {
    return this.#helpers ? this.#helpers.during(simulation, run) : run();
  }

  // Calls use(address) with the struct's defaults and `values`.
  with_struct(struct, init, values, use) {
    return this.with_array(struct, init, [values], use);
  }

  with_array(struct, init, list, use) {
    const { memory } = this, bytes = structs[struct].bytes;
    return memory.with_room(bytes * list.length, (at) => {
      list.forEach((values, i) => {
        this.check(this.exports[init](at + i * bytes, bytes));
        memory.write(struct, at + i * bytes, values, struct.replace("stylet_", ""));
      });
      return use(at);
    });
  }

  // Calls make(address of the handle, address of the refusal); returns the handle.
  create(make) {
    const { memory } = this;
    return memory.with_room(8, (out) => {
      this.asked((why) => make(out, why));
      return memory.view.getUint32(out, true);
    });
  }

  // Calls call(address of the refusal) and throws what it refuses.
  asked(call) {
    const { memory } = this, bytes = structs.stylet_refusal.bytes;
    memory.with_room(bytes, (why) => {
      memory.view.setUint32(why, bytes, true);
      const status = call(why);
      if (status === constants.OK) return;
      const refusal = memory.read("stylet_refusal", why);
      throw new StyletError(refusal.text || this.status_name(status), { ...refusal, status });
    });
  }

  check(status) {
    if (status !== constants.OK) throw new StyletError(this.status_name(status), { status });
  }

  // A struct that call(address) fills.
  filled(struct, call) {
    const { memory } = this, bytes = structs[struct].bytes;
    return memory.with_room(bytes, (at) => {
      memory.view.setUint32(at, bytes, true);
      this.check(call(at));
      return memory.read(struct, at);
    });
  }

  // The numbers that call(address, capacity) copies, `each` of them an element.
  numbers(Numbers, each, call) {
    const count = call(0, 0);
    const out = new Numbers(count * each);
    this.memory.with_room(out.byteLength, (at) => {
      call(at, count);
      out.set(new Numbers(this.exports.memory.buffer, at, count * each));
    });
    return out;
  }

  // The structs that call(address, capacity) copies; `most`: how many there may be.
  list(struct, call, most = call(0, 0)) {
    const { memory } = this, bytes = structs[struct].bytes;
    return memory.with_room(most * bytes, (at) => {
      const count = call(at, most);
      return Array.from({ length: count }, (_, i) => memory.read(struct, at + i * bytes));
    });
  }

  #defaults(struct, init, values) {
    return this.with_struct(struct, init, values, (at) => this.memory.read(struct, at));
  }

  #shaped(shape, size, values) {
    return this.with_struct("stylet_obstacle", "stylet_obstacle_init", {}, (at) => {
      const { memory, exports } = this;
      if (shape === "stylet_obstacle_box") {
        memory.with_room(structs.stylet_vec3.bytes, (half) => {
          memory.write_one("stylet_vec3", half, size, "half_m");
          this.check(exports[shape](at, half));
        });
      } else {
        this.check(exports[shape](at, number(size, "radius_m")));
      }
      memory.write("stylet_obstacle", at, values, "obstacle");
      return memory.read("stylet_obstacle", at);
    });
  }
}

// What a function of the library, by its name, copies out of an organ or a simulation.
const numbers_from = ({ library, handle }, Numbers, each, name) =>
  library.numbers(Numbers, each, (at, most) => library.exports[name](handle.at, at, most));
const structs_from = ({ library, handle }, struct, name, most) =>
  library.list(struct, (at, room) => library.exports[name](handle.at, at, room), most);
const struct_from = ({ library, handle }, struct, name) =>
  library.filled(struct, (at) => library.exports[name](handle.at, at));

/** Made by Stylet.organ. */
export class Organ {
  constructor(library, handle) {
    this.library = library;
    this.handle = new Handle(library, ORGAN, handle);
  }

  get info() {
    return struct_from(this, "stylet_organ_info", "stylet_organ_get_info");
  }

  material(index) {
    const { library } = this;
    return library.filled("stylet_material",
      (at) => library.exports.stylet_organ_get_material(this.handle.at, index, at));
  }

  get triangles() {
    return numbers_from(this, Uint32Array, 3, "stylet_organ_triangles");
  }

  get vertices() {
    return numbers_from(this, Float32Array, 3, "stylet_organ_vertices");
  }

  get vertex_materials() {
    return numbers_from(this, Uint8Array, 1, "stylet_organ_vertex_materials");
  }

  get voxels() {
    return structs_from(this, "stylet_voxel", "stylet_organ_voxels");
  }

  /** The space that each voxel takes up at rest. */
  get cubes() {
    return structs_from(this, "stylet_cube", "stylet_organ_cubes");
  }

  /** Distance along a ray to the surface at rest; null: the ray does not meet it. */
  raycast(origin_m, direction) {
    const { library } = this, { memory } = library, part = structs.stylet_vec3.bytes;
    return memory.with_room(2 * part + 4, (at) => {
      memory.write_one("stylet_vec3", at, origin_m, "origin_m");
      memory.write_one("stylet_vec3", at + part, direction, "direction");
      const meets = library.exports.stylet_organ_raycast(this.handle.at, at, at + part,
        at + 2 * part);
      return meets === 1 ? memory.view.getFloat32(at + 2 * part, true) : null;
    });
  }

  /** Simulations that were made from it stay valid. */
  free() {
    this.handle.release((at) => this.library.exports.stylet_organ_free(at));
  }
}

/** Made by Stylet.simulation. */
export class Simulation {

  constructor(library, organ, handle) {
    this.library = library;
    this.organ = organ;
    this.handle = new Handle(library, SIMULATION, handle);
    this.needles = library.exports.stylet_simulation_needles(handle);
    if (library.threads > 1) {
      library.check(library.exports.stylet_simulation_set_helpers(handle, library.threads - 1));
    }
  }

  /** One tick: poses[i] = { position_m, rotation } moves needle i, null leaves it.
   * Returns what the hands feel, one object for each needle. */
  tick(poses) {
    return this.run([poses])[0];
  }

  /** Many ticks: poses[tick][needle]. Returns outputs[tick][needle]; with `{ last: true }` only
   * those of the last tick. */
  run(ticks, { last = false } = {}) {
    const { library } = this, { memory, exports } = library, n = this.needles;
    list_of(ticks, Infinity, "ticks").forEach((poses, t) => list_of(poses, n, `tick ${t}`));
    if (ticks.length === 0) return [];
    const input = structs.stylet_input.bytes, output = structs.stylet_output.bytes;
    return memory.with_room(ticks.length * n * (input + output) + 8, (room) => {
      const outs = room + ticks.length * n * input + 7 - (room + ticks.length * n * input + 7) % 8;
      ticks.forEach((poses, t) => this.#write_inputs(room + t * n * input, poses));
      for (let i = 0; i < ticks.length * n; ++i) {
        memory.view.setUint32(outs + i * output, output, true);
      }
      library.check(library.together(this.handle.at, () =>
        exports.stylet_simulation_run(this.handle.at, room, outs, ticks.length)));
      const from = last ? ticks.length - 1 : 0;
      return Array.from({ length: ticks.length - from }, (_, t) =>
        Array.from({ length: n }, (_, i) =>
          memory.read("stylet_output", outs + ((from + t) * n + i) * output)));
    });
  }

  reset() {
    this.library.check(this.library.exports.stylet_simulation_reset(this.handle.at));
  }

  /** Bodies that no needle enters; they replace those given before. Only before the first tick. */
  set_obstacles(obstacles) {
    const { library } = this;
    list_of(obstacles, Infinity, "obstacles");
    library.with_array("stylet_obstacle", "stylet_obstacle_init", obstacles, (at) =>
      library.asked((why) => library.exports.stylet_simulation_set_obstacles(this.handle.at, at,
        obstacles.length, why)));
  }

  /** The deformed surface: a place for each vertex of the organ. */
  surface() {
    return numbers_from(this, Float32Array, 3, "stylet_simulation_surface");
  }

  /** A needle from handle to tip. */
  needle_shape(needle = 0) {
    const { library } = this;
    return library.numbers(Float32Array, 3, (at, most) =>
      library.exports.stylet_simulation_needle_shape(this.handle.at, needle, at, most));
  }

  /** The displacement of each particle of the lattice from its place at rest. */
  particles() {
    return numbers_from(this, Float32Array, 3, "stylet_simulation_particles");
  }

  /** Eight particles for each voxel of the organ. */
  voxel_corners() {
    return numbers_from(this, Uint32Array, 1, "stylet_simulation_voxel_corners");
  }

  constraint_particles() {
    return structs_from(this, "stylet_constraint_particle",
      "stylet_simulation_constraint_particles");
  }

  obstacle_touches() {
    return structs_from(this, "stylet_obstacle_touch", "stylet_simulation_obstacle_touches");
  }

  /** The newest events, oldest first. */
  events() {
    return structs_from(this, "stylet_event", "stylet_simulation_events", constants.MAX_EVENTS);
  }

  stats() {
    return struct_from(this, "stylet_stats", "stylet_simulation_get_stats");
  }

  energy() {
    return struct_from(this, "stylet_energy", "stylet_simulation_get_energy");
  }

  /** The mass of a material, and the mass that the step computes with, in kg. */
  mass(material) {
    const { library } = this;
    return library.memory.with_room(8, (at) => {
      library.check(library.exports.stylet_simulation_get_mass(this.handle.at, material, at,
        at + 4));
      const view = library.memory.view;
      return { real_kg: view.getFloat32(at, true), stepped_kg: view.getFloat32(at + 4, true) };
    });
  }

  /** The hash of the whole state, 16 hexadecimal digits: the same on every machine. */
  hash() {
    return hash_text(this.library.exports.stylet_simulation_hash(this.handle.at));
  }

  snapshot() {
    const { library } = this, { exports } = library;
    const bytes = exports.stylet_simulation_snapshot_bytes(this.handle.at);
    return library.memory.with_room(bytes, (at) => {
      library.check(exports.stylet_simulation_snapshot(this.handle.at, at, bytes));
      return library.memory.bytes(at, bytes).slice();
    });
  }

  /** Refuses bytes that are not a snapshot with this organ, configuration and obstacles. */
  restore(snapshot) {
    const { library } = this, data = bytes_of(snapshot, "snapshot");
    library.memory.with_room(data.length, (at) => {
      library.memory.bytes(at, data.length).set(data);
      library.check(library.exports.stylet_simulation_restore(this.handle.at, at, data.length));
    });
  }

  clone() {
    const { library } = this;
    return new Simulation(library, this.organ, library.create((out) =>
      library.exports.stylet_simulation_clone(this.handle.at, out)));
  }

  /** Name of the first field of the state that differs from another's; null: none does. */
  difference(other) {
    const { library } = this;
    if (!(other instanceof Simulation) || other.library !== library) {
      throw new TypeError("other: expected a simulation of this library");
    }
    const at = library.exports.stylet_simulation_difference(this.handle.at, other.handle.at, 0);
    return at === 0 ? null : library.memory.text(at);
  }

  free() {
    this.handle.release((at) => this.library.exports.stylet_simulation_free(at));
  }

  #write_inputs(at, poses) {
    const { memory } = this.library, bytes = structs.stylet_input.bytes;
    for (let i = 0; i < this.needles; ++i) {
      const place = at + i * bytes, pose = poses[i] ?? null;
      if (pose !== null && (!pose.position_m || !pose.rotation)) {
        throw new TypeError(`needle ${i}: expected { position_m, rotation } or null`);
      }
      memory.view.setUint32(place, bytes, true);
      memory.write("stylet_input", place,
        pose ? { valid: 1, handle: pose } : { valid: 0 }, `input ${i}`);
    }
  }
}
