% SPDX-License-Identifier: Apache-2.0
% out = stylet_run (s, tips, direction)   a tick for each column of tips (3 x n, m), at which the
%                                         unbent needle's tip is held, pointing along direction
% out = stylet_run (s, poses)             the same with the handle's poses, 7 x n: position, w x y z
%
% An eighth row of poses is the force on a syringe's plunger.
%
% out has a column a tick: force_n and torque_nm on the hand, tip_m, depth_m, phase (0 free,
% 1 contact, 2 inserted, 3 retracting), layer (material from 1; NaN outside), flags, friction_n; and
% of the fluid hub_pa, opening_pa, flow_m3_per_s, injected_m3, plunger_m.
function out = stylet_run (s, places, direction)
  if (nargin == 3)
    places = stylet_mex ("pose_of_tip", places, direction, s.length_m);
  end
  out = stylet_mex ("run", s.handle, places);
end
