#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Objects of the package in the states that Python allows: without `__init__`, after a failed one,
closed, copied, pickled, used by two threads, with their lists changed. Each works or raises.

The classes are found by introspection, so that later ones are tested too.
"""
import copy
import gc
import importlib
import inspect
import pickle
import pkgutil
import threading
import unittest

import numpy as np
import stylet
from stylet import _stylet
from support import insertion, organ, organ_file, simulation

try:
    import stylet_organ
except ImportError:  # stylet_organ is not built everywhere
    stylet_organ = None
NOT_MADE = "__init__ of this object was not called, or raised"


def modules():
    for package in filter(None, (stylet, stylet_organ)):
        yield package
        for each in pkgutil.iter_modules(package.__path__, f"{package.__name__}."):
            yield importlib.import_module(each.name)


def classes():
    """All classes that the packages define."""
    found = {each for module in modules() for each in vars(module).values()
             if isinstance(each, type) and each.__module__.split(".")[0] in ("stylet",
                                                                           "stylet_organ")}
    return sorted(found, key=lambda each: (each.__module__, each.__name__))


def is_native(kind):
    """Whether objects of C++ are behind it."""
    return type(kind).__name__ == "pybind11_type"


def arguments_of(function):
    """As many None as the function needs besides its object; pybind11 gives the number in its
    docstring."""
    try:
        needed = [each for each in inspect.signature(function).parameters.values()
                  if each.default is each.empty
                  and each.kind in (each.POSITIONAL_ONLY, each.POSITIONAL_OR_KEYWORD)]
        return [None] * len(needed)
    except ValueError:
        first = function.__doc__.splitlines()[0]
        told = first[first.index("(") + 1:first.rindex(") -> ")].split(", ")
        return [None] * len([each for each in told[1:] if ": " in each and " = " not in each])


def members(kind):
    """Names of methods and properties of objects, without those of the class itself."""
    for name in sorted({name for each in kind.__mro__[:-1] for name in vars(each)}):
        plain = inspect.getattr_static(kind, name)
        if not name.startswith("__") and not isinstance(plain, (staticmethod, classmethod)):
            yield name, plain


def use(thing, name):
    value = getattr(thing, name)
    return value(*arguments_of(value)) if callable(value) else value


class WithoutInit(unittest.TestCase):
    def test_natives_are_all_found(self):
        found = {each.__name__ for each in classes() if is_native(each)}
        self.assertEqual(found, {"Organ", "Simulation", "Batch", "Guard", "Device", "Loop"})

    def test_each_member_raises(self):
        """A member of a native class always raises and says why; one of Python's own may need no
        state."""
        used = 0
        for kind in classes():
            try:
                thing = kind.__new__(kind)
            except TypeError:  # an enumeration needs its value
                continue
            for name, plain in members(kind):
                with self.subTest(f"{kind.__module__}.{kind.__name__}.{name}"):
                    if is_native(kind) and not inspect.isfunction(plain):
                        used += 1
                        self.assertRaisesRegex(TypeError, NOT_MADE, use, thing, name)
                        continue
                    try:
                        use(thing, name)
                    except Exception as raised:
                        self.assertNotIsInstance(raised, (SystemError, MemoryError))
        self.assertGreater(used, 60)

    def test_as_an_argument(self):
        def unmade(kind):
            return kind.__new__(kind)
        device = stylet.Device.simulated(0.01, 0.01)
        for call in (lambda: stylet.Simulation(unmade(stylet.Organ)),
                     lambda: stylet.VectorSimulation([simulation(), unmade(stylet.Simulation)]),
                     lambda: simulation().difference(unmade(stylet.Simulation)),
                     lambda: unmade(stylet.Simulation).clone(),
                     lambda: copy.copy(unmade(stylet.Simulation)),
                     lambda: stylet.Loop(unmade(stylet.Simulation), device, stylet.Hand()),
                     lambda: stylet.Loop(simulation(), unmade(stylet.Device), stylet.Hand())):
            self.assertRaisesRegex(TypeError, NOT_MADE, call)

    def test_after_an_init_that_raised(self):
        run = stylet.Simulation.__new__(stylet.Simulation)
        with self.assertRaises(stylet.StyletError):
            run.__init__(organ(), stylet.Needle(length_m=-1))
        self.assertRaisesRegex(TypeError, NOT_MADE, run.hash)
        run.__init__(organ(), config=stylet.Config(inertia="added_mass", substeps=1))
        self.assertEqual(run.hash(), simulation().hash())

    def test_init_twice(self):
        """Otherwise a guard would keep its old limits without a word."""
        guard, run = stylet.Guard(stylet.GuardConfig(max_force_n=2)), simulation()
        loop = stylet.Loop(simulation(), stylet.Device.simulated(0.01, 0.01), stylet.Hand())
        for call in (lambda: guard.__init__(stylet.GuardConfig(max_force_n=3)),
                     lambda: run.__init__(organ()),
                     lambda: loop.__init__(simulation(), stylet.Device.simulated(0.01, 0.01),
                                           stylet.Hand())):
            self.assertRaisesRegex(TypeError, "called before", call)
        self.assertRaises(TypeError, _stylet.refuse_second_init, 7)

    def test_a_derived_class_that_does_not_call_init(self):
        def forgets(self, *_):
            pass

        def too_late(self, *_):
            self.report()
        for kind in (stylet.Simulation, stylet.Guard, stylet.Loop, stylet.Device, stylet.Organ):
            own = type("Own", (kind,), {"__init__": forgets})
            self.assertRaisesRegex(TypeError, "__init__", own, organ())
        late = type("Late", (stylet.Guard,), {"__init__": too_late})
        self.assertRaisesRegex(TypeError, NOT_MADE, late)


class Closed(unittest.TestCase):
    def test_each_member_of_a_loop_raises(self):
        loop = stylet.Loop(simulation(), stylet.Device.simulated(0.01, 0.01), stylet.Hand(),
                           stylet.LoopConfig(virtual_time=1, ticks=5, priority=0))
        loop.run()
        loop.close()
        loop.close()
        for name, plain in members(stylet.Loop):
            if name in ("close", "pause", "acknowledge", "_acknowledge"):
                continue
            with self.subTest(name):
                self.assertRaisesRegex(RuntimeError, "closed", use, loop, name)
        self.assertRaisesRegex(RuntimeError, "closed", loop.pause, True)
        self.assertRaisesRegex(RuntimeError, "closed", loop.acknowledge)

    def test_device(self):
        device = stylet.Device.simulated(0.01, 0.01)
        device.close()
        device.close()
        self.assertRaisesRegex(RuntimeError, "closed", stylet.Loop, simulation(), device,
                               stylet.Hand())

    def test_a_device_cannot_be_copied(self):
        device = stylet.Device.simulated(0.01, 0.01)
        two = simulation([stylet.Needle(), stylet.Needle()])
        with self.assertRaises(stylet.StyletError):
            stylet.Loop(two, [device, device], 2 * [stylet.Hand()])
        stylet.Loop(simulation(), device, stylet.Hand()).close()  # the device still works


class Copied(unittest.TestCase):
    def test_a_simulation_is_a_clone(self):
        poses, first = insertion(200), simulation()
        first.run(poses[:100])
        copies = [copy.copy(first), copy.deepcopy(first)]
        end = first.run(poses[100:]).tobytes()
        for each in copies:
            self.assertEqual(each.run(poses[100:]).tobytes(), end)
            self.assertIs(each.organ, first.organ)

    def test_attributes_of_a_derived_class_are_copied(self):
        class Own(stylet.Simulation):
            def __init__(self, *arguments):
                super().__init__(*arguments)
                self.seen = []
        first = Own(organ())
        first.seen.append(1)
        self.assertIs(first.clone().seen, first.seen)
        deep = copy.deepcopy([first, first])
        self.assertIs(deep[0], deep[1])
        self.assertIsInstance(deep[0], Own)
        first.seen.append(2)
        self.assertEqual(deep[0].seen, [1])

    def test_an_organ_is_itself(self):
        self.assertIs(copy.copy(organ()), organ())
        self.assertIs(copy.deepcopy(organ()), organ())

    def test_an_environment_goes_on_from_here(self):
        """As planners do, to try what an action leads to."""
        env = stylet.NeedleEnv(organ(), [stylet.Target("middle", (0.03, 0, 0.02), 0.002)])
        first = stylet.VectorNeedleEnv([env])
        first.reset(seed=5)
        act = np.array([[0, 0, -1, 0, 0, 0]], np.float32)
        first.step(act)
        second = copy.deepcopy(first)
        expected = [first.step(act)[0].tobytes() for _ in range(3)]
        self.assertEqual([second.step(act)[0].tobytes() for _ in range(3)], expected)
        self.assertIsNone(second.envs[0].simulation.difference(env.simulation))

    def test_pickle_says_what_to_do_instead(self):
        for thing, told in ((organ(), "path"), (simulation(), "snapshot"),
                            (stylet.VectorSimulation([simulation()]), "snapshot"),
                            (stylet.Guard(), "GuardConfig"),
                            (stylet.Device.simulated(0.01, 0.01), "open in this process")):
            self.assertRaisesRegex(TypeError, told, pickle.dumps, thing)
        self.assertRaises(TypeError, copy.copy, stylet.Guard())
        self.assertRaises(TypeError, copy.deepcopy, stylet.Device.simulated(0.01, 0.01))


    def test_each_class_has_its_own_message_in_every_protocol(self):
        """In protocols 0 and 1 pybind11's own way would end the process."""
        for kind in filter(is_native, classes()):
            for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
                self.assertRaisesRegex(TypeError, "cannot be pickled", pickle.dumps,
                                       kind.__new__(kind), protocol)


