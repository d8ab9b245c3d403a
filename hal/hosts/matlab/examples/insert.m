% SPDX-License-Identifier: Apache-2.0
% A needle in an organ, from MATLAB or Octave: 20 mm into it at 10 mm/s from above, and the force on
% the way. insert (organ_file) prints and draws it; insert (organ_file, "no") only prints.
function insert (organ_file, draw)
  addpath (fileparts (fileparts (mfilename ("fullpath"))));
  s = stylet_open (organ_file, struct ("bending_nm2", 0.02));

  % From above the middle of the organ, straight down; the tip begins 1 mm above the skin.
  down = [0; 0; -1];
  at = [(s.organ.low_m(1:2) + s.organ.high_m(1:2)) / 2; s.organ.high_m(3) + 0.01];
  to_skin_m = stylet_mex ("raycast", s.organ_handle, at, down);
  at(3) = at(3) - (to_skin_m - 1e-3);

  tick = 0:2100;
  tips = at + down * (10e-3 * 1e-3 * tick);
  out = stylet_run (s, tips, down);
  for i = 1:100:numel (tick)
    fprintf ("%6.2f mm  %6.3f N\n", 1e3 * out.depth_m(i), out.force_n(3, i));
  end
  if (nargin < 2)
    plot (1e-3 * tick, out.force_n(3, :));
    xlabel ("time, s");
    ylabel ("force on the hand, N");
  end
  [~, ~, events] = stylet_look (s);
  for e = events'
    fprintf ("tick %d: %s, %.3f N\n", e.tick, e.kind, e.force_n);
  end
  stylet_close (s);
end
