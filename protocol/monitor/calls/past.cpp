// The calls on the past: `history`, `look`, `trace`, `live`, `seek` and `branch`.
#include <set>
#include <utility>

#include "protocol/monitor/calls/form.hpp"
#include "protocol/monitor/fields.hpp"

namespace xr3::monitor {
namespace {

// Ticks from one state of a trace to the next.
constexpr std::int64_t kMinEvery = 10;
constexpr std::int64_t kMaxEvery = 3'600'000;
constexpr std::int64_t kUsualEvery = 100;

PastTime read_past_time(ArgsReader& args) {
  PastTime at;
  at.tick = args.integer("tick", 0, kMaxInteger).value_or(0);
  at.epoch = args.integer("epoch", 0, kMaxInteger, Presence::kOptional);
  return at;
}

data::Codec<std::vector<Channel>> latest_wins_channels() {
  std::vector<std::pair<std::string, Channel>> names;
  for (const Channel channel :
       {Channel::kState, Channel::kImage, Channel::kDisplay, Channel::kModel})
    names.emplace_back(name_of(channel), channel);
  const std::size_t most = names.size();
  return data::list(data::choice(std::move(names)), 0, most);
}

CallValue read_look(ArgsReader& args) {
  Look look{read_past_time(args), {}};
  const auto channels = args.coded("channels", latest_wins_channels(), Presence::kOptional)
                            .value_or(std::vector<Channel>{Channel::kState});
  const auto encodings =
      data::choice<Encoding>({{"rows", Encoding::kRows}, {"rle", Encoding::kRle}});
  const Encoding encoding =
      args.coded("encoding", encodings, Presence::kOptional).value_or(Encoding::kRows);
  for (const Channel channel : std::set<Channel>(channels.begin(), channels.end())) {
    const bool is_image = channel == Channel::kImage;
    look.selections.push_back({channel, {}, is_image ? encoding : Encoding::kRows});
  }
  return look;
}

CallValue read_trace(ArgsReader& args) {
  Trace trace{read_past_time(args), 0};
  trace.every =
      args.integer("every", kMinEvery, kMaxEvery, Presence::kOptional).value_or(kUsualEvery);
  return trace;
}

CallValue read_seek(ArgsReader& args) { return Seek{read_past_time(args)}; }

CallValue read_branch(ArgsReader& args) { return Branch{read_past_time(args)}; }

constexpr CallForm kPastCalls[] = {
    {"history", "Gives the times that can be seen again, and their events.",
     read_nothing<ReadHistory>},
    {"look", "Shows a time of the past to this client only.", read_look},
    {"trace", "Gives joints and tool in the past, one state every so many ticks.", read_trace},
    {"live", "Ends look: this client sees the present again.", read_nothing<Live>},
    {"seek", "Takes the cell back to a time of its past, where it waits for resume.", read_seek},
    {"branch", "Opens a new cell that goes on from a time of this one's past.", read_branch},
};

}  // namespace

CallForms past_calls() { return kPastCalls; }

}  // namespace xr3::monitor
