// SPDX-License-Identifier: Apache-2.0
// Handles of the library, which must be freed once, and not while a call uses them. The runtime
// counts the calls that have a SafeHandle as an argument: so neither the garbage collector nor a
// Dispose in another thread frees what a call is using; the last call that returns does. Using a
// handle after that throws ObjectDisposedException.
using System;
using System.Runtime.InteropServices;

namespace Stylet {

internal abstract class LibraryHandle : SafeHandle {
  protected LibraryHandle() : base(IntPtr.Zero, true) {}
  public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

  // The bare pointers of several handles, for a call that takes an array of them; none is freed
  // during the call.
  internal static T WithAll<T>(LibraryHandle[] all, Func<IntPtr[], T> call) {
    var pointers = new IntPtr[all.Length];
    int held = 0;
    try {
      for (bool done = false; held < all.Length; ++held, done = false) {
        all[held].DangerousAddRef(ref done);
        pointers[held] = all[held].DangerousGetHandle();
      }
      return call(pointers);
    } finally {
      while (--held >= 0) all[held].DangerousRelease();
    }
  }

  // A text that belongs to the handle, read before the handle can be freed.
  internal string TextOf(Func<IntPtr> text) {
    bool held = false;
    try {
      DangerousAddRef(ref held);
      return Marshal.PtrToStringAnsi(text());
    } finally {
      if (held) DangerousRelease();
    }
  }
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

internal sealed class BatchHandle : LibraryHandle {
  protected override bool ReleaseHandle() {
    Native.stylet_batch_free(handle);
    return true;
  }
}

internal sealed class GuardHandle : LibraryHandle {
  protected override bool ReleaseHandle() {
    Native.stylet_guard_free(handle);
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
