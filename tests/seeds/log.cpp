#include "tests/seeds/log.hpp"

#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string_view>
#include <utility>

#include "tests/seeds/memory.hpp"

namespace xr3::seeds {
namespace {

std::string& logged_failure() {
  static std::string text;
  return text;
}

class Sink final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
  void sink_it_(const spdlog::details::log_msg& message) override {
    const Outside outside;
    const std::string_view text(message.payload.data(), message.payload.size());
    const bool tells_of_failure = text.find("has failed") != text.npos;
    if (tells_of_failure && logged_failure().empty()) logged_failure() = text;
  }
  void flush_() override {}
};

}  // namespace

void replace_log() {
  auto logger = std::make_shared<spdlog::logger>("seeds", std::make_shared<Sink>());
  logger->set_error_handler([](const std::string&) {});  // no memory to format a message
  spdlog::set_default_logger(std::move(logger));
  spdlog::set_level(spdlog::level::info);
}

std::string take_logged_failure() { return std::exchange(logged_failure(), {}); }

}  // namespace xr3::seeds
