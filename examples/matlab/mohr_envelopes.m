% SPDX-License-Identifier: BSD-3-Clause
% Peak strength of a study with its envelopes: mohr_envelopes('runs/quick-study/collected', 'envelopes.png')
function mohr_envelopes(collected, picture)
  tests = read_table(fullfile(collected, 'tests.csv'));
  envelopes = read_table(fullfile(collected, 'envelopes.csv'));
  drawing = figure('visible', 'off');
  hold on
  rows = find(strcmp(envelopes.quantity, 'peak'));
  colours = lines(numel(rows));
  names = cell(1, numel(rows));
  curves = zeros(1, numel(rows));
  for k = 1:numel(rows)
    content = envelopes.rubber_content(rows(k));
    phi = envelopes.friction_angle_deg(rows(k));
    cohesion = envelopes.cohesion_kPa(rows(k));
    members = tests.rubber_content == content;
    sigma = tests.normal_stress_mean_kPa(members);
    plot(sigma, tests.peak_shear_stress_kPa(members), 'o', 'Color', colours(k, :));
    along = [0, 1.05 * max(sigma)];
    curves(k) = plot(along, cohesion + along * tan(phi * pi / 180), 'Color', colours(k, :));
    names{k} = sprintf('VRC %.0f %%: %.0f degrees, %.0f kPa', 100 * content, phi, cohesion);
    fprintf('peak, VRC %.0f %%: phi %.2f degrees, c %.2f kPa\n', 100 * content, phi, cohesion);
  end
  xlabel('normal stress, kPa'), ylabel('peak shear stress, kPa'), box on
  legend(curves, names, 'Location', 'northwest');
  save_picture(drawing, picture, 14, 11);
end
