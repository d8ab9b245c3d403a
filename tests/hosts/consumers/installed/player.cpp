// SPDX-License-Identifier: Apache-2.0
// A program with the shared library loads a plugin that has the static ones inside, as an engine
// may load two versions of Stylet: each runs its own.
#include <dlfcn.h>
#include <stylet/stylet.h>

#include <cstdio>

int main(int argc, char** argv) {
  void* const plugin = argc == 3 ? dlopen(argv[1], RTLD_NOW | RTLD_GLOBAL) : nullptr;
  if (plugin == nullptr) return std::puts(argc == 3 ? dlerror() : "usage: player PLUGIN ORGAN"), 1;
  using Main = int (*)(int, char**);
  const auto insert = reinterpret_cast<Main>(dlsym(plugin, "main"));

  stylet_organ* organ = nullptr;
  stylet_simulation* simulation = nullptr;
  if (stylet_organ_read(argv[2], &organ, nullptr) != STYLET_OK) return 1;
  if (stylet_simulation_create(organ, nullptr, nullptr, 0, &simulation, nullptr) != STYLET_OK) {
    return 1;
  }
  const unsigned long long before = stylet_simulation_hash(simulation);
  const int code = insert(2, argv + 1);
  const bool untouched = before == stylet_simulation_hash(simulation);
  stylet_simulation_free(simulation);
  stylet_organ_free(organ);
  return untouched ? code : 1;
}
