// SPDX-License-Identifier: Apache-2.0
// The functions and structs of stylet.h and stylet_loop.h that the classes of this package use, as
// they are there: plain data, the same order, nothing is copied or converted on the way.
using System;
using System.Runtime.InteropServices;

namespace Stylet {

[StructLayout(LayoutKind.Sequential)]
public struct Vec3 {
  public float x, y, z;
  public Vec3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
}

[StructLayout(LayoutKind.Sequential)]
public struct Quat {
  public float w, x, y, z;
}

[StructLayout(LayoutKind.Sequential)]
public struct Pose {
  public Vec3 position_m;
  public Quat rotation;
}

[StructLayout(LayoutKind.Sequential)]
public struct Config {
  public uint struct_bytes;
  public uint mode;
  public float period_s;
  public uint substeps, inertia;
  public float tissue_damping_s, surround_drag_per_s, hourglass_weight, paper_alpha;
  public Vec3 breathing_amplitude_m;
  public float breathing_period_s;
  public Vec3 gravity_m_per_s2;
}

[StructLayout(LayoutKind.Sequential)]
public struct Needle {
  public uint struct_bytes;
  public float length_m, outer_radius_m, unit_m, bending_nm2;
  public uint rods;
  public float bevel_per_m, bent_length_m, bent_angle_rad, torsion_nm2, tip_half_angle_rad;
  public float torn_diameters;
  public uint hub;
  public float bore_radius_m, opening_m, filling_pa_s, plunger_radius_m, plunger_friction_n;
  public float syringe_m3, syringe_filled, syringe_gas_m3;
}

[StructLayout(LayoutKind.Sequential)]
public struct Input {
  public uint struct_bytes, valid;
  public Pose handle;
  public float plunger_n;
}

[StructLayout(LayoutKind.Sequential)]
public struct Output {
  public uint struct_bytes, flags;
  public ulong tick;
  public Vec3 force_n, torque_nm;
  public Vec3 stiffness_n, cutting_n, friction_n, clamping_n, obstacle_n;
  public Vec3 tip_m;
  public float depth_m;
  public uint phase, layer, constraint_particles, events;
  public float stiffness_n_per_m;
  public float opening_pa, hub_pa, flow_m3_per_s, injected_m3, plunger_m, plunger_m_per_s, filled;
  public uint reserved;
}

[StructLayout(LayoutKind.Sequential)]
public struct Happened {
  public ulong tick;
  public uint kind, layer;
  public float depth_m, force_n;
  public uint needle, reserved;
}

[StructLayout(LayoutKind.Sequential)]
public struct OrganInfo {
  public uint struct_bytes, format_version;
  public ulong hash;
  internal IntPtr name;  // as long as the organ: Organ.Name is its text
  public float voxel_edge_m;
  public Vec3 origin_m;
  public uint size_x, size_y, size_z, voxels, vertices, triangles, materials;
  public Vec3 low_m, high_m;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct Obstacle {
  public uint struct_bytes, vertex_count;
  public Pose pose;
  public fixed float vertices_m[3 * 64];
  public float rounding_m, stiffness_n_per_m, largest_force_n, friction;
}

[StructLayout(LayoutKind.Sequential)]
public struct LoopConfig {
  public uint struct_bytes;
  public int processor, priority;
  public uint helpers;
  public ulong ticks;
  public uint virtual_time, lock_memory, show_every_ticks;
}

[StructLayout(LayoutKind.Sequential)]
public struct Hand {
  public uint struct_bytes;
  public int clutch_button;
  public Pose start;
  public float motion_scale, force_scale, coupling_stiffness_n_per_m;
}

[StructLayout(LayoutKind.Sequential)]
public struct HandReport {
  public uint struct_bytes, mode, fault, fault_number;
  public Vec3 sent_force_n;
  public uint answered, reserved;
}

[StructLayout(LayoutKind.Sequential)]
public struct LoopReport {
  public uint struct_bytes, runs;
  public ulong ticks, missed_ticks, lost_events;
  public ulong tick_p50_ns, tick_p999_ns, tick_max_ns, late_p50_ns, late_p999_ns, late_max_ns;
}

[StructLayout(LayoutKind.Sequential)]
internal unsafe struct Refusal {
  public uint struct_bytes;
  public ushort status, reserved;
  public fixed byte place[64];
  public ulong index;
  public double value, least, most;
  public fixed byte expected[96];
  public fixed byte text[256];
}

internal static unsafe class Native {
  const string kLibrary = "stylet";  // libstylet.so, stylet.dll

  // `fixed` gives an empty array no address, and the library would take it for a forgotten one.
  internal static byte[] Placed(byte[] bytes) { return bytes.Length > 0 ? bytes : new byte[1]; }

  [DllImport(kLibrary)] internal static extern IntPtr stylet_version_text();
  [DllImport(kLibrary)] internal static extern IntPtr stylet_status_name(ushort status);
  [DllImport(kLibrary)] internal static extern IntPtr stylet_event_name(uint kind);
  [DllImport(kLibrary)] internal static extern IntPtr stylet_fault_name(uint fault);

