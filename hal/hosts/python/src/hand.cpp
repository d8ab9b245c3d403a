// SPDX-License-Identifier: Apache-2.0
// The hand's side for Python: guards, devices, and the loop, which runs in the library's own
// thread. The interpreter's lock is free while this module waits for it.
#include <pybind11/stl.h>

#include <chrono>
#include <thread>

#include "hal/hosts/python/src/poses.h"
#include "hal/hosts/python/src/simulation.h"
#include "stylet/stylet_loop.h"

namespace stylet::python {
namespace {

py::dtype guard_config_dtype() {
  using T = stylet_guard_config;
  return dtype_of(
      {STYLET_FIELD(T, period_s, kFloat), STYLET_FIELD(T, max_force_n, kFloat),
       STYLET_FIELD(T, max_slew_n_per_s, kFloat), STYLET_FIELD(T, ramp_s, kFloat),
       STYLET_FIELD(T, watchdog_s, kFloat), STYLET_FIELD(T, max_speed_m_per_s, kFloat),
       STYLET_FIELD(T, buzz_n, kFloat), STYLET_FIELD(T, continuous_force_n, kFloat),
       STYLET_FIELD(T, thermal_s, kFloat), STYLET_FIELD(T, dead_man_button, kInt32),
       STYLET_FIELD(T, acknowledge_button, kInt32), STYLET_FIELD(T, device_mass_kg, kFloat),
       STYLET_FIELD(T, device_damping_n_s_per_m, kFloat),
       STYLET_FIELD(T, device_friction_n, kFloat), STYLET_FIELD(T, device_resolution_m, kFloat),
       STYLET_FIELD(T, device_delay_s, kFloat), STYLET_FIELD(T, stored_energy_j, kFloat),
       STYLET_FIELD(T, passivity_damping_n_s_per_m, kFloat),
       STYLET_FIELD(T, max_torque_nm, kFloat)},
      sizeof(T));
}

py::dtype loop_config_dtype() {
  using T = stylet_loop_config;
  return dtype_of({STYLET_FIELD(T, processor, kInt32), STYLET_FIELD(T, priority, kInt32),
                   STYLET_FIELD(T, helpers, kUint32), STYLET_FIELD(T, ticks, kUint64),
                   STYLET_FIELD(T, virtual_time, kUint32), STYLET_FIELD(T, lock_memory, kUint32),
                   STYLET_FIELD(T, show_every_ticks, kUint32)},
                  sizeof(T));
}

py::dtype hand_dtype() {
  using T = stylet_hand;
  return dtype_of({STYLET_FIELD(T, clutch_button, kInt32),
                   {"position_m", kVec3, offsetof(T, start.position_m)},
                   {"rotation_wxyz", kQuat, offsetof(T, start.rotation)},
                   STYLET_FIELD(T, motion_scale, kFloat),
                   STYLET_FIELD(T, force_scale, kFloat),
                   STYLET_FIELD(T, coupling_stiffness_n_per_m, kFloat)},
                  sizeof(T));
}

using Three = std::array<float, 3>;
stylet_vec3 vec(const Three& v) {
  return {v[0], v[1], v[2]};
}
Three three(stylet_vec3 v) {
  return {v.x, v.y, v.z};
}

class Guard {
 public:
  explicit Guard(const py::array& config) {
    const auto own = struct_of<stylet_guard_config>(config);
    stylet_guard* made = nullptr;
    stylet_refusal why = empty_refusal();
    check(stylet_guard_create(&own, &made, &why), why);
    handle_ = std::shared_ptr<stylet_guard>(made, stylet_guard_free);
  }

  bool sample(const py::object& pose, std::int64_t now_ns, const std::optional<std::uint64_t>& seq,
              std::uint32_t buttons) {
    const auto p =
        pose.is_none() ? std::array<float, kPoseNumbers>{} : vector_of<kPoseNumbers>("pose", pose);
    seq_ = seq.value_or(seq_ + 1);
    if (pose.is_none()) return stylet_guard_sample(handle_.get(), nullptr, now_ns) != 0;
    const stylet_sample sample = {
        sizeof sample, buttons, seq_, now_ns, {{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}}, 0};
    return stylet_guard_sample(handle_.get(), &sample, now_ns) != 0;
  }
  Three force(const py::object& force_n) {
    return three(stylet_guard_force(handle_.get(), vec(vector_of<3>("force_n", force_n))));
  }
  Three torque(const py::object& torque_nm) {
    return three(stylet_guard_torque(handle_.get(), vec(vector_of<3>("torque_nm", torque_nm))));
  }
  bool end(std::int64_t now_ns) { return stylet_guard_end(handle_.get(), now_ns) != 0; }
  void trip(std::uint32_t fault) { check(stylet_guard_trip(handle_.get(), fault)); }
  bool rearm(std::uint32_t fault) { return stylet_guard_rearm(handle_.get(), fault) != 0; }

