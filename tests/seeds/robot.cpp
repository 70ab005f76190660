// Robot programs. With a joint of its own, a line must receive exactly the replies of a cell that
// it has for itself.
#include <algorithm>

#include "tests/seeds/client.hpp"

namespace xr3::seeds {

namespace {

using namespace std::string_literals;

/// Telnet and RFC 2217. Replies that are suspended are resumed.
std::string telnet_words(Random& random, const std::string& joint) {
  if (random.chance(200)) {
    return "\xFF\xFA,\x08\xFF\xF0" + joint + "?" + joint + "T\xFF\xFA,\x09\xFF\xF0";
  }
  return "\xFF"s + random.any_of({"\xFD\x03", "\xFB\x01", "\xF4", "\xFC\x03", "\xF1", "\xFB,",
                                  "\xFA,\x07\xFF\xF0"});
}

/// A command or an inquiry that depends on no other line. Time stands still.
std::string harmless_words(Random& random, char letter) {
  const std::string joint(1, letter);
  const std::string number = std::to_string(random.below(140));
  switch (random.below(13)) {
    case 0: return joint + (random.chance(500) ? "+" : "-") + number + "\r";
    case 1: return joint + "?";
    case 2: return joint + "T";
    case 3: return joint + "V";
    case 4: return joint + "X";
    case 5: return joint + number + "S";
    case 6: return random.any_of({"I", "J", "K", "AI", "\r\n", " "});
    case 7: return random.any_of({"L", "M", "P3", "R3", "A#", "A!1,2,3!", "A%2", "A.7\r"});
    case 8: return telnet_words(random, joint);
    case 9: return random.any_of({"~^;", "\x7F\x80", "\r?", "\r9", "Z", "[]"});
    case 10: return "A*" + std::to_string(random.below(20)) + "*";
    case 11: return "A*3," + std::to_string(random.below(20)) + "*";
    default: return random.chance(200) ? "A**" : "K";
  }
}

/// Sends only inquiries; the replies depend on the other clients.
std::string watching_words(Random& random) {
  return random.any_of({"E?", "A?", "BT", "CV", "I", "J", "K", "A*3*", "?", "~", "\r"});
}

/// Anything.
std::string wild_words(Random& random) {
  switch (random.below(4)) {
    case 0: return random.any_of({"A$", "A@A@", "Q", "A**", "E+100\rF+100\r", "A+30\r", "A@"});
    case 1: return std::string(1, static_cast<char>(random.below(256)));
    default: return harmless_words(random, static_cast<char>('A' + random.below(8)));
  }
}

std::string quoted(std::string_view bytes) {
  std::string text;
  for (const char each : bytes) {
    const auto byte = static_cast<unsigned char>(each);
    const bool is_shown = byte >= ' ' && byte < 0x7F;
    text += is_shown ? std::string(1, each) : "<" + std::to_string(byte) + ">";
  }
  return text;
}

class Robot final : public Client {
 public:
  Robot(World& world, char letter) : Client(world, world.robot_port), letter_(letter) {
    Random& random = world.random;
    std::string bytes;
    const std::size_t most = random.chance(100) ? 400 : 40;
    for (std::size_t count = random.spread(most); count > 0; --count) bytes += words();
    if (random.chance(30)) {
      for (int i = 0; i < 300; ++i) bytes += "A**";
    }
    queue(bytes);
  }

  std::string name() const override {
    return "robot program "s + (letter_ == 0 ? '-' : letter_) + place();
  }

  void verify(bool is_complete) override {
    if (letter_ == 0 || !is_connected()) return;
    Reference reference(world_.model, Reference::Line::kTcp);
    const std::string right = reference.replies(sent()) + reference.last_replies();
    if (!right.starts_with(in_)) {
      const auto [wrong, ignored] =
          std::mismatch(in_.begin(), in_.end(), right.begin(), right.end());
      const auto place = static_cast<std::size_t>(wrong - in_.begin());
      return fail("wrong reply at byte " + std::to_string(place) + " of " +
                  std::to_string(in_.size()) + ": '" + in_.substr(place, 20) + "', not '" +
                  right.substr(place, 20) + "'; it sent " + quoted(sent().substr(0, 200)));
    }
    const bool is_refused = world_.is_crowded && in_.empty();
    if (!is_complete || !is_tame() || is_refused || in_.size() == right.size()) return;
    fail("only " + std::to_string(in_.size()) + " of " + std::to_string(right.size()) +
         " bytes of replies" + (is_ended_by_server() ? ", then the end" : ""));
  }

 private:
  std::string words() {
    if (letter_ != 0) return harmless_words(world_.random, letter_);
    return world_.is_lockstep ? watching_words(world_.random) : wild_words(world_.random);
  }

  char letter_;
};

}  // namespace

ClientPtr make_robot(World& world, char letter) { return std::make_unique<Robot>(world, letter); }

}  // namespace xr3::seeds
