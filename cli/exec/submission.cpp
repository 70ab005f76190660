#include "cli/exec/submission.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

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

}  // namespace

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
