#include "cli/exec/sandbox.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace xr3 {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "bwrap";
// Memory that it may use as files, in bytes, in each place that it can write to.
constexpr const char* kWritableBytes = "67108864";

/// Without the files of /etc that only some may read, and without home folders.
constexpr const char* kSystem[] = {"/usr",
                                   "/bin",
                                   "/sbin",
                                   "/lib",
                                   "/lib32",
                                   "/lib64",
                                   "/libx32",
                                   "/opt",
                                   "/etc/alternatives",
                                   "/etc/ld.so.cache",
                                   "/etc/ld.so.conf",
                                   "/etc/ld.so.conf.d",
                                   "/etc/passwd",
                                   "/etc/group",
                                   "/etc/nsswitch.conf",
                                   "/etc/localtime",
                                   "/etc/fonts",
                                   "/etc/java-17-openjdk",
                                   "/etc/python3"};

void add(std::vector<std::string>& command, std::initializer_list<std::string> more) {
  command.insert(command.end(), more);
}

void add_writable(std::vector<std::string>& command, const std::string& folder) {
  add(command, {"--size", kWritableBytes, "--tmpfs", folder});
}

/// The current folder is empty and writable, unless the system's own files are in it.
void add_current_folder(std::vector<std::string>& command, const std::string& here) {
  const std::string inside = here.ends_with('/') ? here : here + "/";
  for (const std::string each : kSystem)
    if ((each + "/").starts_with(inside)) return add(command, {"--dir", here});
  add_writable(command, here);
}

/// Files that the program's own command names, and those that the user adds.
void add_readable(std::vector<std::string>& command, const std::string& name) {
  std::error_code error;
  const fs::path path = fs::absolute(name, error);
  if (error || name.empty() || !fs::exists(path, error)) return;
  add(command, {"--ro-bind", path.lexically_normal(), path.lexically_normal()});
}

}  // namespace

bool has_sandbox() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((folder + "/" + kProgram).c_str(), X_OK) == 0) return true;
  return false;
}

std::vector<std::string> sandboxed(const std::vector<std::string>& command,
                                   const std::vector<std::string>& readable,
                                   const std::string& pty) {
  std::vector<std::string> all{kProgram,        "--die-with-parent", "--unshare-pid",
                               "--unshare-ipc", "--unshare-uts",     "--unshare-cgroup-try",
                               "--new-session", "--cap-drop",        "ALL"};
  for (const char* each : kSystem) add(all, {"--ro-bind-try", each, each});
  add(all, {"--proc", "/proc", "--dev", "/dev", "--setenv", "HOME", "/tmp"});
  add_writable(all, "/dev/shm");
  add_writable(all, "/tmp");
  const std::string here = fs::current_path();
  add_current_folder(all, here);
  for (const std::string& each : command) add_readable(all, each);
  for (const std::string& each : readable) add_readable(all, each);
  add(all, {"--dev-bind", pty, kSandboxPty});
  add(all, {"--remount-ro", "/dev", "--remount-ro", "/", "--chdir", here, "--"});
  all.insert(all.end(), command.begin(), command.end());
  return all;
}

}  // namespace xr3