class Threads(unittest.TestCase):
    def test_each_member_of_a_simulation_that_runs_raises(self):
        """Or it answers with something that no tick changes."""
        run, other = simulation(), simulation()
        poses = np.tile(insertion(2)[0], (1000, 1))  # one call of C
        given = {"difference": [other], "restore": [other.snapshot()], "set_obstacles": [[]],
                 "_set_obstacles": [[]], "run": [poses[:1]], "tick": [None], "mass": [0]}
        free = {"needles"}
        names = [name for name, _ in members(stylet.Simulation)]
        self.assertLess(set(given) | free, set(names))
        for name in names:
            value = getattr(run, name)
            calls = [value] if callable(value) else []
            self.assertEqual(not calls, name in free)
            for call in calls:
                self.assertTrue(self.is_refused(run, poses, call, given.get(name, [])), name)
        vector = stylet.VectorSimulation([other, run])
        self.assertTrue(self.is_refused(run, poses, vector.run, [np.stack([poses[:1]] * 2)]))
        self.assertEqual(len(other.run(poses[:1])), 1)  # the refused call has not blocked it

    def is_refused(self, run, poses, call, arguments):
        """Whether the call raises at some time while the other thread is in C; before and after
        that it does not. A run that is over too early is started again."""
        thread = None
        for _ in range(20):
            begun = threading.Event()

            def work():
                begun.set()
                run.run(poses)
            thread = threading.Thread(target=work)
            thread.start()
            begun.wait()
            try:
                while thread.is_alive():
                    call(*arguments)
            except RuntimeError as refused:
                self.assertIn("another thread", str(refused))
                return True
            finally:
                thread.join()
        return False


