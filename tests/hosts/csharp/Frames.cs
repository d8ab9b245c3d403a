// SPDX-License-Identifier: Apache-2.0
// What csharp_test.py asks of the C# package, one question for each name. Prints what it found.
using System;
using Stylet;

public static class Frames {
  public static int Main(string[] arguments) {
    using (var organ = new Organ(arguments[1])) {
      switch (arguments[0]) {
        case "allocation": Allocation(organ); break;
        case "refusal": Refusal(organ); break;
        case "snapshot": Snapshot(organ); break;
        case "loop": LoopOfTheLibrary(organ); break;
        case "collector": Lives.UnderTheCollector(organ); break;
        case "disposal": Lives.DisposedInACall(organ); break;
        case "closed": Lives.Closed(organ); break;
        case "drawn": Drawn.Calls(organ, System.IO.File.ReadAllBytes(arguments[1])); break;
        case "declared": Lives.Declared(); break;
        case "batch": Many(organ); break;
        case "guard": Guarded(); break;
        case "more": More(organ); break;
        case "handles": Lives.Handles(); break;
        case "life": Life(organ, System.IO.File.ReadAllBytes(arguments[1])); break;
        default: return 2;
      }
    }
    return 0;
  }

  // A slanted way through the middle of the skin, which the tip meets after 1 mm.
  internal static Pose At(Organ organ, int tick) {
    Vec3 low = organ.Info.low_m, high = organ.Info.high_m;
    var way = new Vec3(0.0995037F, 0, -0.9950372F);
    var from = new Vec3((low.x + high.x) / 2, (low.y + high.y) / 2, high.z + 0.01F);
    float to_skin_m;
    organ.Raycast(from, way, out to_skin_m);
    float gone_m = to_skin_m - 1e-3F + 2e-5F * (float)tick;
    var tip = new Vec3(from.x + gone_m * way.x, from.y, from.z + gone_m * way.z);
    return Simulation.PoseOfTip(tip, way, 0.15F);
  }

  static void Step(Organ organ, Simulation simulation, int tick) {
    simulation.Inputs[0] = new Input { valid = 1, handle = At(organ, tick) };
    simulation.Tick();
    simulation.Surface();
    simulation.NeedleShape(0);
    simulation.TakeEvents();
  }

  // Bytes that 1000 frames allocate, after some that warm up.
  static void Allocation(Organ organ) {
    using (var simulation = new Simulation(organ, Simulation.DefaultConfig())) {
      for (int i = 0; i < 100; ++i) Step(organ, simulation, i);
      int collections = GC.CollectionCount(0);
      long before = GC.GetTotalMemory(false);
      for (int i = 100; i < 1100; ++i) Step(organ, simulation, i);
      Console.WriteLine("{0} {1}", GC.GetTotalMemory(false) - before,
                        GC.CollectionCount(0) - collections);
    }
  }

  static void Refusal(Organ organ) {
    Needle needle = Simulation.DefaultNeedle();
    needle.length_m = 0.7F;
    try {
      new Simulation(organ, Simulation.DefaultConfig(), Simulation.DefaultNeedle(), needle);
    } catch (StyletException e) {
      Console.WriteLine("{0} {1} {2:F3} {3:F3} {4:F3}", e.Place, e.Index, e.Value, e.Least,
                        e.Most);
    }
    foreach (int size in new[] { 100, 0 }) {
      try {
        new Organ(new byte[size]);
      } catch (StyletException e) {
        Console.WriteLine("{0} {1}", e.Status, e.Place);
      }
    }
    try {
      new Simulation(organ, Simulation.DefaultConfig()).Restore(new byte[0]);
    } catch (StyletException e) {
      Console.WriteLine(e.Message);
    }
  }

  static void Snapshot(Organ organ) {
    using (var simulation = new Simulation(organ, Simulation.DefaultConfig())) {
      for (int i = 0; i < 400; ++i) Step(organ, simulation, i);
      byte[] saved = simulation.Snapshot();
      ulong then = simulation.Hash();
      for (int i = 400; i < 500; ++i) Step(organ, simulation, i);
      bool moved = simulation.Hash() != then;
      simulation.Restore(saved);
      Console.WriteLine("{0} {1}", moved, simulation.Hash() == then);
    }
  }

  static Input[] Way(Organ organ, int ticks, int from) {
    var inputs = new Input[ticks];
    for (int i = 0; i < ticks; ++i) {
      inputs[i] = new Input { valid = 1, handle = At(organ, from + i) };
    }
    return inputs;
  }

