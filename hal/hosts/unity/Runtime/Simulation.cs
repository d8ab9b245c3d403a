// SPDX-License-Identifier: Apache-2.0
// Organs and simulations. What passes between C# and the library every frame lies in arrays that
// the collector does not move (PinnedArray): nothing is copied, nothing allocated.
// Units: SI. Frame: the organ's, right-handed (UnityFrame.cs turns it into Unity's).
using System;
using System.Runtime.InteropServices;

namespace Stylet {

// What the library refused, with the field, its value and its limits.
public sealed class StyletException : Exception {
  public readonly ushort Status;
  public readonly string Place;
  public readonly ulong Index;
  public readonly double Value, Least, Most;

  StyletException(string text, ushort status, string place, ulong index, double value,
                  double least, double most)
      : base(text) {
    Status = status;
    Place = place;
    Index = index;
    Value = value;
    Least = least;
    Most = most;
  }

  internal static unsafe Refusal Empty() {
    return new Refusal { struct_bytes = (uint)sizeof(Refusal) };
  }

  internal static unsafe void Check(ushort status, ref Refusal why) {
    if (status == 0) return;
    fixed (byte* place = why.place, text = why.text) {
      throw new StyletException(Marshal.PtrToStringAnsi((IntPtr)text), status,
                                Marshal.PtrToStringAnsi((IntPtr)place), why.index, why.value,
                                why.least, why.most);
    }
  }

  internal static void Check(ushort status) {
    if (status == 0) return;
    string name = Marshal.PtrToStringAnsi(Native.stylet_status_name(status));
    throw new StyletException(name, status, "", 0, 0, 0, 0);
  }
}

// An array that stays where it is until it is disposed, so that the library may write into it.
public sealed class PinnedArray<T> : IDisposable where T : struct {
  public readonly T[] Values;
  GCHandle handle;

  public PinnedArray(int count) {
    Values = new T[Math.Max(count, 1)];
    handle = GCHandle.Alloc(Values, GCHandleType.Pinned);
    Count = count;
  }
  public readonly int Count;
  internal IntPtr Address { get { return handle.AddrOfPinnedObject(); } }
  public void Dispose() {
    if (handle.IsAllocated) handle.Free();
  }
}

public sealed unsafe class Organ : IDisposable {
  internal IntPtr Handle;
  public readonly OrganInfo Info;

  public Organ(string path) : this(Read(path)) {}
  // Unity: the bytes of a TextAsset or of StreamingAssets.
  public Organ(byte[] bytes) : this(FromBytes(bytes)) {}

  Organ(IntPtr handle) {
    Handle = handle;
    Info = new OrganInfo { struct_bytes = (uint)sizeof(OrganInfo) };
    StyletException.Check(Native.stylet_organ_get_info(Handle, ref Info));
  }

  static IntPtr Read(string path) {
    Refusal why = StyletException.Empty();
    IntPtr organ;
    StyletException.Check(Native.stylet_organ_read(path, out organ, ref why), ref why);
    return organ;
  }

  static IntPtr FromBytes(byte[] bytes) {
    Refusal why = StyletException.Empty();
    IntPtr organ;
    fixed (byte* at = bytes) {
      StyletException.Check(
          Native.stylet_organ_from_bytes(at, (UIntPtr)bytes.Length, out organ, ref why), ref why);
    }
    return organ;
  }

  public string Name { get { return Marshal.PtrToStringAnsi(Info.name); } }

  // Three corners a triangle, counter-clockwise seen from outside.
  public int[] Triangles() {
    var corners = new int[3 * Info.triangles];
    fixed (int* at = corners) Native.stylet_organ_triangles(Handle, at, Info.triangles);
    return corners;
  }
  public Vec3[] Vertices() {
    var places = new Vec3[Info.vertices];
    fixed (Vec3* at = places) Native.stylet_organ_vertices(Handle, at, Info.vertices);
    return places;
  }
  public byte[] VertexMaterials() {
    var materials = new byte[Info.vertices];
    fixed (byte* at = materials) {
      Native.stylet_organ_vertex_materials(Handle, at, Info.vertices);
    }
    return materials;
  }
  // False: the ray does not meet the surface at rest.
  public bool Raycast(Vec3 origin_m, Vec3 direction, out float distance_m) {
    return Native.stylet_organ_raycast(Handle, origin_m, direction, out distance_m) != 0;
  }

  // Simulations that were made from it go on.
  public void Dispose() {
    Native.stylet_organ_free(Handle);
    Handle = IntPtr.Zero;
    GC.SuppressFinalize(this);
  }
  ~Organ() { Dispose(); }
}

public sealed unsafe class Simulation : IDisposable {
  // One of each for every needle. Set Inputs, call Tick, read Outputs.
  public readonly PinnedArray<Input> Inputs;
  public readonly PinnedArray<Output> Outputs;
  // What Surface and NeedleShape write.
  public readonly PinnedArray<Vec3> Vertices;
  public readonly PinnedArray<Vec3> Nodes = new PinnedArray<Vec3>(129);
  public readonly PinnedArray<Happened> Events = new PinnedArray<Happened>(64);
  internal IntPtr Handle;

