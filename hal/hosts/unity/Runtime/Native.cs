// SPDX-License-Identifier: Apache-2.0
// The functions and structs of stylet.h and stylet_loop.h as they are there: plain data in the same
// order, which is neither copied nor converted on the way. Some functions are used by no class of
// this package (README.md): those for hosts that provide all memory, threads, or a device.
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
public struct Material {
  public uint struct_bytes;
  public float density_kg_per_m3;
  internal IntPtr name, source;  // valid as long as the organ; Organ.NameOf gives the name
  public float youngs_modulus_pa, poisson_ratio, relaxing_fraction, relaxation_time_s;
  public float puncture_force_n, cutting_force_n, recut_fraction;
  public float coulomb_friction_n_per_m, static_friction_n_per_m;
  public float stribeck_velocity_m_per_s, viscous_friction_n_s_per_m2;
  public float puncture_velocity_exponent, membrane_n_per_m, strain_stiffening;
  public float fracture_toughness_j_per_m2, toughness_velocity_exponent;
  public float needle_friction_coefficient;
  public float fluid_pressure_pa, fluid_conductance_m3_per_pa_s, fluid_viscosity_pa_s;
}

[StructLayout(LayoutKind.Sequential)]
public struct Voxel {
  public ushort x, y, z;
  public byte material, fixed_corners;  // bit i: corner i is held, corner dx + 2 dy + 4 dz
  public float fill;
}

// The space that a voxel takes up at rest: its corner with the least x, y and z.
[StructLayout(LayoutKind.Sequential)]
public struct Cube {
  public Vec3 low_m;
  public float edge_m;
}

[StructLayout(LayoutKind.Sequential)]
public struct ConstraintParticle {
  public Vec3 position_m, goal_m, force_on_needle_n;
  public float arc_length_m;
  public uint is_tip, needle;
}

[StructLayout(LayoutKind.Sequential)]
public struct ObstacleTouch {
  public Vec3 position_m, normal, force_on_needle_n;
  public uint obstacle, needle;
}

[StructLayout(LayoutKind.Sequential)]
public struct Pool {
  public uint used, used_max, capacity;
}

[StructLayout(LayoutKind.Sequential)]
public struct Stats {
  public uint struct_bytes, filter_passes;
  public ulong ticks;
  public Pool constraint_particles, coupled_voxels, tracks, obstacle_contacts;
  public ulong input_not_finite, input_clamped, input_missing;
  public ulong cp_pool_full, cp_voxel_pool_full, contact_budget, fault;
  public ulong obstacle_pool_full, needle_unstable;
  public float coupling_shortfall, unit_in_voxels;
}

[StructLayout(LayoutKind.Sequential)]
public struct Energy {
  public uint struct_bytes, reserved;
  public double elastic_j, kinetic_j, coupling_j, bending_j, work_by_hand_j;
  public double friction_j, cutting_j, relaxation_j, obstacles_j, sliding_j;
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
  internal IntPtr name;  // valid as long as the organ; Organ.Name gives the text
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
public struct GuardConfig {
  public uint struct_bytes;
  public float period_s, max_force_n, max_slew_n_per_s, ramp_s, watchdog_s, max_speed_m_per_s;
  public float buzz_n, continuous_force_n, thermal_s;
  public int dead_man_button, acknowledge_button;
  public float device_mass_kg, device_damping_n_s_per_m, device_friction_n;
  public float device_resolution_m, device_delay_s;
  public float stored_energy_j, passivity_damping_n_s_per_m, max_torque_nm;
}

[StructLayout(LayoutKind.Sequential)]
public struct Sample {
  public uint struct_bytes, buttons;
  public ulong seq;
  public long t_ns;
  public Pose pose;
  public float plunger_n;
}

[StructLayout(LayoutKind.Sequential)]
public struct MotorReport {
  public Vec3 force_n, torque_nm;
  public uint arming, stopped;
}

[StructLayout(LayoutKind.Sequential)]
public struct GuardReport {
  public uint struct_bytes, mode, fault, fault_number, arming, falls;
  public Vec3 force_n, torque_nm;
  public double energy_j;
  public ulong samples_used, samples_missing, samples_repeated, samples_lost, samples_old;
  public ulong samples_not_finite, samples_absurd, samples_jumped;
  public ulong force_not_finite, force_limited, slew_limited, force_warm, force_damped;
  public ulong faults, rearms;
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

