#include "cli/exec/transcript_difference.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "core/units.hpp"
#include "protocol/explain/command_text.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/line/rhino_parser.hpp"

namespace xr3 {
namespace {

/// A piece of what was sent in one direction: a command, a reply, or bytes without an effect.
struct Piece {
  std::uint64_t offset = 0;  ///< offset of its first byte in this direction
  Tick tick = 0;
  std::string bytes;
  std::string meaning;  ///< empty if it has none
};

/// The bytes of one line, each direction by itself: only their order within a direction does not
/// depend on packets.
struct Talk {
  std::string sent;
  std::vector<std::pair<std::uint64_t, Tick>> packets;  ///< offset and tick of each in `sent`
  std::vector<Piece> replies;
  std::uint64_t received = 0;
};

using Talks = std::map<LineId, Talk>;

int from_hexadecimal(char digit) { return digit <= '9' ? digit - '0' : digit - 'a' + 10; }

/// The inverse of readable().
std::string bytes_of(std::string_view shown) {
  std::string bytes;
  for (std::size_t at = 0; at < shown.size(); ++at) {
    const char c = shown[at];
    if (c != '\\') {
      bytes += c;
      continue;
    }
    const char kind = shown[++at];
    if (kind == 'x') {
      bytes +=
          static_cast<char>(from_hexadecimal(shown[at + 1]) * 16 + from_hexadecimal(shown[at + 2]));
      at += 2;
    } else {
      bytes += kind == 'r' ? '\r' : kind == 'n' ? '\n' : kind == '0' ? '\0' : '\\';
    }
  }
  return bytes;
}

/// Takes the word before the next blank off a row.
std::string_view take_word(std::string_view& row) {
  const std::size_t end = row.find(' ');
  assert(end != row.npos);
  const std::string_view word = row.substr(0, end);
  row.remove_prefix(end + 1);
  return word;
}

template <class Number>
Number take_number(std::string_view& row) {
  const std::string_view word = take_word(row);
  Number number{};
  std::from_chars(word.data(), word.data() + word.size(), number);
  return number;
}

void add_transfer(std::string_view row, Talks& talks) {
  const auto tick = take_number<Tick>(row);
  Talk& talk = talks[take_number<LineId>(row)];
  const bool is_sent = take_word(row) == ">";
  std::string bytes = bytes_of(row);
  if (is_sent) {
    talk.packets.emplace_back(talk.sent.size(), tick);
    talk.sent += bytes;
  } else {
    const std::uint64_t offset = std::exchange(talk.received, talk.received + bytes.size());
    talk.replies.push_back({offset, tick, std::move(bytes), ""});
  }
}

[[maybe_unused]] bool is_in_rows(std::string_view text) {
  return text.empty() || text.ends_with('\n');
}

Talks talks_of(std::string_view text) {
  Talks talks;
  while (!text.empty() && !text.starts_with('#')) {
    const std::size_t end = text.find('\n');
    add_transfer(text.substr(0, end), talks);
    text.remove_prefix(end + 1);
  }
  return talks;
}

/// The tick at which the byte at an offset was sent.
Tick sent_at(const Talk& talk, std::uint64_t offset) {
  const auto after =
      std::ranges::upper_bound(talk.packets, offset, {}, &std::pair<std::uint64_t, Tick>::first);
  return std::prev(after)->second;
}

Piece piece_of(const Talk& talk, std::uint64_t from, std::uint64_t to) {
  return {from, sent_at(talk, from), talk.sent.substr(from, to - from), ""};
}

std::string meaning_of(const Parsed& parsed) {
  const auto* command = std::get_if<Command>(&parsed.what);
  return command == nullptr ? "" : command_text({*command}).phrase;
}

/// The commands of a line. Bytes between two of them belong to the later one; those after the last
/// one are a piece without meaning.
std::vector<Piece> commands_sent(const Talk& talk, Profile profile) {
  RhinoParser parser(profile);
  std::vector<Piece> pieces;
  std::vector<Parsed> parsed;
  std::uint64_t begin = 0;
  for (std::uint64_t offset = 0; offset < talk.sent.size(); ++offset) {
    parsed.clear();
    parser.feed(static_cast<std::uint8_t>(talk.sent[offset]), offset, parsed);
    for (const Parsed& each : parsed) {
      if (each.to <= begin) continue;  // a word, which is a remark about commands
      pieces.push_back(piece_of(talk, begin, each.to));
      pieces.back().meaning = meaning_of(each);
      begin = each.to;
    }
  }
  if (begin < talk.sent.size()) pieces.push_back(piece_of(talk, begin, talk.sent.size()));
  return pieces;
}

/// The pieces at which two runs differ; nullopt for a run that has no further one.
struct FirstDifference {
  LineId line = 0;
  const char* verb = "";
  std::optional<Piece> one;
  std::optional<Piece> other;

