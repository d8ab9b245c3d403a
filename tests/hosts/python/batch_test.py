#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Many simulations at once give, bit for bit, what each gives alone, with any number of threads."""
import gc
import os
import signal
import unittest

import numpy as np
import stylet
from support import insertion, simulation


def offsets(count):
    return [(0.002 * i - 0.005, 0.001 * i) for i in range(count)]


class Batch(unittest.TestCase):
    def test_same_bits_as_each_alone(self):
        poses = np.stack([insertion(600, at) for at in offsets(5)])
        alone = [simulation() for _ in range(5)]
        expected = [run.run(each) for run, each in zip(alone, poses)]
        for threads in (1, 2, 0):
            vector = stylet.VectorSimulation([simulation() for _ in range(5)], threads)
            outputs = np.empty((5, 600), stylet.output_dtype)
            self.assertIs(vector.run(poses[:, :200], out=(first := outputs[:, :200].copy())), first)
            rest = vector.run(stylet.inputs(poses[:, 200:]))
            for i in range(5):
                self.assertEqual(first[i].tobytes() + rest[i].tobytes(), expected[i].tobytes())
                self.assertEqual(vector.simulations[i].hash(), alone[i].hash())

    def test_two_needles(self):
        needles = [stylet.Needle(), stylet.Needle()]
        poses = np.stack([np.stack([insertion(300, (-0.01, y)), insertion(300, (0.01, y))], axis=1)
                          for y in (-0.01, 0.01)])
        vector = stylet.VectorSimulation([simulation(needles), simulation(needles)], 2)
        outputs = vector.run(poses)
        self.assertEqual(outputs.shape, (2, 300, 2))
        for i in range(2):
            self.assertEqual(outputs[i].tobytes(), simulation(needles).run(poses[i]).tobytes())

    def test_refusals(self):
        one = simulation()
        with self.assertRaises(stylet.StyletError) as caught:
            stylet.VectorSimulation([one, one])
        self.assertEqual(caught.exception.status, stylet.Status.ARGUMENT_OUT_OF_RANGE)
        with self.assertRaises(ValueError):
            stylet.VectorSimulation([one, simulation([stylet.Needle(), stylet.Needle()])])
        with self.assertRaises(ValueError):
            stylet.VectorSimulation([one]).run(np.zeros((2, 5, 7)))

    def test_forked_processes_go_on(self):
        """Workers of multiprocessing and of data loaders are forked processes, which do not have
        the threads."""
        poses = np.stack([insertion(200, at) for at in offsets(4)])
        vector = stylet.VectorSimulation([simulation() for _ in range(4)], 2)
        vector.run(poses[:, :100])
        child = os.fork()
        if child == 0:
            signal.alarm(60)  # ends a process that would wait for ever
            outputs = vector.run(poses[:, 100:])
            same = [each.hash() for each in vector.simulations]
            del vector
            gc.collect()
            expected = [simulation() for _ in range(4)]
            for each, its in zip(expected, poses):
                each.run(its)
            os._exit(0 if same == [each.hash() for each in expected] and len(outputs) == 4 else 1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)
        vector.run(poses[:, 100:])  # as if there had been no fork

    def test_simulations_stay_alive_in_the_batch(self):
        vector = stylet.VectorSimulation([simulation() for _ in range(3)])
        batch = vector._batch
        del vector
        self.assertEqual(batch.run(np.stack([insertion(5)] * 3)).shape, (3, 5))


if __name__ == "__main__":
    unittest.main()
