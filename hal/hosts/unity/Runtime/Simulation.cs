// SPDX-License-Identifier: Apache-2.0
// Organs and simulations. What passes between C# and the library in every frame is in arrays of
// plain structs, which the garbage collector does not move during a call: nothing is copied or
// allocated.
// Units: SI. Frame: the organ's, right-handed (UnityFrame.cs turns it into Unity's).
using System;
using System.Runtime.InteropServices;

namespace Stylet {

// Something that the library refused, with the field, its value and its limits.
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

public sealed unsafe class Organ : IDisposable {
  internal readonly OrganHandle Handle;
  public readonly OrganInfo Info;
  public readonly string Name;

  public Organ(string path) : this(Read(path)) {}
  // Unity: the bytes of a TextAsset or of StreamingAssets.
  public Organ(byte[] bytes) : this(FromBytes(bytes)) {}

  Organ(OrganHandle handle) {
    Handle = handle;
    Info = new OrganInfo { struct_bytes = (uint)sizeof(OrganInfo) };
    StyletException.Check(Native.stylet_organ_get_info(Handle, ref Info));
    Name = Marshal.PtrToStringAnsi(Info.name);
    GC.KeepAlive(handle);  // the name was in its memory
    Info.name = IntPtr.Zero;
  }

  static OrganHandle Read(string path) {
    Refusal why = StyletException.Empty();
    OrganHandle organ;
    StyletException.Check(Native.stylet_organ_read(path, out organ, ref why), ref why);
    return organ;
  }

  static OrganHandle FromBytes(byte[] bytes) {
    Refusal why = StyletException.Empty();
    OrganHandle organ;
    fixed (byte* at = Native.Placed(bytes)) {
      StyletException.Check(
          Native.stylet_organ_from_bytes(at, (UIntPtr)bytes.Length, out organ, ref why), ref why);
    }
    return organ;
  }

  // Three vertices for each triangle, counter-clockwise seen from outside.
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
  public Voxel[] Voxels() {
    var voxels = new Voxel[Info.voxels];
    fixed (Voxel* at = voxels) Native.stylet_organ_voxels(Handle, at, Info.voxels);
    return voxels;
  }
  public Cube[] Cubes() {
    var cubes = new Cube[Info.voxels];
    fixed (Cube* at = cubes) Native.stylet_organ_cubes(Handle, at, Info.voxels);
    return cubes;
  }
  // By its number, as in VertexMaterials and in an output's layer.
  public Material Material(int index) {
    var material = new Material { struct_bytes = (uint)sizeof(Material) };
    StyletException.Check(Native.stylet_organ_get_material(Handle, (uint)index, ref material));
    return material;
  }
  public string NameOf(int index) { return Handle.TextOf(() => Material(index).name); }
  // False: the ray does not meet the surface at rest.
  public bool Raycast(Vec3 origin_m, Vec3 direction, out float distance_m) {
    return Native.stylet_organ_raycast(Handle, origin_m, direction, out distance_m) != 0;
  }

  // Simulations that were made from it stay valid.
  public void Dispose() { Handle.Dispose(); }
}

public sealed unsafe class Simulation : IDisposable {
  // One input and one output for each needle. Set Inputs, call Tick, read Outputs.
  public readonly Input[] Inputs;
  public readonly Output[] Outputs;
  // Surface and NeedleShape write these.
  public readonly Vec3[] Vertices;
  public readonly Vec3[] Nodes = new Vec3[129];
  public readonly Happened[] Events = new Happened[64];
  internal readonly SimulationHandle Handle;

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
  // A needle by its name, such as "22G-quincke"; it bends. PresetNames has all names.
  public static Needle Preset(string name) {
    Needle needle = DefaultNeedle();
    StyletException.Check(Native.stylet_needle_preset(ref needle, name));
    return needle;
  }
  public static string[] PresetNames() {
    var names = new System.Collections.Generic.List<string>();
    for (uint i = 0;; ++i) {
      IntPtr name = Native.stylet_needle_preset_name(i);
      if (name == IntPtr.Zero) return names.ToArray();
      names.Add(Marshal.PtrToStringAnsi(name));
    }
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
  // The pose at which an unbent needle has its tip at this place and points in this direction.
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
    Inputs = new Input[needles.Length];
    Outputs = new Output[needles.Length];
    Vertices = new Vec3[organ.Info.vertices];
  }
  Simulation(Simulation from) {
    StyletException.Check(Native.stylet_simulation_clone(from.Handle, out Handle));
    Inputs = (Input[])from.Inputs.Clone();
    Outputs = (Output[])from.Outputs.Clone();
    Vertices = new Vec3[from.Vertices.Length];
  }
  // A second simulation in the same state; both share the organ.
  public Simulation Clone() { return new Simulation(this); }

  // Only before the first tick.
  public void SetObstacles(params Obstacle[] obstacles) {
    Refusal why = StyletException.Empty();
    fixed (Obstacle* at = obstacles) {
      StyletException.Check(
          Native.stylet_simulation_set_obstacles(Handle, at, (uint)obstacles.Length, ref why),
          ref why);
    }
  }

