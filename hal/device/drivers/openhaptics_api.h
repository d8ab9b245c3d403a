// SPDX-License-Identifier: Apache-2.0
// The part of the vendor's interface libHD.so that is used.
// Promise: loading throws DeviceError with one line. Source: OpenHaptics API reference.
#pragma once

#include <string>

namespace stylet::hal::openhaptics {

using HdHandle = unsigned int;
using Enum = unsigned int;
using Callback = unsigned int (*)(void*);
using SchedulerHandle = unsigned long;

// Returned by value in two registers: another size would mean another calling convention.
struct ErrorInfo {
  unsigned int code;
  int internal;
  HdHandle device;
};
static_assert(sizeof(ErrorInfo) == 12);

constexpr HdHandle kInvalidHandle = 0xFFFFFFFFU;
constexpr Enum kCurrentButtons = 0x2000, kCurrentTransform = 0x2052, kCurrentForce = 0x2700;
constexpr Enum kModelType = 0x2501, kSerialNumber = 0x2504, kCalibrationStyle = 0x2555;
constexpr Enum kNominalMaxStiffness = 0x2602, kNominalMaxForce = 0x2603,
               kNominalMaxContinuousForce = 0x2604;
constexpr Enum kForceOutput = 0x4000, kMaxForceClamping = 0x4001, kForceRamping = 0x4002,
               kSoftwareForceLimit = 0x4003;
constexpr Enum kCalibrationOk = 0x5000, kCalibrationNeedsUpdate = 0x5001;
constexpr int kStyleEncoderReset = 1, kStyleAuto = 2, kStyleInkwell = 4;
constexpr unsigned short kMaxPriority = 65535;
constexpr unsigned int kContinue = 1;
constexpr unsigned int kInvalidInputType = 0x0103;
// Warm motors and exceeded limits: the vendor reduces the force itself and continues.
constexpr unsigned int kFirstHarmless = 0x0200, kLastHarmless = 0x0204;

struct Api {
  HdHandle (*init_device)(const char*);
  void (*disable_device)(HdHandle);
  void (*make_current)(HdHandle);
  void (*begin_frame)(HdHandle);
  void (*end_frame)(HdHandle);
  ErrorInfo (*get_error)();
  const char* (*get_error_string)(unsigned int);
  void (*enable)(Enum);
  void (*get_integers)(Enum, int*);
  void (*get_doubles)(Enum, double*);
  void (*set_doubles)(Enum, const double*);
  const char* (*get_string)(Enum);
  Enum (*check_calibration)();
  void (*update_calibration)(Enum);
  void (*start_scheduler)();
  void (*stop_scheduler)();
  SchedulerHandle (*schedule)(Callback, void*, unsigned short);
  void (*unschedule)(SchedulerHandle);
};

// Loads once for a process, see vendor_library.h.
Api load();
// Clears the stack of errors, which is shared by all devices.
void forget_errors(const Api& api);
const char* remedy(unsigned int code);
// Opens the device of this name; empty: the default device. Throws DeviceError.
HdHandle init(const Api& api, const std::string& name);
std::string string_of(const Api& api, Enum what);

}  // namespace stylet::hal::openhaptics
