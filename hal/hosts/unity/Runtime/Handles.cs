// SPDX-License-Identifier: Apache-2.0
// What the library gave, to be given back once and not while a call uses it: the runtime counts a
// call that has a SafeHandle as an argument. So neither the collector nor a Dispose in another
// thread frees what a call is in; the last one that leaves does. What is used later raises
// ObjectDisposedException.
using System;
using System.Runtime.InteropServices;

namespace Stylet {

internal abstract class LibraryHandle : SafeHandle {
  protected LibraryHandle() : base(IntPtr.Zero, true) {}
  public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
}

internal sealed class OrganHandle : LibraryHandle {
  protected override bool ReleaseHandle() {
    Native.stylet_organ_free(handle);
    return true;
  }
}

internal sealed class SimulationHandle : LibraryHandle {
  protected override bool ReleaseHandle() {
    Native.stylet_simulation_free(handle);
    return true;
  }
}

internal sealed class DeviceHandle : LibraryHandle {
  protected override bool ReleaseHandle() {
    Native.stylet_device_close(handle);
    return true;
  }
}

internal sealed class LoopHandle : LibraryHandle {
  protected override bool ReleaseHandle() {
    Native.stylet_loop_free(handle);
    return true;
  }
}

}  // namespace Stylet
