// SPDX-License-Identifier: Apache-2.0
// Simulations and batches for Python.
//
// Promise: what a simulation shows (answers of a tick, surface, particles) are arrays that it owns
// and fills in place, and that Python only reads; the lock of the interpreter is free while ticks
// are computed; a simulation that another thread is using is refused. Units and frames: those of
// stylet.h. Source: stylet.h.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/hosts/python/src/organ.h"

namespace stylet::python {

class Simulation {
 public:
  // Rows of the dtypes of needle, config and obstacle.
  Simulation(const Organ& organ, const std::vector<py::array>& needles, const py::array& config,
             const std::vector<py::array>& obstacles);
  // In the state of another.
  explicit Simulation(Simulation& other);

  py::object tick(const py::object& poses);
  py::array run(const py::object& poses, const py::object& valid, const py::object& out);
  void set_obstacles(const std::vector<py::array>& obstacles);
  void reset();

  py::array surface();
  py::array needle_shape(std::uint32_t needle);
  py::array particles();
  py::array voxel_corners();
  py::array constraint_particles();
  py::array obstacle_touches();
  py::array events();
  py::object stats();
  py::object energy();
  py::tuple mass(std::uint32_t material);

  std::uint64_t hash();
  py::bytes snapshot();
  void restore(const py::object& snapshot);
  py::object difference(Simulation& other);

  std::uint32_t needles() const { return needles_; }
  stylet_simulation* handle() { return handle_.get(); }

 private:
  friend class Use;
  struct Shown {
    py::array own, view;  // the same memory, to be filled and to be read
  };
  void prepare();
  template <typename T, typename Fill>
  py::array show(Shown& shown, const py::dtype& dtype, py::ssize_t columns, std::uint32_t most,
                 const Fill& fill);

  std::shared_ptr<stylet_simulation> handle_;
  std::uint32_t needles_ = 0;
  bool used_ = false;  // by a thread that has left the interpreter; changed under its lock
  std::vector<stylet_input> inputs_;
  Shown outputs_;
  py::object first_output_;
  Shown surface_, particles_, corners_, constraint_particles_, touches_, events_;
  std::array<Shown, STYLET_MAX_NEEDLES> shapes_;
};

// Marks a simulation as used as long as it lives, or refuses: only one thread may have it.
class Use {
 public:
  explicit Use(Simulation& simulation);
  ~Use();
  Use(Use&& other) noexcept : simulation_(std::exchange(other.simulation_, nullptr)) {}
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  Use& operator=(Use&&) = delete;

 private:
  Simulation* simulation_;
};

// The array that outputs go to: `out` if it fits, or a new one.
py::array output_array(const py::object& out, const std::vector<py::ssize_t>& shape);

// Rows of Python as structs in a row.
template <typename T>
std::vector<T> structs_of(const std::vector<py::array>& rows) {
  std::vector<T> out;
  for (const py::array& row : rows) out.push_back(struct_of<T>(row));
  return out;
}

void add_simulation(py::module_& module);
void add_batch(py::module_& module);
void add_hand(py::module_& module);

}  // namespace stylet::python
