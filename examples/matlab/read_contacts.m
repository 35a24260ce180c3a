% SPDX-License-Identifier: BSD-3-Clause
% Contacts between grains of the stored state nearest to a displacement in mm, in SI units: normal (3 x n), normal_force (1 x n, compression
% positive), shear_force (3 x n), kind (1 x n: 0 gravel-gravel, 1 gravel-rubber, 2 rubber-rubber); and displacement_mm.
function contacts = read_contacts(folder, displacement_mm)
  facts = jsondecode(fileread(fullfile(folder, 'summary.json')));
  [~, nearest] = min(abs([facts.state_hashes.displacement_mm] - displacement_mm));
  place = sprintf('/frames/%04d', facts.state_hashes(nearest).frame);
  file = fullfile(folder, 'results.h5');
  read = @(name, rows) read_dataset(file, [place '/' name], rows);
  between = read('contacts/wall', 1) < 0;
  material = read('balls/material', 1);
  ball_i = read('contacts/ball_i', 1);
  ball_j = read('contacts/ball_j', 1);
  contacts.kind = material(ball_i(between) + 1) + material(ball_j(between) + 1);  % ids count from 0
  for name = {'normal', 'shear_force'}
    values = read(['contacts/' name{1}], 3);
    contacts.(name{1}) = values(:, between);
  end
  force = read('contacts/normal_force', 1);
  contacts.normal_force = force(between);
  contacts.displacement_mm = facts.state_hashes(nearest).displacement_mm;
end
