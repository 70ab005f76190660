#include "protocol/explain/explain.hpp"

#include <algorithm>
#include <utility>

#include "protocol/explain/command_text.hpp"
#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/event_report.hpp"
#include "protocol/line/device_command.hpp"

namespace xr3 {
namespace {

constexpr std::string_view kTelnet = "telnet";

/// The text of a reply of a simulated Mark III with the switches of this robot.
std::string value_text(const wire::FromDevice& reply, const Model& model) {
  const std::string byte(1, static_cast<char>(reply.byte));
  ReplyContext device = context_of(model);
  device.profile = Profile::kMark3;
  const auto answered = decode_reply(reply.inquiry, byte, device);
  if (answered) return reply_text(*answered, device).phrase;
  return hexadecimal(byte) + " hex, which is no reply to " +
         readable(for_device(reply.inquiry)->bytes);
}

struct Explainer {
  const wire::Item& item;
  const Model& model;

  Explanation explanation(std::string_view code, std::string message) const {
    return {item.from, item.to, code, std::move(message)};
  }
  Explanation event(const EventBody& body, const std::string& before = "") const {
    const EventReport about = report(body, model);
    return explanation(about.code, before + about.message);
  }

  Explanation operator()(const wire::Executed& executed) const {
    CommandText about = command_text(executed);
    return explanation(about.code, std::move(about.phrase));
  }
  Explanation operator()(const wire::Ignored& ignored) const {
    std::string message =
        describe(Parsed{item.from, item.to, ignored.raw, ignored.problem}, ignored.problem);
    if (ignored.count > 1) message += " (" + std::to_string(ignored.count) + " in a row)";
    return explanation(code_of(ignored.problem.code), std::move(message));
  }
  Explanation operator()(const wire::WarningRaised& raised) const {
    return event(Warning{raised.code, raised.label, raised.value, raised.limit, {}});
  }
  Explanation operator()(const MotorBlocked& blocked) const { return event(blocked); }
  Explanation operator()(const wire::NoMotion& held_back) const {
    if (held_back.stall != Stall::kNo) {
      return event(Stalled{held_back.stall}, "nothing moves: ");
    }
    const bool at_limit = held_back.blocked == Blocked::kLimit;
    return explanation(at_limit ? "limit" : "block",
                       std::string(1, held_back.label) +
                           (at_limit ? " is already at a limit; it can move the other way"
                                     : " is already closed on a block; it can move the other way"));
  }
  Explanation operator()(const wire::Answered& answered) const {
    ReplyText about = reply_text(answered, context_of(model));
    return explanation(about.code, std::move(about.phrase));
  }
  Explanation operator()(const wire::ToDevice& sent) const {
    return explanation("to_device", "to the device: " + readable(for_device(sent.command)->bytes));
  }
  Explanation operator()(const wire::FromDevice& reply) const {
    return explanation("from_device", "from the device: " + value_text(reply, model));
  }
  Explanation operator()(const wire::MoreAnswers& more) const {
    return explanation("more_replies", std::to_string(more.count) + " more replies that were held");
  }
};

/// Appends [from, to), or extends the last explanation if it ends at `from`.
void add_telnet(std::vector<Explanation>& all, std::uint64_t from, std::uint64_t to,
                const char* message) {
  const bool goes_on = !all.empty() && all.back().code == kTelnet && all.back().to == from;
  if (goes_on) {
    all.back().to = to;
  } else {
    all.push_back({from, to, kTelnet, message});
  }
}

/// The received bytes that the telnet filter does not pass on.
std::vector<Explanation> telnet_in(const WireRecord& record) {
  std::vector<Explanation> all;
  if (!record.telnet) return all;
  TelnetFilter filter = *record.telnet;
  std::string answers;
  for (std::size_t i = 0; i < record.shown.size(); ++i) {
    const std::uint64_t at = record.offset + i;
    const bool is_data =
        filter.feed(static_cast<std::uint8_t>(record.shown[i]), answers).data.has_value();
    if (!is_data) add_telnet(all, at, at + 1, "telnet protocol; not passed to the controller");
  }
  return all;
}

/// The sent bytes that are not part of a reply.
std::vector<Explanation> telnet_out(const WireRecord& record) {
  std::vector<Explanation> all;
  std::uint64_t from = record.offset;
  const auto add_up_to = [&](std::uint64_t to) {
    if (from < to) add_telnet(all, from, to, "telnet protocol; not sent by the controller");
  };
  for (const wire::Item& item : record.items) {
    add_up_to(item.from);
    from = item.to;
  }
  add_up_to(record.offset + record.bytes);
  return all;
}

}  // namespace

std::vector<Explanation> explain(const WireRecord& record, const Model& model) {
  std::vector<Explanation> all =
      record.direction == Direction::kIn ? telnet_in(record) : telnet_out(record);
  for (const wire::Item& item : record.items) {
    all.push_back(std::visit(Explainer{item, model}, item.what));
  }
  // Telnet bytes may lie between the bytes of a command, which is listed where it was completed.
  std::stable_sort(all.begin(), all.end(),
                   [](const Explanation& a, const Explanation& b) { return a.to < b.to; });
  return all;
}

}  // namespace xr3
