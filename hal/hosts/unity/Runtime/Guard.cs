// SPDX-License-Identifier: Apache-2.0
// The guard between a force and a hand, for a device that your own loop drives (Loop contains one).
// In each tick call Sample, then Force, and send the force that it returns.
using System;
using System.Runtime.InteropServices;

namespace Stylet {

public sealed unsafe class Guard : IDisposable {
  readonly GuardHandle handle;

  // The limits of an unknown device, or of a known model such as "touch"; DeviceModels lists them.
  public static GuardConfig DefaultConfig() {
    var config = new GuardConfig();
    StyletException.Check(
        Native.stylet_guard_config_init(ref config, (UIntPtr)sizeof(GuardConfig)));
    return config;
  }
  public static GuardConfig ConfigFor(string model) {
    GuardConfig config = DefaultConfig();
    StyletException.Check(Native.stylet_guard_config_for(ref config, model));
    return config;
  }
  public static string[] DeviceModels() {
    var names = new System.Collections.Generic.List<string>();
    for (uint i = 0;; ++i) {
      IntPtr name = Native.stylet_device_model(i);
      if (name == IntPtr.Zero) return names.ToArray();
      names.Add(Marshal.PtrToStringAnsi(name));
    }
  }

  public Guard(GuardConfig config) {
    Refusal why = StyletException.Empty();
    StyletException.Check(Native.stylet_guard_create(ref config, out handle, ref why), ref why);
  }

  // Call this before Sample if the motors tell what force they have.
  public void Motor(MotorReport report) {
    StyletException.Check(Native.stylet_guard_motor(handle, ref report));
  }
  // True: the simulation may use the sample. A null sample: the device did not answer.
  public bool Sample(Sample? sample, long now_ns) {
    if (sample == null) return Native.stylet_guard_sample(handle, null, now_ns) != 0;
    Sample own = sample.Value;
    own.struct_bytes = (uint)sizeof(Sample);
    return Native.stylet_guard_sample(handle, &own, now_ns) != 0;
  }
  // Of a force that you want to send: the one that you may send. Call Torque after Force.
  public Vec3 Force(Vec3 force_n) { return Native.stylet_guard_force(handle, force_n); }
  public Vec3 Torque(Vec3 torque_nm) { return Native.stylet_guard_torque(handle, torque_nm); }
  // At the end of a run call this instead of Sample, Force and Torque, until it returns true: then
  // the force has faded.
  public bool End(long now_ns) { return Native.stylet_guard_end(handle, now_ns) != 0; }
  public void Trip(uint fault) { StyletException.Check(Native.stylet_guard_trip(handle, fault)); }
  // Acknowledges the fault that somebody has seen. True: it is the one that the guard has latched,
  // and the guard begins anew.
  public bool Rearm(uint fault_seen) {
    return Native.stylet_guard_rearm(handle, fault_seen) != 0;
  }
  public GuardReport Report() {
    var report = new GuardReport { struct_bytes = (uint)sizeof(GuardReport) };
    StyletException.Check(Native.stylet_guard_get_report(handle, ref report));
    return report;
  }
  public static string ModeName(uint mode) {
    return Marshal.PtrToStringAnsi(Native.stylet_guard_mode_name(mode));
  }

  public void Dispose() { handle.Dispose(); }
}

}  // namespace Stylet
