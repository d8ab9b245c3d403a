// SPDX-License-Identifier: Apache-2.0
#include "needle/convex.h"

#include <ccd/ccd.h>

#include "base/math.h"

namespace stylet {
namespace {

// The search ends at this relative error of the squared distance.
constexpr double kDistanceTolerance = 1e-13;
// Cores nearer than this overlap.
constexpr double kTouchM = 1e-11;

Vec3d farthest(const ConvexHull& hull, Vec3d direction) {
  Vec3d best = to_double(hull.vertices_m[0]);
  double most = dot(direction, best);
  for (const Vec3& vertex : hull.vertices_m.subspan(1)) {
    const Vec3d v = to_double(vertex);
    const double along = dot(direction, v);
    if (along > most) {
      most = along;
      best = v;
    }
  }
  return best;
}

// ---- GJK: the point of (segment - hull) nearest to the origin -----------------------------------

struct Corner {
  Vec3d p;
  double place;
};

struct Simplex {
  Corner corner[4];
  std::uint32_t count;
};

// Nearest point of a simplex to the origin: `weight` is the weight of each corner.
struct SimplexPoint {
  Vec3d p;
  double square;  // of the distance; 0 inside a tetrahedron
  double weight[4];
};

const SimplexPoint& nearer(const SimplexPoint& a, const SimplexPoint& b) {
  return b.square < a.square ? b : a;
}

SimplexPoint on_edge(const Simplex& s, std::uint32_t i, std::uint32_t j) {
  const Vec3d a = s.corner[i].p, ab = s.corner[j].p - a;
  const double length2 = dot(ab, ab);
  double t = length2 > 0 ? -dot(a, ab) / length2 : 0;
  t = t < 0 ? 0 : (t > 1 ? 1 : t);
  SimplexPoint n = {};
  n.weight[j] = t;
  n.weight[i] = 1 - t;  // second, as where i is j the one corner has all the weight
  n.p = a + t * ab;
  n.square = dot(n.p, n.p);
  return n;
}

SimplexPoint on_face(const Simplex& s, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  const Vec3d a = s.corner[i].p, b = s.corner[j].p, c = s.corner[k].p;
  const Vec3d across = cross(b - a, c - a);
  const double area2 = dot(across, across);
  const double u = dot(cross(b, c), across), v = dot(cross(c, a), across);
  const double w = dot(cross(a, b), across);
  if (!(area2 > 0) || u < 0 || v < 0 || w < 0) {
    return nearer(nearer(on_edge(s, i, j), on_edge(s, j, k)), on_edge(s, k, i));
  }
  SimplexPoint n = {};
  n.weight[i] = u / area2;
  n.weight[j] = v / area2;
  n.weight[k] = w / area2;
  n.p = (dot(a, across) / area2) * across;
  n.square = dot(n.p, n.p);
  return n;
}

SimplexPoint in_tetrahedron(const Simplex& s) {
  const Vec3d a = s.corner[0].p, b = s.corner[1].p, c = s.corner[2].p, d = s.corner[3].p;
  const double volume = dot(b - a, cross(c - a, d - a));
  const double wa = dot(b, cross(c, d)), wb = -dot(a, cross(c, d));
  const double wc = dot(a, cross(b, d)), wd = -dot(a, cross(b, c));
  const bool inside = volume > 0 ? (wa >= 0 && wb >= 0 && wc >= 0 && wd >= 0)
                                 : (volume < 0 && wa <= 0 && wb <= 0 && wc <= 0 && wd <= 0);
  if (inside) return {{0, 0, 0}, 0, {wa / volume, wb / volume, wc / volume, wd / volume}};
  return nearer(nearer(on_face(s, 0, 1, 2), on_face(s, 0, 1, 3)),
                nearer(on_face(s, 0, 2, 3), on_face(s, 1, 2, 3)));
}

SimplexPoint nearest(const Simplex& s) {
  if (s.count == 4) return in_tetrahedron(s);
  if (s.count == 3) return on_face(s, 0, 1, 2);
  return on_edge(s, 0, s.count - 1);
}

bool holds(const Simplex& s, Vec3d p) {
  for (std::uint32_t i = 0; i < s.count; ++i) {
    const Vec3d q = s.corner[i].p;
    if (q.x == p.x && q.y == p.y && q.z == p.z) return true;
  }
  return false;
}

// Drops corners on which the nearest point does not lie; returns its parameter on the segment.
double reduce(Simplex& s, const SimplexPoint& n) {
  std::uint32_t kept = 0;
  double place = 0;
  for (std::uint32_t i = 0; i < s.count; ++i) {
    if (!(n.weight[i] > 0)) continue;
    place += n.weight[i] * s.corner[i].place;
    s.corner[kept++] = s.corner[i];
  }
  s.count = kept;
  return place < 0 ? 0 : (place > 1 ? 1 : place);
}

// ---- libccd -------------------------------------------------------------------------------------

// Both shapes of one query. libccd limits neither of its search loops, but both end when a support
// point lies behind the origin. So once the budget is spent, every support point lies there.
struct Overlap {
  const ConvexHull* hull;
  const Segment* segment;
  mutable std::uint32_t left;
};
constexpr double kBehindM = 1;

const Overlap& overlap_of(const void* object) {
  return *static_cast<const Overlap*>(object);
}

ccd_vec3_t to_ccd(Vec3d a) {
  return {{a.x, a.y, a.z}};
}
Vec3d from_ccd(const ccd_vec3_t& a) {
  return {a.v[0], a.v[1], a.v[2]};
}

// Opposite to the direction, and far for the direction's length.
Vec3d behind(Vec3d direction) {
  const double length = norm(direction);
  return length > 0 ? (-kBehindM / length) * direction : Vec3d{0, 0, 0};
}

void hull_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const Overlap& o = overlap_of(object);
  const Vec3d d = from_ccd(*direction);
  *point = to_ccd(o.left == 0 ? behind(d) : farthest(*o.hull, d));
  if (o.left > 0) --o.left;
}

void segment_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const Overlap& o = overlap_of(object);
  const Vec3d d = from_ccd(*direction);
  const bool at_b = dot(d, o.segment->b_m - o.segment->a_m) > 0;
  *point = to_ccd(o.left == 0 ? behind(d) : (at_b ? o.segment->b_m : o.segment->a_m));
}

