// SPDX-License-Identifier: Apache-2.0
// Between the organ's frame (right-handed, z up) and Unity's (left-handed, y up): y and z change
// places. Triangles keep their corners: seen from outside they run clockwise then, as Unity wants
// them. Compiled in Unity alone.
#if UNITY_2020_3_OR_NEWER
using UnityEngine;

namespace Stylet {

public static class UnityFrame {
  public static Vector3 ToUnity(Vec3 v) { return new Vector3(v.x, v.z, v.y); }
  public static Vec3 FromUnity(Vector3 v) { return new Vec3(v.x, v.z, v.y); }
  // A reflection turns the sense of a rotation round.
  public static Quaternion ToUnity(Quat q) { return new Quaternion(-q.x, -q.z, -q.y, q.w); }
  public static Quat FromUnity(Quaternion q) {
    return new Quat { w = q.w, x = -q.x, y = -q.z, z = -q.y };
  }
  public static void ToUnity(Vec3[] from, Vector3[] to) {
    for (int i = 0; i < to.Length; ++i) to[i] = ToUnity(from[i]);
  }
}

}  // namespace Stylet
#endif
