// SPDX-License-Identifier: Apache-2.0
// The doctor's findings as text, for people (100 columns) and for machines.
#pragma once

#include <string>
#include <vector>

#include "hal/doctor/doctor.h"
#include "hal/doctor/measure.h"

namespace stylet::app {

struct Measurement {
  const char* name;
  bool has_body;  // its cycles ran ticks of a recording, so measured.body is their time
  hal::Measured measured;
};

struct DoctorReport {
  std::string root;
  int cpu = 0, priority = 80;
  std::vector<hal::Finding> findings;
  std::vector<Measurement> measurements;
};

std::string json_text(const DoctorReport& report);
std::string human_text(const DoctorReport& report);

}  // namespace stylet::app
