#include "tests/support/watched.hpp"

#include <stdexcept>

namespace xr3::test {
namespace {

constexpr const char* kModel = R"({"op":"model","cell":"main","epoch":0,"seq":1,"tick":0,
  "robot":{"name":"Teaching arm","joints":[{"label":"C","limits":[-100,100]},
    {"label":"B","limits":[0,400]}],"tool":{"label":"A","limits":[0,60]}}})";

constexpr const char* kState = R"({"op":"state","cell":"main","epoch":2,"seq":9,"tick":12345,
  "clock":{"mode":"real","rate":1.0},
  "joints":[{"label":"C","count":-120,"error":7,"value":-50.0,"unit":"deg","speed":110,
             "switch":false,"moving":true,"blocked":null},
            {"label":"B","count":33,"error":0,"value":250.126,"unit":"mm","speed":90,
             "switch":true,"moving":false,"blocked":"limit"}],
  "tool":{"label":"A","count":0,"error":0,"value":30.0,"unit":"mm","opening_mm":30.0,"speed":60,
          "switch":false,"moving":false,"blocked":null,"xyz_mm":[238.1,-7.5,320.72],
          "holding":"red"},
  "blocks":[{"name":"red","xyz_mm":[238.1,-7.5,320.7],"yaw_deg":90.0,"held":true},
            {"name":"green","xyz_mm":[330.0,96.0,15.0],"yaw_deg":25.5,"held":false}],
  "io":{"inputs":[true,false,false,false,false,false,false,true],
        "outputs":[false,true,false,false,false,false,false,false],"aux":[false,true]},
  "moving":true,"stalled":null,"enabled":true,"model_rev":1})";

constexpr const char* kImage = R"({"op":"image","cell":"main","epoch":2,"seq":3,"tick":12345,
  "width":8,"height":4,"encoding":"rle","rows":[[8],[2,3,3],[2,3,3],[7,1]]})";

constexpr const char* kHomed = R"({"op":"event","cell":"main","epoch":2,"seq":40,"tick":900,
  "event":"homed","line":3,"code":"homed","message":"soft home by A$","by":"serial"})";
constexpr const char* kMoved = R"({"op":"event","cell":"main","epoch":2,"seq":41,"tick":901,
  "event":"move","line":3,"code":"move","message":"C moves","joint":"C","counts":7,"error":7})";
constexpr const char* kWarned = R"({"op":"event","cell":"main","epoch":2,"seq":42,"tick":12001,
  "event":"warning","line":4,"code":"number_out_of_range","message":"B+200: too far; ignored",
  "offset":0,"hex":"42","count":3})";

constexpr const char* kLines = R"({"op":"result","id":"lines","ok":true,"value":{
  "epoch":2,"tick":12345,"lines":[
    {"line":3,"kind":"tcp","peer":"127.0.0.1:51022","opened_tick":2345,"bytes_in":12,
     "bytes_out":1,"warnings":0,"last":"E?"},
    {"line":14,"kind":"pty","peer":"/home/student/rhino","opened_tick":12000,"bytes_in":1234567,
     "bytes_out":7,"warnings":0,"last":"A*12,34*","serial":"9600-7e2"}],
  "device":{"kind":"device","peer":"/dev/ttyUSB0","open":false,"opened_tick":null,"bytes_in":0,
            "bytes_out":0,"last":"","serial":"9600-7e2"}}})";

/// Joins the lines of a text: a message is one line.
std::string one_line(std::string text) {
  std::erase(text, '\n');
  return text;
}

}  // namespace

std::string watched_hello(const std::string& access) {
  return R"({"op":"hello","proto":1,"server":"xr3 0.10.0","cell":"main","cells":["main"],)"
         R"("epoch":0,"tick":5,"tick_hz":1000,"clock":{"mode":"manual","rate":1.0},)"
         R"("robot":{"name":"Teaching arm","joints":["C","B"],"tool":"A"},"access":")" +
         access + R"(","channels":["state","image","event","line","display","model"]})";
}

std::string watched_state(const std::string& from, const std::string& to) {
  std::string state = one_line(kState);
  const std::size_t at = state.find(from);
  if (at == std::string::npos) throw std::invalid_argument(from + " is not in the state");
  return state.replace(at, from.size(), to);
}

std::string watched_lines() { return one_line(kLines); }

std::vector<std::string> watched_messages() {
  return {one_line(kModel), watched_state(),  one_line(kImage),
          one_line(kHomed), one_line(kMoved), one_line(kWarned)};
}

watch::WatchModel watched_model(watch::Wish wish) {
  watch::WatchModel model(std::move(wish));
  model.handle(watched_hello());
  for (const std::string& message : watched_messages()) model.handle(message);
  return model;
}

}  // namespace xr3::test
