# SPDX-License-Identifier: Apache-2.0
"""Needle insertion into soft tissue: organs, needles in them, the force on the hand.

Units: SI. Frame: world, the organ's rest frame, right-handed. A pose is seven numbers: position and
quaternion (w, x, y, z) of the needle's handle. The needle points along the handle's -z.

    organ = stylet.phantom("liver")  # or Organ.read("patient.organ")
    simulation = stylet.Simulation(organ, stylet.Needle(bending_nm2=0.02))
    outputs = simulation.run(poses)  # poses: (ticks, 7)
    outputs["force_n"]

The same poses give the same bits on every machine and with any number of threads.
"""
from stylet import _stylet
from stylet._stylet import (
    Device, Organ, StyletError, build, constraint_particle_dtype, event_dtype, event_name,
    input_dtype, obstacle_touch_dtype, output_dtype, pose_of_tip, state_layout, status_name,
    version, voxel_dtype)
from stylet.device import Fault, Guard, GuardConfig, GuardMode, Hand, Loop, LoopConfig
from stylet.draws import Choice, LogNormal, LogUniform, Normal, Uniform, draw
from stylet.environment import NeedleEnv, VectorNeedleEnv
from stylet.fit import Fit, fit
from stylet.insertion import insertion_poses, kept_organ
from stylet.names import Event, Flag, NO_LAYER, Phase, Status
from stylet.phantom import phantom
from stylet.recording import Recording
from stylet.scene import read_obstacles
from stylet.simulation import Simulation, VectorSimulation, inputs, poses_of_tips
from stylet.spaces import Box
from stylet.structs import Config, Needle, Obstacle
from stylet.sweep import read_table, sweep
from stylet.targets import Target, read_targets

__version__ = _stylet.version()
__all__ = [
    "Box", "Choice", "Config", "Device", "Event", "Fault", "Fit", "Flag", "Guard", "GuardConfig",
    "GuardMode", "Hand", "LogNormal", "LogUniform", "Loop", "LoopConfig", "NO_LAYER", "Needle",
    "NeedleEnv", "Normal", "Obstacle", "Organ", "Phase", "Recording", "Simulation", "Status",
    "StyletError", "Target", "Uniform", "VectorNeedleEnv", "VectorSimulation", "build",
    "constraint_particle_dtype", "draw", "event_dtype", "event_name", "fit", "input_dtype",
    "inputs", "insertion_poses", "kept_organ", "obstacle_touch_dtype", "output_dtype", "phantom",
    "pose_of_tip", "poses_of_tips", "read_obstacles", "read_table", "read_targets", "state_layout",
    "status_name", "sweep", "version", "voxel_dtype"]
