// SPDX-License-Identifier: Apache-2.0
// The interface in C from C++17: a second simulation goes on from where the first is.
#include <stylet/stylet.h>

#include <cstdio>

int main(int argc, char** argv) {
  stylet_organ* organ = nullptr;
  stylet_simulation* first = nullptr;
  stylet_simulation* second = nullptr;
  if (argc != 2 || stylet_organ_read(argv[1], &organ, nullptr) != STYLET_OK) return 1;
  if (stylet_simulation_create(organ, nullptr, nullptr, 0, &first, nullptr) != STYLET_OK) return 1;
  if (stylet_simulation_clone(first, &second) != STYLET_OK) return 1;
  const bool same = stylet_simulation_hash(first) == stylet_simulation_hash(second);
  stylet_simulation_free(first);
  stylet_simulation_free(second);
  stylet_organ_free(organ);
  std::printf("%s of %s\n", same ? "same" : "other", stylet_version_text());
}
