# SPDX-License-Identifier: Apache-2.0
"""Needle insertion for learning, in the form of Gymnasium's environments: one, or many at once.

An episode begins with the tip outside the organ, on a line to a target. It ends when the tip is in
the target (`terminated`, reward +1), when the shaft touches a forbidden zone or the kernel latches
a fault (`terminated`, reward -1), or after `most_steps` (`truncated`). In addition, each step is
rewarded with the distance by which the tip came nearer to the target, as a fraction of the distance
at the start. So an episode that ends in the target is worth 1 plus the fraction that it covered.
"""
from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from stylet import _stylet
from stylet._stylet import Organ
from stylet.bases import Env, NEXT_STEP, VectorEnv
from stylet.motion import moved
from stylet.names import Flag
from stylet.given import Array, Path, count, direction as unit, finite, positive, real
from stylet.render import picture
from stylet.scene import read_obstacles, scene_direction, scene_file, scene_organ
from stylet.simulation import Simulation, VectorSimulation
from stylet.spaces import Box, stacked
from stylet.structs import Config, Needle, Obstacle
from stylet.targets import Target, distance_to_segment_m, read_targets

OBSERVATION = {"way_to_target_m": 3, "rotation_wxyz": 4, "force_n": 3, "torque_nm": 3,
               "depth_m": 1, "phase": 1}


