// SPDX-License-Identifier: Apache-2.0
// What the page leaves for tests on its window (src/main.ts).
import type {Store} from '../../../hal/console/page/src/store';
import type {View3d} from '../../../hal/console/page/src/view3d/view3d';

export interface Hook {
  store: Store;
  view: () => View3d | null;
}
