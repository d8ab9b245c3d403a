// SPDX-License-Identifier: Apache-2.0
import shared from 'stylet-wasm/stylet-threads.wasm?url';
import wasm from 'stylet-wasm/stylet.wasm?url';

import {serve} from './engine';

serve(fetch(wasm).then((answer) => answer.arrayBuffer()), shared);
