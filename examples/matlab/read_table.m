% SPDX-License-Identifier: BSD-3-Clause
% Columns of a CSV file of DEM4GRM by name: numbers as column vectors, texts as cells.
function columns = read_table(file)
  lines = strsplit(strtrim(fileread(file)), sprintf('\n'));
  names = split_line(lines{1});
  cells = cell(numel(lines) - 1, numel(names));
  for row = 1:size(cells, 1)
    words = split_line(lines{row + 1});
    cells(row, 1:numel(words)) = words;
  end
  columns = struct();
  for k = 1:numel(names)
    if isfield(columns, names{k}), continue, end  % tests.csv: the value of the study stands before the measured one
    numbers = str2double(cells(:, k));            % an empty cell is not a number
    is_text = isnan(numbers) & ~cellfun(@isempty, cells(:, k)) & ~strcmpi(cells(:, k), 'nan');
    if any(is_text), columns.(names{k}) = cells(:, k); else, columns.(names{k}) = numbers; end
  end
end

function words = split_line(line)
  words = strtrim(strsplit(line, ',', 'CollapseDelimiters', false));
end
