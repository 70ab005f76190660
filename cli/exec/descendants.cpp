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

std::vector<::pid_t> children() {
  const Parents all = processes();
  std::vector<::pid_t> found;
  const auto [begin, end] = all.equal_range(::getpid());
  for (auto each = begin; each != end; ++each) found.push_back(each->second);
  return found;
}

std::size_t count_descendants() { return descendants().size(); }

void signal_descendants(int signal) {
  for (const ::pid_t process : descendants()) ::kill(process, signal);
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
