// SPDX-License-Identifier: Apache-2.0
// Helper threads: workers that share the library's memory and take part in the tissue step while
// the thread that ticks is in a run. Between runs they look for the next for some 50 us, then
// sleep, and none of them is in the library: what allocates, frees or changes one is alone there.

const GATE = 0, INSIDE = 1, SIMULATION = 2; // words that all threads share
const STACK_BYTES = 1 << 16; // a tick takes half of it at most

// All that a helper does. It names nothing outside, since a worker gets it as text.
function help_along(begin_with, tell) {
  begin_with(async ({ module, memory, words, stack_end }) => {
    const gate = 0, inside = 1, simulation = 2;
    const imports = {};
    for (const { module: from, name, kind } of WebAssembly.Module.imports(module)) {
      (imports[from] ??= {})[name] = kind === "memory" ? memory : () => 0;
    }
    const { exports } = await WebAssembly.instantiate(module, imports);
    exports.__stack_pointer.value = stack_end;
    tell("ready");
    for (;;) {
      for (let look = 0; look < 5000 && Atomics.load(words, gate) === 0; ++look);
      Atomics.wait(words, gate, 0);
      while (Atomics.load(words, gate) === 1) {
        // Once it is counted and the gate is still open, the run waits for it before it ends.
        Atomics.add(words, inside, 1);
        if (Atomics.load(words, gate) === 1) {
          exports.stylet_simulation_help(Atomics.load(words, simulation), 1000);
        }
        Atomics.sub(words, inside, 1);
      }
    }
  });
}

// A worker that has begun. In node it keeps no program from its end.
async function start(message) {
  const text = (first) => `${first}(${help_along})(take, tell);`;
  if (typeof Worker === "undefined") {
    const { Worker: Thread } =
      await import(/* @vite-ignore */ /* webpackIgnore: true */ "node:worker_threads");
    const worker = new Thread(text(`const { parentPort } = require("node:worker_threads");
      const take = (use) => parentPort.once("message", use);
      const tell = (word) => parentPort.postMessage(word);`), { eval: true });
    await new Promise((ready, fail) => {
      worker.once("message", ready).once("error", fail);
      worker.postMessage(message);
    });
    worker.unref();
    return worker;
  }
  const address = URL.createObjectURL(new Blob([text(`
    const take = (use) => { onmessage = ({ data }) => use(data); }, tell = postMessage;`)],
    { type: "text/javascript" }));
  const worker = new Worker(address);
  try {
    await new Promise((ready, fail) => {
      worker.onmessage = ready;
      worker.onerror = fail;
      worker.postMessage(message);
    });
  } catch (why) {
    worker.terminate();
    throw why;
  } finally {
    URL.revokeObjectURL(address);
  }
  return worker;
}

/** Whether threads may share memory here: in a page only if it is crossOriginIsolated. */
export function may_share() {
  return typeof SharedArrayBuffer !== "undefined" &&
    (globalThis.crossOriginIsolated ?? typeof process !== "undefined");
}

export class Helpers {
  #words;
  #workers = [];

  /** Starts so many; `module` and `memory` are those of the instance whose exports these are. */
  static async start(count, module, memory, exports) {
    const helpers = new Helpers();
    helpers.#words = new Int32Array(memory.buffer, exports.malloc(12), 3).fill(0);
    const stacks = exports.malloc(count * STACK_BYTES + 16);
    const begun = await Promise.allSettled(Array.from({ length: count }, (_, i) =>
      start({ module, memory, words: helpers.#words,
        stack_end: Math.floor((stacks + 16 + (i + 1) * STACK_BYTES) / 16) * 16 - 16 })));
    helpers.#workers = begun.flatMap(({ value }) => value ?? []);
    const failed = begun.find(({ reason }) => reason);
    if (failed) {
      helpers.end();
      throw failed.reason;
    }
    return helpers;
  }

  get count() {
    return this.#workers.length;
  }

  /** Calls run() while they help with a simulation. */
  during(simulation, run) {
    const words = this.#words;
    Atomics.store(words, SIMULATION, simulation);
    Atomics.store(words, GATE, 1);
    Atomics.notify(words, GATE);
    try {
      return run();
    } finally {
      Atomics.store(words, GATE, 0);
      while (Atomics.load(words, INSIDE) !== 0);
    }
  }

  /** Between runs they are outside the library, so that they may end at once. */
  end() {
    for (const worker of this.#workers.splice(0)) worker.terminate();
  }
}