void hull_centre(const void* object, ccd_vec3_t* centre) {
  *centre = to_ccd(overlap_of(object).hull->centre_m);
}

void segment_centre(const void* object, ccd_vec3_t* centre) {
  *centre = to_ccd(point_on(*overlap_of(object).segment, 0.5));
}

// Rounds to a grid, so that a library whose build fuses products gives the same bits.
double coarse(double v) {
  constexpr double kGrid = 1024;
  return whole_part(v * kGrid + (v < 0 ? -0.5 : 0.5));
}

Vec3d square_to(const Segment& segment) {
  const Vec3d along = segment.b_m - segment.a_m;
  const double ax = std::fabs(along.x), ay = std::fabs(along.y), az = std::fabs(along.z);
  const Vec3d axis = az <= ax && az <= ay ? Vec3d{0, 0, 1}
                     : ay <= ax           ? Vec3d{0, 1, 0}
                                          : Vec3d{1, 0, 0};
  const double length2 = dot(along, along);
  if (!(length2 > 0)) return axis;
  const Vec3d across = axis - (dot(axis, along) / length2) * along;
  return (1 / norm(across)) * across;
}

}  // namespace

double reach(const ConvexHull& hull, Vec3d direction) {
  return dot(direction, farthest(hull, direction));
}

Closest closest(const ConvexHull& hull, const Segment& segment) {
  Simplex s = {};
  Vec3d v = point_on(segment, 0.5) - hull.centre_m;
  double square = dot(v, v), place = 0.5;
  for (std::uint32_t step = 0; step < kMaxGjkSteps && square > kTouchM * kTouchM; ++step) {
    const bool at_b = dot(v, segment.b_m - segment.a_m) < 0;
    const Vec3d p = (at_b ? segment.b_m : segment.a_m) - farthest(hull, v);
    if (square - dot(v, p) <= kDistanceTolerance * square || holds(s, p)) break;
    Simplex grown = s;
    grown.corner[grown.count++] = {p, at_b ? 1.0 : 0.0};
    const SimplexPoint n = nearest(grown);
    if (step > 0 && !(n.square < square)) break;  // rounding: no nearer point can be found
    place = reduce(grown, n);
    s = grown;
    v = n.p;
    square = n.square;
  }
  if (!(square > kTouchM * kTouchM)) return {0, {0, 0, 0}, place};
  const double distance = std::sqrt(square);
  return {distance, (1 / distance) * v, place};
}

Vec3d way_out(const ConvexHull& hull, const Segment& segment, std::uint32_t budget) {
  const Overlap overlap = {&hull, &segment, budget};
  ccd_t ccd = {};
  ccd.support1 = hull_support;
  ccd.support2 = segment_support;
  ccd.center1 = hull_centre;
  ccd.center2 = segment_centre;
  ccd.max_iterations = budget;
  ccd.mpr_tolerance = 1e-6;
  ccd_real_t depth = 0;
  ccd_vec3_t direction = {}, point = {};
  const int missed = ccdMPRPenetration(&overlap, &overlap, &ccd, &depth, &direction, &point);
  const Vec3d found = from_ccd(direction);
  const double length2 = dot(found, found);
  if (missed != 0 || overlap.left == 0 || !(length2 > 0.25 && length2 < 4)) {
    return square_to(segment);
  }
  const Vec3d out = {coarse(found.x), coarse(found.y), coarse(found.z)};
  return (1 / norm(out)) * out;
}

}  // namespace stylet
