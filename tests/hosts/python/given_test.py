#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What users give: numbers of any size and byte order are accepted; None, imaginary parts, texts
and wrong shapes are refused with the name of the argument, and nothing moves.

Expected values: the same numbers as 32-bit floats; the state's hash before.
"""
import math
import unittest

import numpy as np
import stylet
from support import DOWN, FAST, insertion, organ, simulation

POSE = [0.3, 0.2, 0.25, 1, 0, 0, 0]
GOAL = stylet.Target("goal", (0.03, 0, 0.005), 0.0035)


def environment():
    return stylet.NeedleEnv(organ(), [GOAL], config=stylet.Config(**FAST), ticks_of_step=20)


class Taken(unittest.TestCase):
    def test_numbers_of_every_size_and_order(self):
        poses = insertion(300)
        expected = simulation().run(poses).tobytes()
        for given in (poses.astype(float), poses.astype(np.longdouble), poses.astype(">f4"),
                      poses.tolist(), list(poses), np.asfortranarray(poses),
                      np.repeat(poses, 2, axis=0)[::2]):
            self.assertEqual(simulation().run(given).tobytes(), expected)
            self.assertEqual(simulation().run(stylet.inputs(given)).tobytes(), expected)

    def test_whole_numbers(self):
        whole = [[0, 0, 1, 1, 0, 0, 0], [0, 0, 2, 1, 0, 0, 0]]
        expected = simulation().run(np.float32(whole)).tobytes()
        for given in (whole, np.int8(whole), np.uint64(whole)):
            self.assertEqual(simulation().run(given).tobytes(), expected)
        self.assertEqual(stylet.Needle(length_m=1).length_m, 1.0)
        self.assertEqual(simulation().tick([0, 0, 1, 1, 0, 0, 0]).tick, 1)

    def test_truth_values(self):
        poses, valid = insertion(50), [1, 0] * 25
        expected = simulation().run(poses, np.array(valid, bool)).tobytes()
        self.assertEqual(simulation().run(poses, valid).tobytes(), expected)


class Refused(unittest.TestCase):
    def refused(self, kind, words, call, *arguments, **named):
        with self.assertRaisesRegex(kind, words):
            call(*arguments, **named)

    def test_poses(self):
        run, good = simulation(), insertion(3)
        before = run.hash()
        for kind, words, poses in (
                (TypeError, r"poses\[1\] is None: .*valid", [POSE, None, POSE]),
                (TypeError, r"poses\[0\] is None", [None] * 7),
                (TypeError, r"poses of object", [[None] * 7]),
                (TypeError, r"poses of object", good.astype(object)),
                (TypeError, r"poses of complex128", good.astype(complex)),
                (TypeError, r"poses of complex64", np.complex64(good)),
                (TypeError, r"poses of <U3", "abc"),
                (TypeError, r"poses of bool", good > 0),
                (TypeError, r"poses of datetime64", np.zeros((3, 7), "datetime64[s]")),
                (ValueError, r"poses: rows of different lengths", [POSE, POSE[:6]]),
                (ValueError, r"poses of shape \(3, 6\)", good[:, :6])):
            self.refused(kind, words, run.run, poses)
            self.refused(kind, words, stylet.inputs, poses)
        self.refused(TypeError, "poses is None: .*valid", run.run, None)
        self.refused(TypeError, "poses of complex128", run.tick, np.array(POSE) + 0j)
        self.refused(TypeError, r"poses\[6\] is None", run.tick, POSE[:6] + [None])
        self.refused(TypeError, "valid of float64", run.run, good, np.ones(3))
        self.refused(TypeError, "poses of complex128", stylet.VectorSimulation([run]).run,
                     good[None].astype(complex))
        # The size says where the next struct lies: with a wrong one memory outside the array would
        # be read.
        for wrong in (0, 35, 37, 72, 2 ** 20, 2 ** 32 - 1):
            rows = np.zeros(3, stylet.input_dtype)
            rows["struct_bytes"][0] = wrong
            self.refused(ValueError, f"struct_bytes {wrong}: expected 40", run.run, rows)
        self.assertEqual(run.hash(), before)

    def test_vectors_by_their_names(self):
        guard = stylet.Guard()
        for name, call, *arguments in (
                ("origin_m", organ().raycast, None, DOWN),
                ("direction", organ().raycast, (0, 0, 0), None),
                ("tip_m", stylet.pose_of_tip, None, DOWN, 0.15),
                ("direction", stylet.pose_of_tip, (0, 0, 0), None, 0.15),
                ("tips_m", stylet.poses_of_tips, None, DOWN, 0.15),
                ("direction", stylet.poses_of_tips, [[0, 0, 0]], None, 0.15),
                ("force_n", guard.force, None), ("torque_nm", guard.torque, None),
                ("half_m", stylet.Obstacle.box, None),
                ("vertices_m", stylet.Obstacle.hull, None),
                ("direction", lambda way: stylet.NeedleEnv(organ(), [GOAL], direction=way), None),
                ("breathing_amplitude_m", lambda way: stylet.Config(breathing_amplitude_m=way),
                 None),
                ("gravity_m_per_s2", lambda way: stylet.Config(gravity_m_per_s2=way), None)):
            for wrong, kind, words in (((0, 1), ValueError, r"of shape \(2,\)"),
                                       (1.0, ValueError, r"of shape \(\)"),
                                       ((0, 1, None), TypeError, r"\[2\] is None"),
                                       ((0, 1, 1j), TypeError, "of complex128"),
                                       ("xyz", TypeError, "of <U3")):
                given = [wrong if each is None else each for each in arguments]
                self.refused(kind, name + ".*" + words if kind is ValueError else
                             f"{name} ?{words}", call, *given)
        self.refused(ValueError, r"pose of shape \(6,\)", guard.sample, POSE[:6], 10 ** 9)
        self.refused(ValueError, r"vertices_m of shape \(65, 3\): .*64", stylet.Obstacle.hull,
                     np.zeros((65, 3)))
        for wrong in (math.nan, math.inf):
            self.refused(ValueError, "direction: .*finite", stylet.pose_of_tip, (0, 0, 0),
                         (0, wrong, 1), 0.15)
        self.refused(TypeError, "radius_m is None", stylet.Obstacle.sphere, None)
        self.refused(TypeError, "radius_m of <U1", stylet.Obstacle.sphere, "1")
        self.refused(ValueError, "direction = .*length above 0", stylet.NeedleEnv, organ(), [GOAL],
                     direction=(0, 0, 0))

    def test_numbers_of_structs(self):
        for value, kind, words in ((None, TypeError, "length_m is None"),
                                   (1j, TypeError, "length_m of complex128"),
                                   ("long", TypeError, "length_m of <U4"),
                                   ([0.1, 0.2], ValueError, r"length_m of shape \(2,\): .*one")):
            self.refused(kind, words, stylet.Needle, length_m=value)


class Environments(unittest.TestCase):
    """Numbers with which rewards would be nan, or episodes empty."""

    def test_numbers_are_refused_by_name(self):
        at, radius_m = GOAL.at_m, GOAL.radius_m
        for words, targets, options in (
                ("start_m = nan", [GOAL], {"start_m": math.nan}),
                ("start_m = 0.0: .*more than 0", [GOAL], {"start_m": 0}),
                ("scatter_m = inf", [GOAL], {"scatter_m": math.inf}),
                ("speed_m_per_s = nan", [GOAL], {"speed_m_per_s": math.nan}),
                ("turning_rad_per_s = nan", [GOAL], {"turning_rad_per_s": math.nan}),
                ("ticks_of_step = 0: .*1 or more", [GOAL], {"ticks_of_step": 0}),
                ("ticks_of_step = 1.5: .*whole", [GOAL], {"ticks_of_step": 1.5}),
                ("most_steps = -1", [GOAL], {"most_steps": -1}),
                ("render_mode = 'human'", [GOAL], {"render_mode": "human"}),
                ("needle of list", [GOAL], {"needle": [stylet.Needle()] * 2}),
                ("target 'a': at_m", [stylet.Target("a", (math.nan, 0, 0), radius_m)], {}),
                ("target 'a': radius_m = -1", [stylet.Target("a", at, -1)], {}),
                ("targets: all are forbidden, or there are none",
                 [stylet.Target("a", at, radius_m, forbidden=True)], {}),
                ("targets: all are forbidden, or there are none", [], {})):
            with self.assertRaisesRegex((ValueError, TypeError), words):
                stylet.NeedleEnv(organ(), targets, **options)


class Actions(unittest.TestCase):
    """Gymnasium's bounded Box contains no nan and no infinity; values beyond its bounds are
    clipped, as in Gymnasium's own environments (Pendulum)."""

    WRONG = [([np.nan, 0, 0, 0, 0, 0], ValueError, "action.*finite"),
             ([0, 0, np.inf, 0, 0, 0], ValueError, "action.*finite"),
             ([0, 0, 0, 0, 0, -np.inf], ValueError, "action.*finite"),
             ([0, 0, 0], ValueError, r"action of shape \(3,\): expected 6"),
             ([1j] * 6, TypeError, "action of complex128"),
             (None, TypeError, "action is None"),
             ([0, 0, 0, 0, 0, None], TypeError, r"action\[5\] is None")]

    def test_wrong_actions_move_nothing(self):
        env = environment()
        env.reset(seed=1)
        env.step([0, 0, -1, 0, 0, 0])
        before = env.simulation.hash()
        for action, kind, words in self.WRONG:
            with self.assertRaisesRegex(kind, words):
                env.step(action)
        self.assertEqual(env.simulation.hash(), before)
        other = environment()
        other.reset(seed=1)
        for _ in range(2):
            expected = other.step([0, 0, -1, 0, 0, 0])
        np.testing.assert_array_equal(env.step([0, 0, -1, 0, 0, 0])[0], expected[0])

    def test_actions_beyond_the_bounds_are_clipped_and_reported(self):
        one, other = environment(), environment()
        one.reset(seed=1)
        self.assertFalse(other.reset(seed=1)[1]["clipped"])
        clipped, within = one.step([0, 7, -1e30, 0, 0, 0]), other.step([0, 1, -1, 0, 0, 0])
        np.testing.assert_array_equal(clipped[0], within[0])
        self.assertEqual((clipped[4]["clipped"], within[4]["clipped"]), (True, False))

    def test_all_actions_of_a_vector_are_checked_before_any_is_done(self):
        vector = stylet.VectorNeedleEnv([environment() for _ in range(3)], threads=1)
        vector.reset(seed=3)
        before = [env.simulation.hash() for env in vector.envs]
        poses = [env._pose.copy() for env in vector.envs]
        good = [0, 0, -1, 0, 0, 0]
        for action, kind, _ in self.WRONG:
            with self.assertRaises(kind):
                vector.step([good, action, good])
        self.assertEqual([env.simulation.hash() for env in vector.envs], before)
        np.testing.assert_array_equal([env._pose for env in vector.envs], poses)
        _, _, _, _, infos = vector.step([good, [0, 0, -2, 0, 0, 0], good])
        np.testing.assert_array_equal(infos["clipped"], [False, True, False])


if __name__ == "__main__":
    unittest.main()
