// SPDX-License-Identifier: Apache-2.0
// Prints the lattice's values of all bodies, in the columns of calculix.csv (for plot.py).

#include <cstdio>

#include "bodies.h"

int main() {
  using namespace stylet::test;
  const Bodies bodies = read_bodies(STYLET_CALCULIX_FOLDER "/bodies.json");
  std::printf("case,poisson_ratio,edge_m,quantity,value\n");
  for (const BodyCase& body : bodies.cases) {
    for (const double poisson : bodies.poisson_ratios) {
      for (const double edge_m : body.voxel_edges_m) {
        for (const auto& [quantity, value] : solve_body(bodies, body, poisson, edge_m)) {
          std::printf("%s,%g,%g,%s,%.6g\n", body.name.c_str(), poisson, edge_m, quantity.c_str(),
                      value);
        }
      }
    }
  }
  return 0;
}
