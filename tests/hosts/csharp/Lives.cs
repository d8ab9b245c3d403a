// SPDX-License-Identifier: Apache-2.0
// How long organs, simulations, devices and loops of the C# package live: what csharp_test.py asks.
using System;
using System.Collections.Generic;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Threading;
using Stylet;

public static class Lives {
  // The last use of each object is a call during which another thread collects garbage. The answers
  // are those of an object that is still referenced.
  public static void UnderTheCollector(Organ organ) {
    byte[] saved;
    ulong expected;
    using (var held = new Simulation(organ, Simulation.DefaultConfig())) {
      held.Tick();
      saved = held.Snapshot();
      expected = held.Hash();
    }
    bool ends = false;
    var collector = new Thread(() => {
      while (!Volatile.Read(ref ends)) {
        GC.Collect();
        GC.WaitForPendingFinalizers();
      }
    });
    collector.Start();
    bool same = true;
    int triangles = organ.Triangles().Length;
    for (int round = 0; round < 300; ++round) {
      same = same && HashOfRestored(organ, saved) == expected;
      new Simulation(organ, Simulation.DefaultConfig()).Tick();
      same = same && new Simulation(organ, Simulation.DefaultConfig()).Snapshot().Length ==
                         saved.Length;
      Device.Simulated(0.01F, 0.01F, 0);
    }
    Volatile.Write(ref ends, true);
    collector.Join();
    Console.WriteLine(same && organ.Triangles().Length == triangles);
  }

  static ulong HashOfRestored(Organ organ, byte[] saved) {
    var simulation = new Simulation(organ, Simulation.DefaultConfig());
    simulation.Restore(saved);
    return simulation.Hash();
  }

  // One thread ticks until another has disposed of the simulation; in the same way one waits for
  // the end of a loop that would go on for ever.
  public static void DisposedInACall(Organ organ) {
    bool same = true;
    for (int round = 0; round < 100; ++round) {
      var simulation = new Simulation(organ, Simulation.DefaultConfig());
      simulation.Inputs[0] = new Input { valid = 1, handle = Frames.At(organ, round) };
      bool closed = false;
      var ticking = new Thread(() => {
        try {
          for (;;) simulation.Tick();
        } catch (ObjectDisposedException) {
          closed = true;
        }
      });
      ticking.Start();
      Thread.Sleep(round % 5);
      simulation.Dispose();
      ticking.Join();
      same = same && closed;
    }
    Console.WriteLine(same);
    using (var simulation = new Simulation(organ, Simulation.DefaultConfig())) {
      LoopConfig config = Loop.DefaultConfig();
      config.priority = 0;
      var loop = new Loop(simulation, config, new[] { Device.Simulated(0.02F, 0.02F, 1) },
                          new[] { Loop.DefaultHand() });
      loop.Start();
      var waiting = new Thread(() => loop.Wait());
      waiting.Start();
      Thread.Sleep(20);
      loop.Dispose();
      Console.WriteLine(waiting.Join(20000));
    }
  }

  public static void Closed(Organ organ) {
    var simulation = new Simulation(organ, Simulation.DefaultConfig());
    Device device = Device.Simulated(0.02F, 0.02F, 1);
    var hands = new[] { Loop.DefaultHand() };
    var loop = new Loop(simulation, Loop.DefaultConfig(), new[] { device }, hands);
    Says(() => new Loop(simulation, Loop.DefaultConfig(), new[] { device }, hands));
    loop.Dispose();
    loop.Dispose();
    Says(() => loop.Start());
    simulation.Dispose();
    simulation.Dispose();
    Says(() => simulation.Surface());
    Says(() => simulation.Tick());
    Says(() => simulation.Clone());
    Says(() => new Batch(new[] { simulation }));
    var guard = new Guard(Guard.DefaultConfig());
    guard.Dispose();
    guard.Dispose();
    Says(() => guard.Force(new Vec3(0, 0, 0)));
  }

  static void Says(Action use) {
    try {
      use();
    } catch (Exception e) {
      Console.WriteLine(e.GetType().Name);
    }
  }

  // The functions of the library that the package declares, and the sizes of its structs.
  public static void Declared() {
    Type native = typeof(Organ).Assembly.GetType("Stylet.Native");
    var lines = new List<string>();
    foreach (MethodInfo each in native.GetMethods(BindingFlags.Static | BindingFlags.NonPublic)) {
      if (each.Name.StartsWith("stylet_")) lines.Add(each.Name);
    }
    foreach (Type each in typeof(Organ).Assembly.GetTypes()) {
      bool plain = each.Namespace == "Stylet" && each.IsValueType && each.IsLayoutSequential;
      if (plain && !each.IsNested) lines.Add(each.Name + " " + Marshal.SizeOf(each));
    }
    foreach (string each in lines) Console.WriteLine(each);
  }

  // Names of functions of the library that take one of its objects as a bare pointer.
  public static void Handles() {
    var names = new List<string>();
    Type native = typeof(Organ).Assembly.GetType("Stylet.Native");
    foreach (MethodInfo each in native.GetMethods(BindingFlags.Static | BindingFlags.NonPublic)) {
      foreach (ParameterInfo parameter in each.GetParameters()) {
        Type type = parameter.ParameterType;
        bool is_bare = type == typeof(IntPtr) || type == typeof(IntPtr).MakeByRefType();
        if (is_bare) names.Add(each.Name);
      }
    }
    names.Sort();
    foreach (string each in names) Console.WriteLine(each);
  }
}
