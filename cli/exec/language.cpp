#include "cli/exec/language.hpp"

#include <unistd.h>

#include <map>

#include "server/files/data_files.hpp"

namespace xr3 {

std::vector<std::string> start_command(const std::filesystem::path& program,
                                       const std::string& built, const std::string& headers) {
  static const std::map<std::string, std::string> interpreters{
      {".py", "python3"}, {".js", "node"}, {".mjs", "node"}, {".sh", "sh"}, {".m", "octave-cli"}};
  const std::string end = program.extension();
  if (end == ".c") {
    constexpr const char* kBuild = R"(cc -std=c11 -I "$2" -I "$3" -o "$1" "$0" -lm && exec "$1")";
    return {"sh", "-c", kBuild, program, built, program.parent_path(), headers};
  }
  if (const auto found = interpreters.find(end); found != interpreters.end())
    return {found->second, program};
  if (::access(program.c_str(), X_OK) == 0) return {program};
  std::string known = ".c";
  for (const auto& [each, interpreter] : interpreters) known += ", " + each;
  throw FileError(program.string() + ": is not executable, and its name does not end in one of " +
                  known);
}

}  // namespace xr3
