// SPDX-License-Identifier: Apache-2.0
// Put this on an object with a MeshFilter and a MeshRenderer: it becomes the organ. The position of
// `hand` is the needle's tip, its forward the needle's direction. If `device` is set ("hd:" and so
// on, or "simulated"), a haptic device holds the needle, and `hand` is where it starts.
using Stylet;
using UnityEngine;

public sealed class Insert : MonoBehaviour {
  public TextAsset organFile;
  public Transform hand;
  public LineRenderer line;
  public string device = "";

  Organ organ;
  Simulation simulation;  // null: the organ was refused, which Unity has written to its console
  Loop loop;
  Needle needle;
  OrganMesh surface;

  void Start() {
    organ = new Organ(organFile.bytes);
    surface = new OrganMesh(organ);
    GetComponent<MeshFilter>().mesh = surface.Mesh;
    needle = Simulation.Preset("18G");
    Config config = Simulation.DefaultConfig();
    config.period_s = device == "" ? Time.fixedDeltaTime / 10 : 1e-3F;
    simulation = new Simulation(organ, config, needle);
    if (device == "") return;
    Hand held = Loop.DefaultHand();
    held.start = UnityFrame.PoseOfTip(hand, needle);
    Device opened = device == "simulated" ? Device.Simulated(0.04F, 0.01F, 1) : new Device(device);
    loop = new Loop(simulation, Loop.DefaultConfig(), new[] { opened }, new[] { held });
    loop.Start();
  }

  void FixedUpdate() {  // without a device: ten ticks in a fixed step, towards the hand's place
    if (simulation == null || device != "") return;
    simulation.Inputs[0].valid = 1;
    simulation.Inputs[0].handle = UnityFrame.PoseOfTip(hand, needle);
    for (int i = 0; i < 10; ++i) simulation.Tick();
    simulation.Surface();
    surface.Show(simulation.Vertices);
    UnityFrame.Draw(line, simulation.Nodes, simulation.NeedleShape(0));
  }

  void Update() {
    if (loop == null || !loop.Take()) return;
    surface.Show(loop.Vertices);
    UnityFrame.Draw(line, loop.Nodes, loop.NeedleShape(0));
    if (loop.Hands[0].fault == 0) return;
    Debug.LogWarning(Loop.FaultName(loop.Hands[0].fault) + ": press space when you have seen it");
    if (UnityEngine.Input.GetKeyDown(KeyCode.Space)) loop.Acknowledge(0);
  }

  void OnDestroy() {
    if (loop != null) loop.Dispose();
    if (simulation != null) simulation.Dispose();
    if (organ != null) organ.Dispose();
  }
}
