// SPDX-License-Identifier: Apache-2.0
// A needle in an organ, from C#: it goes 20 mm in from above at 10 mm/s, and the force is printed.
//
//   mcs -unsafe Insert.cs ../Runtime/*.cs && mono Insert.exe liver.organ
using System;
using Stylet;

public static class Insert {
  public static int Main(string[] arguments) {
    if (arguments.Length != 1) {
      Console.Error.WriteLine("usage: Insert ORGAN");
      return 1;
    }
    try {
      using (var organ = new Organ(arguments[0])) Run(organ);
      return 0;
    } catch (StyletException refused) {
      Console.Error.WriteLine(refused.Message);
      return 1;
    }
  }

  static void Run(Organ organ) {
    Needle needle = Simulation.DefaultNeedle();  // 18G, 150 mm, rigid, unless said otherwise
    needle.bending_nm2 = 0.02F;
    using (var simulation = new Simulation(organ, Simulation.DefaultConfig(), needle)) {
      // From above the middle of the organ, straight down; the tip begins 1 mm above the skin.
      Vec3 low = organ.Info.low_m, high = organ.Info.high_m;
      var down = new Vec3(0, 0, -1);
      var at = new Vec3((low.x + high.x) / 2, (low.y + high.y) / 2, high.z + 0.01F);
      float to_skin_m;
      organ.Raycast(at, down, out to_skin_m);
      at.z -= to_skin_m - 1e-3F;

      simulation.Inputs[0].valid = 1;
      for (int tick = 0; tick <= 2100; ++tick) {
        var tip = new Vec3(at.x, at.y, at.z - 10e-3F * 1e-3F * (float)tick);
        simulation.Inputs[0].handle = Simulation.PoseOfTip(tip, down, needle.length_m);
        simulation.Tick();
        Output output = simulation.Outputs[0];
        if (tick % 100 == 0) {
          Console.WriteLine("{0,6:F2} mm  {1,6:F3} N", 1e3 * output.depth_m, output.force_n.z);
        }
      }
      Console.WriteLine("state {0:x16}", simulation.Hash());
    }
  }
}
