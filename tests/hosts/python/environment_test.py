#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Environments have Gymnasium's interface, are the same with the same seed, give the rewards that
they document, and many at once do what each does alone.

Expected values: closed forms of the reward; Gymnasium's published interface (Env.reset, Env.step,
spaces.Box; gymnasium.farama.org/api/env).
"""
import inspect
import math
import unittest

import numpy as np
import stylet
from stylet.motion import moved
from stylet.targets import distance_to_segment_m
from support import FAST, SOURCE, organ

IN, OUT = [0, 0, -1, 0, 0, 0], [0, 0, 1, 0, 0, 0]
# A target 15 mm below the middle of the block's top.
GOAL = stylet.Target("goal", (0.03, 0, 0.005), 0.0035)


def environment(targets=(GOAL,), **options):
    settings = {"config": stylet.Config(**FAST), "ticks_of_step": 50, **options}
    return stylet.NeedleEnv(organ(), list(targets), **settings)


def episode(env, action, seed=0):
    """Rewards until the episode ends, and how it ended."""
    env.reset(seed=seed)
    rewards = []
    for _ in range(env.most_steps):
        _, reward, terminated, truncated, info = env.step(action)
        rewards.append(reward)
        if terminated or truncated:
            break
    return rewards, terminated, truncated, info


class Interface(unittest.TestCase):
    def test_signatures(self):
        reset = inspect.signature(stylet.NeedleEnv.reset).parameters
        self.assertEqual([(p.name, p.kind, p.default) for p in reset.values()][1:],
                         [("seed", inspect.Parameter.KEYWORD_ONLY, None),
                          ("options", inspect.Parameter.KEYWORD_ONLY, None)])
        self.assertEqual(list(inspect.signature(stylet.NeedleEnv.step).parameters),
                         ["self", "action"])
        env = environment()
        observation, info = env.reset(seed=1)
        self.assertIn(observation, env.observation_space)
        self.assertIsInstance(info, dict)
        answer = env.step(env.action_space.sample())
        self.assertEqual([type(each) for each in answer[1:]], [float, bool, bool, dict])
        self.assertIn(answer[0], env.observation_space)
        for name in ("metadata", "render_mode", "np_random", "close", "render"):
            self.assertTrue(hasattr(env, name), name)

    def test_first_step_needs_a_reset(self):
        with self.assertRaises(RuntimeError):
            environment().step(IN)

    def test_box(self):
        box = stylet.Box(np.float32([-1, 0, -np.inf, -np.inf]), np.float32([1, np.inf, 2, np.inf]))
        box.seed(3)
        drawn = [box.sample() for _ in range(200)]
        self.assertTrue(all(each in box for each in drawn))
        np.testing.assert_array_equal(box.sample(seed=3), drawn[0])
        self.assertLess(np.min(drawn, axis=0)[0], -0.9)
        self.assertNotIn(np.float32([2, 0, 0, 0]), box)
        self.assertNotIn(np.float32([0, 0, 0]), box)
        self.assertNotIn(np.float64([0, 0, 0, 0]), box)
        with self.assertRaises(ValueError):
            stylet.Box(1, 0, (2,))

    def test_render(self):
        env = environment()
        env.reset(seed=0)
        before = env.render()
        self.assertEqual((before.dtype, before.shape), (np.uint8, (480, 480, 3)))
        for _ in range(5):
            env.step(IN)
        self.assertTrue((env.render() != before).any())


class Reward(unittest.TestCase):
    def test_straight_in_gives_one_and_the_fraction_of_the_way(self):
        """The tip of a rigid needle moves 1 mm a step, starting 10 mm above the block."""
        env = environment(speed_m_per_s=0.02)
        observation, info = env.reset(seed=0)
        whole_m = info["distance_m"]
        np.testing.assert_allclose(observation[:3], [0, 0, -whole_m], atol=1e-6)
        self.assertAlmostEqual(whole_m, 0.01 + 0.015, places=5)
        rewards, terminated, truncated, info = episode(env, IN)
        self.assertTrue(terminated and not truncated)
        self.assertEqual(len(rewards), 22)
        np.testing.assert_allclose(rewards[:-1], 0.001 / whole_m, atol=1e-4)
        self.assertAlmostEqual(sum(rewards), 1 + (whole_m - info["distance_m"]) / whole_m, places=6)

    def test_away_is_negative_and_ends_by_steps(self):
        rewards, terminated, truncated, _ = episode(environment(most_steps=7), OUT)
        self.assertTrue(truncated and not terminated)
        self.assertEqual(len(rewards), 7)
        self.assertLess(max(rewards), 0)

    def test_forbidden_zone_on_the_way(self):
        zone = stylet.Target("zone", (0.031, 0, 0.015), 0.002, True)
        rewards, terminated, _, info = episode(environment((zone, GOAL)), IN)
        self.assertTrue(terminated)
        self.assertLess(rewards[-1], -0.9)
        self.assertGreater(info["distance_m"], GOAL.radius_m)

    def test_the_shaft_may_touch_a_zone_too(self):
        """The tip misses the zone by 5 mm on its way in, but the shaft passes through it."""
        self.assertAlmostEqual(distance_to_segment_m((0.005, 0, 0.5), (0, 0, 1), (0, 0, 0)), 0.005)
        self.assertAlmostEqual(distance_to_segment_m((0, 3, 4), (0, 0, 0), (0, 0, 0)), 5)
        self.assertAlmostEqual(distance_to_segment_m((0, 0, -2), (0, 0, 1), (0, 0, 0)), 2)

    def test_targets_of_a_scene(self):
        targets = stylet.read_targets(SOURCE / "hal/scenes/lumbar-puncture.toml")
        self.assertEqual([(t.name, t.forbidden) for t in targets],
                         [("epidural space", False), ("dura", True)])
        np.testing.assert_allclose(targets[0].at_m, (0.052, 0, 0))
        self.assertEqual(targets[0].radius_m, 0.004)
        with self.assertRaises(ValueError):
            environment((targets[1],))


class Seeds(unittest.TestCase):
    def test_same_seed_same_episodes(self):
        other = stylet.Target("other", (0.02, 0.01, 0), 0.003)

        def seen(seed):
            env = environment((GOAL, other), scatter_m=0.004)
            env.action_space.seed(5)
            out = []
            for first in (seed, None, None):
                out.append(env.reset(seed=first)[0])
                out += [env.step(env.action_space.sample())[0] for _ in range(3)]
            return np.stack(out)
        np.testing.assert_array_equal(seen(7), seen(7))
        self.assertTrue((seen(7) != seen(8)).any())

    def test_target_by_name(self):
        other = stylet.Target("other", (0.02, 0.01, 0), 0.003)
        env = environment((GOAL, other))
        for name in ("other", "goal"):
            self.assertEqual(env.reset(options={"target": name})[1]["target"], name)
        with self.assertRaises(ValueError):
            env.reset(options={"target": "third"})

    def test_scatter_is_within_its_disc(self):
        env = environment(scatter_m=0.004)
        asides = []
        for seed in range(50):
            observation, _ = env.reset(seed=seed)
            asides.append(math.hypot(observation[0], observation[1]))
        self.assertLessEqual(max(asides), 0.004 + 1e-6)
        self.assertGreater(max(asides), 0.003)


class Motion(unittest.TestCase):
    def test_straight_and_in_place(self):
        start = np.array([0.1, 0.2, 0.3, 1, 0, 0, 0])
        poses = moved(start, (0, 0, -0.02), (0, 0, 0), 1e-3, 50)
        np.testing.assert_allclose(poses[-1], [0.1, 0.2, 0.299, 1, 0, 0, 0])
        rolled = moved(start, (0, 0, 0), (0, 0, math.pi), 1e-3, 1000)[-1]
        np.testing.assert_allclose(rolled, [0.1, 0.2, 0.3, 0, 0, 0, 1], atol=1e-12)

    def test_forward_while_turning_is_a_circle(self):
        """1 m/s and pi/2 rad/s for a second: a quarter of a circle of radius 2/pi."""
        start = np.array([0, 0, 0, 1.0, 0, 0, 0])
        poses = moved(start, (1, 0, 0), (0, 0, math.pi / 2), 1e-4, 10000)
        np.testing.assert_allclose(poses[-1, :3], [2 / math.pi, 2 / math.pi, 0], atol=1e-4)


class Vector(unittest.TestCase):
    def test_many_at_once_do_what_each_does_alone(self):
        def make():
            return [environment(scatter_m=0.003, most_steps=4) for _ in range(3)]
        vector, alone = stylet.VectorNeedleEnv(make(), threads=2), make()
        observations, infos = vector.reset(seed=11)
        expected = [env.reset(seed=11 + i) for i, env in enumerate(alone)]
        self.assertIn(observations, vector.observation_space)
        vector.action_space.seed(2)
        ended, begun = [False] * 3, 0
        for _ in range(12):
            for i in range(3):
                np.testing.assert_array_equal(observations[i], expected[i][0])
                self.assertEqual(infos["distance_m"][i], expected[i][-1]["distance_m"])
            actions = vector.action_space.sample()
            observations, rewards, terminated, truncated, infos = vector.step(actions)
            expected = []
            for i, env in enumerate(alone):
                if ended[i]:
                    begun += 1
                    first, info = env.reset()
                    expected.append((first, 0.0, False, False, info))
                else:
                    expected.append(env.step(actions[i]))
                self.assertEqual((rewards[i], terminated[i], truncated[i]), expected[i][1:4])
                ended[i] = expected[i][2] or expected[i][3]
        self.assertGreater(begun, 0)


if __name__ == "__main__":
    unittest.main()
