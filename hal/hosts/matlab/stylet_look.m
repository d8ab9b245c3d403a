% SPDX-License-Identifier: Apache-2.0
% [surface, needle, events] = stylet_look (s)
%
% The deformed surface (3 x n, m; the triangles are s.organ.triangles), the needle's shape from
% handle to tip (3 x n, m), and what happened: structs with tick, kind, layer, depth_m, force_n.
function [surface, needle, events] = stylet_look (s)
  surface = stylet_mex ("surface", s.handle);
  if (nargout > 1) needle = stylet_mex ("shape", s.handle); end
  if (nargout > 2) events = stylet_mex ("events", s.handle); end
end
