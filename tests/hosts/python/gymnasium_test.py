#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Environments and spaces have all that Gymnasium's tools ask for, and are its classes where it is
installed, with the same episodes.

Gymnasium is a stand-in that the test writes: the parts of gymnasium.Env, gymnasium.spaces.Box and
gymnasium.vector.VectorEnv that subclasses meet, by its published interface (version 1.0).
"""
import os
import subprocess
import sys
import unittest

import numpy as np
import stylet
from support import FAST, folder, organ, organ_file

STAND_IN = '''
import enum, sys, types
import numpy as np

def generator(seed=None):
    sequence = np.random.SeedSequence(seed)
    return np.random.Generator(np.random.PCG64(sequence)), sequence.entropy

class Drawn:
    _np_random = _np_random_seed = None
    @property
    def np_random(self):
        if self._np_random is None:
            self._np_random, self._np_random_seed = generator()
        return self._np_random
    @property
    def np_random_seed(self):
        return self._np_random_seed
    @property
    def unwrapped(self):
        return self

class Env(Drawn):
    metadata, render_mode, spec = {"render_modes": []}, None, None
    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self._np_random, self._np_random_seed = generator(seed)
    def get_wrapper_attr(self, name):
        return getattr(self, name)
    def close(self):
        pass
    def __enter__(self):
        return self
    def __exit__(self, *_):
        self.close()

class VectorEnv(Drawn):
    metadata, render_mode, spec, closed = {}, None, None, False
    reset = Env.reset
    def close(self, **options):
        if not self.closed:
            self.close_extras(**options)
            self.closed = True
    def close_extras(self, **options):
        pass
    def __del__(self):
        if not getattr(self, "closed", True):
            self.close()

class Box(Drawn):
    def __init__(self, low, high, shape=None, dtype=np.float32, seed=None):
        assert low.shape == high.shape == shape
        self.low, self.high, self.dtype = low.astype(dtype), high.astype(dtype), np.dtype(dtype)
        self._shape = shape
        if seed is not None:
            self.seed(seed)
    @property
    def shape(self):
        return self._shape
    def seed(self, seed=None):
        self._np_random, self._np_random_seed = generator(seed)
        return self._np_random_seed
    def sample(self, mask=None):
        raise AssertionError("draws otherwise than without Gymnasium")

class AutoresetMode(enum.Enum):
    NEXT_STEP = "NextStep"

for name, classes in (("spaces", [Box]), ("vector", [VectorEnv, AutoresetMode])):
    module = types.ModuleType(f"gymnasium.{name}")
    module.__dict__.update({each.__name__: each for each in classes})
    sys.modules[module.__name__] = globals()[name] = module
'''
DRIVER = """
import hashlib, numpy as np, os, sys
import stylet
organ = stylet.Organ.read(sys.argv[1])
goals = [stylet.Target("goal", (0.03, 0, 0.005), 0.0035), stylet.Target("low", (0.03, 0, 0), 0.003)]
def made():
    return stylet.NeedleEnv(organ, goals, config=stylet.Config(inertia=0, substeps=1),
                            scatter_m=0.003, most_steps=6)
env, vector = made(), stylet.VectorNeedleEnv([made(), made()], threads=1)
if len(sys.argv) > 2:
    import gymnasium
    assert isinstance(env, gymnasium.Env) and isinstance(vector, gymnasium.vector.VectorEnv)
    assert isinstance(env.action_space, gymnasium.spaces.Box)
    assert isinstance(vector.observation_space, gymnasium.spaces.Box)
    assert vector.metadata["autoreset_mode"] is gymnasium.vector.AutoresetMode.NEXT_STEP
sum = hashlib.sha256()
for each in (env, vector):
    each.action_space.seed(3)
    sum.update(np.asarray(each.reset(seed=5)[0]).tobytes())
    assert each.np_random_seed == 5
    for _ in range(10):
        observation = each.step(each.action_space.sample())[0]
        assert observation in each.observation_space
        sum.update(np.asarray(observation).tobytes())
    each.close()
print(sum.hexdigest())
"""


def environment(**options):
    return stylet.NeedleEnv(organ(), [stylet.Target("goal", (0.03, 0, 0.005), 0.0035)],
                            config=stylet.Config(**FAST), **options)


class WhatToolsAskFor(unittest.TestCase):
    def test_of_one(self):
        with environment(render_mode="rgb_array") as env:
            self.assertIsNone(env.spec)
            self.assertIs(env.unwrapped, env)
            self.assertEqual(env.get_wrapper_attr("most_steps"), env.most_steps)
            self.assertTrue(env.has_wrapper_attr("most_steps"))
            env.set_wrapper_attr("most_steps", 3)
            self.assertEqual(env.most_steps, 3)
            env.reset(seed=8)
            self.assertEqual(env.np_random_seed, 8)
            same = np.random.default_rng(8)
            env.np_random = np.random.default_rng(9)
            self.assertEqual(env.np_random_seed, -1)
            self.assertNotEqual(env.np_random.random(), same.random())

    def test_of_a_vector(self):
        vector = stylet.VectorNeedleEnv([environment(render_mode="rgb_array") for _ in range(2)])
        self.assertIsNone(vector.spec)
        self.assertIs(vector.unwrapped, vector)
        self.assertEqual(vector.render_mode, "rgb_array")
        _, infos = vector.reset(seed=8)
        self.assertEqual(vector.np_random_seed, 8)
        self.assertIsInstance(vector.np_random, np.random.Generator)
        for name in ("target", "distance_m"):
            np.testing.assert_array_equal(infos[f"_{name}"], [True, True])
        with self.assertRaisesRegex(ValueError, r"seed = \[1\]: expected .* each of 2"):
            vector.reset(seed=[1])
        self.assertFalse(vector.closed)
        vector.close()
        self.assertTrue(vector.closed)


class Installed(unittest.TestCase):
    def test_classes_are_gymnasiums_and_episodes_the_same(self):
        place = folder() / "with"
        (place / "gymnasium").mkdir(parents=True)
        (place / "gymnasium/__init__.py").write_text(STAND_IN)
        (folder() / "driver.py").write_text(DRIVER)
        (folder() / "hidden").mkdir()  # a Gymnasium that cannot be imported, wherever there is one
        (folder() / "hidden/gymnasium.py").write_text("raise ImportError('hidden by the test')\n")

        def sum_of(first, *words):
            path = f"{first}:{os.environ['PYTHONPATH']}"
            done = subprocess.run([sys.executable, folder() / "driver.py", organ_file(), *words],
                                  text=True, capture_output=True,
                                  env={**os.environ, "PYTHONPATH": path})
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout
        self.assertEqual(sum_of(place, "with"), sum_of(folder() / "hidden"))


if __name__ == "__main__":
    unittest.main()
