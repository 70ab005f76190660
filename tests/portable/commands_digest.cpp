// Sends random commands to robots with the byte clock, and prints a digest of all replies and states:
// the same on every machine and by every compiler.
//
//   commands_digest DATA COMMANDS
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

#include "cell/cell.hpp"
#include "cell/digest.hpp"
#include "cell/recording/state_hash.hpp"
#include "protocol/files/robot.hpp"
#include "protocol/files/workcell.hpp"

namespace {

/// A digest of 128 bits that is not meant to resist anybody (two FNV-1a with other beginnings).
class Digest {
 public:
  void add(std::string_view text) {
    for (const char c : text) {
      for (std::uint64_t& half : halves_)
        half = (half ^ static_cast<unsigned char>(c)) * 1'099'511'628'211U;
    }
  }
  std::string text() const {
    std::array<char, 33> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx%016llx",
                  static_cast<unsigned long long>(halves_[0]),
                  static_cast<unsigned long long>(halves_[1]));
    return digits.data();
  }

 private:
  std::array<std::uint64_t, 2> halves_{14'695'981'039'346'656'037U, 1};
};

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

xr3::ModelPtr model(const std::string& data, const std::string& name) {
  const std::string robot = data + "/robots/" + name + ".json";
  const std::string workcell = data + "/workcells/" + name + ".json";
  return std::make_shared<const xr3::Model>(xr3::load_robot(content(robot), robot),
                                            xr3::load_workcell(content(workcell), workcell),
                                            xr3::Profile::kPaper);
}

/// Random commands, mostly valid. mt19937 gives the same numbers everywhere; the distributions of
/// the standard library do not.
class Commands {
 public:
  std::string next() {
    static constexpr const char* kOthers[] = {
        "I",      "J",  "K",  "T",          "V?", "A?", "A*10,10*", "A*12*", "A$",   "A-99\r",
        "A+99\r", "P3", "R3", "A&1,1,1,3;", "E",  "#!", "A!",       "A~",    "A\"5", "X"};
    const std::uint32_t kind = below(10);
    if (kind < 4) return joint() + (below(2) == 0 ? "+" : "-") + std::to_string(below(128)) + "\r";
    if (kind < 8) return joint() + (below(8) == 0 ? "X" : "?");
    return kOthers[below(std::size(kOthers))];
  }

 private:
  std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(random_() % end); }
  std::string joint() { return {static_cast<char>('A' + below(8))}; }

  std::mt19937 random_{1};
};

void play(const std::string& data, const std::string& robot, int count, Digest& digest) {
  xr3::Cell cell("main", model(data, robot), xr3::SimClock::bytes(), {});
  cell.set_byte_clock({});
  xr3::StateHasher hasher;
  Commands commands;
  cell.apply(xr3::LineOpened{"test"}, 0);
  for (int i = 1; i <= count; ++i) {
    cell.apply(xr3::BytesIn{1, commands.next()}, 0);
    const std::string_view replies = cell.find_line(1)->outbox();
    digest.add(replies);
    cell.apply(xr3::BytesOut{1, replies.size()}, 0);
    if (i % 100 == 0) digest.add(hasher.hash(cell));
    if (cell.state().stall != xr3::Stall::kNo && i % 50 == 0)
      cell.apply(xr3::Input{xr3::call::Call{xr3::call::Home{}}}, 0);
  }
  std::printf("%s: %d commands, tick %lld, %s\n", robot.c_str(), count,
              static_cast<long long>(cell.state().tick), digest.text().c_str());
}

}  // namespace

// The digests of cells; see cell/digest.hpp. Here they need not resist anybody.
std::string xr3::sha256(std::string_view text) {
  Digest digest;
  digest.add(text);
  return "sha256:" + digest.text() + digest.text();
}

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: commands_digest DATA COMMANDS\n");
    return 2;
  }
  constexpr const char* kRobots[] = {"rhino-xr3", "adept-one", "intelledex-660",
                                     "rhino-xr3-accessories"};
  const int count = std::atoi(argv[2]) / static_cast<int>(std::size(kRobots));
  Digest digest;
  for (const char* robot : kRobots) play(argv[1], robot, count, digest);
  std::printf("digest %s\n", digest.text().c_str());
  return 0;
}