  [DllImport(kLibrary)] internal static extern ushort stylet_organ_read(
      [MarshalAs(UnmanagedType.LPStr)] string path, out OrganHandle organ, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_organ_from_bytes(
      byte* bytes, UIntPtr count, out OrganHandle organ, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern void stylet_organ_free(IntPtr organ);
  [DllImport(kLibrary)] internal static extern ushort stylet_organ_get_info(
      OrganHandle organ, ref OrganInfo info);
  [DllImport(kLibrary)] internal static extern uint stylet_organ_triangles(
      OrganHandle organ, int* corners, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_organ_vertices(
      OrganHandle organ, Vec3* places, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_organ_vertex_materials(
      OrganHandle organ, byte* materials, uint capacity);
  [DllImport(kLibrary)] internal static extern int stylet_organ_raycast(
      OrganHandle organ, Vec3 origin_m, Vec3 direction, out float distance_m);

  [DllImport(kLibrary)] internal static extern ushort stylet_config_init(
      ref Config config, UIntPtr bytes);
  [DllImport(kLibrary)] internal static extern ushort stylet_needle_init(
      ref Needle needle, UIntPtr bytes);
  [DllImport(kLibrary)] internal static extern ushort stylet_obstacle_init(
      ref Obstacle obstacle, UIntPtr bytes);
  [DllImport(kLibrary)] internal static extern ushort stylet_obstacle_box(
      ref Obstacle obstacle, Vec3 half_m);
  [DllImport(kLibrary)] internal static extern ushort stylet_obstacle_sphere(
      ref Obstacle obstacle, float radius_m);

  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_create(
      OrganHandle organ, ref Config config, Needle* needles, uint needle_count,
      out SimulationHandle simulation, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern void stylet_simulation_free(IntPtr simulation);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_set_obstacles(
      SimulationHandle simulation, Obstacle* obstacles, uint count, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_reset(
      SimulationHandle simulation);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_tick(
      SimulationHandle simulation, Input* inputs, uint input_count, Output* outputs,
      uint output_count);
  [DllImport(kLibrary)] internal static extern Pose stylet_pose_of_tip(
      Vec3 tip_m, Vec3 direction, float length_m);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_surface(
      SimulationHandle simulation, Vec3* places, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_needle_shape(
      SimulationHandle simulation, uint needle, Vec3* places, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_events(
      SimulationHandle simulation, Happened* events, uint capacity);
  [DllImport(kLibrary)] internal static extern ulong stylet_simulation_hash(
      SimulationHandle simulation);
  [DllImport(kLibrary)] internal static extern UIntPtr stylet_simulation_snapshot_bytes(
      SimulationHandle simulation);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_snapshot(
      SimulationHandle simulation, byte* bytes, UIntPtr count);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_restore(
      SimulationHandle simulation, byte* bytes, UIntPtr count);

  [DllImport(kLibrary)] internal static extern ushort stylet_device_open(
      [MarshalAs(UnmanagedType.LPStr)] string uri, double patience_s, out DeviceHandle device,
      ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_device_simulated(
      float travel_m, float speed_m_per_s, float hold_s, out DeviceHandle device);
  [DllImport(kLibrary)] internal static extern void stylet_device_close(IntPtr device);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_config_init(
      ref LoopConfig config, UIntPtr bytes);
  [DllImport(kLibrary)] internal static extern ushort stylet_hand_init(
      ref Hand hand, UIntPtr bytes);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_create(
      SimulationHandle simulation, ref LoopConfig config, IntPtr* devices, Hand* hands,
      IntPtr guards, out LoopHandle loop, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_start(LoopHandle loop);
  [DllImport(kLibrary)] internal static extern void stylet_loop_ask_to_stop(LoopHandle loop);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_wait(LoopHandle loop);
  [DllImport(kLibrary)] internal static extern void stylet_loop_free(IntPtr loop);
  [DllImport(kLibrary)] internal static extern void stylet_loop_pause(LoopHandle loop, int paused);
  [DllImport(kLibrary)] internal static extern int stylet_loop_take(LoopHandle loop);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_get_output(
      LoopHandle loop, uint needle, ref Output output);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_get_hand(
      LoopHandle loop, uint needle, ref HandReport report);
  [DllImport(kLibrary)] internal static extern uint stylet_loop_surface(
      LoopHandle loop, Vec3* places, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_loop_needle_shape(
      LoopHandle loop, uint needle, Vec3* places, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_loop_events(
      LoopHandle loop, Happened* events, uint capacity);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_acknowledge(
      LoopHandle loop, uint needle, uint fault, uint fault_number);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_get_report(
      LoopHandle loop, ref LoopReport report);
  [DllImport(kLibrary)] internal static extern IntPtr stylet_loop_lacks(LoopHandle loop);
}

}  // namespace Stylet
