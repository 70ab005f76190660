// Sends random commands to robots with the byte clock, and prints digests of all replies and
// states: the same on every machine and by every compiler.
//
//   commands_digest DATA COMMANDS
//
// DATA is the folder of the robot files; each robot gets an equal part of COMMANDS. A line for
// every kPerLine commands, with the digest of everything before it, shows where two builds part.
#include <array>
#include <charconv>
#include <cstdio>
#include <exception>
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

constexpr int kPerLine = 1000;
constexpr int kPerState = 100;
constexpr int kPerHome = 50;
constexpr int kInquiryMs = 100;  // so long that the arms reach their limits and stall

/// 128 bits, twice FNV-1a from different values: it need not resist anybody.
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

/// Random commands, most of them moves and inquiries, the same on every machine. mt19937 gives the
/// same numbers everywhere, but the distributions of the standard library differ. Each statement
/// draws only one number, because compilers evaluate the operands of + in different orders.
class Commands {
 public:
  std::string next() {
    static constexpr std::array kOthers = {
        "I",   "J",      "K",      "ET", "BV", "FV",  "A**", "A*3*", "A*12*",  "A*10,10*",
        "A$",  "Q",      "A#",     "A|", "A%", "A.6", "A%4", "L",    "M",      "N",
        "O",   "P3",     "R3",     "P8", "X",  "?",   "T",   "E40S", "C255S",  "A!1,-2,3!",
        "A!!", "A+99\r", "A-99\r", "!~", "#",  "\r",  "E+",  "7 ",   "A-9X2 ", "A*99,99*"};
    const std::uint32_t kind = below(10);
    if (kind >= 8) return kOthers[below(kOthers.size())];
    const char joint = static_cast<char>('A' + below(8));
    if (kind >= 4) return {joint, below(8) == 0 ? 'X' : '?'};
    const char sign = below(2) == 0 ? '+' : '-';
    return std::string{joint, sign} + std::to_string(below(128)) + '\r';
  }

 private:
  std::uint32_t below(std::size_t end) { return static_cast<std::uint32_t>(random_() % end); }

  std::mt19937 random_{1};
};

void play(const std::string& data, const char* robot, int count, Digest& digest) {
  xr3::Cell cell("main", model(data, robot), xr3::SimClock::bytes());
  cell.set_byte_clock({.inquiry_ms = kInquiryMs});
  xr3::StateHasher hasher;
  Commands commands;
  cell.apply(xr3::LineOpened{"test"}, 0);
  for (int i = 1; i <= count; ++i) {
    cell.apply(xr3::BytesIn{1, commands.next()}, 0);
    const std::string_view replies = cell.find_line(1)->outbox();
    digest.add(replies);
    cell.sent({1, replies.size()});
    if (i % kPerState == 0 || i == count) digest.add(hasher.hash(cell));
    if (i % kPerHome == 0 && cell.state().stall != xr3::Stall::kNo)
      cell.apply(xr3::Input{xr3::call::Call{xr3::call::Home{}}}, 0);
    if (i % kPerLine == 0 || i == count)
      std::printf("%s, command %d, tick %lld: %s\n", robot, i,
                  static_cast<long long>(cell.state().tick), digest.text().c_str());
  }
}

constexpr std::array kRobots = {"rhino-xr3", "adept-one", "intelledex-660",
                                "rhino-xr3-accessories"};
constexpr int kMinCommands = static_cast<int>(kRobots.size());

void play_all(const std::string& data, int commands) {
  Digest digest;
  for (const char* robot : kRobots) play(data, robot, commands / kMinCommands, digest);
}

/// 0: `text` is no number.
int number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? value : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int commands = argc == 3 ? number(argv[2]) : 0;
  if (commands < kMinCommands) {
    std::fprintf(stderr, "usage: commands_digest DATA COMMANDS, COMMANDS at least %d\n",
                 kMinCommands);
    return 2;
  }
  try {
    play_all(argv[1], commands);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "commands_digest: %s\n", failure.what());
    return 1;
  }
  return 0;
}
