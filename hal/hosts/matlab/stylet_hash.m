% SPDX-License-Identifier: Apache-2.0
% h = stylet_hash (s)   uint64 of the whole state: the same on every machine for the same ticks
function h = stylet_hash (s)
  h = stylet_mex ("hash", s.handle);
end
