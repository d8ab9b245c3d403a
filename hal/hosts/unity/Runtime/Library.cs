// SPDX-License-Identifier: Apache-2.0
// Version and build of the library that was loaded.
using System.Runtime.InteropServices;

namespace Stylet {

public static class Library {
  public static string Version() { return Marshal.PtrToStringAnsi(Native.stylet_version_text()); }
  // Major << 16 | minor << 8 | patch.
  public static uint VersionNumber() { return Native.stylet_version(); }
  // Compiler, and the instruction set that the tissue step uses on this processor.
  public static string Build() { return Marshal.PtrToStringAnsi(Native.stylet_build_text()); }
  // A snapshot can be read by every library with the same number.
  public static ulong StateLayout() { return Native.stylet_state_layout(); }
}

}  // namespace Stylet
