// Commands of the serial line and their replies as text: a stable code and a short phrase. Only for
// executed commands; diagnostic.hpp has the texts for the others.
#pragma once

#include <string>
#include <string_view>

#include "protocol/explain/reply_decoder.hpp"
#include "protocol/explain/wire_record.hpp"

namespace xr3 {

struct CommandText {
  std::string_view code;  ///< stable, the name in data/commands.json, such as `move`
  std::string phrase;     ///< the command's effect or inquiry, such as `move E +5, counter 5`
};

CommandText command_text(const wire::Executed& executed);

/// The code without the phrase.
std::string_view code_of(const Command& command);

struct ReplyText {
  std::string_view code;  ///< stable, such as `reply_error`
  std::string phrase;     ///< the meaning, such as `E: 4 counts to go`
};

/// `context` gives the joints of the switch bits and the profile of the reply's bytes.
ReplyText reply_text(const wire::Answered& answered, const ReplyContext& context);

}  // namespace xr3
