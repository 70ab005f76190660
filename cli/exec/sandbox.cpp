#include "cli/exec/sandbox.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>
#include <system_error>

#include "cli/exec/private_network.hpp"
#include "cli/exec/program.hpp"
#include "protocol/text/printable.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "bwrap";
// Memory that it may use as files, in bytes, in each place that it can write to.
constexpr const char* kWritableBytes = "67108864";

/// Without the files of /etc that only some users may read, and without home folders.
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

bool has_sandbox() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((folder + "/" + kProgram).c_str(), X_OK) == 0) return true;
  return false;
}

/// The error message of bubblewrap for a program that does nothing; empty if it ended well.
std::string complaint(const std::optional<ProgramUser>& user) {
  const PrivateNetwork network(user);
  ProgramSettings settings;
  settings.command = sandboxed({"true"}, {}, "");
  settings.network = &network;
  settings.user = user;
  settings.is_stranger = true;
  asio::io_context io;
  std::string said;
  ProgramEnd ended;
  Program program(io, settings, [&](int, std::string_view text) { said += text; });
  program.on_end([&](const ProgramEnd& end) { ended = end; });
  io.run();
  if (ended.is_good()) return "";
  return said.empty() ? to_text(ended) : printable_line(said.substr(0, said.find('\n')));
}

}  // namespace

// The folder of the Python package: beside the data if installed, with the clients in a checkout.
std::string python_package() {
  const fs::path data = data_folder();
  std::error_code error;
  for (const fs::path& each : {data / "python" / "xr3", data / ".." / "clients" / "python" / "xr3"})
    if (fs::is_directory(each, error)) return fs::canonical(each, error);
  return "";
}

void require_sandbox(const std::optional<ProgramUser>& user, const std::string& without) {
  if (!has_sandbox())
    throw FileError("the sandbox needs bubblewrap (Debian package bubblewrap); install it, or " +
                    without);
  std::string why;
  try {
    why = complaint(user);
  } catch (const std::system_error& error) {
    why = error.what();
  }
  if (!why.empty())
    throw FileError("the sandbox cannot be made: " + why +
                    "; allow user namespaces (sysctl user.max_user_namespaces, or the settings of "
                    "the container), or " +
                    without);
}

std::vector<std::string> sandboxed(const std::vector<std::string>& command,
                                   const std::vector<Binding>& bindings, const std::string& pty) {
  std::vector<std::string> all{kProgram,         "--die-with-parent",
                               "--unshare-user", "--unshare-pid",
                               "--unshare-ipc",  "--unshare-uts",
                               "--new-session",  "--unshare-cgroup-try",
                               "--cap-drop",     "ALL"};
  for (const char* each : kSystem) add(all, {"--ro-bind-try", each, each});
  add(all, {"--proc", "/proc", "--ro-bind", "/proc/sys", "/proc/sys", "--dev", "/dev"});
  add(all, {"--setenv", "HOME", "/tmp"});
  add_writable(all, "/dev/shm");
  add_writable(all, "/tmp");
  const std::string here = fs::current_path();
  add_current_folder(all, here);
  for (const Binding& each : bindings) add(all, {"--ro-bind", each.from, each.to});
  if (!pty.empty()) add(all, {"--dev-bind", pty, kSandboxPty});
  add(all, {"--remount-ro", "/dev", "--remount-ro", "/", "--chdir", here, "--"});
  all.insert(all.end(), command.begin(), command.end());
  return all;
}

}  // namespace xr3
