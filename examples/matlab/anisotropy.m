% SPDX-License-Identifier: BSD-3-Clause
% Anisotropies, direction of the normal force and strong network in shear (Figs. 15 to 17): anisotropy('runs/quick', 'anisotropy.png')
function anisotropy(folder, picture)
  rows = read_table(fullfile(folder, 'micro.csv'));
  drawing = figure('visible', 'off');
  subplot(1, 3, 1)
  plot(rows.displacement_mm, rows.a_all, rows.displacement_mm, rows.a_n_all, rows.displacement_mm, rows.a_t_all);
  xlabel('shear displacement, mm'), ylabel('anisotropy'), legend({'a', 'a_n', 'a_t'});
  subplot(1, 3, 2)
  plot(rows.displacement_mm, rows.theta_n_all_deg, rows.displacement_mm, rows.stress_direction_deg);
  xlabel('shear displacement, mm'), ylabel('major axis, degrees'), ylim([0 180]), legend({'normal force', 'stress'});
  subplot(1, 3, 3)
  plot(rows.displacement_mm, [rows.strong_share_gg, rows.strong_share_gr, rows.strong_share_rr]);
  xlabel('shear displacement, mm'), ylabel('share of the strong contacts'), ylim([0 1]), legend({'g-g', 'g-r', 'r-r'});
  save_picture(drawing, picture, 30, 11);
  fprintf('at the end: a %.4f, a_n %.4f, theta_n %.2f degrees\n', rows.a_all(end), rows.a_n_all(end), rows.theta_n_all_deg(end));
end
