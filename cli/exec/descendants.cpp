#include "cli/exec/descendants.hpp"

#include <dirent.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "cli/exec/throw_errno.hpp"

namespace xr3 {
namespace {

::pid_t parent_of(::pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  return parent_in(file);
}

/// The names in a folder of /proc that are numbers.
std::vector<::pid_t> numbers_in(const std::string& path) {
  const auto close = [](DIR* folder) { ::closedir(folder); };
  const std::unique_ptr<DIR, decltype(close)> folder(::opendir(path.c_str()), close);
  std::vector<::pid_t> found;
  if (!folder) return found;
  while (const dirent* entry = ::readdir(folder.get()))
    if (const auto number = static_cast<::pid_t>(std::strtol(entry->d_name, nullptr, 10)))
      found.push_back(number);
  return found;
}

std::vector<::pid_t> scanned_children_of(::pid_t parent) {
  std::vector<::pid_t> found = numbers_in("/proc");
  std::erase_if(found, [&](::pid_t each) { return parent_of(each) != parent; });
  return found;
}

/// The children of a process. Call repeatedly: a child that has ended may have started another one
/// that is not in the list yet. The kernel's lists, one for each thread, are much quicker than a
/// search through all processes, and so find more of a chain of processes that start each other.
std::vector<::pid_t> children_of(::pid_t parent) {
  static const bool has_lists = ::access("/proc/thread-self/children", R_OK) == 0;
  if (!has_lists) return scanned_children_of(parent);
  std::vector<::pid_t> found;
  const std::string tasks = "/proc/" + std::to_string(parent) + "/task";
  for (const ::pid_t task : numbers_in(tasks)) {
    std::ifstream list(tasks + "/" + std::to_string(task) + "/children");
    for (::pid_t process = 0; list >> process;) found.push_back(process);
  }
  return found;
}

}  // namespace

::pid_t parent_in(std::istream& stat) {
  std::string text;  // the name of the program in it may hold any byte but 0
  std::getline(stat, text, '\0');
  const std::size_t name_end = text.rfind(')');
  int parent = 0;
  char state = 0;
  if (name_end == std::string::npos ||
      std::sscanf(text.c_str() + name_end + 1, " %c %d", &state, &parent) != 2)
    return 0;
  return state == 'Z' ? 0 : parent;
}

void adopt_orphans() {
  if (::prctl(PR_SET_CHILD_SUBREAPER, 1) != 0) throw_errno("prctl(PR_SET_CHILD_SUBREAPER)");
}

std::vector<::pid_t> descendants() {
  std::vector<::pid_t> found = children_of(::getpid());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::vector<::pid_t> its = children_of(found[i]);
    found.insert(found.end(), its.begin(), its.end());
  }
  return found;
}

void end_children(WallNs deadline, ::pid_t kept) {
  constexpr int kLooks = 2;
  for (int empty = 0; empty < kLooks && wall_now() < deadline;) {
    std::vector<::pid_t> found = children_of(::getpid());
    if (parent_of(kept) == 0) std::erase(found, kept);
    empty = found.empty() ? empty + 1 : 0;
    for (const ::pid_t process : found) {
      ::kill(process, SIGKILL);
      if (process != kept) ::waitpid(process, nullptr, WNOHANG);
    }
  }
}

void reap_children(::pid_t kept) {
  for (;;) {
    siginfo_t info{};
    if (::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == 0) return;
    if (info.si_pid == kept) return;  // reaped by its owner; others are found the next time
    ::waitpid(info.si_pid, nullptr, WNOHANG);
  }
}

}  // namespace xr3
