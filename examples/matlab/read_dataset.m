% SPDX-License-Identifier: BSD-3-Clause
% A dataset of real numbers of results.h5, such as '/frames/0003/contacts/normal': one column for each row of the file, so a list of
% vectors is 3 x n. MATLAB reads it by itself; Octave, whose load stops at texts of free length, lets h5dump (package hdf5-tools) read it.
function values = read_dataset(file, place, rows)
  if exist('OCTAVE_VERSION', 'builtin') == 0
    values = double(h5read(file, place));
  else
    raw = [tempname() '.bin'];
    [status, said] = system(sprintf('h5dump -d "%s" -b NATIVE -o "%s" "%s" 2>&1', place, raw, file));
    if status ~= 0, error('%s: %s cannot be read: %s', file, place, said), end
    type = 'double';
    if ~isempty(regexp(said, 'H5T_STD_I32', 'once')), type = 'int32=>double'; end
    if ~isempty(regexp(said, 'H5T_STD_U8', 'once')), type = 'uint8=>double'; end
    from = fopen(raw, 'r');
    values = fread(from, Inf, type);
    fclose(from);
    delete(raw);
  end
  values = reshape(values, rows, []);
end
