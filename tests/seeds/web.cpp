// Browsers and scripts over HTTP, strangers with other bytes, and the inspection at the end.
#include <charconv>
#include <deque>

#include "tests/seeds/client.hpp"

namespace xr3::seeds {
namespace {

using namespace std::string_literals;

class Browser final : public Client {
 public:
  explicit Browser(World& world) : Client(world, world.monitor_port) {
    for (std::size_t count = world.random.between(1, 5); count > 0; --count) request();
  }
  std::string name() const override { return "browser" + place(); }

  void verify(bool is_complete) override {
    const bool was_silent = in_.starts_with('{');  // for a second, so that it was greeted in JSON
    const bool may_be_refused = is_refused_ || was_silent || world_.is_crowded || world_.has_jumped;
    if (!is_complete || !is_tame() || may_be_refused || wanted_.empty()) return;
    fail("no response to GET " + wanted_.front());
  }

 protected:
  bool expects_more() const override { return !wanted_.empty(); }

  void ask(const std::string& path, const std::string& fields) {
    queue("GET " + path + " HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n");
    wanted_.push_back(path);
  }

  void received(std::string_view bytes) override {
    in_.append(bytes);
    while (read_response()) {
    }
  }

  void check(const std::string& path, std::string_view head, std::string_view body) {
    const bool is_full = head.starts_with("HTTP/1.1 503");
    const bool is_check_in_time = path.starts_with("/healthz") && !has_taken(kSecond);
    if (is_full && !is_check_in_time) {
      if (world_.is_crowded || world_.is_harmed) is_refused_ = true;
      if (is_refused_ || path == "/readyz") return;
    }
    if (head.starts_with("HTTP/1.1 408") && has_taken(10 * kSecond)) {
      is_refused_ = true;
      return;
    }
    const bool is_found = head.starts_with("HTTP/1.1 200") || path == "/nothing";
    if (!is_found && world_.is_stopping) return;
    if (!is_found) return fail("GET " + path + ": " + std::string(head) + std::string(body));
    const bool is_check = path == "/healthz" || path == "/readyz";
    if (is_check && body != "ok\n") fail("GET " + path + ": " + std::string(body));
  }

  bool is_refused_ = false;

 private:
  /// The server waits 10 s for the head of a request, and 1 s if it is full.
  bool has_taken(Ns time) const { return world_.kernel.now() - begun_ >= time; }

  void request() {
    const std::string path =
        world_.random.any_of({"/healthz", "/readyz", "/state", "/metrics", "/robot", "/workcell",
                              "/nothing", "/camera.pbm", "/healthz?x=1", "/readyz"});
    ask(path, world_.random.any_of({"", "", "Accept: */*\r\n", "Connection: keep-alive\r\n"}));
  }

  bool read_response() {
    const std::size_t end = in_.find("\r\n\r\n");
    if (end == std::string::npos) return false;
    const std::string_view head = std::string_view(in_).substr(0, end + 4);
    constexpr std::string_view kLength = "Content-Length: ";
    const std::size_t field = head.find(kLength);
    if (field == std::string::npos) return fail("no length: " + std::string(head)), false;
    std::size_t length = 0;
    std::from_chars(head.data() + field + kLength.size(), head.data() + head.size(), length);
    if (in_.size() < head.size() + length) return false;
    if (wanted_.empty()) return fail("a response without a request"), false;
    const std::string path = wanted_.front();
    wanted_.pop_front();
    check(path, head, std::string_view(in_).substr(head.size(), length));
    in_.erase(0, head.size() + length);
    return true;
  }

  std::deque<std::string> wanted_;
  Ns begun_ = world_.kernel.now();
};

class Stranger final : public Client {
 public:
  explicit Stranger(World& world)
      : Client(world, world.random.chance(500) ? world.robot_port : world.monitor_port) {
    never_reads_ = world.random.chance(500);
    queue(port_ == world.robot_port ? to_robot() : to_monitor());
  }
  std::string name() const override { return "stranger" + place(); }

  void verify(bool) override {
    if (port_ == world_.robot_port && !in_.empty()) fail("the robot port has replied: " + in_);
  }

 private:
  std::string to_robot() {
    return world_.random.any_of({"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"s,
                                 "\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03"s, ""s,
                                 "POST /x HTTP/1.1\r\nContent-Length: 99999\r\n\r\nA+50\rA?"s,
                                 "CONNECT localhost:1 HTTP/1.1\r\n\r\n"s});
  }

  std::string to_monitor() {
    Random& random = world_.random;
    switch (random.below(9)) {
      case 0: return "\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03"s;
      case 1: return "hello?\n";
      case 2: return R"({"op":"ping","id":1)" + std::string(300'000, ' ');
      case 3: return "GET /state HTTP/1.1\r\nHost: local";
      case 4: return "GET / HTTP/1.1\r\n" + std::string(20'000, 'a');
      case 5: return "";
      case 6: return many(R"({"op":"get","id":1,"channel":"state"})", 600);
      case 7: return many(R"({"op":"get","id":1,"channel":"line","since":1})", 100);
      default: return "{\n{\n}\n[\n" + std::string(40, '{') + "\n";
    }
  }

  static std::string many(const std::string& line, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += line + "\n";
    return text;
  }
};

/// Asks only for the metrics.
class Inspection final : public Client {
 public:
  explicit Inspection(World& world)
      : Client(world, world.monitor_port), are_all_closed_(world.kernel.open_streams() == 0) {
    ending_ = Ending::kWaits;
    never_reads_ = is_slow_ = false;
    queue("GET /metrics HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  }
  std::string name() const override { return "the inspection at the end"; }
  bool expects_more() const override { return true; }

  void verify(bool is_complete) override {
    if (!is_complete || world_.is_harmed) return;
    for (const char* count : {"xr3_lines_open", "xr3_viewers"}) {
      const bool is_none = in_.find(count + "{cell=\"main\"} 0\n"s) != std::string::npos;
      if (!is_none && are_all_closed_)
        return fail(count + " is not 0 after all clients have left: "s + in_);
    }
  }

 private:
  bool are_all_closed_;
};

}  // namespace

ClientPtr make_browser(World& world) { return std::make_unique<Browser>(world); }
ClientPtr make_stranger(World& world) { return std::make_unique<Stranger>(world); }
ClientPtr make_inspector(World& world) { return std::make_unique<Inspection>(world); }

}  // namespace xr3::seeds
