% SPDX-License-Identifier: GPL-3.0-or-later
% A recording of Stylet (stylet run SCENE --record out.h5): prints its phases, and draws force
% against time by cause, and against depth. For MATLAB, and for GNU Octave, which reads the same
% file with load.
%
%   recording('out.h5')
%   recording('out.h5', 'curves.png')     % writes the picture instead of showing it
%   curves = recording('out.h5', '');     % only the numbers: s, mm and N
%
% One column a tick, SI units in the file, the frame of the organ at rest. The first needle's.
function curves = recording(file, picture)
  causes = {'stiffness', 'cutting', 'friction', 'clamping', 'obstacle'};
  if exist('h5read', 'file') || exist('h5read', 'builtin')
    read = @(path) h5read(file, ['/' path]);
    period_s = double(h5readatt(file, '/', 'config_period_s'));
  else
    all = load('-hdf5', file, 'output', 'needles', 'events');
    read = @(path) fetch(all, path);
    period_s = 1e-3;  % an attribute, which Octave does not read: change it for another period
  end
  direction = double(read('needles/direction'));
  direction = direction(:, 1)';

  % Along the direction of insertion; what resists the way in is positive.
  axial = @(name) -direction * double(read(['output/' name '_n']));
  curves.time_s = double(read('output/tick'));
  curves.time_s = curves.time_s(:)' * period_s;
  curves.depth_mm = 1e3 * double(read('output/depth_m'));
  curves.depth_mm = curves.depth_mm(:)';
  curves.phase = double(read('output/phase'));
  curves.phase = curves.phase(:)';
  curves.force_n = axial('force');
  for i = 1:numel(causes)
    curves.causes_n.(causes{i}) = axial(causes{i});
  end

  print_phases(curves);
  if nargin < 2
    draw(curves, causes, figure());
  elseif ~isempty(picture)
    shown = figure('visible', 'off');
    draw(curves, causes, shown);
    print(shown, picture, '-dpng');
  end
end

function value = fetch(all, path)
  parts = strsplit(path, '/');
  value = all.(parts{1}).(parts{2});
end

% As the kernel sees them.
function print_phases(curves)
  names = {'free', 'contact', 'inserted', 'retracting'};
  edges = [1, find(diff(curves.phase) ~= 0) + 1, numel(curves.phase) + 1];
  fprintf('%-11s%9s%9s%10s%9s%9s\n', 'phase', 'from s', 'to s', 'depth mm', 'peak N', 'mean N');
  for i = 1:numel(edges) - 1
    part = edges(i):edges(i + 1) - 1;
    force = curves.force_n(part);
    [~, at] = max(abs(force));
    fprintf('%-11s%9.3f%9.3f%10.2f%9.3f%9.3f\n', names{curves.phase(part(1)) + 1}, ...
            curves.time_s(part(1)), curves.time_s(part(end)), max(curves.depth_mm(part)), ...
            force(at), mean(force));
  end
end

function draw(curves, causes, in)
  % Of each cause, of the total, the way in and out, as in every other figure (hal/palette.csv).
  colours = [0 114 178; 194 78 0; 0 158 115; 168 71 138; 92 61 0] / 255;
  total = [29 39 51] / 255;
  way_in = [51 34 136] / 255;
  way_out = [204 102 119] / 255;
  above = subplot(2, 1, 1, 'parent', in);
  plot(above, curves.time_s, curves.force_n, 'color', total, 'linewidth', 1.6);
  hold(above, 'on');
  for i = 1:numel(causes)
    plot(above, curves.time_s, curves.causes_n.(causes{i}), 'color', colours(i, :));
  end
  legend(above, [{'total'}, causes]);
  xlabel(above, 'Time / s');
  ylabel(above, 'Axial force on the needle / N');
  below = subplot(2, 1, 2, 'parent', in);
  [~, deepest] = max(curves.depth_mm);
  plot(below, curves.depth_mm(1:deepest), curves.force_n(1:deepest), 'color', way_in);
  hold(below, 'on');
  plot(below, curves.depth_mm(deepest:end), curves.force_n(deepest:end), 'color', way_out);
  legend(below, {'way in', 'way out'});
  xlabel(below, 'Depth in tissue / mm');
  ylabel(below, 'Axial force on the needle / N');
end
