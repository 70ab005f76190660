// Helpers for tests with requests of the monitor protocol: they are parsed and expected to be valid
// or invalid.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/monitor/request.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3::monitor {

using Pointers = std::vector<std::string>;

inline Pointers pointers_of(const RequestError& error) {
  Pointers pointers;
  for (const Detail& detail : error.details) pointers.push_back(detail.pointer);
  return pointers;
}

/// "message: pointer: found; allowed", for failure messages.
inline std::string words_of(const RequestError& error) {
  std::string words = error.message;
  for (const Detail& detail : error.details)
    words += "\n" + detail.pointer + ": " + detail.found.dump() + "; " + detail.allowed;
  return words;
}

inline Request good(const std::string& text) {
  RequestReading reading = read_request(text);
  const auto* error = std::get_if<RequestError>(&reading);
  EXPECT_EQ(error, nullptr) << text << ": " << (error == nullptr ? "" : words_of(*error));
  return error == nullptr ? std::get<Request>(std::move(reading)) : Request{};
}

inline RequestError bad(const std::string& text) {
  RequestReading reading = read_request(text);
  const auto* error = std::get_if<RequestError>(&reading);
  EXPECT_NE(error, nullptr) << text;
  return error == nullptr ? RequestError{} : *error;
}

inline std::string call_text(const std::string& fn, const std::string& args) {
  return R"({"op":"call","fn":")" + fn + R"(","args":)" + args + "}";
}

/// The value of a valid call of the cell.
template <class Call>
Call call_of(const std::string& fn, const std::string& args) {
  const Request request = good(call_text(fn, args));
  const auto* wanted = std::get_if<CallRequest>(&request.what);
  if (wanted == nullptr) return Call{};
  return std::get<Call>(std::get<call::Call>(wanted->call));
}

/// The pointers in the details of a refused call.
inline Pointers wrong_in(const std::string& fn, const std::string& args) {
  const RequestError error = bad(call_text(fn, args));
  EXPECT_EQ(error.code, "bad_args") << args;
  return pointers_of(error);
}

}  // namespace xr3::monitor
