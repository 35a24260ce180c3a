% SPDX-License-Identifier: BSD-3-Clause
% Writes a figure as PNG, width x height in cm, without a window.
function save_picture(figure_handle, file, width, height)
  set(figure_handle, 'PaperUnits', 'centimeters', 'PaperPosition', [0 0 width height], 'PaperSize', [width height]);
  print(figure_handle, file, '-dpng', '-r150');
  close(figure_handle);
  fprintf('%s\n', file);
end