  // `fixed` gives an empty array no address, which the library would take for a missing argument.
  internal static byte[] Placed(byte[] bytes) { return bytes.Length > 0 ? bytes : new byte[1]; }

  [DllImport(kLibrary)] internal static extern uint stylet_version();
  [DllImport(kLibrary)] internal static extern IntPtr stylet_version_text();
  [DllImport(kLibrary)] internal static extern IntPtr stylet_build_text();
  [DllImport(kLibrary)] internal static extern ulong stylet_state_layout();
  [DllImport(kLibrary)] internal static extern IntPtr stylet_status_name(ushort status);

  [DllImport(kLibrary)] internal static extern ushort stylet_organ_read(
      [MarshalAs(UnmanagedType.LPStr)] string path, out OrganHandle organ, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_organ_from_bytes(
      byte* bytes, UIntPtr count, out OrganHandle organ, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern void stylet_organ_free(IntPtr organ);
  [DllImport(kLibrary)] internal static extern ushort stylet_organ_get_info(
      OrganHandle organ, ref OrganInfo info);
  [DllImport(kLibrary)] internal static extern ushort stylet_organ_get_material(
      OrganHandle organ, uint index, ref Material material);
  [DllImport(kLibrary)] internal static extern uint stylet_organ_voxels(
      OrganHandle organ, Voxel* voxels, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_organ_cubes(
      OrganHandle organ, Cube* cubes, uint capacity);
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
  [DllImport(kLibrary)] internal static extern ushort stylet_needle_preset(
      ref Needle needle, [MarshalAs(UnmanagedType.LPStr)] string name);
  [DllImport(kLibrary)] internal static extern IntPtr stylet_needle_preset_name(uint index);
  [DllImport(kLibrary)] internal static extern ushort stylet_obstacle_init(
      ref Obstacle obstacle, UIntPtr bytes);
  [DllImport(kLibrary)] internal static extern ushort stylet_obstacle_box(
      ref Obstacle obstacle, Vec3 half_m);
  [DllImport(kLibrary)] internal static extern ushort stylet_obstacle_sphere(
      ref Obstacle obstacle, float radius_m);

  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_create(
      OrganHandle organ, ref Config config, Needle* needles, uint needle_count,
      out SimulationHandle simulation, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_bytes(
      OrganHandle organ, ref Config config, Needle* needles, uint needle_count, out UIntPtr bytes,
      ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_create_in(
      OrganHandle organ, ref Config config, Needle* needles, uint needle_count, byte* memory,
      UIntPtr bytes, out SimulationHandle simulation, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_clone(
      SimulationHandle simulation, out SimulationHandle copy);
  [DllImport(kLibrary)] internal static extern void stylet_simulation_free(IntPtr simulation);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_set_obstacles(
      SimulationHandle simulation, Obstacle* obstacles, uint count, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_reset(
      SimulationHandle simulation);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_tick(
      SimulationHandle simulation, Input* inputs, uint input_count, Output* outputs,
      uint output_count);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_run(
      SimulationHandle simulation, Input* inputs, Output* outputs, uint ticks);
  [DllImport(kLibrary)] internal static extern Pose stylet_pose_of_tip(
      Vec3 tip_m, Vec3 direction, float length_m);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_needles(
      SimulationHandle simulation);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_surface(
      SimulationHandle simulation, Vec3* places, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_needle_shape(
      SimulationHandle simulation, uint needle, Vec3* places, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_particles(
      SimulationHandle simulation, Vec3* moved_m, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_voxel_corners(
      SimulationHandle simulation, uint* particles, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_constraint_particles(
      SimulationHandle simulation, ConstraintParticle* particles, uint capacity);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_obstacle_touches(
      SimulationHandle simulation, ObstacleTouch* touches, uint capacity);
  [DllImport(kLibrary)] internal static extern IntPtr stylet_event_name(uint kind);
  [DllImport(kLibrary)] internal static extern uint stylet_simulation_events(
      SimulationHandle simulation, Happened* events, uint capacity);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_get_stats(
      SimulationHandle simulation, ref Stats stats);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_get_energy(
      SimulationHandle simulation, ref Energy energy);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_get_mass(
      SimulationHandle simulation, uint material, out float real_kg, out float stepped_kg);
  [DllImport(kLibrary)] internal static extern ulong stylet_simulation_hash(
      SimulationHandle simulation);
  [DllImport(kLibrary)] internal static extern UIntPtr stylet_simulation_snapshot_bytes(
      SimulationHandle simulation);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_snapshot(
      SimulationHandle simulation, byte* bytes, UIntPtr count);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_restore(
      SimulationHandle simulation, byte* bytes, UIntPtr count);
  [DllImport(kLibrary)] internal static extern IntPtr stylet_simulation_difference(
      SimulationHandle a, SimulationHandle b, out ulong index);
  [DllImport(kLibrary)] internal static extern ushort stylet_simulation_set_helpers(
      SimulationHandle simulation, uint helpers);
  [DllImport(kLibrary)] internal static extern int stylet_simulation_help(
      SimulationHandle simulation, uint looks);

  [DllImport(kLibrary)] internal static extern ushort stylet_batch_create(
      IntPtr* simulations, uint count, uint threads, out BatchHandle batch);
  [DllImport(kLibrary)] internal static extern void stylet_batch_free(IntPtr batch);
  [DllImport(kLibrary)] internal static extern uint stylet_batch_needles(BatchHandle batch);
  [DllImport(kLibrary)] internal static extern ushort stylet_batch_run(
      BatchHandle batch, Input* inputs, Output* outputs, uint ticks);

  [DllImport(kLibrary)] internal static extern IntPtr stylet_fault_name(uint fault);
  [DllImport(kLibrary)] internal static extern IntPtr stylet_guard_mode_name(uint mode);
  [DllImport(kLibrary)] internal static extern ushort stylet_guard_config_init(
      ref GuardConfig config, UIntPtr bytes);
  [DllImport(kLibrary)] internal static extern ushort stylet_guard_config_for(
      ref GuardConfig config, [MarshalAs(UnmanagedType.LPStr)] string model);
  [DllImport(kLibrary)] internal static extern IntPtr stylet_device_model(uint index);
  [DllImport(kLibrary)] internal static extern ushort stylet_guard_create(
      ref GuardConfig config, out GuardHandle guard, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern void stylet_guard_free(IntPtr guard);
  [DllImport(kLibrary)] internal static extern ushort stylet_guard_motor(
      GuardHandle guard, ref MotorReport report);
  [DllImport(kLibrary)] internal static extern int stylet_guard_sample(
      GuardHandle guard, Sample* sample, long now_ns);
  [DllImport(kLibrary)] internal static extern Vec3 stylet_guard_force(
      GuardHandle guard, Vec3 force_n);
  [DllImport(kLibrary)] internal static extern Vec3 stylet_guard_torque(
      GuardHandle guard, Vec3 torque_nm);
  [DllImport(kLibrary)] internal static extern int stylet_guard_end(
      GuardHandle guard, long now_ns);
  [DllImport(kLibrary)] internal static extern ushort stylet_guard_trip(
      GuardHandle guard, uint fault);
  [DllImport(kLibrary)] internal static extern int stylet_guard_rearm(
      GuardHandle guard, uint fault_seen);
  [DllImport(kLibrary)] internal static extern ushort stylet_guard_get_report(
      GuardHandle guard, ref GuardReport report);

  [DllImport(kLibrary)] internal static extern ushort stylet_device_open(
      [MarshalAs(UnmanagedType.LPStr)] string uri, double patience_s, out DeviceHandle device,
      ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_device_from_functions(
      byte* functions, out DeviceHandle device, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_device_simulated(
      float travel_m, float speed_m_per_s, float hold_s, out DeviceHandle device);
  [DllImport(kLibrary)] internal static extern void stylet_device_close(IntPtr device);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_config_init(
      ref LoopConfig config, UIntPtr bytes);
  [DllImport(kLibrary)] internal static extern ushort stylet_hand_init(
      ref Hand hand, UIntPtr bytes);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_create(
      SimulationHandle simulation, ref LoopConfig config, IntPtr* devices, Hand* hands,
      GuardConfig* guards, out LoopHandle loop, ref Refusal refusal);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_start(LoopHandle loop);
  [DllImport(kLibrary)] internal static extern ushort stylet_loop_run(LoopHandle loop);
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
  [DllImport(kLibrary)] internal static extern IntPtr stylet_loop_trouble(
      LoopHandle loop, uint needle);
}

}  // namespace Stylet
