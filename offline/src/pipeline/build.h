// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes to the bytes of an organ file: repair, voxelise, combine, attach, embed, bound, write.
// The order of the stages is here and nowhere else; each stage has its own file.
//
// Promises: the same inputs and options give the same bytes; the bytes have passed the kernel's own
// organ_open; what cannot be built is refused with one line. Units: metres.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "asset/materials.h"
#include "asset/write_organ.h"
#include "base/progress.h"
#include "meshes/read_mesh.h"
#include "meshes/repair.h"
#include "pipeline/bodies.h"
#include "voxels/attach.h"
#include "voxels/lattice.h"
#include "voxels/layers.h"
#include "voxels/sample_parts.h"

namespace stylet::bake {

struct Input {
  std::string path;  // for messages; only the file name is kept in the organ
  std::string tissue;
  int priority = 0;  // the higher one wins a voxel; the larger filled volume among equals
  double metres_per_unit = 1e-3;
  ReadMesh read;  // in file units
};

struct BuildOptions {
  std::string name;
  double voxel_edge_m = 5e-3;
  std::uint32_t voxels_across = 0;  // along the longest side; replaces voxel_edge_m unless 0
  std::uint32_t most_voxels = 0;  // unless 0: the finest edge that sweeps no more (voxels/sweep.h)
  std::string capsule;            // tissue of the voxels at the outer surface; empty: none
  std::string capsule_of;         // only where the input has this tissue; empty: everywhere
  std::vector<std::string> wall;  // tissues that the capsule has outside of it, as if bare
  bool split = false;             // parts that do not touch get voxels of their own
  bool wrap = false;              // replace each input by a closed skin around it
  std::string gap_tissue;         // of gaps between inputs up to gap_m wide; empty: gaps stay
  double gap_m = 0;
  std::vector<Region> held;
  std::vector<Region> crop;  // only what lies in all of these
  std::vector<Layer> layers;
  LayerCourse layer_course;
  std::vector<Tissue> own_tissues;
  bool measured = false;     // fill in what a quality report asks for
  std::string options_text;  // what provenance says of all this
  std::string tool_version;
};

struct InputReport {
  std::string path;
  std::string tissue;
  ReadCounts read;
  RepairCounts repair;
  bool closed = false;
  bool oriented = false;
  double mesh_volume_m3 = 0;    // signed volume after repair; of an open mesh only a hint
  double filled_volume_m3 = 0;  // sum of fill fractions before inputs are combined
  std::size_t decided_by_winding = 0;
};

// A tissue of a label map.
struct LabelReport {
  std::string tissue;
  std::size_t voxels = 0;  // of the map
  double map_volume_m3 = 0;
  double filled_volume_m3 = 0;  // before the largest share takes a voxel
};

// What one input, or one tissue of a label map, became. Only with `measured`.
struct ShareReport {
  std::string from;  // file, or tissue of a label map
  std::string tissue;
  double input_m3 = 0;    // of the mesh or the labels
  double sampled_m3 = 0;  // of the samples inside
  double given_m3 = 0;    // of those in voxels that it owns
  std::size_t pieces = 0, pieces_lost = 0;
};

struct BuildReport {
  std::vector<InputReport> inputs;
  std::vector<LabelReport> labels;
  std::vector<ShareReport> shares;
  std::size_t closed_gaps = 0;  // voxels or faces that hold together what does not touch
  std::vector<std::string> warnings;
};

struct Built {
  std::vector<std::byte> bytes;
  BuildReport report;
  std::vector<NamedHull> obstacles;  // of a label map
  std::vector<Target> targets;
  Mesh input_m;  // surface of all inputs, for comparison; only with `measured`
};

// Refuses what the organ format does not allow.
void require_voxel_edge(double edge_m);

Built build(std::vector<Input> inputs, const BuildOptions& options, const Progress& progress);

// ---- for other sources than meshes --------------------------------------------------------------

// What a tick sweeps at an edge (voxels/sweep.h), for where that is what is given.
using SweptAtEdge = std::function<double(double edge_m)>;
double choose_edge(const Box& box, const BuildOptions& options, const SweptAtEdge& swept_at);
void warn_of_size(const Box& box, std::vector<std::string>& warnings);

// Volume of each owner's samples in the voxels that it owns.
std::vector<double> given_volumes_m3(const Claims& claims, std::size_t owner_count);

// Voxels with their owners, and what is embedded in them: all that is left is the organ itself.
struct Claimed {
  Claims claims;
  SamplePlaces places;               // of its samples
  std::vector<std::string> tissues;  // of each owner
  Box box;
  Mesh mesh;                      // metres
  std::vector<std::uint8_t> cut;  // cells cut away, see voxels/crop.h
  std::vector<SourceRecord> sources;
  std::vector<double> sample_m3;  // what a sample of each owner stands for
};
// Only a part of it, where that is asked for; and what a tick of the organ sweeps, with gaps filled
// and parts split as options say.
void cut_away(Claimed& claimed, const BuildOptions& options);
double swept_voxels(Claimed claimed, const BuildOptions& options, const Progress& progress);
std::vector<std::byte> assemble(Claimed claimed, const BuildOptions& options,
                                std::vector<std::string>& warnings, const Progress& progress);

}  // namespace stylet::bake
