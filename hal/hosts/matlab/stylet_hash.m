% SPDX-License-Identifier: Apache-2.0
% h = stylet_hash (s)   hash of the whole state, uint64: the same for the same ticks everywhere
function h = stylet_hash (s)
  h = stylet_mex ("hash", s.handle);
end
