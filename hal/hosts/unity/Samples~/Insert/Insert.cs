// SPDX-License-Identifier: Apache-2.0
// Put it on an object with a MeshFilter and a MeshRenderer: the organ. `hand` is the object whose
// position is the needle's tip and whose forward is its direction. With `device` set ("hd:" and so
// on, or "simulated") a haptic device holds the needle, and `hand` is where it starts.
using Stylet;
using UnityEngine;

public sealed class Insert : MonoBehaviour {
  public TextAsset organFile;
  public Transform hand;
  public LineRenderer line;
  public string device = "";

  Organ organ;
  Simulation simulation;
  Loop loop;
  Needle needle;
  Mesh mesh;
  Vector3[] places;

  void Start() {
    organ = new Organ(organFile.bytes);
    needle = Simulation.DefaultNeedle();
    needle.bending_nm2 = 0.02F;
    Config config = Simulation.DefaultConfig();
    config.period_s = device == "" ? Time.fixedDeltaTime / 10 : 1e-3F;
    simulation = new Simulation(organ, config, needle);
    places = new Vector3[organ.Info.vertices];
    UnityFrame.ToUnity(organ.Vertices(), places);
    mesh = new Mesh { indexFormat = UnityEngine.Rendering.IndexFormat.UInt32 };
    mesh.MarkDynamic();
    mesh.vertices = places;
    mesh.triangles = organ.Triangles();
    GetComponent<MeshFilter>().mesh = mesh;
    if (device == "") return;
    Hand held = Loop.DefaultHand();
    held.start = PoseOfHand();
    Device opened = device == "simulated" ? Device.Simulated(0.04F, 0.01F, 1) : new Device(device);
    loop = new Loop(simulation, Loop.DefaultConfig(), new[] { opened }, new[] { held });
    loop.Start();
  }

  Pose PoseOfHand() {
    return Simulation.PoseOfTip(UnityFrame.FromUnity(hand.position),
                                UnityFrame.FromUnity(hand.forward), needle.length_m);
  }

  void FixedUpdate() {  // without a device: ten ticks a fixed step, toward where the hand is
    if (loop != null) return;
    simulation.Inputs[0].valid = 1;
    simulation.Inputs[0].handle = PoseOfHand();
    for (int i = 0; i < 10; ++i) simulation.Tick();
  }

  void Update() {
    if (loop != null && !loop.Take()) return;
    if (loop == null) simulation.Surface();
    UnityFrame.ToUnity(loop != null ? loop.Vertices : simulation.Vertices, places);
    mesh.vertices = places;
    mesh.RecalculateNormals();
    int nodes = loop != null ? loop.NeedleShape(0) : simulation.NeedleShape(0);
    Vec3[] shape = loop != null ? loop.Nodes : simulation.Nodes;
    line.positionCount = nodes;
    for (int i = 0; i < nodes; ++i) line.SetPosition(i, UnityFrame.ToUnity(shape[i]));
    if (loop != null && loop.Hands[0].fault != 0) {
      Debug.LogWarning(Loop.FaultName(loop.Hands[0].fault) + ": press space once seen");
      if (UnityEngine.Input.GetKeyDown(KeyCode.Space)) loop.Acknowledge(0);
    }
  }

  void OnDestroy() {
    if (loop != null) loop.Dispose();
    if (simulation != null) simulation.Dispose();
    if (organ != null) organ.Dispose();
  }
}
