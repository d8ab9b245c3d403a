// SPDX-License-Identifier: Apache-2.0
// Many simulations at once, which the library's own threads run. The bits do not depend on how many
// threads there are.
using System;

namespace Stylet {

public sealed unsafe class Batch : IDisposable {
  readonly BatchHandle handle;
  readonly int needles;  // of all simulations

  // `threads` 0: one for each processor. Tick none of the simulations while Run lasts.
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

  // Many ticks of each: inputs of the first simulation, tick by tick and needle by needle, then of
  // the next; the answers likewise.
  public void Run(Input[] inputs, Output[] outputs) {
    uint ticks = Simulation.TicksOf(inputs, outputs, needles);
    if (ticks == 0) return;
    fixed (Input* given = inputs)
    fixed (Output* told = outputs) {
      StyletException.Check(Native.stylet_batch_run(handle, given, told, ticks));
    }
  }

  // The simulations stay.
  public void Dispose() { handle.Dispose(); }
}

}  // namespace Stylet
