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

  // The bare pointers of several, for a call that takes an array of them, during which none is
  // freed.
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

  // A text of what the handle holds, read before that can be freed.
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
