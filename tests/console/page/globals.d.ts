// SPDX-License-Identifier: Apache-2.0
// What run.mjs defines for all tests.
declare const kPage: string;      // folder of the page
declare const kChromium: string;  // program