class NeedleEnv(Env):
    """One needle, held by a learner. It is a gymnasium.Env if Gymnasium is installed.

    An action is six numbers from -1 to 1: the velocity of the handle along its own axes, as a
    fraction of `speed_m_per_s`, and about them, as a fraction of `turning_rad_per_s`. The needle
    points along the handle's -z, so action[2] < 0 pushes it in. Numbers beyond -1 and 1 are
    clipped, and info["clipped"] is then True; with nan or an infinity the action is refused, and
    nothing moves. An observation has the quantities of OBSERVATION one after the other.
    """
    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 50}

    def __init__(self, organ: Organ, targets: list[Target] | tuple[Target, ...] | Path,
                 needle: Needle | None = None, config: Config | None = None,
                 direction: ArrayLike = (0, 0, -1), start_m: float = 0.01, scatter_m: float = 0.0,
                 ticks_of_step: int = 20, most_steps: int = 1000, speed_m_per_s: float = 0.02,
                 turning_rad_per_s: float = 1.0, obstacles: Obstacle | Iterable[Obstacle] = (),
                 render_mode: str | None = None) -> None:
        """`targets`: a list of Targets, or a scene's file, of which only the targets are taken
        (`of_scene` takes more of it). The line to the target has `direction`, and the tip starts
        `start_m` before the surface, or before the target if the line misses the organ. The line
        passes the middle of the target at a random distance of at most `scatter_m`. The defaults
        are those of a hand: 20 mm/s, 1 rad/s, and a decision every 20 ticks."""
        self.organ, self.needle = organ, needle or Needle()
        if not isinstance(self.needle, Needle):
            raise TypeError(f"needle of {type(needle).__name__}: expected one stylet.Needle")
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode = {render_mode!r}: expected None or one of "
                             f"{self.metadata['render_modes']}")
        self.targets = targets if isinstance(targets, (list, tuple)) else read_targets(targets)
        self._goals = [target for target in self.targets if not target.forbidden]
        if not self._goals:
            raise ValueError("targets: all are forbidden, or there are none: expected one to reach")
        for target in self.targets:
            finite(f"target {target.name!r}: at_m", target.at_m, (3,))
            positive(f"target {target.name!r}: radius_m", target.radius_m)
        self.direction = unit("direction", direction)
        self.start_m = positive("start_m", start_m)
        self.scatter_m = float(finite("scatter_m", scatter_m, ()))
        self.ticks_of_step = count("ticks_of_step", ticks_of_step)
        self.most_steps = count("most_steps", most_steps)
        self.speed_m_per_s = float(finite("speed_m_per_s", speed_m_per_s, ()))
        self.turning_rad_per_s = float(finite("turning_rad_per_s", turning_rad_per_s, ()))
        config = config or Config()
        self.period_s = config.period_s
        self.simulation = Simulation(organ, self.needle, config, obstacles)
        self.action_space = Box(-1.0, 1.0, (6,))
        self.observation_space = Box(-np.inf, np.inf, (sum(OBSERVATION.values()),))
        self.render_mode = render_mode
        self._pose: Any = None
        self._output: Any = None

    @classmethod
    def of_scene(cls, path: Path, **options: Any) -> NeedleEnv:
        """An environment with the organ, targets, obstacles and direction of approach of a scene.
        The scene is given by its name, such as "lumbar-puncture", or as a file, such as
        stylet-organ writes for a patient's label map. Needle, configuration and hand are not taken
        from the scene. `options` are arguments of NeedleEnv, and override the scene."""
        path = scene_file(path)
        given: dict[str, Any] = {"organ": scene_organ, "targets": read_targets,
                                 "obstacles": read_obstacles, "direction": scene_direction}
        return cls(**{**{name: of(path) for name, of in given.items() if name not in options},
                      **options})

    def reset(self, *, seed: int | None = None,
              options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        """Begins an episode. With a seed, this episode and those that follow are the same each
        time. Options: "target", the name of the target to reach; without it a target is drawn."""
        super().reset(seed=seed)
        self.target = self._drawn_target((options or {}).get("target"))
        tip_m = self._start(self.target)
        self._pose = np.asarray(
            _stylet.pose_of_tip(tip_m, self.direction, self.needle.length_m), float)
        self.simulation.reset()
        self._output = self.simulation.tick(self._pose).copy()
        self._steps, self._clipped = 0, False
        self._whole_way_m = self._distance_m = self._distance(self._output)
        return self._observation(), self._info()

    def step(self, action: ArrayLike) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """Moves the handle for `ticks_of_step` ticks."""
        return self._answer(self.simulation.run(self._poses(finite("action", action, (6,)))))

    def render(self) -> Array:
        """A picture of organ, needle and targets from the side: an array (height, width, 3)."""
        return picture(self.simulation, self.targets, self.direction)

    def __repr__(self) -> str:
        return (f"<stylet.{type(self).__name__} in {self.organ!r}, targets "
                f"{', '.join(target.name for target in self.targets)}>")

    # ---- halves of a step, between which the vector form runs all simulations at once

    def _poses(self, action: Array) -> Array:
        if self._pose is None:
            raise RuntimeError("step: no episode has begun: expected a call of reset first")
        self._clipped = bool((np.abs(action) > 1).any())
        action = np.clip(action, -1, 1)
        poses = moved(self._pose, self.speed_m_per_s * action[:3],
                      self.turning_rad_per_s * action[3:], self.period_s, self.ticks_of_step)
        self._pose = poses[-1]
        return poses

    def _answer(self, outputs: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        self._output = outputs[-1].copy()
        self._steps += 1
        before_m, self._distance_m = self._distance_m, self._distance(self._output)
        reward = (before_m - self._distance_m) / self._whole_way_m
        reached = min(map(self._distance, outputs)) <= self.target.radius_m
        failed = bool(np.bitwise_or.reduce(outputs["flags"]) & Flag.FAULT) or self._touches()
        reward += 1.0 * (reached and not failed) - 1.0 * failed
        terminated = bool(reached or failed)
        truncated = not terminated and self._steps >= self.most_steps
        return self._observation(), float(reward), terminated, truncated, self._info()

    # ---- what an episode is made of

    def _drawn_target(self, name: str | None) -> Target:
        if name is None:
            return self._goals[int(self.np_random.integers(len(self._goals)))]
        for target in self._goals:
            if target.name == name:
                return target
        raise ValueError(f"target {name!r}: expected one of {[t.name for t in self._goals]}")

    def _start(self, target: Target) -> Array:
        """Where the tip begins: before the surface that the line meets first from far outside."""
        info = self.organ.info
        size_m = float(np.linalg.norm(np.subtract(info.high_m, info.low_m)))
        through = np.asarray(target.at_m) + self._scattered()
        far = through - 2 * size_m * self.direction
        meets_m = self.organ.raycast(far, self.direction)
        meets_m = 2 * size_m if meets_m is None else meets_m
        return far + (meets_m - self.start_m) * self.direction

    def _scattered(self) -> Array:
        """A random offset, uniform on a disc across the line. It is drawn even without scatter, so
        that later draws are the same."""
        radius = self.scatter_m * math.sqrt(self.np_random.random())
        angle = 2 * math.pi * self.np_random.random()
        right = np.cross(self.direction, np.eye(3)[np.argmin(np.abs(self.direction))])
        right /= np.linalg.norm(right)
        up = np.cross(right, self.direction)
        return radius * (math.cos(angle) * right + math.sin(angle) * up)

    def _distance(self, output: Any) -> float:
        return float(np.linalg.norm(output["tip_m"] - np.asarray(self.target.at_m)))

    def _touches(self) -> bool:
        return any(distance_to_segment_m(zone.at_m, self._pose[:3], self._output["tip_m"])
                   <= zone.radius_m for zone in self.targets if zone.forbidden)

    def _observation(self) -> Array:
        out = self._output
        return np.concatenate([self.target.at_m - out["tip_m"], self._pose[3:], out["force_n"],
                               out["torque_nm"], [out["depth_m"], out["phase"]]]).astype(np.float32)

    def _info(self) -> dict[str, Any]:
        return {"target": self.target.name, "distance_m": self._distance_m,
                "force_n": float(np.linalg.norm(self._output["force_n"])),
                "flags": int(self._output["flags"]), "tick": int(self._output["tick"]),
                "clipped": self._clipped}


class VectorNeedleEnv(VectorEnv):
    """Environments of the same kind, whose simulations run at once. It is a
    gymnasium.vector.VectorEnv if Gymnasium is installed.

    An environment whose episode has ended ignores the next action and begins a new one, with
    reward 0, as Gymnasium's vector environments do ("NextStep")."""

    def __init__(self, environments: Iterable[NeedleEnv], threads: int = 0) -> None:
        self.envs = list(environments)
        self.num_envs = len(self.envs)
        if not self.envs:
            raise ValueError("environments: none: expected one at least")
        lengths = [env.ticks_of_step for env in self.envs]
        if len(set(lengths)) > 1:
            raise ValueError(f"environments: ticks_of_step {lengths}: expected the same of all")
        self._batch = VectorSimulation([env.simulation for env in self.envs], threads)
        self.metadata = {**NeedleEnv.metadata, "autoreset_mode": NEXT_STEP}
        self.render_mode = self.envs[0].render_mode
        self.single_action_space = self.envs[0].action_space
        self.single_observation_space = self.envs[0].observation_space
        self.action_space = stacked(self.single_action_space, self.num_envs)
        self.observation_space = stacked(self.single_observation_space, self.num_envs)
        self._ended = np.zeros(self.num_envs, bool)

    def reset(self, *, seed: int | Sequence[int | None] | None = None,
              options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Array]]:
        """Begins an episode in each environment. Environment i gets seed + i, or the i-th seed of a
        list."""
        if isinstance(seed, (int, np.integer)):
            super().reset(seed=int(seed))
            seed = [int(seed) + i for i in range(self.num_envs)]
        seeds = [None] * self.num_envs if seed is None else seed
        if len(seeds) != self.num_envs:
            raise ValueError(f"seed = {seed}: expected one number, or one for each of "
                             f"{self.num_envs} environments")
        self._ended[:] = False
        answers = [env.reset(seed=each, options=options) for env, each in zip(self.envs, seeds)]
        return np.stack([observation for observation, _ in answers]), columns(
            [info for _, info in answers])

    def step(self, actions: ArrayLike) -> tuple[Array, Array, Array, Array, dict[str, Array]]:
        # A new episode begins at tick 0, whatever ticks the batch makes of the old one before.
        actions = np.where(self._ended[:, None], 0, real("actions", actions, (self.num_envs, 6)))
        finite("actions", actions, actions.shape)  # all of them, before any environment moves
        poses = np.stack([env._poses(action) for env, action in zip(self.envs, actions)])
        outputs = self._batch.run(poses)
        answers = []
        for i, env in enumerate(self.envs):
            if self._ended[i]:
                observation, info = env.reset()
                answers.append((observation, 0.0, False, False, info))
            else:
                answers.append(env._answer(outputs[i]))
        observations, rewards, terminated, truncated, infos = zip(*answers)
        terminated, truncated = np.array(terminated), np.array(truncated)
        self._ended = terminated | truncated
        return np.stack(observations), np.array(rewards), terminated, truncated, columns(infos)

    def __repr__(self) -> str:
        return f"<stylet.{type(self).__name__} of {self.num_envs}: {self.envs[0]!r}>"

    def render(self) -> tuple[Array, ...]:
        return tuple(env.render() for env in self.envs)

    def close_extras(self, **options: Any) -> None:
        for env in self.envs:
            env.close()


def columns(infos: Sequence[dict[str, Any]]) -> dict[str, Array]:
    """For each name, an array of the values of all environments; and under `_name`, as Gymnasium
    does it, which environments have a value: all."""
    out = {name: np.array([info[name] for info in infos]) for name in infos[0]}
    return {**out, **{f"_{name}": np.ones(len(infos), bool) for name in out}}
