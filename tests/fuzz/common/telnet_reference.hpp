// A simple telnet server with RFC 2217 for comparison: it looks at whole commands instead of single
// bytes, and keeps all it knows in maps. From RFC 854, 855, 1143 and 2217.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace xr3::fuzz {

class TelnetReference {
 public:
  /// `robot` returns the replies to a byte of data. With `most_held` bytes of held replies the
  /// input is taken as ended before the next byte of data.
  TelnetReference(std::function<std::string(char)> robot, std::size_t most_held);

  /// The bytes that a client receives who sends all these bytes and then ends its sending side.
  std::string all_sent(std::string_view bytes);

 private:
  struct Unit;
  using Option = std::pair<bool, unsigned char>;  ///< whether it is the client's, and its number

  Unit first_unit(std::string_view rest) const;
  void handle(const Unit& unit);
  void option(unsigned char verb, unsigned char option);
  void request(std::string_view content);
  void set(char code, std::string value);
  void control(char value);
  void answer(std::string_view answer);
  void reply(std::string_view replies);
  void resume();
  bool has_com_port() const;

  std::function<std::string(char)> robot_;
  std::size_t most_held_;
  std::string sent_;
  std::string held_;
  bool is_telnet_ = false;
  bool is_suspended_ = false;
  bool has_ended_ = false;
  std::set<Option> on_;
  std::map<char, std::string> settings_;
  std::map<char, char> controls_;  ///< by the value that asks
};

}  // namespace xr3::fuzz
