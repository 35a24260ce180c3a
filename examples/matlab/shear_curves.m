% SPDX-License-Identifier: BSD-3-Clause
% Shear stress and rise of the plate of some tests (the article's Figs. 10 and 11): shear_curves({'runs/quick'}, 'curves.png')
function shear_curves(folders, picture)
  drawing = figure('visible', 'off');
  names = cell(size(folders));
  colours = lines(numel(folders));
  for k = 1:numel(folders)
    rows = read_table(fullfile(folders{k}, 'shear.csv'));
    facts = jsondecode(fileread(fullfile(folders{k}, 'summary.json')));
    names{k} = sprintf('VRC %.0f %%, %.0f kPa', 100 * facts.rubber_content, facts.normal_stress_target_kPa);
    subplot(1, 2, 1), hold on
    plot(rows.displacement_mm, rows.shear_stress_kPa, 'Color', colours(k, :));
    subplot(1, 2, 2), hold on
    plot(rows.displacement_mm, rows.vertical_displacement_mm, 'Color', colours(k, :));
    fprintf('%s: peak %.1f kPa at %.2f mm\n', folders{k}, facts.peak_shear_stress_kPa, facts.displacement_at_peak_mm);
  end
  subplot(1, 2, 1), xlabel('shear displacement, mm'), ylabel('shear stress, kPa'), box on
  legend(names, 'Location', 'southeast');
  subplot(1, 2, 2), xlabel('shear displacement, mm'), ylabel('rise of the plate, mm'), box on
  save_picture(drawing, picture, 24, 10);
end
