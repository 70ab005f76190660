// A robot program and a monitor in lockstep: bytes on the line, then a step of the manual clock
// after them. Replies and states must be those of a cell to which the same happens directly.
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocol/json/document.hpp"
#include "tests/seeds/client.hpp"
#include "tests/seeds/messages.hpp"

namespace xr3::seeds {
namespace {

class Lockstep final : public Client {
 public:
  explicit Lockstep(World& world)
      : Client(world, world.monitor_port), reference_(world.model, Reference::Line::kTcp) {
    ending_ = Ending::kWaits;
    never_reads_ = is_slow_ = false;
    rounds_ = world.random.between(1, 12);
  }
  std::string name() const override { return "lockstep"; }

  void act() override {
    robot(world_.random.between(1, 64));
    Client::act();
    go_on();
  }
  bool settle() override {
    const bool has_moved = robot(std::string::npos);
    const bool has_settled = Client::settle();
    return go_on() || has_moved || has_settled;
  }
  bool is_done() const override { return is_over() || (rounds_ == 0 && Client::is_done()); }
  void leave() override {
    if (robot_ && robot_->sides[0].is_open) world_.kernel.close(*robot_);
    Client::leave();
  }

  void verify(bool is_complete) override {
    const std::string right = replies_;
    const bool is_hurt = world_.is_crowded || (robot_ && robot_->is_aborted);
    if (!right.starts_with(robot_in_) && !is_waiting_)
      return fail("wrong replies on the line: " + std::to_string(robot_in_.size()) + " bytes, " +
                  std::to_string(right.size()) + " expected");
    if (!is_complete || !is_tame() || is_hurt) return;
    if (world_.has_jumped && is_over()) return;  // it was too slow
    if (rounds_ > 0 || messages_.unanswered() > 0)
      return fail("it stands still" + std::string(is_over() ? ", its connection is over" : ""));
    if (robot_in_ != right) fail("replies are missing on the line");
  }

 protected:
  bool expects_more() const override { return messages_.unanswered() > 0; }

  void received(std::string_view bytes) override {
    in_.append(bytes);
    for (std::size_t end; (end = in_.find('\n')) != std::string::npos; in_.erase(0, end + 1)) {
      const std::string_view line = std::string_view(in_).substr(0, end);
      const std::string wrong = messages_.feed(line);
      if (!wrong.empty()) return fail(wrong);
      const Json message = Json::parse(line);
      if (message.value("op", "") == "result") handle(message);
    }
  }

 private:
  /// The robot's side: sends and reads.
  bool robot(std::size_t most) {
    Kernel& kernel = world_.kernel;
    if (!robot_) robot_ = kernel.connect(world_.robot_port, 65'536, 65'536);
    if (!robot_) return false;
    const std::size_t count =
        kernel.write(*robot_, std::string_view(robot_out_).substr(robot_sent_, most));
    robot_sent_ += count;
    const std::string bytes = kernel.read(*robot_, most);
    robot_in_ += bytes;
    return count > 0 || !bytes.empty();
  }

  /// Makes the next request once the last one is answered.
  bool go_on() {
    if (is_over() || rounds_ == 0 || messages_.unanswered() > 0 || !robot_) return false;
    if (line_ == 0) return ask("lines", "");
    --rounds_;
    for (std::size_t count = world_.random.below(5); count > 0; --count) say(words());
    ticks_ = static_cast<std::int64_t>(world_.random.below(400));
    is_waiting_ = true;
    return ask("step", R"("ticks":)" + std::to_string(ticks_) + R"(,"fields":["joints"],)" +
                           R"("after":{"within_ms":60000,"line":)" + std::to_string(line_) +
                           R"(,"bytes_in":)" + std::to_string(robot_out_.size()) + "}");
  }

  bool ask(const std::string& function, const std::string& arguments) {
    const std::string id = "step-" + std::to_string(++count_);
    messages_.expect(id, "result");
    queue(R"({"op":"call","id":")" + id + R"(","fn":")" + function + R"(","args":{)" + arguments +
          "}}\n");
    return true;
  }

  std::string words() {
    Random& random = world_.random;
    const std::string joint(1, static_cast<char>('A' + random.below(7)));
    const std::string number = std::to_string(random.below(128));
    return random.any_of<std::string>({joint + "+" + number + "\r", joint + "-" + number + "\r",
                                       joint + "?", joint + "T", "I", "J", "A$", joint + "X",
                                       "A*4*", "Q", joint + "50S"});
  }

  void say(const std::string& bytes) {
    robot_out_ += bytes;
    replies_ += reference_.replies(bytes);
  }

  void handle(const Json& result) {
    if (line_ == 0) return find_line(result);
    is_waiting_ = false;
    if (!result.value("ok", false)) {
      const std::string code = result["error"].value("code", "");
      const bool is_hurt = world_.is_harmed || world_.is_crowded || robot_->is_aborted;
      if (code != "timeout" && !is_hurt) fail("step fails: " + result.dump());
      return;
    }
    reference_.step(ticks_);
    const Json& value = result["value"];
    if (value["tick"] != reference_.tick()) return fail("wrong tick: " + value.dump());
    if (value["state"]["joints"] != Json::parse(reference_.joints()))
      fail("wrong state: " + value.dump());
  }

  void find_line(const Json& result) {
    const std::string peer = "127.0.0.1:" + std::to_string(robot_->ports[0]);
    if (!result.contains("value")) return;
    for (const Json& line : result["value"]["lines"]) {
      if (line["peer"] == peer) line_ = line["line"].get<unsigned>();
    }
    if (line_ == 0 && ++searches_ > 200) rounds_ = 0;  // refused, or aborted
  }

  Reference reference_;
  std::string replies_;  ///< of the reference
  Messages messages_{"step-"};
  ConnectionPtr robot_;
  std::string robot_out_;
  std::size_t robot_sent_ = 0;
  std::string robot_in_;
  unsigned line_ = 0;
  std::int64_t ticks_ = 0;
  std::size_t rounds_ = 0;
  int searches_ = 0;
  int count_ = 0;
  bool is_waiting_ = false;
};

}  // namespace

ClientPtr make_lockstep(World& world) { return std::make_unique<Lockstep>(world); }

}  // namespace xr3::seeds
