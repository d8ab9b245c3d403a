// SPDX-License-Identifier: Apache-2.0
// The processor's name, with family and model, because cloud providers give many processors the
// same name.
#pragma once

#include <fstream>
#include <string>

namespace stylet::test {

inline std::string processor_name() {
  std::ifstream cpus("/proc/cpuinfo");
  std::string line, name = "unknown processor", family, model;
  const auto value = [](const std::string& text) { return text.substr(text.find(':') + 2); };
  while (std::getline(cpus, line) && !line.empty()) {
    if (line.rfind("model name", 0) == 0) {
      name = value(line);
    } else if (line.rfind("model", 0) == 0) {
      model = value(line);
    } else if (line.rfind("cpu family", 0) == 0) {
      family = value(line);
    }
  }
  return model.empty() ? name : name + ", family " + family + " model " + model;
}

}  // namespace stylet::test
