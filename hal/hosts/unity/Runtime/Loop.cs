// SPDX-License-Identifier: Apache-2.0
// A haptic device with the guard in its loop. The loop runs in a thread of the library at its own
// period; a frame of the host takes what is newest and draws it. So neither the collector nor a
// slow frame is ever felt in the hand.
using System;
using System.Runtime.InteropServices;

namespace Stylet {

public sealed class Device : IDisposable {
  internal IntPtr Handle;

  // By URI, as `stylet devices` lists them.
  public Device(string uri, double patience_s = 10) {
    Refusal why = StyletException.Empty();
    StyletException.Check(Native.stylet_device_open(uri, patience_s, out Handle, ref why),
                          ref why);
  }
  Device(IntPtr handle) { Handle = handle; }
  // A computed hand that goes straight in, holds, and comes back: for trials without a device.
  public static Device Simulated(float travel_m, float speed_m_per_s, float hold_s) {
    IntPtr handle;
    StyletException.Check(
        Native.stylet_device_simulated(travel_m, speed_m_per_s, hold_s, out handle));
    return new Device(handle);
  }
  // A loop that has it closes it.
  public void Dispose() {
    if (Handle != IntPtr.Zero) Native.stylet_device_close(Handle);
    Handle = IntPtr.Zero;
    GC.SuppressFinalize(this);
  }
  ~Device() { Dispose(); }
}

public sealed unsafe class Loop : IDisposable {
  IntPtr handle;
  public readonly Output[] Outputs;  // of each needle, of the tick that was taken last
  public readonly HandReport[] Hands;
  public readonly PinnedArray<Vec3> Vertices;
  public readonly PinnedArray<Vec3> Nodes = new PinnedArray<Vec3>(129);
  public readonly PinnedArray<Happened> Events = new PinnedArray<Happened>(64);

  public static LoopConfig DefaultConfig() {
    var config = new LoopConfig();
    StyletException.Check(Native.stylet_loop_config_init(ref config, (UIntPtr)sizeof(LoopConfig)));
    return config;
  }
  public static Hand DefaultHand() {
    var hand = new Hand();
    StyletException.Check(Native.stylet_hand_init(ref hand, (UIntPtr)sizeof(Hand)));
    return hand;
  }

  // One device and one hand for each needle. The simulation is the loop's until it is disposed.
  public Loop(Simulation simulation, LoopConfig config, Device[] devices, Hand[] hands) {
    int needles = simulation.Inputs.Count;
    if (devices.Length != needles || hands.Length != needles) {
      throw new ArgumentException("expected " + needles + " devices and hands, one a needle");
    }
    var handles = new IntPtr[needles];
    for (int i = 0; i < needles; ++i) handles[i] = devices[i].Handle;
    Refusal why = StyletException.Empty();
    fixed (IntPtr* all = handles)
    fixed (Hand* held = hands) {
      StyletException.Check(
          Native.stylet_loop_create(simulation.Handle, ref config, all, held, IntPtr.Zero,
                                    out handle, ref why), ref why);
    }
    foreach (Device each in devices) {  // the loop's now
      each.Handle = IntPtr.Zero;
      each.Dispose();
    }
    Outputs = new Output[needles];
    Hands = new HandReport[needles];
    Vertices = new PinnedArray<Vec3>(simulation.Vertices.Count);
    for (int i = 0; i < needles; ++i) {
      Outputs[i].struct_bytes = (uint)sizeof(Output);
      Hands[i].struct_bytes = (uint)sizeof(HandReport);
    }
  }

  public void Start() { StyletException.Check(Native.stylet_loop_start(handle)); }
  public void Stop() {
    Native.stylet_loop_ask_to_stop(handle);
    StyletException.Check(Native.stylet_loop_wait(handle));
  }
  public void Wait() { StyletException.Check(Native.stylet_loop_wait(handle)); }
  public void Pause(bool paused) { Native.stylet_loop_pause(handle, paused ? 1 : 0); }

  // Once a frame: takes the newest tick into Outputs, Hands and Vertices. False: nothing new.
  public bool Take() {
    if (Native.stylet_loop_take(handle) == 0) return false;
    for (int i = 0; i < Outputs.Length; ++i) {
      StyletException.Check(Native.stylet_loop_get_output(handle, (uint)i, ref Outputs[i]));
      StyletException.Check(Native.stylet_loop_get_hand(handle, (uint)i, ref Hands[i]));
    }
    Native.stylet_loop_surface(handle, (Vec3*)Vertices.Address, (uint)Vertices.Count);
    return true;
  }
  public int NeedleShape(int needle) {
    return (int)Native.stylet_loop_needle_shape(handle, (uint)needle, (Vec3*)Nodes.Address,
                                                (uint)Nodes.Count);
  }
  // Events since the last call.
  public int TakeEvents() {
    return (int)Native.stylet_loop_events(handle, (Happened*)Events.Address, (uint)Events.Count);
  }
  // After somebody has seen the fault of a hand: the force may come back.
  public void Acknowledge(int needle) {
    StyletException.Check(Native.stylet_loop_acknowledge(
        handle, (uint)needle, Hands[needle].fault, Hands[needle].fault_number));
  }
  public static string FaultName(uint fault) {
    return Marshal.PtrToStringAnsi(Native.stylet_fault_name(fault));
  }
  public LoopReport Report() {
    var report = new LoopReport { struct_bytes = (uint)sizeof(LoopReport) };
    StyletException.Check(Native.stylet_loop_get_report(handle, ref report));
    return report;
  }
  // What this machine refused, once the loop has ended; empty: nothing.
  public string Lacks() { return Marshal.PtrToStringAnsi(Native.stylet_loop_lacks(handle)); }

  public void Dispose() {
    if (handle == IntPtr.Zero) return;
    Native.stylet_loop_free(handle);
    handle = IntPtr.Zero;
    foreach (IDisposable each in new IDisposable[] { Vertices, Nodes, Events }) {
      if (each != null) each.Dispose();
    }
    GC.SuppressFinalize(this);
  }
  ~Loop() { Dispose(); }
}

}  // namespace Stylet
