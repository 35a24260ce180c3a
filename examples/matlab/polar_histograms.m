% SPDX-License-Identifier: BSD-3-Clause
% Polar histograms of contacts and forces with their fits (Figs. 12 to 14): polar_histograms('runs/quick', [0 8], 'polar.png')
%
% The fit is mean (1 + a cos k (theta - theta_a)), k = 2 for contacts and normal forces, 4 for tangential forces; `dem4grm micro` prints the same.
function polar_histograms(folder, displacements_mm, picture)
  drawing = figure('visible', 'off');
  names = {'contacts', 'normal force', 'tangential force'};
  orders = [2 2 4];
  bins = 18;  % of 10 degrees on the half circle: a contact looks the same from both sides
  width = pi / bins;
  for column = 1:numel(displacements_mm)
    contacts = read_contacts(folder, displacements_mm(column));
    angle = mod(atan2(contacts.normal(3, :), contacts.normal(1, :)), pi);  % from x, the shear direction
    bin = min(floor(angle / width), bins - 1)' + 1;
    count = accumarray(bin, 1, [bins 1]);
    tangential = sqrt(sum(contacts.shear_force .^ 2, 1));
    values = [count / (2 * sum(count) * width), accumarray(bin, contacts.normal_force', [bins 1]) ./ count, ...
              accumarray(bin, tangential', [bins 1]) ./ count];
    fprintf('%.2f mm', contacts.displacement_mm);
    for row = 1:3
      subplot(3, numel(displacements_mm), (row - 1) * numel(displacements_mm) + column)
      [average, amplitude, direction] = fit(values(:, row), orders(row), width);
      draw(values(:, row), width, average, amplitude, direction, orders(row));
      title(sprintf('%.2f mm: %s, %.3f at %.0f', contacts.displacement_mm, names{row}, amplitude, direction * 180 / pi), 'FontSize', 8);
      fprintf('; %.4f at %.2f degrees', amplitude, direction * 180 / pi);
    end
    fprintf('\n');
  end
  save_picture(drawing, picture, 8 * numel(displacements_mm), 24);
end

function [average, amplitude, direction] = fit(values, order, width)
  centre = ((1:numel(values))' - 0.5) * width;
  there = ~isnan(values);
  columns = [ones(size(centre)), cos(order * centre), sin(order * centre)];
  part = columns(there, :) \ values(there);
  smeared = sin(order * width / 2) / (order * width / 2);  % what the width of the bins takes from the amplitude
  average = part(1);
  amplitude = hypot(part(2), part(3)) / average / smeared;
  direction = mod(atan2(part(3), part(2)) / order, 2 * pi / order);
end

function draw(values, width, average, amplitude, direction, order)
  hold on
  values(isnan(values)) = 0;
  for k = 1:2 * numel(values)
    value = values(mod(k - 1, numel(values)) + 1);
    edge = linspace((k - 1) * width, k * width, 8);
    patch([0, value * cos(edge)], [0, value * sin(edge)], [0.73 0.64 0.50], 'EdgeColor', 'w');
  end
  theta = linspace(0, 2 * pi, 361);
  radius = average * (1 + amplitude * cos(order * (theta - direction)));
  plot(radius .* cos(theta), radius .* sin(theta), 'Color', [0.19 0.28 0.37], 'LineWidth', 1.5);
  axis equal
  axis off
end
