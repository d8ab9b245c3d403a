// SPDX-License-Identifier: Apache-2.0
// Many simulations that run at once, in threads of the library. Whatever the number of threads, the
// results are the same, bit for bit.
using System;

namespace Stylet {

public sealed unsafe class Batch : IDisposable {
  readonly BatchHandle handle;
  readonly int needles;  // of all simulations

  // `threads` 0: one for each processor. While Run lasts, none of the simulations may be ticked.
  public Batch(Simulation[] simulations, int threads = 0) {
    SimulationHandle[] handles = Array.ConvertAll(simulations, each => each.Handle);
    handle = LibraryHandle.WithAll(handles, pointers => {
      BatchHandle made;
      fixed (IntPtr* all = pointers) {
        StyletException.Check(Native.stylet_batch_create(all, (uint)pointers.Length, (uint)threads,
                                                         out made));
      }
      return made;
    });
    needles = (int)Native.stylet_batch_needles(handle);
  }

  // Many ticks of each. The inputs of the first simulation come first, tick by tick and needle by
  // needle, then those of the next; the outputs have the same order.
  public void Run(Input[] inputs, Output[] outputs) {
    uint ticks = Simulation.TicksOf(inputs, outputs, needles);
    if (ticks == 0) return;
    fixed (Input* given = inputs)
    fixed (Output* told = outputs) {
      StyletException.Check(Native.stylet_batch_run(handle, given, told, ticks));
    }
  }

  // The simulations stay valid.
  public void Dispose() { handle.Dispose(); }
}

}  // namespace Stylet
