% SPDX-License-Identifier: Apache-2.0
% s = stylet_open (organ_file)
% s = stylet_open (organ_file, needle, config)
%
% Opens an organ and makes a simulation with one needle in it. needle and config are structs with
% those fields of stylet_needle and stylet_config (stylet.h) that differ from their defaults, for
% example struct ("bending_nm2", 0.02), or for breathing struct ("breathing_amplitude_m",
% [0 0 0.01], "breathing_period_s", 4). SI units.
%
% s.organ has name, voxel_edge_m, low_m, high_m, vertices (3 x n, m) and triangles (3 x n, indices
% from 1).
% stylet_close (s) frees both.
function s = stylet_open (organ_file, needle, config)
  if (nargin < 2) needle = struct (); end
  if (nargin < 3) config = struct (); end
  s.organ_handle = stylet_mex ("organ", organ_file);
  try
    s.organ = stylet_mex ("info", s.organ_handle);
    s.handle = stylet_mex ("simulation", s.organ_handle, needle, config);
  catch refused
    stylet_mex ("free", s.organ_handle);
    rethrow (refused);
  end
  s.length_m = 0.15;
  if (isfield (needle, "length_m")) s.length_m = needle.length_m; end
end
