#include "tests/seeds/requests.hpp"

namespace xr3::seeds {
namespace {

std::string hexadecimal(const std::string& bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string digits;
  for (const char each : bytes) {
    const auto byte = static_cast<unsigned char>(each);
    digits += {kDigits[byte / 16], kDigits[byte % 16]};
  }
  return digits;
}

}  // namespace

Requests::Requests(World& world, int number)
    : world_(world),
      random_(world.random),
      number_(number),
      messages_("c" + std::to_string(number) + "-") {}

std::string Requests::new_id(const std::string& reply) {
  id_ = "c" + std::to_string(number_) + "-" + std::to_string(++count_);
  messages_.expect(id_, reply);
  return R"("id":")" + id_ + R"(")";
}

std::string Requests::next() {
  switch (random_.below(world_.is_manual ? 12 : 16)) {
    case 0: return ping();
    case 1: return invalid();
    case 2:
    case 3:
    case 4: return get();
    case 5:
    case 6: return subscribe();
    case 7: return unsubscribe();
    case 8:
    case 9: return look();
    case 10:
    case 11: return send();
    default: return change();
  }
}

std::string Requests::channel() {
  if (random_.chance(60)) return "image";
  return random_.any_of({"state", "event", "line", "display", "model", "event", "line", "state"});
}

std::string Requests::ping() { return R"({"op":"ping",)" + new_id("pong") + "}"; }

std::string Requests::get() {
  const std::string wanted = channel();
  const bool is_ring = wanted == "event" || wanted == "line";
  std::string text =
      R"({"op":"get",)" + new_id(is_ring ? "result" : wanted) + R"(,"channel":")" + wanted + R"(")";
  if (is_ring && random_.chance(500)) text += R"(,"since":)" + std::to_string(random_.below(40));
  if (wanted == "state" && random_.chance(700)) text += R"(,"fields":["moving","enabled"])";
  if (wanted == "image") text += R"(,"encoding":"rle")";
  return text + "}";
}

std::string Requests::subscribe() {
  const std::string wanted = channel();
  std::string text = R"({"op":"sub",)" + new_id("result") + R"(,"channel":")" + wanted + R"(")";
  if (random_.chance(300)) text += R"(,"since":1)";
  if (random_.chance(300))
    text += R"(,"max_hz":)" + random_.any_of<std::string>({"0.1", "1", "60"});
  if (random_.chance(300)) text += R"(,"on_change":false)";
  return text + "}";
}

std::string Requests::unsubscribe() {
  return R"({"op":"unsub",)" + new_id("result") + R"(,"channel":")" + channel() + R"("})";
}

std::string Requests::call(const std::string& function, const std::string& arguments) {
  return R"({"op":"call",)" + new_id("result") + R"(,"fn":")" + function + R"(","args":{)" +
         arguments + "}}";
}

std::string Requests::look() {
  const auto wait = R"("ticks":0,"after":{"line":)" + std::to_string(random_.below(4)) +
                    R"(,"bytes_in":)" + std::to_string(random_.below(60)) + R"(,"within_ms":)" +
                    std::to_string(random_.below(3000)) + "}";
  switch (random_.below(5)) {
    case 0: return call("describe", R"("fn":"step")");
    case 1: return call("lines", "");
    case 2: return call("line_disconnect", R"("line":9999)");
    case 3: return call("snapshot_save", random_.any_of({R"("inline":true)", R"("name":"a")"}));
    default: return call("step", wait);
  }
}

// On the line of this client, which is a line like any other.
std::string Requests::send() {
  std::string bytes;
  for (std::size_t count = random_.between(1, 6); count > 0; --count)
    bytes += random_.any_of({"G?", "K", "I", "GT", "A*2*", "~", "G+5\r", "H3S", "A#", "J"});
  std::string text = call("send", R"("hex":")" + hexadecimal(bytes) + R"(")");
  if (!world_.is_manual || world_.is_lockstep) return text;
  if (!alone_) alone_ = std::make_unique<Reference>(world_.model, Reference::Line::kMonitor);
  messages_.expect_hex(id_, alone_->hexadecimal_replies(bytes));
  return text;
}

// Only where nothing is compared with a cell that is alone.
std::string Requests::change() {
  const auto line = R"("line":)" + std::to_string(random_.below(6));
  const auto block = R"("name":"b","size_mm":[20,20,20],"xyz_mm":[300,0,10],"color":3)";
  switch (random_.below(13)) {
    case 0: return call("pause", "");
    case 1: return call("resume", "");
    case 2:
      return call("rate", R"("factor":)" + random_.any_of<std::string>({"0.001", "1", "100000"}));
    case 3: return call("step", R"("ticks":)" + std::to_string(random_.below(500)));
    case 4: return call("run_until", R"("idle":true,"max_ticks":3000)");
    case 5: return call("reset", "");
    case 6: return call("home", "");
    case 7:
      return call("input",
                  R"("input":2,"value":)" + random_.any_of<std::string>({"true", "false"}));
    case 8: return call("block_add", block);
    case 9: return call("block_remove", R"("name":"b")");
    case 10: return call("snapshot_load", R"("name":"a")");
    case 11: return call("key", R"("function":"home")");
    default: return call("line_disconnect", line);
  }
}

std::string Requests::invalid() {
  switch (random_.below(4)) {
    case 0: return R"({"op":"fly",)" + new_id("result") + "}";
    case 1: return R"({"op":"get",)" + new_id("result") + R"(,"channel":"smell"})";
    case 2: return call("step", R"("ticks":-1)");
    default: return call("send", R"("hex":"zz")");
  }
}

}  // namespace xr3::seeds
