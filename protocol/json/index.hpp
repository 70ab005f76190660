// Builds the index of a JSON text: follows the parser's events and finds the position of each value
// and name.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/json/document.hpp"
#include "protocol/json/long_token.hpp"

namespace xr3 {

class JsonIndexer : public nlohmann::json_sax<Json> {
 public:
  explicit JsonIndexer(JsonDocument& document) : document_(document) {}

  /// Fills the document's index, or sets its fault.
  void run();

  bool null() override { return word(); }
  bool boolean(bool) override { return word(); }
  bool number_integer(number_integer_t) override { return number(); }
  bool number_unsigned(number_unsigned_t) override { return number(); }
  bool number_float(number_float_t, const string_t&) override { return number(); }
  bool string(string_t&) override { return text(0); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(); }
  bool start_array(std::size_t) override { return open(); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t&) override { return text(JsonDocument::kIsName); }
  bool parse_error(std::size_t position, const std::string& last_token,
                   const nlohmann::detail::exception& error) override;

 private:
  void complain_of(const LongToken& wrong);
  void find_next();
  bool word();
  bool number();
  bool text(std::uint32_t flags);
  bool open();
  bool close();
  std::uint32_t next_index() const { return static_cast<std::uint32_t>(document_.tokens_.size()); }

  JsonDocument& document_;
  std::size_t at_ = 0;  ///< end of the last token
  std::vector<std::uint32_t> open_;
};

}  // namespace xr3
