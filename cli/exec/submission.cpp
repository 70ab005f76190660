#include "cli/exec/submission.hpp"

#include <algorithm>
#include <iomanip>
#include <system_error>
#include <vector>

#include "cell/sha256.hpp"
#include "protocol/text/text_stream.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

bool is_within(const fs::path& folder, const fs::path& link) {
  std::error_code error;
  const fs::path target = fs::canonical(link, error);
  if (error) return false;
  return std::mismatch(folder.begin(), folder.end(), target.begin(), target.end()).first ==
         folder.end();
}

// The contents of a larger file are not read: SHA-256 of this much takes 0.2 s.
constexpr std::size_t kMostHashed = std::size_t{16} << 20U;

std::string digest_of(const fs::path& file) {
  TextStream text;
  for (const int byte : sha256_bytes(read_file(file, kMostHashed).text))
    text << std::hex << std::setw(2) << std::setfill('0') << byte;
  return text.str();
}

/// Errors are those of a file that is being removed or changed.
std::string line_of(const fs::path& file, const fs::path& name) try {
  const auto size = fs::file_size(file);
  const auto changed = fs::last_write_time(file).time_since_epoch().count();
  const std::string what = size > kMostHashed ? std::to_string(changed) : digest_of(file);
  return what + " " + std::to_string(size) + " " + name.string() + "\n";
} catch (const std::runtime_error& error) {
  return std::string(error.what()) + "\n";
}

std::vector<std::string> lines_of(const fs::path& folder) {
  std::vector<std::string> lines;
  const fs::recursive_directory_iterator entries(folder);
  for (auto each = begin(entries); each != end(entries); ++each) {
    const bool is_kept = !is_by_the_way(each->path());
    if (!is_kept) each.disable_recursion_pending();
    if (is_kept && each->is_regular_file())
      lines.push_back(line_of(each->path(), each->path().lexically_relative(folder)));
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

}  // namespace

bool is_by_the_way(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with('.') || name == "__pycache__";
}

std::string files_of(const fs::path& submission) {
  std::string text = why_refused(submission);
  if (!text.empty()) return text + "\n";
  if (!fs::is_directory(submission)) return line_of(submission, submission.filename());
  for (const std::string& line : lines_of(submission)) text += line;
  return text;
}

std::string why_refused(const fs::path& submission) try {
  const std::string name = submission.filename().string();
  if (fs::is_symlink(submission))
    return name + " is a symbolic link; a submission is a file or a folder of its own";
  if (!fs::is_regular_file(submission) && !fs::is_directory(submission))
    return name + " is neither a file nor a folder";
  if (!fs::is_directory(submission)) return "";
  const fs::path folder = fs::canonical(submission);
  for (const fs::directory_entry& each : fs::recursive_directory_iterator(submission))
    if (each.is_symlink() && !is_within(folder, each))
      return (name / each.path().lexically_relative(submission)).string() +
             " is a symbolic link that leads out of the submission";
  return "";
} catch (const fs::filesystem_error& error) {
  return error.path1().string() + ": cannot be read: " + error.code().message();
}

std::optional<fs::path> main_of(const fs::path& submission, const std::string& main) {
  if (main.empty() || !fs::is_directory(submission)) return submission;
  if (fs::is_regular_file(submission / main)) return submission / main;
  std::vector<fs::path> alike;
  for (const fs::directory_entry& each : fs::directory_iterator(submission))
    if (each.is_regular_file() && each.path().extension() == fs::path(main).extension())
      alike.push_back(each.path());
  if (alike.size() != 1) return std::nullopt;
  return alike.front();
}

}  // namespace xr3
