// SPDX-License-Identifier: Apache-2.0
// Every constructor, method and static function of the C# package with random arguments: null,
// empty and short arrays, structs of zeros and of odd numbers, numbers that are not finite. They
// are found by reflection, so that later ones are tested too. The library never ends the process.
using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using Stylet;

public sealed class Drawn {
  static readonly string[] NotCalled = { "Loop.Wait", "Loop.Start", "Loop.Run" };  // it has no end
  readonly Random random;
  readonly Organ organ;
  readonly SortedSet<string> called = new SortedSet<string>(), silent = new SortedSet<string>();

  Drawn(int seed, Organ organ) {
    random = new Random(seed);
    this.organ = organ;
  }

  float Odd() {
    float[] odd = { 0, -1, 1, 0.01F, float.NaN, float.PositiveInfinity, float.NegativeInfinity,
                    3e38F, 1e-40F };
    return odd[random.Next(odd.Length)];
  }

  object Struct(Type type) {
    MethodInfo init = typeof(Simulation).GetMethod("Default" + type.Name) ??
                      typeof(Loop).GetMethod("Default" + type.Name);
    if (Nullable.GetUnderlyingType(type) != null) {
      return random.Next(3) == 0 ? null : Struct(Nullable.GetUnderlyingType(type));
    }
    object made = init != null && random.Next(3) > 0 ? init.Invoke(null, null)
                                                     : Activator.CreateInstance(type);
    foreach (FieldInfo field in type.GetFields().Where(each => random.Next(4) == 0)) {
      if (field.FieldType == typeof(float)) field.SetValue(made, Odd());
      if (field.FieldType == typeof(uint)) field.SetValue(made, (uint)random.Next(200));
      if (field.FieldType == typeof(Vec3)) field.SetValue(made, new Vec3(Odd(), Odd(), Odd()));
    }
    return made;
  }

  object Value(Type type) {
    if (type == typeof(string)) {
      return new[] { null, "", "none:", "/", "a\0b", new string('x', 70000) }[random.Next(6)];
    }
    if (!type.IsValueType && random.Next(6) == 0) return null;
    if (type.IsArray) {
      Array made = Array.CreateInstance(type.GetElementType(), random.Next(4));
      for (int i = 0; i < made.Length; ++i) made.SetValue(Value(type.GetElementType()), i);
      return made;
    }
    if (type == typeof(bool)) return random.Next(2) == 0;
    if (type == typeof(byte)) return (byte)random.Next(256);
    if (type == typeof(int))
      return new[] { 0, 1, -1, 7, int.MaxValue, int.MinValue }[random.Next(6)];
    if (type == typeof(uint)) return new[] { 0U, 1U, 99U, uint.MaxValue }[random.Next(4)];
    if (type == typeof(float)) return Odd();
    if (type == typeof(double)) return (double)Odd();
    if (type == typeof(Organ)) return organ;
    if (type == typeof(Simulation)) return new Simulation(organ, Simulation.DefaultConfig());
    if (type == typeof(Batch)) {
      return new Batch(new[] { new Simulation(organ, Simulation.DefaultConfig()) }, 1);
    }
    if (type == typeof(Guard)) return new Guard(Guard.DefaultConfig());
    if (type == typeof(Device)) return Device.Simulated(0.01F, 0.01F, 0);
    if (type == typeof(Loop)) {
      return new Loop(new Simulation(organ, Simulation.DefaultConfig()), Loop.DefaultConfig(),
                      new[] { Device.Simulated(0.01F, 0.01F, 0) }, new[] { Loop.DefaultHand() });
    }
    return type.IsByRef ? Value(type.GetElementType()) : Struct(type);
  }

  // A call that neither returns nor throws anything has refused silently.
  void Call(string name, MethodBase method, object of) {
    object[] given = method.GetParameters().Select(each => Value(each.ParameterType)).ToArray();
    called.Add(name);
    try {
      if (method is ConstructorInfo made) {
        using (made.Invoke(given) as IDisposable) {}
      } else {
        method.Invoke(of, given);
      }
    } catch (TargetInvocationException raised) {
      if (raised.InnerException.Message == "") silent.Add(name);
    }
  }

  public static void Calls(Organ organ, byte[] bytes) {
    var drawn = new Drawn(7, organ);
    Type[] kinds = { typeof(Organ), typeof(Simulation), typeof(Batch), typeof(Guard),
                     typeof(Device), typeof(Loop), typeof(Library) };
    for (int round = 0; round < 40; ++round) {
      foreach (Type kind in kinds) {
        foreach (ConstructorInfo each in kind.GetConstructors()) {
          drawn.Call(kind.Name, each, null);
        }
        foreach (MethodInfo each in kind.GetMethods().Where(
                     each => each.DeclaringType == kind &&
                             !NotCalled.Contains(kind.Name + "." + each.Name))) {
          object of = each.IsStatic ? null
                      : kind == typeof(Organ) ? new Organ(bytes) : drawn.Value(kind);
          if (each.IsStatic || of != null) drawn.Call(kind.Name + "." + each.Name, each, of);
          if (of is IDisposable ends) ends.Dispose();
        }
      }
    }
    Console.WriteLine(drawn.called.Count);
    Console.WriteLine(string.Join(" ", drawn.silent));
  }
}
