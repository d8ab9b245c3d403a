// SPDX-License-Identifier: Apache-2.0
// Sorting at creation, by a heap: std::sort, which grows with every type and order that it is
// given, was 6 kB of a page's library.
//
// Promises: no allocation; n log n for any input. Elements of which none comes before the other may
// end up in any order.
#pragma once

#include <algorithm>

namespace stylet {

template <typename Element, typename Before>
void sort(Element* first, Element* end, Before before) {
  std::partial_sort(first, end, end, before);
}

}  // namespace stylet