  std::uint64_t offset() const { return one ? one->offset : other->offset; }
  Tick tick() const { return std::min(one ? one->tick : kNoTick, other ? other->tick : kNoTick); }

 private:
  static constexpr Tick kNoTick = std::numeric_limits<Tick>::max();
};

template <class Equal>
std::optional<FirstDifference> compared(LineId line, const char* verb,
                                        const std::vector<Piece>& one,
                                        const std::vector<Piece>& other, Equal is_equal) {
  const auto [first, second] = std::ranges::mismatch(one, other, is_equal);
  if (first == one.end() && second == other.end()) return std::nullopt;
  const auto piece = [](auto at, auto end) {
    return at == end ? std::nullopt : std::optional<Piece>(*at);
  };
  return FirstDifference{line, verb, piece(first, one.end()), piece(second, other.end())};
}

/// The first difference on a line. Its replies follow from what was sent, so they come second.
std::optional<FirstDifference> compared(LineId line, const Talk& one, const Talk& other,
                                        Profile profile) {
  const auto has_equal_bytes = [](const Piece& a, const Piece& b) { return a.bytes == b.bytes; };
  const auto is_equal = [](const Piece& a, const Piece& b) {
    return a.bytes == b.bytes && a.tick == b.tick;
  };
  auto found = compared(line, "sent", commands_sent(one, profile), commands_sent(other, profile),
                        has_equal_bytes);
  return found ? found : compared(line, "received", one.replies, other.replies, is_equal);
}

std::string shown(const std::optional<Piece>& piece, const char* verb) {
  constexpr std::size_t kMaxShown = 64;
  if (!piece) return std::string(verb) + " nothing more";
  const std::string_view bytes = piece->bytes;
  const std::string more = bytes.size() > kMaxShown ? "..." : "";
  const std::string meaning = piece->meaning.empty() ? "" : " (" + piece->meaning + ")";
  return std::string(verb) + " " + readable(bytes.substr(0, kMaxShown)) + more + meaning +
         " at tick " + std::to_string(piece->tick);
}

std::set<LineId> line_numbers(const Talks& one, const Talks& other) {
  std::set<LineId> lines;
  for (const Talks* each : {&one, &other})
    for (const auto& [line, talk] : *each) lines.insert(line);
  return lines;
}

}  // namespace

std::string first_difference(const NamedTranscript& one, const NamedTranscript& other,
                             Profile profile) {
  assert(is_in_rows(one.text) && is_in_rows(other.text));
  Talks ones = talks_of(one.text);
  Talks others = talks_of(other.text);
  std::optional<FirstDifference> first;
  for (const LineId line : line_numbers(ones, others)) {
    const auto found = compared(line, ones[line], others[line], profile);
    if (found && (!first || found->tick() < first->tick())) first = found;
  }
  const std::string names = one.name + " and " + other.name;
  if (!first)
    return names +
           " have the same bytes in their transcripts: they differ later, or in the state "
           "at the end";
  return names + " differ first on line " + std::to_string(first->line) + " after " +
         std::to_string(first->offset()) + " bytes: " + one.name + " " +
         shown(first->one, first->verb) + ", " + other.name + " " +
         shown(first->other, first->verb);
}

}  // namespace xr3
