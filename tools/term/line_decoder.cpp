#include "tools/term/line_decoder.hpp"

#include <utility>

#include "protocol/explain/command_text.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3::term {
namespace {

/// A size above that of the largest image of a camera.
constexpr std::size_t kMaxReceived = std::size_t{1} << 20U;
constexpr std::size_t kMaxExcerpt = 64;

/// Bytes at the beginning of a line of text: the decimal value of one, the number of several.
std::string amount(std::string_view bytes) {
  if (bytes.size() != 1) return std::to_string(bytes.size()) + " bytes";
  return std::to_string(static_cast<std::uint8_t>(bytes[0]));
}

/// The first bytes in readable form.
std::string excerpt(std::string_view bytes) {
  return readable(bytes.substr(0, kMaxExcerpt)) + (bytes.size() > kMaxExcerpt ? "..." : "");
}

std::string unasked_line(std::string_view bytes) {
  return amount(bytes) + "  not asked for: " + excerpt(bytes);
}

/// Consecutive bytes with the same problem.
struct IgnoredRun {
  Parsed parsed;
  int count = 1;
};

void add_ignored(std::vector<IgnoredRun>& runs, const Parsed& parsed) {
  const bool goes_on = !runs.empty() && runs.back().parsed.to == parsed.from &&
                       runs.back().parsed.what == parsed.what;
  if (!goes_on) return runs.push_back({parsed});
  IgnoredRun& run = runs.back();
  for (const char byte : parsed.raw.view()) run.parsed.raw.push(static_cast<std::uint8_t>(byte));
  run.parsed.to = parsed.to;
  ++run.count;
}

std::string sentence_of(const IgnoredRun& run) {
  const std::string sentence = describe(run.parsed, std::get<Problem>(run.parsed.what));
  return run.count == 1 ? sentence : sentence + " (" + std::to_string(run.count) + " in a row)";
}

/// Without the line end and the blanks around it.
std::string text_of_inquiry(const RawBytes& raw) {
  const std::string text = readable(raw.view());
  const std::size_t end = text.find_last_not_of(' ');
  return text.substr(0, end == std::string::npos ? 0 : end + 1);
}

}  // namespace

std::string hex_lines(char mark, std::string_view bytes) {
  constexpr std::size_t kBytesOfLine = 16;
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    if (at % kBytesOfLine == 0) text += (at == 0 ? "" : "\n") + std::string(1, mark);
    text += " " + hexadecimal(bytes.substr(at, 1));
  }
  return text.empty() ? text : text + "\n";
}

std::vector<std::string> LineDecoder::send(std::string_view bytes) {
  std::vector<IgnoredRun> ignored;
  std::vector<Parsed> items;
  for (const char byte : bytes) {
    items.clear();
    parser_.feed(static_cast<std::uint8_t>(byte), sent_++, items);
    for (const Parsed& item : items) {
      const auto* command = std::get_if<Command>(&item.what);
      if (command == nullptr) {
        add_ignored(ignored, item);
      } else if (reply_size(*command, context_) != 0U) {
        inquiries_.push_back({*command, text_of_inquiry(item.raw)});
      }
    }
  }
  std::vector<std::string> problems;
  for (const IgnoredRun& run : ignored) problems.push_back(sentence_of(run));
  return problems;
}

std::vector<std::string> LineDecoder::receive(std::string_view bytes) {
  std::vector<std::string> lines;
  received_ += bytes;
  std::string_view rest = received_;
  while (!inquiries_.empty() && !rest.empty()) {
    const Inquiry& inquiry = inquiries_.front();
    const auto size = reply_size(inquiry.command, context_);
    if (!size && rest.size() > kMaxReceived) {
      inquiries_.clear();
      break;
    }
    if (!size || rest.size() < *size) break;
    lines.push_back(line_of(inquiry, rest.substr(0, *size)));
    rest.remove_prefix(*size);
    inquiries_.pop_front();
  }
  if (inquiries_.empty() && !rest.empty()) {
    lines.push_back(unasked_line(rest));
    rest = {};
  }
  received_ = std::string(rest);
  return lines;
}

std::string LineDecoder::line_of(const Inquiry& inquiry, std::string_view bytes) const {
  const auto answered = decode_reply(inquiry.command, bytes, context_);
  if (!answered) {
    return amount(bytes) + "  no reply to " + inquiry.text + ": " + excerpt(bytes);
  }
  const std::string line = amount(bytes) + "  " + reply_text(*answered, context_).phrase;
  return std::holds_alternative<CameraRow>(inquiry.command) ? line + ": " + excerpt(bytes) : line;
}

bool LineDecoder::is_in_burst() const {
  return !received_.empty() && !reply_size(inquiries_.front().command, context_);
}

// The end of a reply of unknown length. The rows of a camera have one length, so the bytes
// determine it unless images are among them.
std::vector<std::string> LineDecoder::end_of_burst() {
  if (!is_in_burst()) return {};
  std::size_t known = 0;
  std::size_t pictures = 0;
  std::size_t images = 0;
  for (const Inquiry& inquiry : inquiries_) {
    const auto size = reply_size(inquiry.command, context_);
    known += size.value_or(0);
    pictures += size ? 0 : 1;
    images += std::holds_alternative<CameraImage>(inquiry.command) ? 1 : 0;
  }
  const bool is_certain = received_.size() > known && (images == 0 || pictures == images) &&
                          (received_.size() - known) % pictures == 0;
  if (!is_certain) {
    std::vector<std::string> lines = {amount(received_) + "  replies to " +
                                      std::to_string(inquiries_.size()) + " inquiries"};
    inquiries_.clear();
    received_.clear();
    return lines;
  }
  const std::size_t each = (received_.size() - known) / pictures;
  std::vector<std::string> lines;
  while (is_in_burst()) {
    lines.push_back(picture_line(each));
    for (std::string& line : receive({})) lines.push_back(std::move(line));
  }
  return lines;
}

std::string LineDecoder::picture_line(std::size_t bytes) {
  const std::string picture = received_.substr(0, bytes);
  const bool is_row = std::holds_alternative<CameraRow>(inquiries_.front().command);
  received_.erase(0, bytes);
  inquiries_.pop_front();
  if (!is_row) return amount(picture) + "  image; --robot tells its size";
  return std::to_string(bytes) + " bytes  row of the image: " + excerpt(picture);
}

std::vector<std::string> LineDecoder::give_up() {
  if (inquiries_.empty()) return {};
  std::string line = "no reply to " + inquiries_.front().text;
  if (inquiries_.size() > 1) {
    line += " and " + std::to_string(inquiries_.size() - 1) + " more";
  }
  if (!received_.empty()) line += "; incomplete: " + amount(received_) + " " + excerpt(received_);
  inquiries_.clear();
  received_.clear();
  return {line};
}

}  // namespace xr3::term
