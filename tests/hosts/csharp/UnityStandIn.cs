// SPDX-License-Identifier: Apache-2.0
// The part of UnityEngine that the package's sample and UnityFrame.cs use, so that they can be
// compiled: signatures of Unity 2020.3's scripting reference, without any code behind them.
namespace UnityEngine {

public struct Vector3 {
  public float x, y, z;
  public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
}

public struct Quaternion {
  public float x, y, z, w;
  public Quaternion(float x, float y, float z, float w) {
    this.x = x;
    this.y = y;
    this.z = z;
    this.w = w;
  }
}

public class MonoBehaviour {
  public T GetComponent<T>() { return default(T); }
}

public class TextAsset {
  public byte[] bytes { get { return null; } }
}

public class Transform {
  public Vector3 position { get; set; }
  public Vector3 forward { get; set; }
}

public class LineRenderer {
  public int positionCount { get; set; }
  public void SetPosition(int index, Vector3 position) {}
}

public sealed class Mesh {
  public Rendering.IndexFormat indexFormat { get; set; }
  public Vector3[] vertices { get; set; }
  public int[] triangles { get; set; }
  public void MarkDynamic() {}
  public void RecalculateNormals() {}
}

public sealed class MeshFilter {
  public Mesh mesh { get; set; }
}

public class Time {
  public static float fixedDeltaTime { get; set; }
}

public class Debug {
  public static void LogWarning(object message) {}
}

public enum KeyCode { Space = 32 }

public class Input {
  public static bool GetKeyDown(KeyCode key) { return false; }
}

namespace Rendering {
public enum IndexFormat { UInt16, UInt32 }
}

}  // namespace UnityEngine