  // Writes struct_bytes of Inputs[0] and Outputs[0], so that you may assign whole structs.
  public void Tick() {
    Inputs[0].struct_bytes = (uint)sizeof(Input);
    Outputs[0].struct_bytes = (uint)sizeof(Output);
    fixed (Input* given = Inputs)
    fixed (Output* told = Outputs) {
      StyletException.Check(Native.stylet_simulation_tick(
          Handle, given, (uint)Inputs.Length, told, (uint)Outputs.Length));
    }
  }
  // The number of whole ticks in these arrays; also tells the library the sizes of the structs. (It
  // does not take a delegate, which would allocate in each frame.)
  internal static uint TicksOf(Input[] inputs, Output[] outputs, int needles) {
    if (inputs.Length % needles != 0 || outputs.Length != inputs.Length) {
      throw new ArgumentException(inputs.Length + " inputs, " + outputs.Length +
                                  " outputs: expected as many of both, a multiple of " + needles);
    }
    if (inputs.Length == 0) return 0;
    inputs[0].struct_bytes = (uint)sizeof(Input);
    outputs[0].struct_bytes = (uint)sizeof(Output);
    return (uint)(inputs.Length / needles);
  }
  // Many ticks: inputs[tick * needles + needle]; the outputs have the same order.
  public void Run(Input[] inputs, Output[] outputs) {
    uint ticks = TicksOf(inputs, outputs, Inputs.Length);
    if (ticks == 0) return;
    fixed (Input* given = inputs)
    fixed (Output* told = outputs) {
      StyletException.Check(Native.stylet_simulation_run(Handle, given, told, ticks));
    }
  }
  public void Reset() { StyletException.Check(Native.stylet_simulation_reset(Handle)); }
  // Writes the deformed surface into Vertices.
  public void Surface() {
    fixed (Vec3* at = Vertices) {
      Native.stylet_simulation_surface(Handle, at, (uint)Vertices.Length);
    }
  }
  // Writes the places of a needle, from handle to tip, into Nodes; returns their number.
  public int NeedleShape(int needle) {
    fixed (Vec3* at = Nodes) {
      return (int)Native.stylet_simulation_needle_shape(Handle, (uint)needle, at,
                                                        (uint)Nodes.Length);
    }
  }
  // Writes the newest events, oldest first, into Events; returns their number.
  public int TakeEvents() {
    fixed (Happened* at = Events) {
      return (int)Native.stylet_simulation_events(Handle, at, (uint)Events.Length);
    }
  }
  public static string EventName(uint kind) {
    return Marshal.PtrToStringAnsi(Native.stylet_event_name(kind));
  }
  // The displacement of each particle of the lattice from its place at rest.
  public Vec3[] Particles() {
    var moved = new Vec3[Native.stylet_simulation_particles(Handle, null, 0)];
    fixed (Vec3* at = moved) Native.stylet_simulation_particles(Handle, at, (uint)moved.Length);
    return moved;
  }
  // Eight particles for each voxel of the organ, corner dx + 2 dy + 4 dz.
  public uint[] VoxelCorners() {
    var corners = new uint[Native.stylet_simulation_voxel_corners(Handle, null, 0)];
    fixed (uint* at = corners) {
      Native.stylet_simulation_voxel_corners(Handle, at, (uint)corners.Length);
    }
    return corners;
  }
  public ConstraintParticle[] ConstraintParticles() {
    uint all = Native.stylet_simulation_constraint_particles(Handle, null, 0);
    var particles = new ConstraintParticle[all];
    fixed (ConstraintParticle* at = particles) {
      Native.stylet_simulation_constraint_particles(Handle, at, all);
    }
    return particles;
  }
  public ObstacleTouch[] ObstacleTouches() {
    var touches = new ObstacleTouch[Native.stylet_simulation_obstacle_touches(Handle, null, 0)];
    fixed (ObstacleTouch* at = touches) {
      Native.stylet_simulation_obstacle_touches(Handle, at, (uint)touches.Length);
    }
    return touches;
  }
  public Stats Stats() {
    var stats = new Stats { struct_bytes = (uint)sizeof(Stats) };
    StyletException.Check(Native.stylet_simulation_get_stats(Handle, ref stats));
    return stats;
  }
  public Energy Energy() {
    var energy = new Energy { struct_bytes = (uint)sizeof(Energy) };
    StyletException.Check(Native.stylet_simulation_get_energy(Handle, ref energy));
    return energy;
  }
  // The mass of a material, and the mass that the step computes with.
  public void Mass(int material, out float real_kg, out float stepped_kg) {
    StyletException.Check(Native.stylet_simulation_get_mass(Handle, (uint)material, out real_kg,
                                                            out stepped_kg));
  }
  // Name of the first field of the state that differs; null: none does.
  public string Difference(Simulation other, out ulong index) {
    return Marshal.PtrToStringAnsi(
        Native.stylet_simulation_difference(Handle, other.Handle, out index));
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
    fixed (byte* at = Native.Placed(bytes)) {
      StyletException.Check(Native.stylet_simulation_restore(Handle, at, (UIntPtr)bytes.Length));
    }
  }

  public void Dispose() { Handle.Dispose(); }
}

}  // namespace Stylet
