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
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "cli/exec/throw_errno.hpp"

namespace xr3 {
namespace {

using Parents = std::multimap<::pid_t, ::pid_t>;  // parent to child

::pid_t parent_of(::pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  return parent_in(file);
}

/// All processes that run, by their parents.
Parents processes() {
  const auto close = [](DIR* folder) { ::closedir(folder); };
  const std::unique_ptr<DIR, decltype(close)> folder(::opendir("/proc"), close);
  Parents all;
  if (!folder) return all;
  while (const dirent* entry = ::readdir(folder.get())) {
    const auto process = static_cast<::pid_t>(std::strtol(entry->d_name, nullptr, 10));
    if (process <= 0) continue;
    if (const ::pid_t parent = parent_of(process)) all.emplace(parent, process);
  }
  return all;
}

void add_descendants(const Parents& all, ::pid_t parent, std::vector<::pid_t>& found) {
  const auto [begin, end] = all.equal_range(parent);
  for (auto each = begin; each != end; ++each) {
    found.push_back(each->second);
    add_descendants(all, each->second, found);
  }
}

std::vector<::pid_t> descendants() {
  std::vector<::pid_t> found;
  add_descendants(processes(), ::getpid(), found);
  return found;
}

/// The children of this process, as a rule with those that have ended: they may have started another
/// one that is not in the list yet. The list of the kernel is much quicker than
/// looking through all processes, and so finds more of a chain of processes that start each other.
std::vector<::pid_t> children() {
  std::vector<::pid_t> found;
  const std::string own = std::to_string(::getpid());
  std::ifstream list("/proc/self/task/" + own + "/children");
  if (!list) {
    const Parents all = processes();
    const auto [begin, end] = all.equal_range(::getpid());
    for (auto each = begin; each != end; ++each) found.push_back(each->second);
  }
  for (::pid_t process = 0; list >> process;) found.push_back(process);
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

std::size_t count_descendants() { return descendants().size(); }

void end_children(WallNs deadline, ::pid_t kept) {
  constexpr int kLooks = 2;
  for (int empty = 0; empty < kLooks && wall_now() < deadline;) {
    std::vector<::pid_t> found = children();
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