  py::object report() const {
    using namespace py::literals;
    stylet_guard_report r = {};
    r.struct_bytes = sizeof r;
    check(stylet_guard_get_report(handle_.get(), &r));
    return names(
        py::dict("mode"_a = r.mode, "fault"_a = r.fault, "fault_number"_a = r.fault_number,
                 "arming"_a = r.arming, "falls"_a = r.falls != 0, "force_n"_a = three(r.force_n),
                 "torque_nm"_a = three(r.torque_nm), "energy_j"_a = r.energy_j,
                 "samples_used"_a = r.samples_used, "samples_missing"_a = r.samples_missing,
                 "samples_repeated"_a = r.samples_repeated, "samples_lost"_a = r.samples_lost,
                 "samples_old"_a = r.samples_old, "samples_not_finite"_a = r.samples_not_finite,
                 "samples_absurd"_a = r.samples_absurd, "samples_jumped"_a = r.samples_jumped,
                 "force_not_finite"_a = r.force_not_finite, "force_limited"_a = r.force_limited,
                 "slew_limited"_a = r.slew_limited, "force_warm"_a = r.force_warm,
                 "force_damped"_a = r.force_damped, "faults"_a = r.faults, "rearms"_a = r.rearms));
  }

 private:
  std::shared_ptr<stylet_guard> handle_;
  std::uint64_t seq_ = 0;  // of the newest sample
};

// Closed when a loop that has it ends, or with this object.
class Device {
 public:
  static Device open(const std::string& uri, double patience_s) {
    stylet_device* made = nullptr;
    stylet_refusal why = empty_refusal();
    stylet_status status = STYLET_OK;
    {
      const py::gil_scoped_release others_run;
      status = stylet_device_open(uri.c_str(), patience_s, &made, &why);
    }
    check(status, why);
    return Device(made, uri);
  }
  static Device simulated(float travel_m, float speed_m_per_s, float hold_s) {
    stylet_device* made = nullptr;
    check(stylet_device_simulated(travel_m, speed_m_per_s, hold_s, &made));
    return Device(made, "simulated");
  }
  Device(Device&&) = default;

  stylet_device* get() const {
    if (handle_ == nullptr) throw std::runtime_error("this device is closed, or a loop has it");
    return handle_.get();
  }
  void give() { (void)handle_.release(); }
  void close() { handle_.reset(); }
  std::string told() const {
    return "<stylet.Device " + name_ + (handle_ == nullptr ? ": closed, or a loop has it>" : ">");
  }

 private:
  struct Close {
    void operator()(stylet_device* device) const { stylet_device_close(device); }
  };
  Device(stylet_device* handle, std::string name) : handle_(handle), name_(std::move(name)) {}
  std::unique_ptr<stylet_device, Close> handle_;
  std::string name_;
};

class Loop {
 public:
  Loop(Simulation& simulation, const std::vector<Device*>& devices,
       const std::vector<py::array>& hands, const std::vector<py::array>& guards,
       const py::array& config)
      : needles_(simulation.needles()) {
    const Use use(simulation);
    if (devices.size() != needles_ || hands.size() != needles_ ||
        (!guards.empty() && guards.size() != needles_)) {
      throw py::value_error("devices, hands, guards: " + std::to_string(devices.size()) + ", " +
                            std::to_string(hands.size()) + ", " + std::to_string(guards.size()) +
                            ": expected " + std::to_string(needles_) +
                            " of each, one for a needle, or no guards");
    }
    std::vector<stylet_device*> own_devices;
    for (const Device* each : devices) {
      if (each == nullptr) throw py::type_error("None: expected a stylet.Device");
      own_devices.push_back(each->get());
    }
    const auto own_hands = structs_of<stylet_hand>(hands);
    const auto own_guards = structs_of<stylet_guard_config>(guards);
    const auto own_config = struct_of<stylet_loop_config>(config);
    stylet_loop* made = nullptr;
    stylet_refusal why = empty_refusal();
    check(stylet_loop_create(simulation.handle(), &own_config, own_devices.data(), own_hands.data(),
                             own_guards.empty() ? nullptr : own_guards.data(), &made, &why),
          why);
    handle_.reset(made);
    for (Device* each : devices) each->give();
    const std::uint32_t vertices = stylet_loop_surface(made, nullptr, 0);
    surface_ = py::array_t<float>({static_cast<py::ssize_t>(vertices), py::ssize_t{3}});
    surface_view_ = read_only(surface_);
  }

