% SPDX-License-Identifier: Apache-2.0
% out = stylet_run (s, tips, direction)   a tick for each column of tips (3 x n, m): where the tip
%                                         of the unbent needle is held; it points along direction
% out = stylet_run (s, poses)             the same with poses of the handle, 7 x n: position, wxyz
%
% An eighth row of poses is the force on a syringe's plunger.
%
% The fields of out have one column for each tick: force_n and torque_nm on the hand, tip_m,
% depth_m, phase (0 free, 1 contact, 2 inserted, 3 retracting), layer (number of the material from
% 1; NaN outside), flags, friction_n; and for the fluid hub_pa, opening_pa, flow_m3_per_s,
% injected_m3, plunger_m.
function out = stylet_run (s, places, direction)
  if (nargin == 3)
    places = stylet_mex ("pose_of_tip", places, direction, s.length_m);
  end
  out = stylet_mex ("run", s.handle, places);
end