class Kept(unittest.TestCase):
    def test_simulations_of_a_vector_whose_list_changes(self):
        given = [simulation() for _ in range(3)]
        vector = stylet.VectorSimulation(given, 2)
        poses = np.stack([insertion(50)] * 3)
        given.clear()
        vector.simulations = ()
        gc.collect()
        crowd = [simulation() for _ in range(6)]  # at the old addresses
        expected = crowd[0].run(poses[0]).tobytes()
        self.assertEqual([each.tobytes() for each in vector.run(poses)], 3 * [expected])

    def test_a_vector_of_no_simulations(self):
        vector = stylet.VectorSimulation([])
        self.assertEqual(len(vector), 0)
        for shape in ((0, 5), (0, 0), (0, 5, 1)):
            self.assertEqual(vector.run(np.zeros((*shape, 7))).shape, shape)
            out = np.empty(shape, stylet.output_dtype)
            self.assertIs(vector.run(np.zeros((*shape, 7)), out=out), out)
        self.assertRaises(ValueError, vector.run, np.zeros((1, 5, 7)))
        self.assertRaises(ValueError, stylet.VectorNeedleEnv, [])

    def test_no_ticks(self):
        run = simulation()
        before = run.hash()
        self.assertEqual(run.run(np.zeros((0, 7))).shape, (0,))
        self.assertEqual(stylet.VectorSimulation([run]).run(np.zeros((1, 0, 7))).shape, (1, 0))
        self.assertEqual(run.hash(), before)


class Bytes(unittest.TestCase):
    def test_any_contiguous_buffer(self):
        first = simulation()
        first.run(insertion(100))
        kept, content = first.snapshot(), organ_file().read_bytes()
        for made in (bytes, bytearray, memoryview, lambda b: np.frombuffer(b, np.uint8),
                     lambda b: np.frombuffer(b, np.uint8)[None]):
            run = simulation()
            run.restore(made(kept))
            self.assertIsNone(run.difference(first))
            self.assertEqual(stylet.Organ.from_bytes(made(content)).info.hash, organ().info.hash)

    def test_other_buffers_are_refused(self):
        run = simulation()
        kept, before = run.snapshot(), run.hash()
        scattered = np.repeat(np.frombuffer(kept, np.uint8), 2)[::2]
        for given, kind in ((kept.decode("latin-1"), TypeError), (None, TypeError),
                            (7, TypeError), (scattered, (BufferError, ValueError)),
                            (memoryview(kept)[::2], BufferError)):
            self.assertRaises(kind, run.restore, given)
            self.assertRaises(kind, stylet.Organ.from_bytes, given)
        for given in (b"", kept[:-1], bytearray(kept + b"\0")):
            self.assertRaises(stylet.StyletError, run.restore, given)
        held = bytearray(kept)
        run.restore(held)
        held.append(0)  # possible only if the buffer was released
        self.assertEqual(run.hash(), before)


if __name__ == "__main__":
    unittest.main()
