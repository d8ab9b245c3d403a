// SPDX-License-Identifier: Apache-2.0
// Structs of the interface in C in the library's memory, as objects with the same names of fields.
import { structs } from "./layout.mjs";

/** What the library refused, and why: the fields of stylet_refusal. */
export class StyletError extends Error {
  constructor(text, refusal = {}) {
    super(text);
    this.name = "StyletError";
    this.refusal = refusal;
  }
}

const SIZES = { u8: 1, u16: 2, u32: 4, u64: 8, f32: 4, f64: 8, text: 4, char: 1 };
const size_of = (kind) => SIZES[kind] ?? structs[kind].bytes;

// The library's memory. It may grow in any call that allocates; a view of it is then another.
export class Memory {
  #view = new DataView(new ArrayBuffer(0));
  constructor(exports) {
    this.exports = exports;
    this.decoder = new TextDecoder();
  }

  get view() {
    const { buffer } = this.exports.memory;
    if (this.#view.buffer !== buffer) this.#view = new DataView(buffer);
    return this.#view;
  }

  bytes(at, count) {
    return new Uint8Array(this.exports.memory.buffer, at, count);
  }

  allocate(bytes) {
    if (!Number.isSafeInteger(bytes) || bytes < 0) {
      throw new TypeError(`bytes: ${bytes}: expected a whole number`);
    }
    const at = this.exports.malloc(Math.max(bytes, 1));
    if (at === 0) throw new StyletError(`no memory for ${bytes} bytes`);
    return at;
  }

  free(at) {
    this.exports.free(at);
  }

  // Calls use(address) with room that is zero and freed afterwards.
  with_room(bytes, use) {
    const at = this.allocate(bytes);
    try {
      this.bytes(at, bytes).fill(0);
      return use(at);
    } finally {
      this.free(at);
    }
  }

  text(at, most = 4096) {
    if (at === 0) return "";
    const all = this.bytes(at, Math.min(most, this.exports.memory.buffer.byteLength - at));
    const end = all.indexOf(0);
    return this.decoder.decode(all.slice(0, end < 0 ? all.length : end));
  }

  read_one(kind, at, name) {
    const view = this.view;
    switch (kind) {
      case "u8": return view.getUint8(at);
      case "u16": return view.getUint16(at, true);
      case "u32": return view.getUint32(at, true);
      case "u64": {
        const value = view.getBigUint64(at, true);
        return name === "hash" ? hash_text(value) : Number(value);
      }
      case "f32": return view.getFloat32(at, true);
      case "f64": return view.getFloat64(at, true);
      case "text": return this.text(view.getUint32(at, true));
      case "stylet_vec3": return [0, 4, 8].map((i) => view.getFloat32(at + i, true));
      default: return this.read(kind, at);
    }
  }

  read(struct, at) {
    const out = {};
    for (const [name, kind, offset, count] of structs[struct].fields) {
      if (name === "struct_bytes" || name === "reserved") continue;
      const place = at + offset;
      if (kind === "char") out[name] = this.text(place, count);
      else if (count === 0) out[name] = this.read_one(kind, place, name);
      else {
        out[name] = Array.from({ length: count },
          (_, i) => this.read_one(kind, place + i * size_of(kind), name));
      }
    }
    return out;
  }

  write_one(kind, at, value, name) {
    const view = this.view;
    if (kind === "stylet_vec3") {
      if (value?.length !== 3) throw new TypeError(`${name}: expected [x, y, z]`);
      [...value].forEach((v, i) => view.setFloat32(at + 4 * i, number(v, name), true));
      return;
    }
    if (structs[kind]) {
      this.write(kind, at, value, name);
      return;
    }
    const v = number(value, name);
    switch (kind) {
      case "f32": view.setFloat32(at, v, true); break;
      case "f64": view.setFloat64(at, v, true); break;
      default: {
        if (!Number.isInteger(v) || v < 0 || v >= 2 ** (8 * SIZES[kind])) {
          throw new TypeError(`${name}: ${v}: expected a whole number, 0 or more`);
        }
        if (kind === "u8") view.setUint8(at, v);
        else if (kind === "u16") view.setUint16(at, v, true);
        else view.setUint32(at, v, true);
      }
    }
  }

  // Writes the fields that `values` has; the others stay.
  write(struct, at, values, where = struct) {
    const fields = structs[struct].fields;
    for (const [name, value] of Object.entries(values)) {
      const field = fields.find((f) => f[0] === name);
      if (!field || name === "struct_bytes" || name === "reserved" || field[1] === "text") {
        throw new TypeError(`${where} has no field ${name}`);
      }
      const [, kind, offset, count] = field;
      if (count === 0) {
        this.write_one(kind, at + offset, value, `${where}.${name}`);
        continue;
      }
      if (!(value?.length <= count)) {
        throw new TypeError(`${where}.${name}: expected an array of at most ${count}`);
      }
      [...value].forEach((one, i) =>
        this.write_one(kind, at + offset + i * size_of(kind), one, `${where}.${name}[${i}]`));
    }
  }
}

export function number(value, name) {
  if (typeof value !== "number" && typeof value !== "boolean") {
    throw new TypeError(`${name}: expected a number`);
  }
  return Number(value);
}

export const hash_text = (value) => BigInt.asUintN(64, value).toString(16).padStart(16, "0");