  void start() { check(stylet_loop_start(get())); }
  void run() {
    start();
    wait();
  }
  void stop() { stylet_loop_ask_to_stop(get()); }
  // In steps, so that Ctrl-C is seen: it ends the wait, not the loop.
  void wait() {
    while (runs()) {
      {
        const py::gil_scoped_release others_run;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
  }
  void pause(bool paused) { stylet_loop_pause(get(), paused ? 1 : 0); }
  void close() {
    const auto going = std::move(handle_);  // freed with the lock: nobody looks at it meanwhile
    if (going != nullptr) stylet_loop_ask_to_stop(going.get());
  }
  bool runs() {
    stylet_loop_report r = {};
    r.struct_bytes = sizeof r;
    check(stylet_loop_get_report(get(), &r));
    return r.runs != 0;
  }

  bool take() { return stylet_loop_take(get()) != 0; }
  py::object output(std::uint32_t needle) {
    py::array row(output_dtype(), 1);
    auto* const out = static_cast<stylet_output*>(row.mutable_data());
    *out = {};
    out->struct_bytes = sizeof *out;
    check(stylet_loop_get_output(get(), needle, out));
    return row.attr("view")(py::module_::import("numpy").attr("recarray"))[py::int_(0)];
  }
  py::object hand(std::uint32_t needle) {
    using namespace py::literals;
    stylet_hand_report r = {};
    r.struct_bytes = sizeof r;
    check(stylet_loop_get_hand(get(), needle, &r));
    return names(py::dict("mode"_a = r.mode, "fault"_a = r.fault, "fault_number"_a = r.fault_number,
                          "sent_force_n"_a = three(r.sent_force_n),
                          "answered"_a = r.answered != 0));
  }
  py::array surface() {
    (void)stylet_loop_surface(get(), reinterpret_cast<stylet_vec3*>(surface_.mutable_data()),
                              static_cast<std::uint32_t>(surface_.shape(0)));
    return surface_view_;
  }
  py::array needle_shape(std::uint32_t needle) {
    std::array<stylet_vec3, STYLET_MAX_RODS + 1> nodes;
    const std::uint32_t count =
        stylet_loop_needle_shape(get(), needle, nodes.data(), STYLET_MAX_RODS + 1);
    py::array_t<float> out({static_cast<py::ssize_t>(count), py::ssize_t{3}});
    std::copy_n(nodes.data(), count, reinterpret_cast<stylet_vec3*>(out.mutable_data()));
    return out;
  }
  py::array events() {
    py::array out(event_dtype(), py::ssize_t{4096});
    const std::uint32_t count =
        stylet_loop_events(get(), static_cast<stylet_event*>(out.mutable_data()), 4096);
    return out[py::slice(0, count, 1)].cast<py::array>();
  }
  void acknowledge(std::uint32_t needle, std::uint32_t fault, std::uint32_t number) {
    check(stylet_loop_acknowledge(get(), needle, fault, number));
  }
  py::object report() {
    using namespace py::literals;
    stylet_loop_report r = {};
    r.struct_bytes = sizeof r;
    check(stylet_loop_get_report(get(), &r));
    return names(py::dict("runs"_a = r.runs != 0, "ticks"_a = r.ticks,
                          "missed_ticks"_a = r.missed_ticks, "lost_events"_a = r.lost_events,
                          "tick_p50_ns"_a = r.tick_p50_ns, "tick_p999_ns"_a = r.tick_p999_ns,
                          "tick_max_ns"_a = r.tick_max_ns, "late_p50_ns"_a = r.late_p50_ns,
                          "late_p999_ns"_a = r.late_p999_ns, "late_max_ns"_a = r.late_max_ns,
                          "lacks"_a = stylet_loop_lacks(get())));
  }
  std::string trouble(std::uint32_t needle) { return stylet_loop_trouble(get(), needle); }

 private:
  struct Free {
    void operator()(stylet_loop* loop) const { stylet_loop_free(loop); }
  };
  stylet_loop* get() const {
    if (handle_ == nullptr) throw std::runtime_error("this loop is closed");
    return handle_.get();
  }
  std::uint32_t needles_;
  std::unique_ptr<stylet_loop, Free> handle_;
  py::array_t<float> surface_;
  py::array surface_view_;
};

py::array guard_config_for(const std::string& model) {
  py::array row = defaults<stylet_guard_config>(guard_config_dtype(), stylet_guard_config_init);
  check(stylet_guard_config_for(static_cast<stylet_guard_config*>(row.mutable_data()),
                                model.c_str()));
  return row;
}

std::vector<std::string> device_models() {
  std::vector<std::string> out;
  for (std::uint32_t i = 0; stylet_device_model(i) != nullptr; ++i) {
    out.emplace_back(stylet_device_model(i));
  }
  return out;
}

void add_loop(py::module_& module) {
  py::class_<Loop> loop(module, "Loop");
  refuse_pickle(loop, "a loop cannot be pickled or copied: it is one thread of this process");
  loop.def(py::init<Simulation&, const std::vector<Device*>&, const std::vector<py::array>&,
                    const std::vector<py::array>&, const py::array&>(),
           py::keep_alive<1, 2>())
      .def("start", &Loop::start)
      .def("run", &Loop::run)
      .def("stop", &Loop::stop)
      .def("wait", &Loop::wait)
      .def("pause", &Loop::pause, py::arg("paused") = true)
      .def("close", &Loop::close)
      .def("take", &Loop::take)
      .def("output", &Loop::output, py::arg("needle") = 0)
      .def("hand", &Loop::hand, py::arg("needle") = 0)
      .def("surface", &Loop::surface)
      .def("needle_shape", &Loop::needle_shape, py::arg("needle") = 0)
      .def("events", &Loop::events)
      .def("_acknowledge", &Loop::acknowledge)
      .def("report", &Loop::report)
      .def("trouble", &Loop::trouble, py::arg("needle") = 0);
}

}  // namespace

void add_hand(py::module_& module) {
  module.def("default_guard_config", [] {
    return defaults<stylet_guard_config>(guard_config_dtype(), stylet_guard_config_init);
  });
  module.def("guard_config_for", guard_config_for);
  module.def("device_models", device_models);
  module.def("default_loop_config", [] {
    return defaults<stylet_loop_config>(loop_config_dtype(), stylet_loop_config_init);
  });
  module.def("default_hand", [] { return defaults<stylet_hand>(hand_dtype(), stylet_hand_init); });
  module.def("fault_name", stylet_fault_name);
  py::class_<Guard> guard(module, "Guard");
  refuse_pickle(guard, "a guard cannot be pickled or copied: make another of its GuardConfig");
  guard.def(py::init<const py::array&>())
      .def("sample", &Guard::sample, py::arg("pose"), py::arg("now_ns"),
           py::arg("seq") = py::none(), py::arg("buttons") = 0)
      .def("force", &Guard::force, py::arg("force_n"))
      .def("torque", &Guard::torque, py::arg("torque_nm"))
      .def("end", &Guard::end, py::arg("now_ns"))
      .def("trip", &Guard::trip, py::arg("fault"))
      .def("rearm", &Guard::rearm, py::arg("fault_seen"))
      .def("report", &Guard::report);
  py::class_<Device> device(module, "Device");
  refuse_pickle(device, "a device cannot be pickled or copied: it is open in this process");
  device.def_static("open", &Device::open, py::arg("uri"), py::arg("patience_s") = 10.0)
      .def_static("simulated", &Device::simulated, py::arg("travel_m"), py::arg("speed_m_per_s"),
                  py::arg("hold_s") = 0.0F)
      .def("close", &Device::close)
      .def("__repr__", &Device::told);
  add_loop(module);
}

}  // namespace stylet::python
