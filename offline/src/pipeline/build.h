// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the bytes of an organ file from meshes: repair, voxelise, combine, attach, embed, bound,
// write. Only this file knows the order of the stages; each stage has its own file.
//
// Promises: the same inputs and options give the same bytes; the kernel's organ_open has accepted
// the bytes; inputs that cannot be built are refused with one line. Units: metres.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "asset/materials.h"
#include "asset/write_organ.h"
#include "base/progress.h"
#include "base/refinement.h"
#include "base/slide.h"
#include "meshes/read_mesh.h"
#include "meshes/repair.h"
#include "pipeline/bodies.h"
#include "voxels/attach.h"
#include "voxels/lattice.h"
#include "voxels/layers.h"
#include "voxels/sample_parts.h"

namespace stylet::offline {

struct Input {
  std::string path;  // for messages; only the file name is kept in the organ
  std::string tissue;
  int priority = 0;  // the highest wins a voxel; among equals, the one that fills most of it
  double metres_per_unit = 1e-3;
  ReadMesh read;  // in file units
};

// A surface thinner than a voxel, of a tissue of its own (pipeline/membranes.h).
struct Membrane {
  std::string from;  // file, plane, or labels
  std::string tissue;
  bool is_plane = false;
  std::size_t axis = 0;  // of a plane
  double at_m = 0;
  Mesh mesh_m;  // of others
  double metres_per_unit = 1;
  std::string sha256;              // of a file
  std::vector<std::string> notes;  // warnings of who read it
};

struct BuildOptions {
  std::string name;
  double voxel_edge_m = 5e-3;
  std::uint32_t voxels_across = 0;  // along the longest side; replaces voxel_edge_m unless 0
  std::uint32_t most_voxels = 0;    // unless 0: choose the finest edge that sweeps no more voxels
  std::string capsule;              // tissue of the voxels at the outer surface; empty: none
  std::string capsule_of;           // only where the input has this tissue; empty: everywhere
  std::vector<std::string> wall;    // a voxel that touches these tissues has a capsule as well
  bool split = false;               // parts that do not touch get voxels of their own
  bool wrap = false;                // replace each input by a closed skin around it
  std::string gap_tissue;           // fills gaps between inputs up to gap_m wide; empty: gaps stay
  double gap_m = 0;
  std::vector<Region> held;
  std::vector<Region> crop;  // keep only what lies in all of these
  std::vector<Layer> layers;
  LayerCourse layer_course;
  std::vector<Membrane> membranes;
  std::vector<Slide> slides;            // between tissues of inputs (pipeline/slides.h)
  std::vector<Refinement> refinements;  // where voxels are finer (pipeline/refine.h)
  std::vector<Tissue> own_tissues;
  bool measured = false;     // fill in what a quality report asks for
  std::string options_text;  // these options as text, for the provenance in the file
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

// What was found for a tissue of a label map.
struct LabelReport {
  std::string tissue;
  std::size_t voxels = 0;  // voxels of the map
  double map_volume_m3 = 0;
  double filled_volume_m3 = 0;  // before each voxel goes to the tissue with most samples in it
};

// What became of one input, or of one tissue of a label map. Only with `measured`.
struct ShareReport {
  std::string from;  // file, or tissue of a label map
  std::string tissue;
  double input_m3 = 0;    // volume of the mesh or the labels
  double sampled_m3 = 0;  // volume of the samples inside it
  double given_m3 = 0;    // volume of those of them that lie in voxels it owns
  std::size_t pieces = 0, pieces_lost = 0;
};

struct BuildReport {
  std::vector<InputReport> inputs;
  std::vector<LabelReport> labels;
  std::vector<ShareReport> shares;
  std::size_t closed_gaps = 0;  // voxels or faces that join parts which do not touch
  std::vector<std::string> warnings;
};

struct Built {
  std::vector<std::byte> bytes;
  BuildReport report;
  std::vector<NamedHull> obstacles;  // only from a label map, as are targets
  std::vector<Target> targets;
  Mesh input_m;  // surface of all inputs, for comparison; only with `measured`
};

// Refuses an edge that the organ format does not allow.
void require_voxel_edge(double edge_m);

Built build(std::vector<Input> inputs, const BuildOptions& options, const Progress& progress);

// ---- for other sources than meshes --------------------------------------------------------------

// Voxels that a tick sweeps at an edge (voxels/sweep.h); needed where `most_voxels` is given.
using SweptAtEdge = std::function<double(double edge_m)>;
double choose_edge(const Box& box, const BuildOptions& options, const SweptAtEdge& swept_at);
void warn_of_size(const Box& box, std::vector<std::string>& warnings);

// For each owner, the volume of its samples in voxels that it owns.
std::vector<double> given_volumes_m3(const Claims& claims, std::size_t owner_count);

// Cells with their owners, and the surface to embed: all that `assemble` needs to make the organ.
struct Claimed {
  std::vector<Claims> levels;        // each with half the edge of the one before; without
                                     // refinements only one
  SamplePlaces places;               // of a cell's samples
  std::vector<std::string> tissues;  // of each owner
  Box box;
  Mesh mesh;                      // metres
  std::vector<std::uint8_t> cut;  // cells of level 0 cut away, see voxels/crop.h
  std::vector<SourceRecord> sources;
  std::vector<double> sample_m3;  // volume that a sample of each owner in the finest level is
  std::vector<Mesh> surface_m;    // of each owner that slides; others may be empty
};
// cut_away keeps only the part that `options.crop` asks for. swept_voxels is what a tick of the
// organ sweeps, with gaps filled and parts split as the options say.
void cut_away(Claimed& claimed, const BuildOptions& options);
double swept_voxels(Claimed claimed, const BuildOptions& options, const Progress& progress);
std::vector<std::byte> assemble(Claimed claimed, const BuildOptions& options,
                                std::vector<std::string>& warnings, const Progress& progress);

}  // namespace stylet::offline
