// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/slurm_client.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "dem4grm/campaign/command_output.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/results/json_text.hpp"
#include "dem4grm/results/output_file.hpp"

namespace dem {
namespace {

std::string trimmed_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text.substr(std::min(text.find_first_not_of(" \n"), text.size()));
}

/// The output of a program of Slurm that must succeed.
std::string ask_slurm(const std::vector<std::string>& command) {
  const CommandOutput output = output_of(command);
  if (output.exit_code == 0) return output.out;
  throw IoError(fmt::format("{} failed with code {}: {}", fmt::join(command, " "), output.exit_code,
                            trimmed_line(output.err.empty() ? output.out : output.err)));
}

bool is_of_one_of(const std::string& job, const std::vector<SlurmJob>& jobs) {
  return std::any_of(jobs.begin(), jobs.end(), [&](const SlurmJob& j) { return j.id == job; });
}

}  // namespace

int largest_array_index() {
  std::istringstream lines(ask_slurm({"scontrol", "show", "config"}));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("MaxArraySize")) continue;
    const std::string number = trimmed_line(line.substr(line.find('=') + 1));
    int size = 0;
    std::from_chars(number.data(), number.data() + number.size(), size);
    if (size > 1) return size - 1;
  }
  throw IoError("scontrol show config names no MaxArraySize: this Slurm takes no job arrays");
}

void submit(const std::vector<SlurmArray>& arrays, const std::filesystem::path& folder, std::vector<SlurmJob>& jobs) {
  const std::size_t before = jobs.size();
  for (const SlurmArray& array : arrays) {
    std::vector<std::string> command{"sbatch", "--parsable"};
    if (array.after_array >= 0) {
      const std::string& id = jobs[before + static_cast<std::size_t>(array.after_array)].id;
      command.push_back(array.after_index < 0 ? fmt::format("--dependency=afterany:{}", id)
                                              : fmt::format("--dependency=afterany:{}_{}", id, array.after_index));
    }
    command.push_back((folder / array.file).string());
    // "1234", on a federation "1234;cluster".
    const std::string answer = trimmed_line(ask_slurm(command));
    jobs.push_back({answer.substr(0, answer.find(';')), array.file, array.names, array.prepares});
  }
}

std::map<std::string, SlurmElement> ask_queue(const std::vector<SlurmJob>& jobs) {
  std::map<std::string, SlurmElement> found;
  if (jobs.empty()) return found;
  // Asking for a job that Slurm has forgotten is an error, so all jobs of the user are asked for.
  std::istringstream lines(ask_slurm({"squeue", "--me", "--noheader", "--array", "--format=%F|%K|%T|%r"}));
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream parts(line);
    for (std::string field; std::getline(parts, field, '|');) fields.push_back(trimmed_line(field));
    if (fields.size() < 4 || !is_of_one_of(fields[0], jobs)) continue;
    const std::string job = fields[0] + "_" + fields[1];
    found[job] = {job, fields[2], fields[3] == "None" ? "" : fields[3]};
  }
  return found;
}

std::vector<SlurmJob> read_jobs(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {};
  const JsonObject record = read_json_file(path);
  const JsonValue* field = find_field(record, "jobs");
  const auto* list = field == nullptr ? nullptr : std::get_if<JsonList>(&field->data);
  if (list == nullptr)
    throw IoError(fmt::format("{}: is damaged; remove it when no job of the campaign is left", path.string()));
  std::vector<SlurmJob> jobs;
  for (const JsonValue& item : *list) {
    const auto* object = std::get_if<JsonObject>(&item.data);
    if (object == nullptr) continue;
    SlurmJob job{text_in(*object, "id"), text_in(*object, "file"), {}, is_set_in(*object, "prepares")};
    if (const JsonValue* names = find_field(*object, "tests")) {
      if (const auto* texts = std::get_if<JsonList>(&names->data)) {
        for (const JsonValue& name : *texts) {
          if (const auto* text = std::get_if<std::string>(&name.data)) job.names.push_back(*text);
        }
      }
    }
    jobs.push_back(std::move(job));
  }
  return jobs;
}

void write_jobs(const std::filesystem::path& path, const std::vector<SlurmJob>& jobs) {
  JsonList list;
  for (const SlurmJob& job : jobs) {
    list.emplace_back(JsonObject{{"id", job.id}, {"file", job.file}, {"prepares", job.prepares}, {"tests", job.names}});
  }
  replace_file(path, json_text(JsonObject{{"jobs", list}}));
}

}  // namespace dem
