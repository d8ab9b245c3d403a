// SPDX-License-Identifier: Apache-2.0
// Runs a program of WebAssembly under node: its words in, its text out, its exit code.
//
// usage: node --experimental-wasi-unstable-preview1 run_wasm.mjs PROGRAM WORD ...
import { readFile } from "node:fs/promises";
import { WASI } from "node:wasi";

const [program, ...words] = process.argv.slice(2);
const wasi = new WASI({ version: "preview1", args: [program, ...words], returnOnExit: true });
const { instance } = await WebAssembly.instantiate(await readFile(program), {
  wasi_snapshot_preview1: wasi.wasiImport,
  env: { emscripten_notify_memory_growth: () => {} },
});
process.exitCode = wasi.start(instance);
