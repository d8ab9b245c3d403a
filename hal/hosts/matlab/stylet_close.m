% SPDX-License-Identifier: Apache-2.0
% stylet_close (s)   frees the organ and the simulation that stylet_open made
function stylet_close (s)
  stylet_mex ("free", s.handle);
  stylet_mex ("free", s.organ_handle);
end