  public static Config DefaultConfig() {
    var config = new Config();
    StyletException.Check(Native.stylet_config_init(ref config, (UIntPtr)sizeof(Config)));
    return config;
  }
  // 18G, 150 mm, rigid.
  public static Needle DefaultNeedle() {
    var needle = new Needle();
    StyletException.Check(Native.stylet_needle_init(ref needle, (UIntPtr)sizeof(Needle)));
    return needle;
  }
  public static Obstacle Box(Vec3 half_m) {
    Obstacle obstacle = Sphere(0);
    StyletException.Check(Native.stylet_obstacle_box(ref obstacle, half_m));
    return obstacle;
  }
  public static Obstacle Sphere(float radius_m) {
    var obstacle = new Obstacle();
    StyletException.Check(Native.stylet_obstacle_init(ref obstacle, (UIntPtr)sizeof(Obstacle)));
    StyletException.Check(Native.stylet_obstacle_sphere(ref obstacle, radius_m));
    return obstacle;
  }
  // The pose whose unbent needle has its tip here and points there.
  public static Pose PoseOfTip(Vec3 tip_m, Vec3 direction, float length_m) {
    return Native.stylet_pose_of_tip(tip_m, direction, length_m);
  }

  public Simulation(Organ organ, Config config, params Needle[] needles) {
    if (needles.Length == 0) needles = new[] { DefaultNeedle() };
    Refusal why = StyletException.Empty();
    fixed (Needle* at = needles) {
      StyletException.Check(
          Native.stylet_simulation_create(organ.Handle, ref config, at, (uint)needles.Length,
                                          out Handle, ref why), ref why);
    }
    Inputs = new PinnedArray<Input>(needles.Length);
    Outputs = new PinnedArray<Output>(needles.Length);
    Vertices = new PinnedArray<Vec3>((int)organ.Info.vertices);
    for (int i = 0; i < needles.Length; ++i) {
      Inputs.Values[i].struct_bytes = (uint)sizeof(Input);
      Outputs.Values[i].struct_bytes = (uint)sizeof(Output);
    }
  }

  // Before the first tick.
  public void SetObstacles(params Obstacle[] obstacles) {
    Refusal why = StyletException.Empty();
    fixed (Obstacle* at = obstacles) {
      StyletException.Check(
          Native.stylet_simulation_set_obstacles(Handle, at, (uint)obstacles.Length, ref why),
          ref why);
    }
  }

  public void Tick() {
    StyletException.Check(Native.stylet_simulation_tick(Handle, (Input*)Inputs.Address,
                                                        (uint)Inputs.Count, (Output*)Outputs.Address,
                                                        (uint)Outputs.Count));
  }
  public void Reset() { StyletException.Check(Native.stylet_simulation_reset(Handle)); }
  // Writes the deformed surface into Vertices.
  public void Surface() {
    Native.stylet_simulation_surface(Handle, (Vec3*)Vertices.Address, (uint)Vertices.Count);
  }
  // Writes a needle, from handle to tip, into Nodes; returns how many places it has.
  public int NeedleShape(int needle) {
    return (int)Native.stylet_simulation_needle_shape(Handle, (uint)needle, (Vec3*)Nodes.Address,
                                                      (uint)Nodes.Count);
  }
  // Writes the newest events, oldest first, into Events; returns how many.
  public int TakeEvents() {
    return (int)Native.stylet_simulation_events(Handle, (Happened*)Events.Address, (uint)Events.Count);
  }
  public ulong Hash() { return Native.stylet_simulation_hash(Handle); }

  public byte[] Snapshot() {
    var bytes = new byte[(long)Native.stylet_simulation_snapshot_bytes(Handle)];
    fixed (byte* at = bytes) {
      StyletException.Check(
          Native.stylet_simulation_snapshot(Handle, at, (UIntPtr)bytes.Length));
    }
    return bytes;
  }
  public void Restore(byte[] bytes) {
    fixed (byte* at = bytes) {
      StyletException.Check(Native.stylet_simulation_restore(Handle, at, (UIntPtr)bytes.Length));
    }
  }

  public void Dispose() {
    if (Handle == IntPtr.Zero) return;
    Native.stylet_simulation_free(Handle);
    Handle = IntPtr.Zero;
    foreach (IDisposable each in new IDisposable[] { Inputs, Outputs, Vertices, Nodes, Events }) {
      if (each != null) each.Dispose();
    }
    GC.SuppressFinalize(this);
  }
  ~Simulation() { Dispose(); }
}

}  // namespace Stylet