  // A batch of two and runs of many ticks end where single ticks do.
  static void Many(Organ organ) {
    Simulation[] all = { new Simulation(organ, Simulation.DefaultConfig()),
                         new Simulation(organ, Simulation.DefaultConfig()) };
    Input[] first = Way(organ, 200, 0), second = Way(organ, 200, 50);
    var inputs = new Input[400];
    first.CopyTo(inputs, 0);
    second.CopyTo(inputs, 200);
    var outputs = new Output[400];
    using (var batch = new Batch(all, 2)) batch.Run(inputs, outputs);
    var single = new Simulation(organ, Simulation.DefaultConfig());
    foreach (Input each in second) {
      single.Inputs[0] = each;
      single.Tick();
    }
    var runs = new Simulation(organ, Simulation.DefaultConfig());
    var told = new Output[200];
    runs.Run(first, told);
    ulong index;
    Console.WriteLine("{0} {1} {2} {3}", all[1].Hash() == single.Hash(),
                      outputs[399].force_n.z == single.Outputs[0].force_n.z,
                      all[0].Difference(runs, out index) == null, told[199].tick);
    using (Simulation copy = single.Clone()) {
      copy.Tick();
      Console.WriteLine("{0} {1}", single.Outputs[0].tick, copy.Outputs[0].tick);
    }
    try {
      runs.Run(new Input[3], new Output[2]);
    } catch (ArgumentException e) {
      Console.WriteLine(e.Message);
    }
  }

  // A force beyond the limit is cut; a fault takes it away until somebody has seen it.
  static void Guarded() {
    GuardConfig config = Guard.ConfigFor("touch");
    config.dead_man_button = -1;
    using (var guard = new Guard(config)) {
      float most = 0;
      for (int tick = 1; tick <= 3000; ++tick) {
        var sample = new Sample { seq = (ulong)tick, t_ns = tick * 1000000L };
        sample.pose.rotation.w = 1;
        guard.Sample(sample, tick * 1000000L);
        most = Math.Max(most, guard.Force(new Vec3(0, 0, 1)).z);
      }
      guard.Trip(5);
      GuardReport report = guard.Report();
      Console.WriteLine("{0:F3}|{1}|{2}|{3}", most, Loop.FaultName(report.fault),
                        report.samples_used, guard.Rearm(1));
    }
    config.max_force_n = -1;
    try {
      new Guard(config);
    } catch (StyletException e) {
      Console.WriteLine("{0} {1}", e.Place, e.Value);
    }
    try {
      Guard.ConfigFor("no such");
    } catch (StyletException e) {
      Console.WriteLine(e.Message);
    }
  }

  // What is seen of a needle in tissue.
  static void More(Organ organ) {
    using (var simulation = new Simulation(organ, Simulation.DefaultConfig())) {
      for (int i = 0; i < 600; ++i) Step(organ, simulation, i);
      float real_kg, stepped_kg;
      simulation.Mass(0, out real_kg, out stepped_kg);
      Console.WriteLine("{0} {1} {2}", organ.NameOf(0), organ.Material(0).youngs_modulus_pa > 0,
                        real_kg > 0 && stepped_kg > 0);
      Console.WriteLine("{0} {1} {2}", organ.Voxels().Length == organ.Info.voxels &&
                            organ.Cubes()[1].edge_m == organ.Info.voxel_edge_m,
                        simulation.VoxelCorners().Length == 8 * organ.Info.voxels,
                        simulation.Particles().Length > organ.Info.voxels);
      Console.WriteLine("{0} {1} {2} {3}",
                        simulation.ConstraintParticles().Length ==
                            simulation.Outputs[0].constraint_particles,
                        simulation.ObstacleTouches().Length, simulation.Stats().ticks,
                        simulation.Energy().work_by_hand_j > 0);
    }
    Needle preset = Simulation.Preset(Simulation.PresetNames()[0]);
    Console.WriteLine("{0} {1} {2}", preset.bending_nm2 > 0, Library.Version(),
                      Simulation.EventName(2));
  }

  // Organs to which there is no reference any more, while the collector runs and moves what it can.
  static void Life(Organ organ, byte[] bytes) {
    ulong first = 0;
    bool same = true;
    for (int round = 0; round < 10; ++round) {
      Simulation simulation;
      using (var own = new Organ(bytes)) {
        simulation = new Simulation(own, Simulation.DefaultConfig());
      }
      for (int i = 0; i < 200; ++i) {
        Step(organ, simulation, i);
        if (i % 20 == 0) GC.Collect();
      }
      if (round == 0) first = simulation.Hash();
      same = same && simulation.Hash() == first;
      if (round % 2 == 0) simulation.Dispose();  // otherwise the collector does it
    }
    GC.Collect();
    GC.WaitForPendingFinalizers();
    Console.WriteLine(same);
  }

  static void LoopOfTheLibrary(Organ organ) {
    using (var simulation = new Simulation(organ, Simulation.DefaultConfig())) {
      LoopConfig config = Loop.DefaultConfig();
      config.virtual_time = 1;
      config.ticks = 1500;
      Hand hand = Loop.DefaultHand();
      hand.start = At(organ, 0);
      using (var loop = new Loop(simulation, config, new[] { Device.Simulated(0.02F, 0.02F, 1) },
                                 new[] { hand })) {
        loop.Start();
        loop.Wait();
        bool refused = false;
        try {
          simulation.Tick();
        } catch (StyletException) {
          refused = true;
        }
        Console.WriteLine("{0} {1} {2} {3}", loop.Take(), loop.Outputs[0].tick,
                          Loop.FaultName(loop.Hands[0].fault), refused);
        Console.WriteLine("{0} {1:F4} {2}", loop.TakeEvents() > 1, loop.Outputs[0].depth_m,
                          loop.NeedleShape(0));
      }
      Console.WriteLine("{0:x16}", simulation.Hash());
    }
  }
}
