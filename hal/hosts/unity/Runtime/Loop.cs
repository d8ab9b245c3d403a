// SPDX-License-Identifier: Apache-2.0
// A haptic device with the guard in its loop. The loop runs in a thread of the library with its own
// period; a frame of the host takes the newest state and draws it. So the hand feels neither the
// garbage collector nor a slow frame.
using System;
using System.Runtime.InteropServices;

namespace Stylet {

public sealed class Device : IDisposable {
  internal readonly DeviceHandle Handle;

  // By URI, such as "hd:"; `stylet devices` lists them.
  public Device(string uri, double patience_s = 10) {
    Refusal why = StyletException.Empty();
    StyletException.Check(Native.stylet_device_open(uri, patience_s, out Handle, ref why),
                          ref why);
  }
  Device(DeviceHandle handle) { Handle = handle; }
  // A simulated hand that goes straight in, rests, and comes back: for trials without a device.
  public static Device Simulated(float travel_m, float speed_m_per_s, float hold_s) {
    DeviceHandle handle;
    StyletException.Check(
        Native.stylet_device_simulated(travel_m, speed_m_per_s, hold_s, out handle));
    return new Device(handle);
  }
  // If a loop has the device, only the loop closes it.
  public void Dispose() { Handle.Dispose(); }
}

public sealed unsafe class Loop : IDisposable {
  readonly LoopHandle handle;
  public readonly Output[] Outputs;  // of each needle, of the tick that was taken last
  public readonly HandReport[] Hands;
  public readonly Vec3[] Vertices;
  public readonly Vec3[] Nodes = new Vec3[129];
  public readonly Happened[] Events = new Happened[64];

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

  // One device and one hand for each needle, and one guard; null guards: the limits that each
  // device states. Until the loop is disposed, nothing else may tick the simulation.
  public Loop(Simulation simulation, LoopConfig config, Device[] devices, Hand[] hands,
              GuardConfig[] guards = null) {
    int needles = simulation.Inputs.Length;
    if (devices.Length != needles || hands.Length != needles ||
        (guards != null && guards.Length != needles)) {
      throw new ArgumentException("expected " + needles +
                                  " devices, hands and guards, one for each needle");
    }
    handle = Create(simulation.Handle, config, devices, hands, guards);
    Outputs = new Output[needles];
    Hands = new HandReport[needles];
    Vertices = new Vec3[simulation.Vertices.Length];
    for (int i = 0; i < needles; ++i) {
      Outputs[i].struct_bytes = (uint)sizeof(Output);
      Hands[i].struct_bytes = (uint)sizeof(HandReport);
    }
  }

  static LoopHandle Create(SimulationHandle simulation, LoopConfig config, Device[] devices,
                           Hand[] hands, GuardConfig[] guards) {
    DeviceHandle[] handles = Array.ConvertAll(devices, each => each.Handle);
    return LibraryHandle.WithAll(handles, pointers => {
      Refusal why = StyletException.Empty();
      LoopHandle loop;
      fixed (IntPtr* all = pointers)
      fixed (Hand* hand = hands)
      fixed (GuardConfig* guard = guards) {
        StyletException.Check(Native.stylet_loop_create(simulation, ref config, all, hand, guard,
                                                        out loop, ref why), ref why);
      }
      foreach (DeviceHandle each in handles) each.SetHandleAsInvalid();  // the loop's now
      return loop;
    });
  }

  // In this thread, until its ticks are done or another thread stops it.
  public void Run() { StyletException.Check(Native.stylet_loop_run(handle)); }
  // In a thread of its own.
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
    fixed (Vec3* at = Vertices) Native.stylet_loop_surface(handle, at, (uint)Vertices.Length);
    return true;
  }
  public int NeedleShape(int needle) {
    fixed (Vec3* at = Nodes) {
      return (int)Native.stylet_loop_needle_shape(handle, (uint)needle, at, (uint)Nodes.Length);
    }
  }
  // Events since the last call.
  public int TakeEvents() {
    fixed (Happened* at = Events) {
      return (int)Native.stylet_loop_events(handle, at, (uint)Events.Length);
    }
  }
  // Says that somebody has seen the fault of a hand, so that the force may come back.
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
  // The rights that this machine refused to the loop; known when the loop has ended. Empty: none.
  public string Lacks() { return handle.TextOf(() => Native.stylet_loop_lacks(handle)); }
  // Why a needle's device does not answer; empty: it does.
  public string Trouble(int needle) {
    return handle.TextOf(() => Native.stylet_loop_trouble(handle, (uint)needle));
  }

  // Stops the loop first: another thread may be in the library, waiting for the loop to end.
  public void Dispose() {
    lock (handle) {
      if (handle.IsClosed) return;
      Native.stylet_loop_ask_to_stop(handle);
      handle.Dispose();
    }
  }
}

}  // namespace Stylet
