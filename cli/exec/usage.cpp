#include "cli/exec/usage.hpp"

#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>

namespace xr3 {
namespace {

/// The folder in /proc of a living thread of a process, since the first thread may have ended
/// before the others. Empty if there is none.
std::string folder_of(::pid_t process) {
  const std::string tasks = "/proc/" + std::to_string(process) + "/task";
  std::error_code ended;
  std::filesystem::directory_iterator each(tasks, ended);
  for (; !ended && each != std::filesystem::directory_iterator(); each.increment(ended)) {
    std::ifstream statm(each->path() / "statm");
    if (std::uint64_t pages = 0; statm >> pages && pages > 0) return each->path();
  }
  return "";
}

/// The memory of the process with this folder, in which a page that n processes share counts as
/// 1/n; all of it if the process hides its maps.
std::uint64_t memory_of(const std::string& process) {
  constexpr std::uint64_t kKib = 1024;
  std::ifstream rollup(process + "/smaps_rollup");
  for (std::string word; rollup >> word;)
    if (std::uint64_t kib = 0; word == "Pss:" && rollup >> kib) return kib * kKib;
  std::ifstream statm(process + "/statm");
  std::uint64_t all = 0;
  std::uint64_t resident = 0;
  statm >> all >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Adds the files of a process's folders that are in memory and not yet in `counted`.
void add_files(const std::string& process, const std::vector<std::string>& folders,
               std::set<::dev_t>& counted, Usage& usage) {
  for (const std::string& folder : folders) {
    std::string path = process;
    path.append("/root").append(folder);
    struct ::statfs system {};
    struct ::stat its {};
    struct ::stat of_judge {};
    if (::statfs(path.c_str(), &system) != 0 || system.f_type != TMPFS_MAGIC) continue;
    const bool is_outside =
        ::stat(path.c_str(), &its) != 0 ||
        (::stat(folder.c_str(), &of_judge) == 0 && its.st_dev == of_judge.st_dev);
    if (is_outside || !counted.insert(its.st_dev).second) continue;
    usage.files += system.f_files - system.f_ffree;
    usage.memory_bytes +=
        (system.f_blocks - system.f_bfree) * static_cast<std::uint64_t>(system.f_bsize);
  }
}

}  // namespace

Usage usage_of(const std::vector<::pid_t>& processes, const std::vector<std::string>& folders) {
  Usage usage;
  usage.processes = processes.size();
  std::set<::dev_t> counted;
  for (const ::pid_t each : processes) {
    const std::string process = folder_of(each);
    if (process.empty()) continue;
    usage.memory_bytes += memory_of(process);
    if (counted.size() < folders.size()) add_files(process, folders, counted, usage);
  }
  return usage;
}

}  // namespace xr3
