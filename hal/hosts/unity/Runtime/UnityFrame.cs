// SPDX-License-Identifier: Apache-2.0
// Between the organ's frame (right-handed, z up) and Unity's (left-handed, y up): y and z change
// places. Triangles keep the order of their corners, which is then clockwise seen from outside, as
// Unity expects it. Also draws organ and needle. Compiled only in Unity.
#if UNITY_2020_3_OR_NEWER
using UnityEngine;

namespace Stylet {

public static class UnityFrame {
  public static Vector3 ToUnity(Vec3 v) { return new Vector3(v.x, v.z, v.y); }
  public static Vec3 FromUnity(Vector3 v) { return new Vec3(v.x, v.z, v.y); }
  // A reflection reverses the sense of a rotation.
  public static Quaternion ToUnity(Quat q) { return new Quaternion(-q.x, -q.z, -q.y, q.w); }
  public static Quat FromUnity(Quaternion q) {
    return new Quat { w = q.w, x = -q.x, y = -q.z, z = -q.y };
  }
  public static void ToUnity(Vec3[] from, Vector3[] to) {
    for (int i = 0; i < to.Length; ++i) to[i] = ToUnity(from[i]);
  }

  // The needle's tip is at the object's position and points along its forward direction.
  public static Pose PoseOfTip(Transform hand, Needle needle) {
    return Simulation.PoseOfTip(FromUnity(hand.position), FromUnity(hand.forward),
                                needle.length_m);
  }
  // `nodes`: points along the needle, of which the first `count` are drawn.
  public static void Draw(LineRenderer line, Vec3[] nodes, int count) {
    line.positionCount = count;
    for (int i = 0; i < count; ++i) line.SetPosition(i, ToUnity(nodes[i]));
  }
}

// An organ's surface, deformed by a simulation or a loop.
public sealed class OrganMesh {
  public readonly Mesh Mesh = new Mesh { indexFormat = UnityEngine.Rendering.IndexFormat.UInt32 };
  readonly Vector3[] places;

  public OrganMesh(Organ organ) {
    places = new Vector3[organ.Info.vertices];
    Mesh.MarkDynamic();
    Show(organ.Vertices());
    Mesh.triangles = organ.Triangles();
    Mesh.RecalculateNormals();
  }

  public void Show(Vec3[] vertices) {
    UnityFrame.ToUnity(vertices, places);
    Mesh.vertices = places;
    Mesh.RecalculateNormals();
  }
}

}  // namespace Stylet
#endif
